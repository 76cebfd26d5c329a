// XYZ: points as chemists and astronomers pass them on, element by element.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "common/words.h"
#include "formats/text/table_header.h"
#include "formats/text/table_layout.h"

namespace splotchcl {
namespace {

std::optional<std::uint64_t> count_in(std::string_view line) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), count);
  const bool is_count = error == std::errc() && end == line.data() + line.size() && count > 0;
  return is_count ? std::optional(count) : std::nullopt;
}

// What a line of text says for a key: key=value or key="some values"; empty where it says nothing.
std::string value_of_key(std::string_view line, const std::string& key) {
  const std::string start = lower_case(key) + "=";
  const std::string text = lower_case(std::string(line));
  std::size_t at = text.find(start);
  while (at != std::string::npos && at > 0 && text[at - 1] != ' ' && text[at - 1] != '\t')
    at = text.find(start, at + 1);
  if (at == std::string::npos) return {};
  std::string_view value = line.substr(at + start.size());
  if (!value.empty() && value.front() == '"')
    return std::string(value.substr(1, value.substr(1).find('"')));
  return std::string(value.substr(0, value.find_first_of(" \t")));
}

// Of "species:S:1:pos:R:3:mass:R:1"; words have no name. None where it is something else.
std::optional<std::vector<std::string>> names_of_properties(const std::string& properties) {
  const std::vector<std::string_view> parts = split_cells(properties, ':');
  if (properties.empty() || parts.size() % 3 != 0) return std::nullopt;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    const auto columns = count_in(parts[i + 2]);
    if (!columns || *columns > 64) return std::nullopt;
    const std::string name(parts[i]);
    for (std::uint64_t column = 0; column < *columns; ++column) {
      const bool is_vector = *columns == 3;
      names.push_back(is_vector       ? fmt::format("{} {}", name, static_cast<char>('x' + column))
                      : *columns == 1 ? name
                                      : fmt::format("{}_{}", name, column + 1));
    }
  }
  return names;
}

// An element, x, y, z, and more that has no name; or the positions alone.
std::vector<std::string> names_of_cells(const std::vector<std::string_view>& cells) {
  if (cells.size() == 3) return {"x", "y", "z"};
  if (cells.size() < 3 || parse_cell(cells.front())) return {};
  std::vector<std::string> names = {"element", "x", "y", "z"};
  names.resize(cells.size());
  return names;
}

// Periodic sides along the axes; nothing for those that lean.
std::optional<BoxSides> box_of_lattice(const std::string& lattice) {
  std::vector<double> numbers;
  for (const std::string_view cell : split_cells(lattice, ' ')) {
    const auto number = cell.empty() ? std::nullopt : parse_cell(cell);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != 9) return std::nullopt;
  for (const std::size_t other : {1U, 2U, 3U, 5U, 6U, 7U}) {
    if (numbers[other] != 0) return std::nullopt;
  }
  return box_of({numbers[0], numbers[4], numbers[8]});
}

void read_text_line(std::string_view line, TableLayout& layout) {
  layout.names =
      names_of_properties(value_of_key(line, "Properties")).value_or(names_of_cells(layout.cells));
  layout.box = box_of_lattice(value_of_key(line, "Lattice"));
  const std::string periodic = lower_case(value_of_key(line, "pbc"));
  if (periodic.find('f') != std::string::npos) layout.box.reset();
  if (const auto time = parse_number(value_of_key(line, "Time"))) layout.time = *time;
}

// Whether the line below the number belongs to a table of another form: it names the columns, or is
// a row of numbers like the next.
bool is_of_other_table(std::string_view line, const std::vector<std::string_view>& cells) {
  if (name_positions(names_of_columns(line, cells.size()))) return true;
  const std::vector<std::string_view> words = split_cells(line, ' ');
  return words.size() == cells.size() && is_row(words) && parse_cell(cells.front());
}

// One of the tables in the file; none where there is none at this place.
std::optional<TableLayout> read_table(TextLines& lines) {
  const auto count = lines.next() ? count_in(lines.line()) : std::nullopt;
  if (!count || !lines.next_of_all()) return std::nullopt;
  const std::string_view text = lines.line();
  TableLayout layout;
  layout.rows = *count;
  if (!lines.next_of_all()) return std::nullopt;
  layout.cells = cells_of(lines, layout.format);
  layout.first_row = lines.start();
  layout.lines_before = lines.number() - 1;
  if (is_of_other_table(text, layout.cells)) return std::nullopt;
  read_text_line(text, layout);
  const bool is_table =
      is_row(layout.cells) && !layout.names.empty() && layout.names.size() == layout.cells.size();
  return is_table ? std::optional(std::move(layout)) : std::nullopt;
}

}  // namespace

std::optional<TableLayout> find_xyz_layout(const MappedFile& file) {
  TextLines lines(file);
  auto last = read_table(lines);
  int tables = 0;
  for (auto next = last; next; next = read_table(lines)) {
    last = std::move(next);
    ++tables;
    for (std::uint64_t row = 1; row < *last->rows && lines.next_of_all(); ++row) {
    }
  }
  if (tables > 1) {
    last->notes.push_back(
        fmt::format("the file has {} tables one after the other, as of steps in time: the last is "
                    "read",
                    tables));
  }
  return last;
}

}  // namespace splotchcl
