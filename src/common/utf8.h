#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace splotchcl {

struct Character {
  std::optional<char32_t> code;  // none: a byte that is no UTF-8
  std::string_view bytes;        // of the text
};

std::vector<Character> characters_of(std::string_view text);

// What a scene names must be UTF-8, as its file is. Throws UsageError.
void require_utf8(const std::string& text);

// Whether a terminal may obey it rather than show it: control characters, and those that turn the
// order of letters or end a line.
bool is_control(char32_t code);

// With a question mark for each of these, and for each byte that is no UTF-8.
std::string printable(std::string_view text);

}  // namespace splotchcl
