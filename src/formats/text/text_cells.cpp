#include "formats/text/text_cells.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>

#include "formats/snapshot_format.h"
#include "snapshot/field_names.h"

namespace splotchcl {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

TextLines::TextLines(const MappedFile& file, std::uint64_t offset, std::uint64_t number)
    : data_(reinterpret_cast<const char*>(file.data())),
      size_(file.size()),
      offset_(offset),
      number_(number) {
  if (offset_ == 0) offset_ = size_ - text_of(file).size();
}

bool TextLines::next_of_all() {
  if (offset_ >= size_) return false;
  start_ = offset_;
  const void* const end = std::memchr(data_ + offset_, '\n', size_ - offset_);
  const std::uint64_t stop =
      end == nullptr ? size_ : static_cast<std::uint64_t>(static_cast<const char*>(end) - data_);
  offset_ = stop + 1;
  ++number_;
  whole_ = std::string_view(data_ + start_, stop - start_);
  line_ = without_blanks(whole_);
  return true;
}

bool TextLines::next() {
  while (next_of_all()) {
    if (!line_.empty()) return true;
  }
  return false;
}

namespace {

// Of a line in a frame. A bar at one end alone is beside an empty cell.
std::string_view without_bars(std::string_view line) {
  const bool is_framed = line.size() > 1 && line.front() == '|' && line.back() == '|';
  return is_framed ? line.substr(1, line.size() - 2) : line;
}

// Takes the next cell off the line.
std::string_view take_cell(std::string_view& line, char separator, bool& has_more) {
  if (separator == ' ') line = without_blanks(line);
  std::size_t end = 0;
  bool is_quoted = false;
  for (; end < line.size(); ++end) {
    const char c = line[end];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if (separator == ' ' ? c == ' ' || c == '\t' : c == separator) break;
  }
  std::string_view cell = without_blanks(line.substr(0, end));
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = without_blanks(cell.substr(1, cell.size() - 2));
  }
  has_more = end < line.size();
  line.remove_prefix(has_more ? end + 1 : end);
  return cell;
}

// Where a tab at the beginning or end means an empty cell, or blanks keep places, all of it.
std::string_view text_of(const TextLines& line, const CellFormat& format) {
  if (!format.places.empty() || format.separator == '\t') return line.whole();
  return format.separator == '|' ? without_bars(line.line()) : line.line();
}

std::optional<double> parse_plain(std::string_view text) {
  double value = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(value) : std::nullopt;
}

// Fortran leaves the letter out where an exponent has three digits: 1.5-103.
std::optional<double> parse_without_e(std::string_view cell) {
  constexpr std::size_t exponent = 4;
  if (cell.size() < 2 * exponent - 2 || cell.size() > 64) return std::nullopt;
  const std::size_t sign = cell.size() - exponent;
  const bool is_one = (cell[sign] == '-' || cell[sign] == '+') &&
                      cell.substr(0, sign).find('.') != std::string_view::npos;
  if (!is_one) return std::nullopt;
  return parse_plain(std::string(cell.substr(0, sign)) + "e" + std::string(cell.substr(sign)));
}

}  // namespace

const char* CellFormat::name() const {
  if (!places.empty()) return "columns of fixed places";
  if (separator == ',') return "commas between columns";
  if (separator == '\t') return "tabs between columns";
  if (separator == '|') return "bars between columns";
  return separator == ';' ? "semicolons between columns" : "white space between columns";
}

CellReader::CellReader(const TextLines& line, const CellFormat& format)
    : format_(format), rest_(text_of(line, format)) {}

bool CellReader::next() {
  if (!format_.places.empty()) {
    if (place_ == format_.places.size()) return false;
    const CellPlace& place = format_.places[place_++];
    const bool is_there = place.first < rest_.size();
    cell_ = is_there ? without_blanks(rest_.substr(place.first, place.count)) : std::string_view();
    return true;
  }
  if (!has_more_) return false;
  cell_ = take_cell(rest_, format_.separator, has_more_);
  return true;
}

std::vector<std::string_view> cells_of(const TextLines& line, const CellFormat& format) {
  std::vector<std::string_view> cells;
  CellReader reader(line, format);
  while (cells.size() < most_columns && reader.next())
    cells.push_back(reader.cell());
  return cells;
}

std::vector<std::string_view> split_cells(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (bool has_more = true; has_more && cells.size() < most_columns;)
    cells.push_back(take_cell(line, separator, has_more));
  return cells;
}

std::vector<char> possible_separators(std::string_view line) {
  constexpr std::string_view known = ";,|";
  std::string found;
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    if (!is_quoted && known.find(c) != std::string_view::npos) found += c;
  }
  std::vector<char> separators;
  for (const char c : known) {
    if (found.find(c) != std::string::npos) separators.push_back(c);
  }
  separators.push_back(' ');
  return separators;
}

bool is_missing(std::string_view cell) {
  constexpr std::array<std::string_view, 7> words = {"na", "n/a", "null",  "none",
                                                     "--", "---", "masked"};
  return cell.empty() || std::any_of(words.begin(), words.end(), [cell](std::string_view word) {
           return equal_ignoring_case(cell, word);
         });
}

std::optional<double> parse_cell(std::string_view cell, char decimal_mark) {
  if (is_missing(cell)) return std::numeric_limits<double>::quiet_NaN();
  if (decimal_mark == ',' && cell.find('.') != std::string_view::npos) return std::nullopt;
  if (cell.front() == '+') cell.remove_prefix(1);
  if (const auto value = parse_plain(cell)) return value;
  // Of countries with a decimal comma.
  const std::size_t comma = decimal_mark == '.' ? std::string_view::npos : cell.find(',');
  if (comma != std::string_view::npos && cell.size() <= 64) {
    std::string with_point(cell);
    with_point[comma] = '.';
    return parse_plain(with_point);
  }
  // Fortran's double precision: 1.5D+03.
  if (const auto value = parse_without_e(cell)) return value;
  const std::size_t exponent = cell.find_first_of("dD");
  if (exponent == std::string_view::npos || exponent == 0 || cell.size() > 64) return std::nullopt;
  std::string with_e(cell);
  with_e[exponent] = 'e';
  return parse_plain(with_e);
}

char find_decimal_mark(const std::vector<std::string_view>& cells) {
  char mark = 0;
  for (const std::string_view cell : cells) {
    const std::size_t place = cell.find_first_of(".,");
    if (place == std::string_view::npos || !parse_cell(cell)) continue;
    if (mark != '.') mark = cell[place];
  }
  return mark;
}

bool is_row(const std::vector<std::string_view>& cells) {
  constexpr std::ptrdiff_t fewest = 3;
  return std::count_if(cells.begin(), cells.end(), [](std::string_view cell) {
           return !is_missing(cell) && parse_cell(cell).has_value();
         }) >= fewest;
}

bool are_whole(const std::vector<std::string_view>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](std::string_view cell) {
    return cell.find_first_not_of("0123456789") == std::string_view::npos;
  });
}

}  // namespace splotchcl
