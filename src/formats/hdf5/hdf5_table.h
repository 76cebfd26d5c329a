#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_file.h"
#include "formats/table.h"

namespace splotchcl {

// A quantity of each particle: the sum of datasets, each times a factor, and a constant.
struct Hdf5Column {
  struct Term {
    Hdf5Dataset dataset;
    double factor = 1;
    std::vector<double> missing = {};  // stored values that stand for none

    bool is_missing(double stored) const;
  };
  std::string name;   // without its unit
  std::string owner;  // whose attributes tell the unit: a dataset, or a group instead of one
  std::vector<Term> terms;
  double constant = 0;
  int values = 1;
  std::optional<std::uint64_t> rows;  // none: as many as there are particles

  // What is read is what is stored.
  bool is_as_stored() const { return terms.size() == 1 && terms[0].factor == 1 && constant == 0; }
};

// What belongs together: a group's datasets and those of groups that stand for one quantity, or
// what the records of a dataset hold.
struct Hdf5Columns {
  std::vector<Hdf5Column> columns;
  std::vector<std::string> others;       // names of datasets that cannot be columns
  std::vector<std::string> used_groups;  // of the groups in it, those that are columns
};
Hdf5Columns columns_in(const Hdf5File& file, const std::string& place);

std::vector<TableColumn> names_of(const std::vector<Hdf5Column>& columns);

// Where particles are: groups, the root among them, and datasets of records. Only up to some depth
// and number of groups.
std::vector<std::string> find_particle_groups(const Hdf5File& file);

// "group/dataset (300 x 3)", for messages: what the file holds, down to the same depth.
std::vector<std::string> list_contents(const Hdf5File& file, std::size_t most);

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
