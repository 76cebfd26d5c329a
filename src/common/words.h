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

// The number that is all of the text, finite or not; a plus sign may stand before it.
std::optional<double> parse_number(const std::string& text);

// The whole number that is all of the text, in digits alone; none beyond 2^64 - 1.
std::optional<std::uint64_t> parse_whole_number(std::string_view text);

// The candidate that `name` is most likely a misspelling of, or none when nothing is
// near: more than a third of its letters would have to change. Case counts little.
std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& candidates);

// "; did you mean x?", or nothing.
std::string did_you_mean(const std::optional<std::string>& name);

}  // namespace splotchcl
