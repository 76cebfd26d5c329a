#include "arguments.h"

#include <cstdio>
#include <exception>

#include "splotchcl/error.h"

namespace splotchcl::bench {
namespace {

const char* const help_option = "help: shows this";

std::string before(const std::string& text, const char* ends) {
  return text.substr(0, text.find_first_of(ends));
}

bool takes_value(const std::string& option) {
  return before(option, ":").find('=') != std::string::npos;
}

}  // namespace

Arguments::Arguments(int count, const char* const* words, const std::vector<std::string>& options)
    : options_(options) {
  options_.push_back(help_option);
  for (int i = 1; i < count; ++i) {
    const std::string given = words[i], word = before(given, "=");
    const std::string* known = nullptr;
    for (const std::string& option : options_) {
      if (word == "--" + before(option, "=:")) known = &option;
    }
    if (known == nullptr) {
      throw UsageError("found '" + given + "', expected one of these options:\n" + help());
    }
    std::string value;
    if (word != given) {
      if (!takes_value(*known)) throw UsageError(word + ": found a value behind it, expected none");
      value = given.substr(word.size() + 1);
    } else if (takes_value(*known)) {
      if (++i == count) throw UsageError(word + ": found nothing after it, expected a value");
      value = words[i];
    }
    values_[word.substr(2)] = value;
  }
}

std::string Arguments::help() const {
  std::string text;
  for (const std::string& option : options_)
    text += "  --" + option + "\n";
  return text;
}

std::string Arguments::text(const std::string& name, const std::string& otherwise) const {
  const auto found = values_.find(name);
  return found == values_.end() ? otherwise : found->second;
}

int Arguments::number(const std::string& name, int otherwise) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return otherwise;
  std::size_t used = 0;
  int value = 0;
  try {
    value = std::stoi(found->second, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != found->second.size() || value < 1) {
    throw UsageError("--" + name + ": found '" + found->second +
                     "', expected a whole number above 0");
  }
  return value;
}

int run_main(int count, char** words, const std::vector<std::string>& options,
             void (*benchmark)(const Arguments&)) {
  try {
    const Arguments arguments(count, words, options);
    if (arguments.wants_help()) {
      std::printf("%s", arguments.help().c_str());
    } else {
      benchmark(arguments);
    }
    return 0;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "%s: %s\n", words[0], error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", words[0], error.what());
    return 1;
  }
}

}  // namespace splotchcl::bench
