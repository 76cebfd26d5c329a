// Tables of catalogs and journals (CDS, MRT), whose header tells the bytes of each column.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <utility>

#include "common/words.h"
#include "formats/snapshot_format.h"
#include "formats/text/table_layout.h"

namespace splotchcl {
namespace {

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
