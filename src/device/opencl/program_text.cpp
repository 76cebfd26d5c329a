#include "device/opencl/program_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "device/opencl/device_traits.h"
#include "splotchcl/error.h"
#include "splotchcl_embedded/kernels.h"

namespace splotchcl {
namespace {

// Relaxed math is unfit for keys and for expm1.
constexpr char zero_denormals[] = "-cl-denorms-are-zero";
// As if opencl-c.h, of clang's headers, had been read.
constexpr char without_declarations[] = "-D_OPENCL_H_";
// What compilers have beyond the language (common.cl, flags.cl).
constexpr char with_prefetch[] = "-DHAS_PREFETCH";
constexpr char with_ballot[] = "-DHAS_BALLOT";
// Of who compiles a kernel several times (common.cl).
constexpr char with_bodies[] = "-DCALLS_BODIES";

std::string include_of(const std::string& file) {
  return "#include \"" + file + "\"\n";
}

std::string joined(const std::string& a, const std::string& b) {
  return a + (a.empty() || b.empty() ? "" : " ") + b;
}

std::string extras_of(const compute::device& device) {
  const Quirks quirks = quirks_of(device);
  const std::string extensions =
      joined(quirks.has_prefetch ? with_prefetch : "", quirks.has_ballot ? with_ballot : "");
  return joined(extensions, quirks.compiles_bodies_again ? with_bodies : "");
}

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

constexpr bool is_of_word(char letter) {
  return letter == '_' || (letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') ||
         (letter >= 'a' && letter <= 'z');
}

std::string_view name_in(std::string_view line) {
  const std::string_view name = line.substr(line.find(' ') + 1);
  return name.substr(0, name.find_first_of(" \n"));
}

// Each line of definitions, and whether a text mentions its name. Texts have ten thousand words:
// only those are looked up that begin as a name does.
class Mentions {
 public:
  explicit Mentions(std::string_view defines) {
    while (!defines.empty()) {
      const std::string_view line = defines.substr(0, defines.find('\n') + 1);
      lines_.push_back({line, false});
      places_[name_in(line)].push_back(lines_.size() - 1);
      begins_[place_of(name_in(line).front())] = true;
      defines.remove_prefix(line.size());
    }
  }

  // Comments count.
  void look_in(std::string_view text) {
    for (auto begin = text.begin(); begin != text.end();) {
      begin = std::find_if(begin, text.end(), is_of_word);
      const auto end = std::find_if_not(begin, text.end(), is_of_word);
      if (begin != end && begins_[place_of(*begin)])
        note({&*begin, static_cast<std::size_t>(end - begin)});
      begin = end;
    }
  }

  std::string mentioned_lines() const {
    std::string lines;
    for (const auto& [line, is_mentioned] : lines_) {
      if (is_mentioned) lines += line;
    }
    return lines;
  }

 private:
  static std::size_t place_of(char letter) { return static_cast<unsigned char>(letter); }

  void note(std::string_view word) {
    const auto known = places_.find(word);
    if (known == places_.end()) return;
    for (const std::size_t place : known->second)
      lines_[place].second = true;
  }

  std::vector<std::pair<std::string_view, bool>> lines_;
  std::map<std::string_view, std::vector<std::size_t>> places_;  // of lines, by name
  std::array<bool, 256> begins_{};
};

}  // namespace

std::string define(const std::string& choice) {
  return "#define " + choice + "\n";
}

ProgramSource program_source(const std::string& file, const Choices& choices) {
  ProgramSource source;
  source.file = file;
  for (const std::string& choice : choices)
    source.defines += define(choice);
  return source;
}

ProgramText text_of(const ProgramSource& source, const compute::device& device) {
  const std::string file = source.file.empty() ? "" : include_of(source.file);
  const std::string text = flattened(file + source.more);
  return {joined(source.denormals_are_zero ? zero_denormals : "", extras_of(device)),
          source.defines + mentioned(source.variant, text) + text};
}

ProgramText short_text_of(const ProgramText& text) {
  return {joined(without_declarations, text.options),
          flattened(include_of("kernels/common/builtins.h")) + text.source};
}

std::string mentioned(const std::string& defines, const std::string& text) {
  Mentions mentions(defines);
  mentions.look_in(text);
  return mentions.mentioned_lines();
}

std::string flattened(const std::string& source) {
  Flattener flattener;
  flattener.add_text(source);
  return flattener.text();
}

}  // namespace splotchcl
