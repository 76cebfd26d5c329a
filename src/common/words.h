#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace splotchcl {

// Without the blanks, or other characters, around it.
std::string trimmed(const std::string& text, const char* characters = " \t\r\n");

// The letters of ASCII.
std::string lower_case(std::string text);

// A path's ending in lower case: ".toml"; empty where it has none.
std::string lower_ending(const std::filesystem::path& path);
// Of an HDF5 file.
bool is_hdf5_ending(const std::string& lower_ending);

// Where a file lies, as a path that can be opened: of a name alone ".".
std::filesystem::path folder_of(const std::filesystem::path& file);

// The number that is all of the text, finite or not; a plus sign may stand before it.
std::optional<double> parse_number(const std::string& text);

// The whole number that is all of the text, in digits alone; none beyond 2^64 - 1.
std::optional<std::uint64_t> parse_whole_number(std::string_view text);

// The candidate that `name` is most likely a misspelling of, or none when nothing is
// near: more than a third of its letters would have to change. Case counts little.
std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& candidates);

// "1 frame", "2 frames".
std::string counted(std::uint64_t count, const std::string& noun);

// "; did you mean x?", or nothing.
std::string did_you_mean(const std::optional<std::string>& name);

// What the system says of an errno.
std::string reason(int error_number);

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
