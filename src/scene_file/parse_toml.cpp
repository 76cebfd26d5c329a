#include "scene_file/parse_toml.h"

#include <cctype>
#include <cstddef>

namespace splotchcl::scene_file {
namespace {

constexpr int most_parts = 16;

// Goes through a text from string to string and from remark to remark.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  int find_deep_key() {
    while (at_ < text_.size()) {
      step();
      if (parts_ > most_parts) return line_;
    }
    return 0;
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') {
      skip_string(c);
    } else if (c == '#') {
      while (at_ < text_.size() && text_[at_] != '\n')
        ++at_;
    } else {
      take(c);
      ++at_;
    }
  }

  // Names, and blanks around dots, go on with a key; all else ends it.
  void take(char c) {
    if (c == '\n') ++line_;
    if (c == '.') {
      ++parts_;
    } else if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-' &&
               c != ' ' && c != '\t') {
      parts_ = 1;
    }
  }

  bool is_triple(char quote) const { return text_.compare(at_, 3, std::string(3, quote)) == 0; }

  // As a part of a key, if it is one.
  void skip_string(char quote) {
    const bool has_lines = is_triple(quote);
    at_ += has_lines ? 3 : 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        if (!has_lines) return;
        ++line_;
      }
      if (c == quote && (!has_lines || is_triple(quote))) {
        at_ += has_lines ? 3 : 1;
        return;
      }
      at_ += c == '\\' && quote == '"' ? 2 : 1;
    }
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1, parts_ = 1;
};

}  // namespace

int find_deep_key(const std::string& text) {
  return Scanner(text).find_deep_key();
}

// Twice before it is none: the parser reads numbers from a stream, which takes memory that it does
// not get for a number that it cannot read.
toml::table parse_toml(const std::string& text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error&) {
    return toml::parse(text);
  }
}

}  // namespace splotchcl::scene_file
