#include "common/words.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <limits>
#include <system_error>
#include <utility>

#include "splotchcl/error.h"

namespace splotchcl {

std::string trimmed(const std::string& text, const char* characters) {
  const std::size_t first = text.find_first_not_of(characters);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(characters) - first + 1);
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string lower_ending(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

bool is_hdf5_ending(const std::string& lower_ending) {
  return lower_ending == ".hdf5" || lower_ending == ".h5";
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

std::optional<double> parse_number(const std::string& text) {
  const char* const end = text.data() + text.size();
  const char* const begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  double value = 0;
  const auto [rest, error] = fast_float::from_chars(begin, end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> parse_whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  const bool is_all = error == std::errc() && rest == end;
  return is_all ? std::optional(number) : std::nullopt;
}

namespace {

// Beyond this nobody mistypes a name; it also bounds the work for hostile input.
constexpr std::size_t longest_name = 200;

// Insertions, deletions, changes and swaps of neighbours that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::size_t largest_distance(const std::string& a, const std::string& b) {
  return std::max<std::size_t>(1, std::max(a.size(), b.size()) / 3);
}

}  // namespace

std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& candidates) {
  if (name.size() > longest_name) return std::nullopt;
  const std::string wanted = lower_case(name);
  std::optional<std::string> nearest;
  std::size_t nearest_distance = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(wanted, lower_case(candidate));
    if (distance < nearest_distance && distance <= largest_distance(wanted, candidate)) {
      nearest = candidate;
      nearest_distance = distance;
    }
  }
  return nearest;
}

std::string counted(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string did_you_mean(const std::optional<std::string>& name) {
  return name ? "; did you mean " + *name + "?" : "";
}

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

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
