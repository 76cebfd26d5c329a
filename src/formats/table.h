#pragma once

#include <cstdint>
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

}  // namespace splotchcl
