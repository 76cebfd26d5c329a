// Delimited text: a header with the names of the columns, then a line of numbers for each
// particle, separated by commas, semicolons or white space.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "common/words.h"
#include "formats/snapshot_format.h"
#include "formats/table.h"
#include "formats/text/table_layout.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

class TextTable : public Table {
 public:
  // `names`: in the order of the columns, instead of those in the file.
  TextTable(std::shared_ptr<const MappedFile> file, TableLayout layout,
            const std::vector<std::string>& names, std::vector<std::string>& notes);

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
  void find_decimal_mark();
  void find_columns(const std::vector<std::string>& names, std::vector<std::string>& notes);
  void refuse_lost_axis(const std::string& axis, const std::vector<std::string>& names) const;
  void count_rows();
  TextLines first_lines() const {
    return TextLines(*file_, layout_.first_row, layout_.lines_before);
  }
  void read_row(const TextLines& line, const std::vector<WantedCell>& wanted, double* values) const;
  [[noreturn]] void fail(const TextLines& line, const std::string& what) const;
  // What is said of a cell that is none.
  std::string no_number(std::string_view cell) const;
  [[noreturn]] void refuse_cell(const TextLines& line, std::string_view cell) const;
  [[noreturn]] void refuse_count(const TextLines& line, std::size_t cells) const;

  std::shared_ptr<const MappedFile> file_;
  TableLayout layout_;
  std::vector<TableColumn> columns_;
  std::vector<std::size_t> cells_;  // which cell of a row each column is
  std::uint64_t rows_ = 0;
};

// As old Macs wrote them: to us the file is one line.
bool has_old_line_ends(const MappedFile& file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  return text.find('\r') != std::string_view::npos && text.find('\n') == std::string_view::npos;
}

TextTable::TextTable(std::shared_ptr<const MappedFile> file, TableLayout layout,
                     const std::vector<std::string>& names, std::vector<std::string>& notes)
    : file_(std::move(file)), layout_(std::move(layout)) {
  const std::string path = file_->path().string();
  const std::size_t width = layout_.cells.size();
  const std::vector<std::string>& wanted = names.empty() ? layout_.names : names;
  if (wanted.empty() && has_old_line_ends(*file_)) {
    throw DataError(path +
                    ": its lines end in carriage returns alone, expected line feeds; convert them, "
                    "as tr '\\r' '\\n' does");
  }
  if (wanted.empty() && layout_.other_names > 0) {
    throw DataError(
        fmt::format("{}: line {} has {}, but the line of names above has {}; correct that line, or "
                    "name them all in their order, as in read.columns = [\"x\", \"y\", \"z\", "
                    "\"mass\"], \"-\" for those that are not needed",
                    path, layout_.lines_before + 1, counted(width, "column"), layout_.other_names));
  }
  if (wanted.empty()) {
    throw DataError(fmt::format(
        "{}: a table of {} without a header that names them; name them in their order, as "
        "in read.columns = [\"x\", \"y\", \"z\", \"mass\"]",
        path, counted(width, "column")));
  }
  if (wanted.size() != width) {
    throw UsageError(fmt::format(
        "{}: line {} has {}, but read.columns names {}; name each of them (\"-\" for those "
        "that are not needed), or leave out the lines before the table with read.skip_lines",
        path, layout_.lines_before + 1, counted(width, "column"), wanted.size()));
  }
  find_decimal_mark();
  find_columns(wanted, notes);
  count_rows();
  if (!names.empty()) leave_out_line_of_counts(notes);
}

// A table has one decimal mark: a comma beside points, or between commas, is that of thousands.
void TextTable::find_decimal_mark() {
  if (layout_.format.separator == ',') layout_.format.decimal_mark = '.';
  TextLines lines = first_lines();
  for (int looked_at = 0; looked_at < 1000 && layout_.format.decimal_mark == 0 && lines.next();
       ++looked_at) {
    if (is_comment_line(lines.line())) continue;
    layout_.format.decimal_mark = splotchcl::find_decimal_mark(cells_of(lines, layout_.format));
  }
}

void TextTable::find_columns(const std::vector<std::string>& names,
                             std::vector<std::string>& notes) {
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "-") continue;
    if (names[i].empty()) {
      notes.push_back(fmt::format("column {} left out, as it has no name", i + 1));
    } else if (parse_cell(layout_.cells[i], layout_.format.decimal_mark)) {
      columns_.push_back({names[i], 1});
      cells_.push_back(i);
    } else {
      left_out.push_back(names[i]);
    }
  }
  if (left_out.empty()) return;
  refuse_lost_axis(lost_axis(columns_, left_out), names);
  notes.push_back(
      fmt::format("columns left out, as they do not hold numbers: {}", fmt::join(left_out, ", ")));
}

void TextTable::refuse_lost_axis(const std::string& axis,
                                 const std::vector<std::string>& names) const {
  if (axis.empty()) return;
  const auto column = std::find(names.begin(), names.end(), axis) - names.begin();
  throw DataError(fmt::format("{}: line {}: column {}: {}", file_->path().string(),
                              layout_.lines_before + 1, axis,
                              no_number(layout_.cells[static_cast<std::size_t>(column)])));
}

void TextTable::count_rows() {
  TextLines lines = first_lines();
  while (lines.next()) {
    if (!is_comment_line(lines.line())) ++rows_;
  }
  if (!layout_.rows || *layout_.rows == rows_) return;
  throw DataError(fmt::format(
      "{}: found {}, expected {} as the file says; it is truncated or damaged: write it again",
      file_->path().string(), counted(rows_, "row"), *layout_.rows));
}

// Some codes write first how many rows there are. As a row it would be a particle: unlike one it is
// all of whole numbers, of which the first is that of the rows.
void TextTable::leave_out_line_of_counts(std::vector<std::string>& notes) {
  const bool counts_rows = parse_cell(layout_.cells.front()) == static_cast<double>(rows_ - 1);
  if (!counts_rows || !are_whole({layout_.cells.front()})) return;
  TextLines lines = first_lines();
  lines.next();
  const std::uint64_t number = lines.number();
  while (lines.next() && is_comment_line(lines.line())) {
  }
  const std::vector<std::string_view> next = cells_of(lines, layout_.format);
  if (are_whole(next)) return;
  if (!are_whole(layout_.cells)) {
    if (are_whole({next.front()})) return;  // identifiers
    notes.push_back(fmt::format(
        "line {} is taken for a particle; if its {} is the number of rows, leave it out with "
        "read.skip_lines",
        number, rows_ - 1));
    return;
  }
  notes.push_back(
      fmt::format("line {} is left out: it tells the number of rows, {}", number, rows_ - 1));
  layout_.first_row = lines.start();
  layout_.lines_before = lines.number() - 1;
  --rows_;
}

void TextTable::fail(const TextLines& line, const std::string& what) const {
  throw DataError(
      fmt::format("{}: line {}: {}; take out what stands below the table, or write the file again "
                  "if it is truncated or damaged",
                  file_->path().string(), line.number(), what));
}

std::string TextTable::no_number(std::string_view cell) const {
  const std::string found = fmt::format("found '{}', expected a number", cell.substr(0, 40));
  if (!parse_cell(cell)) return found;
  return fmt::format(
      "{} with a decimal {}, as others in the table have; take out what stands between thousands",
      found, layout_.format.decimal_mark == ',' ? "comma" : "point");
}

void TextTable::refuse_cell(const TextLines& line, std::string_view cell) const {
  if (!parse_cell(cell)) fail(line, no_number(cell));
  throw DataError(
      fmt::format("{}: line {}: {}", file_->path().string(), line.number(), no_number(cell)));
}

// Without names, lines before the table may look like its first row.
void TextTable::refuse_count(const TextLines& line, std::size_t cells) const {
  const std::string what = fmt::format("found {}, expected {} as in the first row",
                                       counted(cells, "value"), layout_.cells.size());
  const bool may_be_first = layout_.names.empty() && line.number() == layout_.lines_before + 2;
  if (!may_be_first) fail(line, what);
  throw DataError(fmt::format(
      "{}: line {}: {}; if the table begins further down, leave out the lines before it with "
      "read.skip_lines, else the file is damaged: write it again",
      file_->path().string(), line.number(), what));
}

void TextTable::read_row(const TextLines& line, const std::vector<WantedCell>& wanted,
                         double* values) const {
  CellReader reader(line, layout_.format);
  auto next = wanted.begin();
  std::size_t cells = 0;
  for (; reader.next(); ++cells) {
    const std::string_view cell = reader.cell();
    for (; next != wanted.end() && next->cell == cells; ++next) {
      const std::optional<double> value = parse_cell(cell, layout_.format.decimal_mark);
      if (!value) refuse_cell(line, cell);
      values[next->place] = *value;
    }
  }
  if (cells != layout_.cells.size()) refuse_count(line, cells);
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
  TextLines lines = first_lines();
  while (lines.next()) {
    if (is_comment_line(lines.line())) continue;
    read_row(lines, cells, values.data());
    use(values.data());
  }
}

std::optional<std::vector<std::uint64_t>> TextTable::integers(std::size_t column) const {
  std::vector<std::uint64_t> values;
  TextLines lines = first_lines();
  while (lines.next()) {
    if (is_comment_line(lines.line())) continue;
    const std::vector<std::string_view> cells = cells_of(lines, layout_.format);
    if (cells.size() <= cells_[column]) return std::nullopt;
    const std::string_view cell = cells[cells_[column]];
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
    values.push_back(value);
  }
  return values;
}

// Those of a table without names, by their numbers from 1.
std::vector<std::string> numbered_names(std::size_t columns) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < columns; ++i)
    names.push_back(fmt::format("column_{}", i + 1));
  return names;
}

[[noreturn]] void refuse_text(const std::filesystem::path& path, std::uint64_t skipped,
                              std::size_t columns) {
  if (skipped == 0 && columns > 0) {
    throw DataError(fmt::format(
        "{}: found no row of {} columns with three numbers or more, expected such rows as "
        "read.columns names; correct it, or leave out lines with read.skip_lines",
        path.string(), columns));
  }
  throw DataError(
      skipped > 0
          ? fmt::format(
                "{}: found no table after {} lines, expected rows of three numbers or more; "
                "correct read.skip_lines",
                path.string(), skipped)
          : path.string() + ": not a table of numbers any more; is it being written?");
}

class TextTableFormat : public SnapshotFormat {
 public:
  bool recognizes(const std::shared_ptr<const MappedFile>& file) const override {
    return find_layout(*file).has_value();
  }
  std::unique_ptr<Snapshot> open(const std::filesystem::path& path,
                                 const SnapshotOptions& options) const override {
    const PathInFile place = path_in_file(path).value_or(PathInFile{path, ""});
    auto file = MappedFile::open(place.file);
    const bool has_new_names = names_columns_anew(options.columns);
    std::vector<std::string> names = has_new_names ? std::vector<std::string>() : options.columns;
    const auto skipped = static_cast<std::uint64_t>(std::max(options.skip_lines, 0));
    std::optional<TableLayout> layout = find_layout(*file, {skipped, names.size()});
    if (!layout) refuse_text(place.file, skipped, options.columns.size());
    SnapshotInfo info;
    info.format = fmt::format("text with {}", layout->format.name());
    info.files = {place.file};
    info.notes = layout->notes;
    info.time = layout->time;
    info.box_size = layout->box;
    if (has_new_names && layout->names.empty()) names = numbered_names(layout->cells.size());
    std::unique_ptr<const Table> table =
        std::make_unique<TextTable>(std::move(file), std::move(*layout), names, info.notes);
    table = with_new_names(std::move(table), options.columns, place.file);
    table = with_one_step(std::move(table), place.group, info);
    table = with_flat_positions(std::move(table), info.notes);
    return make_table_snapshot(std::move(table), std::move(info));
  }
  bool has_groups() const override { return true; }
  std::vector<std::string> groups_in(const std::filesystem::path& path,
                                     const std::string& group) const override {
    auto file = MappedFile::open(path);
    std::optional<TableLayout> layout = find_layout(*file);
    if (!group.empty() || !layout || layout->names.empty()) return {};
    std::vector<std::string> notes;
    return steps_in(TextTable(std::move(file), std::move(*layout), {}, notes));
  }
  bool has_columns(const std::vector<std::string>&) const override { return true; }
};

}  // namespace

const SnapshotFormat& text_table_format() {
  static const TextTableFormat format;
  return format;
}

}  // namespace splotchcl
