#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace splotchcl {

// Without the blanks, or other characters, around it.
std::string trimmed(const std::string& text, const char* characters = " \t\r\n");

// The letters of ASCII.
std::string lower_case(std::string text);

// A path's ending in lower case: ".toml"; empty where it has none.
std::string lower_ending(const std::filesystem::path& path);

// The number that is all of the text, finite or not; a plus sign may stand before it.
std::optional<double> parse_number(const std::string& text);

}  // namespace splotchcl
