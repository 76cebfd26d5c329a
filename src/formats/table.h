#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// One column of a table. Its name may end in a unit: "x [kpc]", "mass (Msun)".
struct TableColumn {
  std::string name;
  int values_per_row = 1;
};

// One value of each row.
struct TableValue {
  std::size_t column = 0;
  int axis = 0;
};

// Rows of named columns, a row per particle: text and NumPy files.
class Table {
 public:
  using UseRow = std::function<void(const double* values)>;

  virtual ~Table() = default;
  virtual const std::vector<TableColumn>& columns() const = 0;
  virtual std::uint64_t rows() const = 0;
  // Calls `use` with the wanted values of each row, in order. Throws DataError.
  virtual void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const = 0;
  // Whether single precision holds every value of the column. Text may have any digits.
  virtual bool is_single_precision(std::size_t column) const = 0;
  // A column of one value per row as whole numbers, exact; none where it has others.
  virtual std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const = 0;
  // Where in the file a column lies that its name alone does not tell from others: of a group, a
  // step in time, or one that was given another name. Else empty.
  virtual std::string place(std::size_t) const { return {}; }
};

// A table as a snapshot of particles of type 0. Columns such as x, y, z or vx, vy, vz become
// vectors; others are found by the names of fields. `info` comes with format and files.
// Throws DataError when there are no positions.
std::unique_ptr<Snapshot> make_table_snapshot(std::unique_ptr<const Table> table,
                                              SnapshotInfo info);
// The same of a table for each type.
using TablesByType = std::map<int, std::unique_ptr<const Table>>;
std::unique_ptr<Snapshot> make_table_snapshot(TablesByType tables, SnapshotInfo info);

// The table itself, or, where its positions have x and y alone, one with a z of 0 beside them: a
// flow in a plane. Notes it.
std::unique_ptr<const Table> with_flat_positions(std::unique_ptr<const Table> table,
                                                 std::vector<std::string>& notes);

// Whether read.columns gives NAME=COLUMN, not names in the order of the columns. Throws UsageError
// for a mixture.
bool names_columns_anew(const std::vector<std::string>& wanted);

// The table itself, or, where read.columns gives NAME=COLUMN, one whose columns have these names;
// all others keep theirs. Throws UsageError for a column that is not there.
std::unique_ptr<const Table> with_new_names(std::unique_ptr<const Table> table,
                                            const std::vector<std::string>& wanted,
                                            const std::filesystem::path& path);

// Steps in time that a table holds one below the other, as a column "step" or "time" tells:
// "step=0", "step=1", ... in their order. None where no particle is there twice.
std::vector<std::string> steps_in(const Table& table);

// The table of one step: of `wanted`, "step=3", or where that is empty of the last, with a note.
// All rows for "step=all". Throws DataError for a step that the table does not have.
std::unique_ptr<const Table> with_one_step(std::unique_ptr<const Table> table,
                                           const std::string& wanted, SnapshotInfo& info);

// "a/step=3" is "step=3" of the group "a".
struct GroupAndStep {
  std::string group, step;
};
GroupAndStep split_step(const std::string& group);

struct NameAndUnit {
  std::string name, unit;
};

// Itself, or where it is no UTF-8 what it is in Latin-1, as older programs write it.
std::string as_utf8(const std::string& name);

// A unit with the words that we do not have as our products: "ckpc/h" as "a kpc/h".
std::string in_our_units(const std::string& unit);

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
