#pragma once

#include <filesystem>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

// Texts and what is expected of each, as files. "== Name" begins a row: below it stand the lines of
// its text, and below these, each behind "-> ", what is expected. Further text below that is a row
// of the same name and a number. A line "-or-" divides texts of which the same is expected. In all
// "\n", "\t", "\r", "\0", "\x1f" and "\\" stand for these bytes, a "\" at a text's end for no end
// of its last line, and "${name}" for what a line "let name = text" above said. Lines that begin
// with "## " above a text, and blank ones there, are remarks.
namespace splotchcl::test {

struct TextRow {
  std::string name;
  std::vector<std::string> texts;
  std::vector<std::string> expected;
};

inline void PrintTo(const TextRow& row, std::ostream* out) {
  *out << row.name;
}

std::vector<TextRow> read_text_rows(const std::filesystem::path& file);

// Of floats or doubles; "nan" as well, which streams do not read.
template <class Number>
std::vector<Number> numbers_in(const std::string& text) {
  std::istringstream words(text);
  std::vector<Number> numbers;
  for (std::string word; words >> word;) {
    if constexpr (std::is_same_v<Number, float>) {
      numbers.push_back(std::stof(word));
    } else {
      numbers.push_back(std::stod(word));
    }
  }
  return numbers;
}

}  // namespace splotchcl::test
