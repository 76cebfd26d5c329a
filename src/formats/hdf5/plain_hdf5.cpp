// HDF5 without a header that counts particles: datasets at the root or in groups, as users of h5py
// and yt's save_as_dataset write them. The data themselves tell how many there are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/hdf5/hdf5_column.h"
#include "formats/hdf5/hdf5_formats.h"
#include "formats/hdf5/hdf5_steps.h"
#include "formats/hdf5/hdf5_units.h"
#include "formats/table.h"
#include "formats/table_names.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Notes = std::vector<std::string>;

bool is_column(const Hdf5Dataset& dataset) {
  const std::uint64_t values = dataset.values_per_row();
  return dataset.kind != Hdf5Dataset::Kind::other && !dataset.shape.empty() &&
         (values == 1 || values == 3);
}

// yt's names of particles' fields begin with "particle_"; its index is the identifier.
std::string field_label(const std::string& label) {
  const std::string prefix = "particle_";
  if (label.compare(0, prefix.size(), prefix) != 0 || label.size() == prefix.size()) return label;
  const std::string name = label.substr(prefix.size());
  return name == "index" ? "ids" : name;
}

std::string unit_of(const Hdf5File& file, const Hdf5Dataset& dataset) {
  for (const char* attribute : {"units", "unit", "Units", "Unit"}) {
    const auto unit = file.text(dataset.path, attribute);
    if (unit && !unit->empty() && *unit != "dimensionless") return *unit;
  }
  return read_field_unit(file, dataset, read_units(file));
}

TableColumn column_of(const Hdf5File& file, const Hdf5Dataset& dataset) {
  const std::string unit = unit_of(file, dataset);
  const std::string name = field_label(dataset.label());
  return {unit.empty() ? name : fmt::format("{} [{}]", name, unit),
          static_cast<int>(dataset.values_per_row())};
}

// The datasets of a group that can be columns; those of other shapes in `others`.
std::vector<Hdf5Dataset> columns_in(const Hdf5File& file, const std::string& group,
                                    std::vector<std::string>& others) {
  std::vector<Hdf5Dataset> columns;
  for (Hdf5Dataset& dataset : file.datasets(group)) {
    if (dataset.shape.empty()) continue;  // a single value
    if (is_column(dataset)) {
      columns.push_back(std::move(dataset));
    } else {
      others.push_back(dataset.label());
    }
  }
  return columns;
}

std::vector<TableColumn> described(const Hdf5File& file, const std::vector<Hdf5Dataset>& datasets) {
  std::vector<TableColumn> columns;
  for (const Hdf5Dataset& dataset : datasets)
    columns.push_back(column_of(file, dataset));
  return columns;
}

// The datasets of a group as columns, as long as the positions among them.
class Hdf5Table : public Table {
 public:
  Hdf5Table(const std::filesystem::path& path, const std::string& group, Notes& notes);

  const std::vector<TableColumn>& columns() const override { return columns_; }
  std::uint64_t rows() const override { return rows_; }
  void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const override;
  bool is_single_precision(std::size_t column) const override {
    return datasets_[column].is_single_precision();
  }
  std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const override;

 private:
  void keep_those_of_particles(std::vector<std::string>& left_out);

  Hdf5File file_;
  std::vector<TableColumn> columns_;
  std::vector<Hdf5Dataset> datasets_;  // of the columns
  std::uint64_t rows_ = 0;
};

Hdf5Table::Hdf5Table(const std::filesystem::path& path, const std::string& group, Notes& notes)
    : file_(path) {
  std::vector<std::string> left_out;
  datasets_ = columns_in(file_, group, left_out);
  columns_ = described(file_, datasets_);
  if (const auto guessed = guess_positions(columns_)) {
    notes.push_back(fmt::format("dataset {} is taken for the positions", datasets_[*guessed].path));
    columns_[*guessed].name = "position";
  }
  keep_those_of_particles(left_out);
  if (!left_out.empty()) {
    notes.push_back(
        fmt::format("left out of {}, as they are not one or three numbers for each of {} "
                    "particles: {}",
                    group, rows_, fmt::join(left_out, ", ")));
  }
  if (rows_ == 0) {
    throw DataError(fmt::format("{}: the positions in {} have no rows; expected particles",
                                path.string(), group));
  }
}

void Hdf5Table::keep_those_of_particles(std::vector<std::string>& left_out) {
  if (const auto positions = find_positions(columns_)) rows_ = datasets_[*positions].rows();
  std::vector<TableColumn> columns;
  std::vector<Hdf5Dataset> datasets;
  for (std::size_t i = 0; i < datasets_.size(); ++i) {
    if (datasets_[i].rows() != rows_) {
      left_out.push_back(datasets_[i].label());
      continue;
    }
    columns.push_back(columns_[i]);
    datasets.push_back(datasets_[i]);
  }
  columns_ = std::move(columns);
  datasets_ = std::move(datasets);
}

void Hdf5Table::for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const {
  std::uint64_t piece = rows_;
  for (const TableValue& value : wanted) {
    file_.check_complete(datasets_[value.column]);
    piece = std::min(piece, file_.rows_per_piece(datasets_[value.column]));
  }
  std::map<std::size_t, std::vector<double>> pieces;  // of each column
  std::vector<double> values(wanted.size());
  for (std::uint64_t first = 0; first < rows_; first += piece) {
    const std::uint64_t rows = std::min(piece, rows_ - first);
    pieces.clear();
    for (const TableValue& value : wanted) {
      std::vector<double>& read = pieces[value.column];
      if (!read.empty()) continue;
      const Hdf5Dataset& dataset = datasets_[value.column];
      read.resize(rows * dataset.values_per_row());
      file_.read_rows(dataset, first, rows, read.data());
    }
    for (std::uint64_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        const std::uint64_t width = datasets_[wanted[i].column].values_per_row();
        values[i] =
            pieces[wanted[i].column][row * width + static_cast<std::uint64_t>(wanted[i].axis)];
      }
      use(values.data());
    }
  }
}

// yt keeps identifiers as doubles: they are whole numbers as far as doubles have all of these.
std::optional<std::vector<std::uint64_t>> Hdf5Table::integers(std::size_t column) const {
  const Hdf5Dataset& dataset = datasets_[column];
  if (dataset.kind == Hdf5Dataset::Kind::integer) return read_integers({{file_.path(), dataset}});
  constexpr double largest = 9007199254740992.0;
  std::vector<std::uint64_t> numbers;
  bool are_whole = true;
  for_rows({{column, 0}}, [&](const double* value) {
    const bool is_whole = *value >= 0 && *value <= largest && *value == std::floor(*value);
    are_whole = are_whole && is_whole;
    numbers.push_back(is_whole ? static_cast<std::uint64_t>(*value) : 0);
  });
  return are_whole ? std::optional(std::move(numbers)) : std::nullopt;
}

bool has_positions(const Hdf5File& file, const std::string& group) {
  std::vector<std::string> ignored;
  const std::vector<TableColumn> columns = described(file, columns_in(file, group, ignored));
  return find_positions(columns) || guess_positions(columns);
}

// The groups with particles, the root among them.
std::vector<std::string> particle_groups(const Hdf5File& file) {
  std::vector<std::string> groups;
  if (has_positions(file, "/")) groups.emplace_back("/");
  for (const std::string& group : file.groups("/")) {
    if (has_positions(file, "/" + group)) groups.push_back("/" + group);
  }
  return groups;
}

// A type for each group: by its name; where no name is one, in their order from 0. Beside groups
// whose names are types others tend to hold the same particles again.
std::map<int, std::string> choose_types(const std::vector<std::string>& groups, Notes& notes) {
  std::map<int, std::string> types;
  std::vector<std::string> others;
  for (const std::string& group : groups) {
    const auto type = find_particle_type(group.substr(1));
    const bool is_new = type && types.emplace(*type, group).second;
    if (!is_new) others.push_back(group);
  }
  if (!types.empty()) {
    for (const std::string& group : others)
      notes.push_back(fmt::format("group {} is left out: its name is no type of particles", group));
    return types;
  }
  for (const std::string& group : others) {
    const auto type = static_cast<int>(types.size());
    if (others.size() > 1) {
      notes.push_back(fmt::format("the particles of {} are taken for type {}", group, type));
    }
    types.emplace(type, group);
  }
  return types;
}

// Of groups that are steps in time one: that which is asked for, or the last.
std::vector<std::string> choose_step(const Hdf5File& file, const std::vector<std::string>& groups,
                                     const std::string& wanted, Notes& notes) {
  if (!wanted.empty()) {
    if (std::find(groups.begin(), groups.end(), "/" + wanted) != groups.end())
      return {"/" + wanted};
    throw DataError(fmt::format("{}: found no particles in a group {}, expected one of {}",
                                file.path().string(), wanted, fmt::join(groups, ", ")));
  }
  const std::vector<std::string> steps = find_steps(file, groups);
  if (steps.empty()) return groups;
  notes.push_back(fmt::format(
      "the file has {0} steps in time, {1} to {2}: the last is read; {3}{1} as the snapshot is the "
      "first, and time.snapshots may list them",
      steps.size(), steps.front(), steps.back(), file.path().string()));
  return {steps.back()};
}

// The first of these attributes that is a number, or a dataset of a single one.
std::optional<double> find_number(const Hdf5File& file, const std::vector<const char*>& names,
                                  const std::string& group = "/") {
  for (const std::string& object : {group, std::string("/"), std::string("Header")}) {
    for (const char* name : names) {
      if (const auto number = file.number(object, name)) return number;
    }
  }
  for (const char* name : names) {
    if (!file.has(name)) continue;
    const Hdf5Dataset dataset = file.dataset(name);
    const bool is_number =
        dataset.kind != Hdf5Dataset::Kind::other && dataset.rows() * dataset.values_per_row() == 1;
    double value = 0;
    if (is_number) file.read_rows(dataset, 0, 1, &value);
    if (is_number) return value;
  }
  return std::nullopt;
}

// "kpccm/h" as yt calls comoving lengths, with our symbols.
std::string without_comoving(std::string unit) {
  const std::size_t parsec = unit.find("pccm");
  return parsec == std::string::npos ? unit : unit.replace(parsec, 4, "pc a");
}

// What lengths are in that yt says to be in `unit`: its code_length is a number of another one.
std::string unit_of_yt(const Hdf5File& file, const std::string& unit) {
  const auto number = file.number("/", "length_unit");
  const auto of_number = file.text("/", "length_unit_units");
  if (unit != "code_length" || !number || !of_number) return without_comoving(unit);
  return fmt::format("{} {}", *number, without_comoving(*of_number));
}

std::optional<double> ratio_of_yt(const Hdf5File& file, const std::string& from,
                                  const std::string& to, const UnitFactors& factors) {
  return from == to ? 1
                    : ratio_of_known_units(unit_of_yt(file, from), unit_of_yt(file, to), factors);
}

// yt's domain in the positions' unit.
std::optional<BoxSides> find_domain(const Hdf5File& file, const std::string& position_unit,
                                    const UnitFactors& factors) {
  const auto low = file.numbers("/", "domain_left_edge");
  const auto high = file.numbers("/", "domain_right_edge");
  if (!low || !high || low->size() != 3 || high->size() != 3) return std::nullopt;
  const auto ratio = ratio_of_yt(file, file.text("/", "domain_right_edge_units").value_or(""),
                                 position_unit, factors);
  if (!ratio) return std::nullopt;
  std::vector<double> sides;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sides.push_back(((*high)[axis] - (*low)[axis]) * *ratio);
  return box_of(sides);
}

// `group`: of the only particles, or the root.
void read_numbers(const Hdf5File& file, const std::string& group, SnapshotInfo& info) {
  info.time = find_number(file, {"time", "Time", "current_time"}, group).value_or(0);
  const bool is_of_expansion = file.number("/", "cosmological_simulation").value_or(1) != 0;
  if (is_of_expansion) {
    info.redshift = find_number(file, {"redshift", "Redshift", "current_redshift"}, group);
  }
  info.hubble_parameter = find_number(file, {"HubbleParam", "hubble_constant"});
}

void read_box(const Hdf5File& file, SnapshotInfo& info) {
  constexpr std::array<const char*, 3> names = {"box_size", "BoxSize", "boxsize"};
  for (const char* const object : {"/", "Header"}) {
    for (const char* const name : names) {
      if (const auto sides = file.numbers(object, name)) info.box_size = box_of(*sides);
      if (info.box_size) return;
    }
  }
  if (const auto side = find_number(file, {names.begin(), names.end()})) {
    info.box_size = box_of({*side});
  }
}

}  // namespace

bool is_plain_hdf5(const Hdf5File& file) {
  return !file.numbers("Header", "NumPart_ThisFile") && !particle_groups(file).empty();
}

std::unique_ptr<Snapshot> open_plain_hdf5(const std::filesystem::path& path,
                                          const std::string& wanted_group) {
  const Hdf5File file(path);
  const bool is_of_yt = file.text("/", "data_type").value_or("").compare(0, 3, "yt_") == 0;
  SnapshotInfo info;
  info.format = is_of_yt ? "HDF5 by yt's save_as_dataset" : "HDF5 without a header";
  info.files = {path};
  const std::vector<std::string> groups =
      choose_step(file, particle_groups(file), wanted_group, info.notes);
  read_numbers(file, groups.size() == 1 ? groups.front() : "/", info);
  TablesByType tables;
  for (const auto& [type, group] : choose_types(groups, info.notes)) {
    tables.emplace(type, std::make_unique<Hdf5Table>(path, group, info.notes));
  }
  // By now it has been asked for all groups.
  info.files_beside.assign(file.links().followed.begin(), file.links().followed.end());
  note_refused(file.links(), info.notes);
  const std::vector<TableColumn>& columns = tables.begin()->second->columns();
  const auto positions = find_positions(columns);
  // What yt hands on of the simulation's header is in other units than what it writes.
  if (!is_of_yt) read_box(file, info);
  if (!info.box_size && positions) {
    info.box_size =
        find_domain(file, split_unit(columns[*positions].name).unit, unit_factors(info));
  }
  return make_table_snapshot(std::move(tables), std::move(info));
}

}  // namespace splotchcl
