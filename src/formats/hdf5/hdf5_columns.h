#pragma once

#include <cstdint>
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

}  // namespace splotchcl
