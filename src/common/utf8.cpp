#include "common/utf8.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// How many bytes follow a first one, which of its bits count, and from which code on so many are
// needed.
struct Lead {
  unsigned mask, value;
  std::size_t following;
  char32_t first_code;
};
constexpr std::array<Lead, 4> leads = {
    {{0x80, 0x00, 0, 0}, {0xe0, 0xc0, 1, 0x80}, {0xf0, 0xe0, 2, 0x800}, {0xf8, 0xf0, 3, 0x10000}}};

bool is_code(char32_t code, const Lead& lead) {
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return code >= lead.first_code && code <= 0x10ffff && !is_surrogate;
}

// The one that the text, which is not empty, begins with.
Character first_of(std::string_view text) {
  const Character none = {std::nullopt, text.substr(0, 1)};
  const unsigned first = static_cast<unsigned char>(text.front());
  const auto* const lead = std::find_if(leads.begin(), leads.end(), [first](const Lead& known) {
    return (first & known.mask) == known.value;
  });
  if (lead == leads.end() || text.size() <= lead->following) return none;
  char32_t code = first & ~lead->mask;
  for (const char c : text.substr(1, lead->following)) {
    const unsigned byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0U) != 0x80U) return none;
    code = code << 6 | (byte & 0x3fU);
  }
  if (!is_code(code, *lead)) return none;
  return {code, text.substr(0, 1 + lead->following)};
}

}  // namespace

std::vector<Character> characters_of(std::string_view text) {
  std::vector<Character> characters;
  while (!text.empty()) {
    characters.push_back(first_of(text));
    text.remove_prefix(characters.back().bytes.size());
  }
  return characters;
}

void require_utf8(const std::string& text) {
  for (const Character& character : characters_of(text)) {
    if (character.code) continue;
    throw UsageError(
        "\"" + printable(text) +
        "\" is not UTF-8, expected UTF-8 as in all scenes: rename the file, or give it "
        "a link whose name is");
  }
}

bool is_control(char32_t code) {
  constexpr std::array<std::array<char32_t, 2>, 6> ranges = {{{0, 0x1f},
                                                              {0x7f, 0x9f},
                                                              {0x61c, 0x61c},
                                                              {0x200e, 0x200f},
                                                              {0x2028, 0x202e},
                                                              {0x2066, 0x2069}}};
  return std::any_of(ranges.begin(), ranges.end(),
                     [code](const auto& range) { return code >= range[0] && code <= range[1]; });
}

std::string printable(std::string_view text) {
  std::string result;
  for (const Character& character : characters_of(text)) {
    if (character.code && !is_control(*character.code)) {
      result += character.bytes;
    } else {
      result += '?';
    }
  }
  return result;
}

}  // namespace splotchcl
