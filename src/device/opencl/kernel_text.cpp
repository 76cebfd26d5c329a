#include "device/opencl/kernel_text.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <vector>

#include "splotchcl/error.h"
#include "splotchcl_embedded/kernels.h"

namespace splotchcl {
namespace {

std::string_view embedded_text(std::string_view name) {
  for (const embedded::TextFile& file : embedded::kernels()) {
    if (name == file.name) return file.text;
  }
  throw DeviceError("kernel source " + std::string(name) + " is not part of this build");
}

bool starts_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

// What #if asks for, and whether its first branch or #else is meant.
struct Condition {
  std::string asked;
  bool holds;
  bool operator==(const Condition& other) const {
    return std::tie(asked, holds) == std::tie(other.asked, other.holds);
  }
};
using Conditions = std::vector<Condition>;

class Flattener {
 public:
  void add_text(std::string_view rest) {
    while (!rest.empty()) {
      const std::size_t length = std::min(rest.find('\n'), rest.size() - 1) + 1;
      add_line(rest.substr(0, length));
      rest.remove_prefix(length);
    }
  }
  const std::string& text() const { return text_; }

 private:
  void add_file(const std::string& file) {
    if (is_known(file)) return;
    known_[file].push_back(conditions_);
    add_text(embedded_text(file));
  }

  void add_line(std::string_view line) {
    constexpr std::string_view include = "#include \"";
    if (starts_with(line, include)) {
      line.remove_prefix(include.size());
      add_file(std::string(line.substr(0, line.find('"'))));
      return;
    }
    // Each file is put in once, and is all one file then.
    if (starts_with(line, "#pragma once")) return;
    if (starts_with(line, "#")) follow(line);
    text_ += line;
  }

  void follow(std::string_view line) {
    const std::string_view asked = line.substr(std::min(line.find(' '), line.size()));
    if (starts_with(line, "#if")) {
      conditions_.push_back(condition_of(asked, starts_with(line, "#ifndef")));
    } else if (starts_with(line, "#elif")) {
      conditions_.back() = {conditions_.back().asked + std::string(asked), true};
    } else if (starts_with(line, "#else")) {
      conditions_.back().holds = !conditions_.back().holds;
    } else if (starts_with(line, "#endif")) {
      conditions_.pop_back();
    }
  }

  // `#if !NAME` asks for the same as `#if NAME`, of one name.
  static Condition condition_of(std::string_view asked, bool is_negative) {
    const bool is_of_one = asked.find("&&") == asked.npos && asked.find("||") == asked.npos;
    if (!starts_with(asked, " !") || !is_of_one) return {std::string(asked), !is_negative};
    return {" " + std::string(asked.substr(2)), is_negative};
  }

  bool is_known(const std::string& file) {
    const std::vector<Conditions>& places = known_[file];
    return std::any_of(places.begin(), places.end(), [this](const Conditions& place) {
      return std::all_of(place.begin(), place.end(), [this](const Condition& condition) {
        return std::find(conditions_.begin(), conditions_.end(), condition) != conditions_.end();
      });
    });
  }

  std::string text_;
  Conditions conditions_;                                 // around the line that is read
  std::map<std::string, std::vector<Conditions>> known_;  // around what has been put in
};

bool is_of_word(char letter) {
  return letter == '_' || std::isalnum(static_cast<unsigned char>(letter)) != 0;
}

// Beginning with a letter or a digit; of comments, too.
std::set<std::string_view> words_of(std::string_view text) {
  std::set<std::string_view> words;
  for (auto begin = text.begin(); begin != text.end();) {
    begin = std::find_if(begin, text.end(), is_of_word);
    const auto end = std::find_if_not(begin, text.end(), is_of_word);
    if (begin != end) words.insert({&*begin, static_cast<std::size_t>(end - begin)});
    begin = end;
  }
  return words;
}

}  // namespace

std::string mentioned(const std::string& defines, const std::string& text) {
  const std::set<std::string_view> words = words_of(text);
  std::string lines;
  for (std::string_view rest = defines; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n') + 1);
    const std::string_view name = line.substr(line.find(' ') + 1);
    if (words.count(name.substr(0, name.find_first_of(" \n"))) > 0) lines += line;
    rest.remove_prefix(line.size());
  }
  return lines;
}

std::string flattened(const std::string& source) {
  Flattener flattener;
  flattener.add_text(source);
  return flattener.text();
}

}  // namespace splotchcl
