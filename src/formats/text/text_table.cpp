// Delimited text: a header with the names of the columns, then a line of numbers for each
// particle, separated by commas, semicolons or white space.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include "formats/snapshot_format.h"
#include "formats/table.h"
#include "formats/table_names.h"
#include "formats/text/table_header.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";  // some spreadsheets begin with it

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_comment(std::string_view line) {
  return line.front() == '#' || line.front() == '%' || line.front() == '!' ||
         line.substr(0, 2) == "//";
}

// Goes through the lines of a file that are not blank.
class Lines {
 public:
  explicit Lines(const MappedFile& file, std::uint64_t offset = 0, std::uint64_t number = 0)
      : data_(reinterpret_cast<const char*>(file.data())),
        size_(file.size()),
        offset_(offset),
        number_(number) {
    if (offset_ == 0 &&
        std::string_view(data_, size_).substr(0, byte_order_mark.size()) == byte_order_mark) {
      offset_ = byte_order_mark.size();
    }
  }

  bool next() {
    while (offset_ < size_) {
      start_ = offset_;
      const void* const end = std::memchr(data_ + offset_, '\n', size_ - offset_);
      const std::uint64_t stop =
          end == nullptr ? size_
                         : static_cast<std::uint64_t>(static_cast<const char*>(end) - data_);
      offset_ = stop + 1;
      ++number_;
      whole_ = std::string_view(data_ + start_, stop - start_);
      line_ = trim(whole_);
      begins_with_blank_ = data_[start_] == ' ' || data_[start_] == '\t';
      if (!line_.empty()) return true;
    }
    return false;
  }
  std::string_view line() const { return line_; }
  // Where a tab at the beginning or end means an empty cell.
  std::string_view line(char separator) const { return separator == '\t' ? whole_ : line_; }
  bool begins_with_blank() const { return begins_with_blank_; }
  std::uint64_t number() const { return number_; }  // from 1
  std::uint64_t start() const { return start_; }

 private:
  const char* data_;
  std::uint64_t size_, offset_, number_;
  std::uint64_t start_ = 0;
  std::string_view line_, whole_;
  bool begins_with_blank_ = false;
};

// The separator of a line: a semicolon or comma outside of quotes, else white space. Between
// semicolons a comma may be that of a number.
char find_separator(std::string_view line) {
  bool is_quoted = false;
  char separator = ' ';
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    if (!is_quoted && c == ';') return c;
    if (!is_quoted && c == ',') separator = c;
  }
  return separator;
}

// Takes the next cell off the line, without quotes and blanks around it.
std::string_view take_cell(std::string_view& line, char separator, bool& has_more) {
  if (separator == ' ') line = trim(line);
  std::size_t end = 0;
  bool is_quoted = false;
  for (; end < line.size(); ++end) {
    const char c = line[end];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if (separator == ' ' ? c == ' ' || c == '\t' : c == separator) break;
  }
  std::string_view cell = trim(line.substr(0, end));
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = trim(cell.substr(1, cell.size() - 2));
  }
  has_more = end < line.size();
  line.remove_prefix(has_more ? end + 1 : end);
  return cell;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (bool has_more = true; has_more && cells.size() < most_columns;) {
    cells.push_back(take_cell(line, separator, has_more));
  }
  return cells;
}

bool is_missing(std::string_view cell) {
  constexpr std::array<std::string_view, 6> words = {"na", "n/a", "null", "none", "--", "masked"};
  return cell.empty() || std::any_of(words.begin(), words.end(), [cell](std::string_view word) {
           return equal_ignoring_case(cell, word);
         });
}

std::optional<double> parse_plain(std::string_view text) {
  double value = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(value) : std::nullopt;
}

// A number; not-a-number where the cell says that there is none.
std::optional<double> parse_number(std::string_view cell) {
  if (is_missing(cell)) return std::numeric_limits<double>::quiet_NaN();
  if (cell.front() == '+') cell.remove_prefix(1);
  if (const auto value = parse_plain(cell)) return value;
  // Of countries with a decimal comma: no cell between commas has one.
  const std::size_t comma = cell.find(',');
  if (comma != std::string_view::npos && cell.size() <= 64) {
    std::string with_point(cell);
    with_point[comma] = '.';
    return parse_plain(with_point);
  }
  // Fortran's double precision: 1.5D+03.
  const std::size_t exponent = cell.find_first_of("dD");
  if (exponent == std::string_view::npos || exponent == 0 || cell.size() > 64) return std::nullopt;
  std::string with_e(cell);
  with_e[exponent] = 'e';
  return parse_plain(with_e);
}

struct Layout {
  char separator = ' ';
  std::vector<std::string> names;       // from the header; empty where there is none
  std::vector<std::string_view> cells;  // of the first row
  std::uint64_t first_row = 0;          // its place in the file
  std::uint64_t lines_before = 0;
};

// A unit in brackets belongs to the name before it: "x [kpc] y [kpc]" are two names.
std::vector<std::string> with_units(const std::vector<std::string_view>& words) {
  std::vector<std::string> names;
  char closing = 0;  // of the bracket that is open
  for (const std::string_view word : words) {
    const bool is_bracket = !word.empty() && (word.front() == '[' || word.front() == '(');
    const bool opens = closing == 0 && !names.empty() && is_bracket;
    const bool continues = closing != 0;
    if (opens) closing = word.front() == '[' ? ']' : ')';
    if (opens || continues) {
      names.back() += ' ';
      names.back() += word;
    } else {
      names.emplace_back(word);
    }
    if (closing != 0 && !word.empty() && word.back() == closing) closing = 0;
  }
  return names;
}

// The words of a line as names of columns; none where they are not as many as wanted. The first
// may be empty: tables of data frames begin with a column of row numbers that has no name.
std::vector<std::string> names_in(std::string_view line, std::size_t wanted) {
  for (const char candidate : {',', ';', ' '}) {
    const std::vector<std::string_view> words = split(line, candidate);
    // Lines of SPLASH end in a comma.
    const auto end = words.end() - (words.size() > 2 && words.back().empty() ? 1 : 0);
    const bool is_complete =
        words.size() == wanted &&
        std::none_of(words.begin() + 1, end, [](std::string_view word) { return word.empty(); });
    if (is_complete) return {words.begin(), words.end()};
  }
  const bool is_empty = trim(line).empty();
  const std::vector<std::string> names =
      is_empty ? std::vector<std::string>() : with_units(split(line, ' '));
  if (names.size() == wanted) return names;
  const std::vector<std::string> far_apart = words_far_apart(line);
  return far_apart.size() == wanted ? far_apart : std::vector<std::string>();
}

// As above, where a tab or blank before the first name stands for an empty one.
std::vector<std::string> names_in_line(const std::string_view line, bool begins_with_blank,
                                       std::size_t wanted) {
  std::vector<std::string> names = names_in(line, wanted);
  if (!names.empty() || !begins_with_blank || wanted == 0) return names;
  names = names_in(line, wanted - 1);
  if (!names.empty()) names.insert(names.begin(), "");
  return names;
}

bool is_row(const std::vector<std::string_view>& cells) {
  constexpr std::ptrdiff_t fewest = 3;
  return std::count_if(cells.begin(), cells.end(), [](std::string_view cell) {
           return !is_missing(cell) && parse_number(cell).has_value();
         }) >= fewest;
}

bool are_whole(const std::vector<std::string_view>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](std::string_view cell) {
    return cell.find_first_not_of("0123456789") == std::string_view::npos;
  });
}

// What may hold the names of columns.
struct Header {
  std::vector<std::string_view> comments;
  std::string_view line;  // that is no comment; empty where there is none
  std::string_view whole_line;
  bool begins_with_blank = false;
};

bool name_positions(const std::vector<std::string>& names) {
  std::vector<TableColumn> columns;
  for (const std::string& name : names)
    columns.push_back({name, 1});
  return find_positions(columns).has_value();
}

// The comment whose words are as many as the columns: of several the last that names positions,
// else the last.
std::vector<std::string> names_in_comments(const std::vector<std::string_view>& comments,
                                           std::size_t wanted) {
  std::vector<std::string> last = names_by_number(comments, wanted);
  if (!last.empty()) return last;
  for (auto comment = comments.rbegin(); comment != comments.rend(); ++comment) {
    std::vector<std::string> names = names_in_columns(*comment);
    if (names.size() != wanted) names = in_our_words(names_in(trim(*comment), wanted));
    if (names.size() != wanted) continue;
    if (name_positions(names)) return names;
    if (last.empty()) last = std::move(names);
  }
  return last;
}

std::vector<std::string> names_in(const Header& header, std::size_t wanted) {
  if (header.line.empty()) return names_in_comments(header.comments, wanted);
  std::vector<std::string> names =
      in_our_words(names_in_line(header.line, header.begins_with_blank, wanted));
  add_ecsv_units(header.comments, names);
  return names;
}

// Whether the line of names has so many of them apart by tabs: cells may then be empty.
bool has_tabs(const Header& header, std::size_t columns) {
  if (header.line.find('\t') == std::string_view::npos) return false;
  const std::vector<std::string_view> names = split(header.whole_line, '\t');
  return names.size() == columns && std::none_of(names.begin(), names.end(), is_missing);
}

std::vector<std::string> names_between_tabs(const Header& header) {
  const std::vector<std::string_view> names = split(header.whole_line, '\t');
  return in_our_words({names.begin(), names.end()});
}

std::string_view without_mark(std::string_view comment) {
  comment.remove_prefix(comment.substr(0, 2) == "//" ? 2 : 1);
  return comment;
}

// The first row of numbers, after comments and at most one other line, and the names before
// it. None where the file is not a table.
std::optional<Layout> find_layout(const MappedFile& file) {
  constexpr std::uint64_t farthest_row = 1U << 20;  // a text that is no table is given up
  Header header;
  Lines lines(file);
  while (lines.next() && lines.start() < farthest_row) {
    const std::string_view line = lines.line();
    if (line.find('\0') != std::string_view::npos) return std::nullopt;
    if (is_comment(line)) {
      header.comments.push_back(without_mark(line));
      continue;
    }
    Layout layout;
    layout.separator = find_separator(line);
    layout.cells = split(line, layout.separator);
    const std::vector<std::string_view> apart_by_tabs = split(lines.line('\t'), '\t');
    if (layout.separator == ' ' && is_row(apart_by_tabs) &&
        has_tabs(header, apart_by_tabs.size())) {
      layout.separator = '\t';
      layout.cells = apart_by_tabs;
    }
    if (is_row(layout.cells)) {
      layout.first_row = lines.start();
      layout.lines_before = lines.number() - 1;
      layout.names = layout.separator == '\t' ? names_between_tabs(header)
                                              : names_in(header, layout.cells.size());
      if (!header.line.empty() && layout.names.empty()) return std::nullopt;
      return layout;
    }
    if (!header.line.empty()) return std::nullopt;
    header.line = line;
    header.whole_line = lines.line('\t');
    header.begins_with_blank = lines.begins_with_blank();
  }
  return std::nullopt;
}

class TextTable : public Table {
 public:
  TextTable(std::shared_ptr<const MappedFile> file, const std::vector<std::string>& names,
            std::vector<std::string>& notes);

  const std::vector<TableColumn>& columns() const override { return columns_; }
  std::uint64_t rows() const override { return rows_; }
  void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const override;
  bool is_single_precision(std::size_t) const override { return false; }
  std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const override;

 private:
  struct WantedCell {
    std::size_t cell;
    std::size_t place;  // among the wanted values
  };
  void leave_out_line_of_counts(std::vector<std::string>& notes);
  void read_row(const Lines& line, const std::vector<WantedCell>& wanted, double* values) const;
  [[noreturn]] void fail(const Lines& line, const std::string& what) const;

  std::shared_ptr<const MappedFile> file_;
  Layout layout_;
  std::vector<TableColumn> columns_;
  std::vector<std::size_t> cells_;  // which cell of a row each column is
  std::uint64_t rows_ = 0;
};

TextTable::TextTable(std::shared_ptr<const MappedFile> file, const std::vector<std::string>& names,
                     std::vector<std::string>& notes)
    : file_(std::move(file)) {
  const std::string path = file_->path().string();
  std::optional<Layout> layout = find_layout(*file_);
  if (!layout) throw DataError(path + ": not a table of numbers any more; is it being written?");
  layout_ = std::move(*layout);
  const std::size_t width = layout_.cells.size();
  const std::vector<std::string>& wanted = names.empty() ? layout_.names : names;
  if (wanted.empty()) {
    throw DataError(fmt::format(
        "{}: a table of {} columns without a header that names them; name them in their order, as "
        "in read.columns = [\"x\", \"y\", \"z\", \"mass\"]",
        path, width));
  }
  if (wanted.size() != width) {
    throw UsageError(fmt::format(
        "{}: line {} has {} columns, but read.columns names {}; name each of them (\"-\" for those "
        "that are not needed)",
        path, layout_.lines_before + 1, width, wanted.size()));
  }
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < width; ++i) {
    if (wanted[i] == "-") continue;
    if (wanted[i].empty()) {
      notes.push_back(fmt::format("column {} left out, as it has no name", i + 1));
    } else if (parse_number(layout_.cells[i])) {
      columns_.push_back({wanted[i], 1});
      cells_.push_back(i);
    } else {
      left_out.push_back(wanted[i]);
    }
  }
  if (!left_out.empty()) {
    notes.push_back(fmt::format("columns left out, as they do not hold numbers: {}",
                                fmt::join(left_out, ", ")));
  }
  Lines lines(*file_, layout_.first_row, layout_.lines_before);
  while (lines.next()) {
    if (!is_comment(lines.line())) ++rows_;
  }
  if (!names.empty()) leave_out_line_of_counts(notes);
}

// Some codes write first how many rows there are. As a row it would be a particle: unlike one it is
// all of whole numbers, of which the first is that of the rows.
void TextTable::leave_out_line_of_counts(std::vector<std::string>& notes) {
  const bool counts_rows = parse_number(layout_.cells.front()) == static_cast<double>(rows_ - 1);
  if (!counts_rows || !are_whole(layout_.cells)) return;
  Lines lines(*file_, layout_.first_row, layout_.lines_before);
  lines.next();
  const std::uint64_t number = lines.number();
  while (lines.next() && is_comment(lines.line())) {
  }
  if (are_whole(split(lines.line(), layout_.separator))) return;
  notes.push_back(
      fmt::format("line {} is left out: it tells the number of rows, {}", number, rows_ - 1));
  layout_.first_row = lines.start();
  layout_.lines_before = lines.number() - 1;
  --rows_;
}

void TextTable::fail(const Lines& line, const std::string& what) const {
  throw DataError(fmt::format("{}: line {}: {}; the file is truncated or damaged: write it again",
                              file_->path().string(), line.number(), what));
}

void TextTable::read_row(const Lines& line, const std::vector<WantedCell>& wanted,
                         double* values) const {
  std::string_view rest = line.line(layout_.separator);
  auto next = wanted.begin();
  std::size_t cells = 0;
  for (bool has_more = true; has_more; ++cells) {
    const std::string_view cell = take_cell(rest, layout_.separator, has_more);
    for (; next != wanted.end() && next->cell == cells; ++next) {
      const std::optional<double> value = parse_number(cell);
      if (!value) fail(line, fmt::format("found '{}', expected a number", cell.substr(0, 40)));
      values[next->place] = *value;
    }
  }
  const std::size_t expected = layout_.cells.size();
  if (cells != expected) {
    fail(line, fmt::format("found {} values, expected {} as in the first row", cells, expected));
  }
}

void TextTable::for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const {
  std::vector<WantedCell> cells;
  for (std::size_t place = 0; place < wanted.size(); ++place) {
    cells.push_back({cells_[wanted[place].column], place});
  }
  std::sort(cells.begin(), cells.end(),
            [](const WantedCell& a, const WantedCell& b) { return a.cell < b.cell; });
  std::vector<double> values(wanted.size());
  file_->check_size();
  Lines lines(*file_, layout_.first_row, layout_.lines_before);
  while (lines.next()) {
    if (is_comment(lines.line())) continue;
    read_row(lines, cells, values.data());
    use(values.data());
  }
}

std::optional<std::vector<std::uint64_t>> TextTable::integers(std::size_t column) const {
  std::vector<std::uint64_t> values;
  Lines lines(*file_, layout_.first_row, layout_.lines_before);
  while (lines.next()) {
    if (is_comment(lines.line())) continue;
    const std::vector<std::string_view> cells =
        split(lines.line(layout_.separator), layout_.separator);
    if (cells.size() <= cells_[column]) return std::nullopt;
    const std::string_view cell = cells[cells_[column]];
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
    values.push_back(value);
  }
  return values;
}

const char* separator_name(char separator) {
  if (separator == ',') return "commas";
  if (separator == '\t') return "tabs";
  return separator == ';' ? "semicolons" : "white space";
}

class TextTableFormat : public SnapshotFormat {
 public:
  bool recognizes(const std::shared_ptr<const MappedFile>& file) const override {
    return find_layout(*file).has_value();
  }
  std::unique_ptr<Snapshot> open(const std::filesystem::path& path,
                                 const SnapshotOptions& options) const override {
    auto file = MappedFile::open(path);
    SnapshotInfo info;
    const std::optional<Layout> layout = find_layout(*file);
    info.format = fmt::format("text with {} between columns",
                              separator_name(layout ? layout->separator : ' '));
    info.files = {path};
    auto table = std::make_unique<TextTable>(std::move(file), options.columns, info.notes);
    return make_table_snapshot(std::move(table), std::move(info));
  }
  bool has_columns() const override { return true; }
};

}  // namespace

const SnapshotFormat& text_table_format() {
  static const TextTableFormat format;
  return format;
}

}  // namespace splotchcl
