#include "formats/text/table_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <utility>

#include "common/words.h"
#include "formats/snapshot_format.h"
#include "formats/table.h"
#include "formats/text/table_header.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// What stands before the first row.
struct HeaderLines {
  std::vector<std::string_view> comments;
  std::vector<std::string_view> bars;  // lines between bars
  std::string_view line, whole_line;   // the last that is none of these; empty where there is none
  std::string_view line_before;        // the last but one of these
  bool begins_with_blank = false;
  int others = 0;  // such lines
};

std::string_view without_mark(std::string_view comment) {
  comment.remove_prefix(comment.substr(0, 2) == "//" ? 2 : 1);
  return comment;
}

bool is_between_bars(std::string_view line) {
  return line.size() > 2 && line.front() == '|' && line.back() == '|';
}

std::vector<std::string_view> cells_between_bars(std::string_view whole_line) {
  const std::string_view line = without_blanks(whole_line);
  return split_cells(line.substr(1, line.size() - 2), '|');
}

// The first names, with the units of the line below that has them.
std::vector<std::string> names_between_bars(const std::vector<std::string_view>& bars,
                                            std::size_t line_of_units) {
  const std::vector<std::string_view> cells = cells_between_bars(bars.front());
  std::vector<std::string> names(cells.begin(), cells.end());
  if (line_of_units >= bars.size()) return names;
  const std::vector<std::string_view> units = cells_between_bars(bars[line_of_units]);
  for (std::size_t i = 0; i < std::min(names.size(), units.size()); ++i) {
    if (!is_missing(units[i])) names[i] += " [" + std::string(units[i]) + "]";
  }
  return names;
}

// IPAC: what is below two bars belongs to the column between them.
std::vector<CellPlace> places_between_bars(std::string_view whole_line) {
  std::vector<CellPlace> places;
  std::size_t bar = whole_line.find('|');
  for (std::size_t next = whole_line.find('|', bar + 1); next != std::string_view::npos;
       next = whole_line.find('|', bar + 1)) {
    places.push_back({bar, next - bar});
    bar = next;
  }
  return places;
}

// The comment whose words are as many as the columns: of several the last that names positions,
// else the last.
std::vector<std::string> names_in_comments(const std::vector<std::string_view>& comments,
                                           std::size_t wanted) {
  std::vector<std::string> last = names_by_number(comments, wanted);
  if (!last.empty()) return last;
  for (auto comment = comments.rbegin(); comment != comments.rend(); ++comment) {
    std::vector<std::string> names = names_in_columns(*comment);
    if (names.size() != wanted) names = names_in_brackets(*comment);
    if (names.size() != wanted)
      names = in_our_words(names_of_columns(without_blanks(*comment), wanted));
    if (names.size() != wanted) continue;
    if (name_positions(names)) {
      for (auto below = comments.rbegin(); below != comment; ++below)
        add_units_below(*below, names);
      add_rockstar_units(comments, names);
      return names;
    }
    if (last.empty()) last = std::move(names);
  }
  return last;
}

std::vector<std::string> names_in(const HeaderLines& header, std::size_t wanted) {
  if (header.line.empty()) return names_in_comments(header.comments, wanted);
  std::vector<std::string> names =
      in_our_words(names_in_line(header.line, header.begins_with_blank, wanted));
  if (!name_positions(names) && !header.line_before.empty()) {
    std::vector<std::string> before =
        in_our_words(names_in_line(header.line_before, false, wanted));
    if (name_positions(before) && add_units_below(header.line, before)) names = std::move(before);
  }
  add_ecsv_units(header.comments, names);
  return names;
}

bool has_tabs_between(std::string_view line, std::size_t columns) {
  if (line.find('\t') == std::string_view::npos) return false;
  const std::vector<std::string_view> names = split_cells(line, '\t');
  return names.size() == columns && std::none_of(names.begin(), names.end(), is_missing);
}

// Whether the line of names has so many of them apart by tabs: cells may then be empty.
bool has_tabs(const HeaderLines& header, std::size_t columns) {
  if (!header.line.empty()) return has_tabs_between(header.whole_line, columns);
  return std::any_of(header.comments.begin(), header.comments.end(),
                     [columns](std::string_view comment) {
                       return has_tabs_between(without_blanks(comment), columns);
                     });
}

// A line of a frame around a table: ===== ===== or |-----|.
bool is_ruler(std::string_view line) {
  const bool is_long = line.find("---") != std::string_view::npos ||
                       line.find("===") != std::string_view::npos ||
                       line.find("|-") != std::string_view::npos;
  return is_long && line.find_first_not_of("-=+|: \t") == std::string_view::npos;
}

// The row's cells, and what is between them.
void split_row(const TextLines& line, const HeaderLines& header, TableLayout& layout) {
  CellFormat& format = layout.format;
  if (is_between_bars(line.line())) {
    format.separator = '|';
    layout.cells = cells_of(line, format);
    return;
  }
  for (const char separator : possible_separators(line.line())) {
    format.separator = separator;
    layout.cells = cells_of(line, format);
    if (separator == ';' || is_row(layout.cells)) break;
  }
  const CellFormat tabs = {'\t', {}};
  const std::vector<std::string_view> apart_by_tabs = cells_of(line, tabs);
  if (format.separator == ' ' && is_row(apart_by_tabs) && has_tabs(header, apart_by_tabs.size())) {
    format = tabs;
    layout.cells = apart_by_tabs;
  }
  if (!header.bars.empty() && format.separator == ' ') {
    format.places = places_between_bars(header.bars.front());
    layout.cells = cells_of(line, format);
  }
}

void name_columns(const HeaderLines& header, TableLayout& layout) {
  if (!header.bars.empty()) {
    // IPAC's types are between names and units.
    const std::size_t units = layout.format.places.empty() ? header.bars.size() : 2;
    layout.names = in_our_words(names_between_bars(header.bars, units));
    if (layout.names.size() != layout.cells.size()) layout.names.clear();
  } else if (layout.format.separator == '\t' && !header.line.empty()) {
    const std::vector<std::string_view> names = split_cells(header.whole_line, '\t');
    layout.names = in_our_words({names.begin(), names.end()});
    add_ecsv_units(header.comments, layout.names);
  } else {
    layout.names = names_in(header, layout.cells.size());
  }
}

// How many columns a line names, positions among them; 0 where it does not.
std::size_t count_names(std::string_view line) {
  for (const char separator : separators_of_names) {
    std::vector<std::string_view> words = split_cells(line, separator);
    if (words.back().empty()) words.pop_back();
    if (name_positions(in_our_words({words.begin(), words.end()}))) return words.size();
  }
  return 0;
}

std::size_t count_other_names(const HeaderLines& header) {
  if (!header.line.empty()) return count_names(header.line);
  for (auto comment = header.comments.rbegin(); comment != header.comments.rend(); ++comment) {
    if (const std::size_t count = count_names(without_blanks(*comment)); count > 0) return count;
  }
  return 0;
}

// Looks for a row that can be the first of the table.
class LayoutSearch {
 public:
  LayoutSearch(const MappedFile& file, const KnownOfTable& known) : lines_(file), known_(known) {
    for (std::uint64_t i = 0; i < known.skip_lines && lines_.next_of_all(); ++i) {
    }
  }
  std::optional<TableLayout> find();

 private:
  bool take(TableLayout layout);
  void add_other_line();

  TextLines lines_;
  const KnownOfTable& known_;
  HeaderLines header_;
  std::optional<TableLayout> found_;
  bool is_other_text_ = false;  // unless a line names positions
};

// True where no better one can follow.
bool LayoutSearch::take(TableLayout layout) {
  layout.first_row = lines_.start();
  layout.lines_before = lines_.number() - 1;
  name_columns(header_, layout);
  if (layout.names.empty()) layout.other_names = count_other_names(header_);
  const bool has_names = !layout.names.empty() || layout.other_names > 0;
  const bool is_wanted =
      known_.columns == 0 ? name_positions(layout.names) : layout.cells.size() == known_.columns;
  const bool may_be_first =
      header_.others == 0 || (header_.others == 1 && (has_names || known_.columns > 0));
  if (!found_ && !may_be_first) is_other_text_ = true;
  if (!is_wanted && (found_ || is_other_text_)) return false;
  if (found_) {
    layout.notes.push_back(
        fmt::format("the first row is line {}: numbers before it belong to something else",
                    layout.lines_before + 1));
  }
  found_ = std::move(layout);
  return is_wanted;
}

void LayoutSearch::add_other_line() {
  header_.line_before = header_.line;
  header_.line = lines_.line();
  header_.whole_line = lines_.whole();
  header_.begins_with_blank = lines_.begins_with_blank();
  ++header_.others;
}

std::optional<TableLayout> LayoutSearch::find() {
  constexpr std::uint64_t farthest_row = 1U << 20;  // a text that is no table is given up
  constexpr int lines_looked_at_after_a_row = 64;
  int after = 0;
  while (lines_.next() && lines_.start() < farthest_row && after < lines_looked_at_after_a_row) {
    const std::string_view line = lines_.line();
    if (line.find('\0') != std::string_view::npos) break;
    if (found_) ++after;
    if (is_ruler(line)) continue;
    if (is_comment_line(line)) {
      header_.comments.push_back(without_mark(line));
      continue;
    }
    TableLayout layout;
    split_row(lines_, header_, layout);
    if (is_row(layout.cells)) {
      if (take(std::move(layout))) break;
      // What is before it names nothing that follows.
      header_ = HeaderLines();
    } else if (is_between_bars(line)) {
      header_.bars.push_back(lines_.whole());
    } else {
      add_other_line();
    }
  }
  return std::move(found_);
}

}  // namespace

bool is_comment_line(std::string_view line) {
  return line.front() == '#' || line.front() == '%' || line.front() == '!' ||
         line.front() == '\\' || line.substr(0, 2) == "//" || is_ruler(line);
}

bool name_positions(const std::vector<std::string>& names) {
  std::vector<TableColumn> columns;
  for (const std::string& name : names)
    columns.push_back({name, 1});
  return find_positions(columns).has_value();
}

std::optional<RowsInText> find_rows_in_text(const MappedFile& file) {
  constexpr std::uint64_t farthest_row = 1U << 20;
  RowsInText last;  // a row alone may be anything
  TextLines lines(file);
  while (lines.next() && lines.start() < farthest_row) {
    TableLayout layout;
    split_row(lines, HeaderLines(), layout);
    const std::size_t columns = is_row(layout.cells) ? layout.cells.size() : 0;
    if (columns > 0 && columns == last.columns) return last;
    last = {lines.number(), columns};
  }
  return std::nullopt;
}

std::optional<TableLayout> find_layout(const MappedFile& file, const KnownOfTable& known) {
  if (known.skip_lines == 0) {
    if (auto layout = find_described_layout(file)) return layout;
    if (auto layout = find_xyz_layout(file)) return layout;
  }
  return LayoutSearch(file, known).find();
}

namespace {

// Tables of catalogs and journals (CDS, MRT), whose header tells the bytes of each column.

struct DescribedColumn {
  CellPlace place;
  std::string name;  // with its unit
};

std::optional<std::size_t> leading_number(std::string& text) {
  text = trimmed(text);
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number == 0) return std::nullopt;
  text.erase(0, static_cast<std::size_t>(end - text.data()));
  return number;
}

// "   1-  8 F8.5   kpc   x   the position": the bytes, a format, a unit, a name.
std::optional<DescribedColumn> read_description(std::string_view line) {
  std::string rest(line);
  const auto first = leading_number(rest);
  if (!first) return std::nullopt;
  std::size_t last = *first;
  const std::string after = trimmed(rest);
  if (!after.empty() && after.front() == '-') {
    rest = after.substr(1);
    const auto end = leading_number(rest);
    if (!end || *end < *first) return std::nullopt;
    last = *end;
  }
  const std::string description = trimmed(rest);
  std::vector<std::string> words;
  for (const std::string_view word : split_cells(description, ' '))
    words.emplace_back(word);
  if (words.size() < 3) return std::nullopt;
  const bool has_unit = words[1].find_first_not_of('-') != std::string::npos;
  DescribedColumn column;
  column.place = {*first - 1, last - *first + 1};
  column.name = has_unit ? words[2] + " [" + words[1] + "]" : words[2];
  return column;
}

bool is_dashed(std::string_view line) {
  constexpr std::size_t shortest = 20;
  return line.size() >= shortest && line.find_first_not_of("-=") == std::string_view::npos;
}

bool begins_description(std::string_view line) {
  constexpr std::string_view words = "byte-by-byte";
  return lower_case(std::string(line.substr(0, words.size()))) == words;
}

// After the last line of dashes.
void find_rows(TextLines lines, TableLayout& layout) {
  constexpr std::uint64_t longest_header = 1U << 22;
  bool is_after_dashes = false;
  while (lines.next() && lines.start() < longest_header) {
    if (is_dashed(lines.line())) {
      is_after_dashes = true;
    } else if (is_after_dashes) {
      is_after_dashes = false;
      layout.first_row = lines.start();
      layout.lines_before = lines.number() - 1;
      layout.cells = cells_of(lines, layout.format);
    }
  }
}

}  // namespace

std::optional<TableLayout> find_described_layout(const MappedFile& file) {
  constexpr std::uint64_t farthest = 1U << 16;
  TextLines lines(file);
  while (lines.next() && lines.start() < farthest && !begins_description(lines.line())) {
    if (lines.line().find('\0') != std::string_view::npos) return std::nullopt;
  }
  if (lines.start() >= farthest || !begins_description(lines.line())) return std::nullopt;
  TableLayout layout;
  for (int dashed = 0; dashed < 3 && lines.next();) {
    if (is_dashed(lines.line())) ++dashed;
    const auto column = dashed == 2 ? read_description(lines.line()) : std::nullopt;
    if (!column || layout.names.size() == most_columns) continue;
    layout.names.push_back(column->name);
    layout.format.places.push_back(column->place);
  }
  if (layout.names.empty()) return std::nullopt;
  find_rows(TextLines(file, lines.start(), lines.number() - 1), layout);
  const bool has_rows = !layout.cells.empty() && is_row(layout.cells);
  return has_rows ? std::optional(std::move(layout)) : std::nullopt;
}

}  // namespace splotchcl
