#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/mapped_file.h"
#include "formats/text/text_cells.h"
#include "splotchcl/periodic.h"

namespace splotchcl {

// How a file of text is a table.
struct TableLayout {
  CellFormat format;
  std::vector<std::string> names;       // from the header; empty where there is none
  std::size_t other_names = 0;          // of a header that names more or fewer columns
  std::vector<std::string_view> cells;  // of the first row
  std::uint64_t first_row = 0;          // its place in the file
  std::uint64_t lines_before = 0;
  std::optional<std::uint64_t> rows;  // as many as the file says that there are
  std::optional<BoxSides> box;
  double time = 0;
  std::vector<std::string> notes;
};

// What is known of a table beforehand: lines that are no part of it, and how many columns it has.
struct KnownOfTable {
  std::uint64_t skip_lines = 0;
  std::size_t columns = 0;  // 0: not known
};

// The first row of numbers and the names before it. None where the file is not a table.
std::optional<TableLayout> find_layout(const MappedFile& file, const KnownOfTable& known = {});

// The table of points that chemists use: their number, a line of any text, then an element and its
// x, y and z in each line, or what the line of text says (extended XYZ). Of several such tables in
// one file the last.
std::optional<TableLayout> find_xyz_layout(const MappedFile& file);

// A table whose header describes it byte by byte, as catalogs and journals have them (CDS, MRT).
std::optional<TableLayout> find_described_layout(const MappedFile& file);

// Of a text that is no table as it stands: the line where rows of numbers begin that would be one
// if their columns were named, and how many columns they have.
struct RowsInText {
  std::uint64_t line = 0;
  std::size_t columns = 0;
};
std::optional<RowsInText> find_rows_in_text(const MappedFile& file);

// Whether a line is no part of the rows.
bool is_comment_line(std::string_view line);

bool name_positions(const std::vector<std::string>& names);

}  // namespace splotchcl
