#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_columns.h"
#include "formats/table.h"

namespace splotchcl {

// The columns that read.columns names: NAME=PATH of a dataset below `group`, PATH:MEMBER of one of
// records, PATH:1 for the first column of one of several. Throws UsageError where there is none.
std::vector<Hdf5Column> named_columns(const Hdf5File& file, const std::string& group,
                                      const std::vector<std::string>& wanted);

// Columns of one place in a file, as long as the positions among them.
class Hdf5Table : public Table {
 public:
  // All that there is. Notes what is left out.
  Hdf5Table(const std::filesystem::path& path, const std::string& place,
            std::vector<std::string>& notes);
  // Those that somebody has named, whose units are theirs to say.
  Hdf5Table(const std::filesystem::path& path, std::vector<Hdf5Column> named);

  const std::vector<TableColumn>& columns() const override { return columns_; }
  std::uint64_t rows() const override { return rows_; }
  void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const override;
  bool is_single_precision(std::size_t column) const override;
  std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const override;
  std::string place(std::size_t column) const override;

 private:
  void keep_those_of_particles(std::vector<std::string>& left_out);
  void refuse_lost_axis(const std::vector<std::string>& others) const;
  // Rows that are read at a time, of columns that are there to their ends.
  std::uint64_t rows_at_a_time(const Hdf5File& file, const std::vector<TableValue>& wanted) const;

  // Open only while it is read: others in this process may want to change it.
  std::filesystem::path path_;
  std::vector<TableColumn> columns_;
  std::vector<Hdf5Column> sources_;  // of the columns
  std::uint64_t rows_ = 0;
  bool is_named_ = false;  // by somebody
};

}  // namespace splotchcl
