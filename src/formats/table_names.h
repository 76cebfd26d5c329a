#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/table.h"

namespace splotchcl {

struct NameAndUnit {
  std::string name, unit;
};

// Itself, or where it is no UTF-8 what it is in Latin-1, as older programs write it.
std::string as_utf8(const std::string& name);

// "x [kpc]" is x in kpc.
NameAndUnit split_unit(const std::string& text);

// An entry of read.columns that names a column of the file anew: NAME=COLUMN. None where it is a
// mere name.
struct NamedColumn {
  std::string name, source;
};
std::optional<NamedColumn> split_named_column(const std::string& text);

// The vector whose first axis a column of this name is: "" where it is none. The names of the
// three columns differ in their last letter only.
std::string vector_name(const std::string& column);
// The name of another axis' column, 0 to 2, from that of the first.
std::string with_axis(std::string column, int axis);

// The column that positions are in, by its name: also the first of three axes.
std::optional<std::size_t> find_positions(const std::vector<TableColumn>& columns);

// Whether a column of this name is of positions or smoothing lengths.
bool is_place_or_size(const std::string& column);

// Which axis of the positions is among what is left out; empty where none is. Without it the
// positions would be others.
std::string lost_axis(const std::vector<TableColumn>& columns,
                      const std::vector<std::string>& left_out);

// Where none has such a name: the only column of three values that is nothing else by its name.
std::optional<std::size_t> guess_positions(const std::vector<TableColumn>& columns);

}  // namespace splotchcl
