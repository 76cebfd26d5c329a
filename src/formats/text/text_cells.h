#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/mapped_file.h"

namespace splotchcl {

// Goes through the lines of a file that are not blank.
class TextLines {
 public:
  // From a place in the file, before which so many lines are.
  explicit TextLines(const MappedFile& file, std::uint64_t offset = 0, std::uint64_t number = 0);

  bool next();
  // The same, blank lines too.
  bool next_of_all();

  std::string_view line() const { return line_; }    // without blanks around it
  std::string_view whole() const { return whole_; }  // with them
  bool begins_with_blank() const { return !whole_.empty() && whole_.data() != line_.data(); }
  std::uint64_t number() const { return number_; }  // from 1
  std::uint64_t start() const { return start_; }
  std::uint64_t end() const { return offset_; }  // where the next one begins

 private:
  const char* data_;
  std::uint64_t size_, offset_, number_;
  std::uint64_t start_ = 0;
  std::string_view line_, whole_;
};

std::string_view without_blanks(std::string_view text);

// Where a cell is in each line.
struct CellPlace {
  std::size_t first = 0, count = 0;
};

// How the cells of a line are apart.
struct CellFormat {
  // A blank: any white space. A bar: those at both ends of the line count for nothing.
  char separator = ' ';
  std::vector<CellPlace> places;  // not empty: each has its place instead
  // What stands before the digits behind the point; 0: no number has told, a point or a comma.
  char decimal_mark = 0;

  const char* name() const;  // of what is between columns
};

// Takes the cells of a line one by one, without quotes and blanks around them.
class CellReader {
 public:
  CellReader(const TextLines& line, const CellFormat& format);
  bool next();
  std::string_view cell() const { return cell_; }

 private:
  const CellFormat& format_;
  std::string_view rest_, cell_;
  std::size_t place_ = 0;
  bool has_more_ = true;
};

// Of one line, or of its text; no more than any table has.
std::vector<std::string_view> cells_of(const TextLines& line, const CellFormat& format);
std::vector<std::string_view> split_cells(std::string_view line, char separator);

// What may separate the cells of a line, likeliest first: a semicolon, a comma or a bar outside of
// quotes, and white space. A comma may be that of a number, and a bar part of a word.
std::vector<char> possible_separators(std::string_view line);

// Between names of columns, in the order in which they are tried.
constexpr char separators_of_names[] = {',', ';', '|', '\t', ' '};

// Whether a cell says that there is no number.
bool is_missing(std::string_view cell);
// A number; not-a-number where the cell says that there is none. Where the decimal mark is known,
// the other one would be that of thousands: no number.
std::optional<double> parse_cell(std::string_view cell, char decimal_mark = 0);

// The mark of the numbers in a row, a point where they have both; 0 where none has one.
char find_decimal_mark(const std::vector<std::string_view>& cells);

// Whether there are as many numbers as a particle has at least.
bool is_row(const std::vector<std::string_view>& cells);
// Whether all are digits alone.
bool are_whole(const std::vector<std::string_view>& cells);

}  // namespace splotchcl
