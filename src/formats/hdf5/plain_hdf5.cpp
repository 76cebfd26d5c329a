// HDF5 without a header that counts particles: datasets at the root or in groups, or records, as
// users of h5py, astropy and PyTables, yt's save_as_dataset and openPMD write them. The data
// themselves tell how many there are.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/words.h"
#include "formats/hdf5/hdf5_file.h"
#include "formats/hdf5/hdf5_formats.h"
#include "formats/hdf5/hdf5_table.h"
#include "formats/table.h"
#include "snapshot/field_names.h"
#include "snapshot/stated_numbers.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct NumberedName {
  std::string stem;
  std::string number;  // without leading zeros
};

NumberedName split_number(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  const std::size_t digits = last == std::string::npos ? 0 : last + 1;
  const std::size_t significant = std::min(name.find_first_not_of('0', digits), name.size());
  return {name.substr(0, digits), digits == name.size() ? "" : "0" + name.substr(significant)};
}

bool is_stem_of_steps(const std::string& stem) {
  constexpr std::array<const char*, 10> known = {"",     "step", "timestep", "time",  "snapshot",
                                                 "snap", "t",    "frame",    "cycle", "output"};
  const std::string word = lower_case(trimmed(stem.substr(stem.rfind('/') + 1), "#_-. "));
  return std::find(known.begin(), known.end(), word) != known.end();
}

std::optional<double> time_of(const Hdf5File& file, const std::string& group) {
  const auto time = file.number(group, "time");
  return time ? time : file.number(group, "Time");
}

bool are_steps(const Hdf5File& file, const std::string& stem,
               const std::vector<std::string>& groups) {
  if (groups.size() < 2) return false;
  return is_stem_of_steps(stem) ||
         std::all_of(groups.begin(), groups.end(),
                     [&](const std::string& group) { return time_of(file, group).has_value(); });
}

bool is_before(const std::string& a, const std::string& b) {
  const std::string x = split_number(a).number, y = split_number(b).number;
  return x.size() != y.size() ? x.size() < y.size() : x < y;
}

// A group that may be a step, and how its numbered name begins.
struct NumberedGroup {
  std::string stem, path;
};

// On the way to a group of particles, from the outside in.
std::vector<NumberedGroup> numbered_groups(const std::string& path) {
  std::vector<NumberedGroup> groups;
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end);
    const NumberedName name = split_number(group);
    const bool may_be_step =
        !name.number.empty() && !find_particle_type(group.substr(group.rfind('/') + 1));
    if (may_be_step) groups.push_back({name.stem, group});
    if (end == std::string::npos) return groups;
  }
}

// Groups of other names, each at a time of its own.
std::vector<std::string> steps_by_time(const Hdf5File& file,
                                       const std::vector<std::string>& groups) {
  std::map<double, std::string> by_time;
  for (const std::string& group : groups) {
    const auto time = time_of(file, group);
    const bool is_type = find_particle_type(group.substr(group.rfind('/') + 1)).has_value();
    if (!time || is_type || !by_time.emplace(*time, group).second) return {};
  }
  std::vector<std::string> steps;
  for (const auto& [time, group] : by_time)
    steps.push_back(group);
  return steps.size() > 1 ? steps : std::vector<std::string>();
}

// Of these groups with particles those that are the same particles at several times, as H5Part
// writes them (Step#0, Step#1, ...), in the order of their numbers: their names differ in a number
// alone, and tell of steps or each state a time. Empty: they are none.
std::vector<std::string> find_steps(const Hdf5File& file, const std::vector<std::string>& groups) {
  std::map<std::string, std::vector<std::string>> by_stem;
  for (const std::string& group : groups) {
    for (const NumberedGroup& numbered : numbered_groups(group)) {
      std::vector<std::string>& steps = by_stem[numbered.stem];
      if (std::find(steps.begin(), steps.end(), numbered.path) == steps.end())
        steps.push_back(numbered.path);
    }
  }
  for (auto& [stem, steps] : by_stem) {
    if (!are_steps(file, stem, steps)) continue;
    std::sort(steps.begin(), steps.end(), is_before);
    return std::move(steps);
  }
  return steps_by_time(file, groups);
}

using Notes = std::vector<std::string>;

// The group itself, then those that it is in.
std::vector<std::string> with_outer_groups(std::string group) {
  std::vector<std::string> groups;
  while (group.size() > 1) {
    groups.push_back(group);
    group.resize(group.rfind('/'));
  }
  groups.emplace_back("/");
  return groups;
}

// By its own name or that of the nearest group that it is in.
std::optional<int> type_of_group(const std::string& group) {
  for (const std::string& outer : with_outer_groups(group)) {
    if (const auto type = find_particle_type(outer.substr(outer.rfind('/') + 1))) return type;
  }
  return std::nullopt;
}

// A type for each group: by its name; where no name is one, in their order from 0. Beside groups
// whose names are types others tend to hold the same particles again.
std::map<int, std::string> choose_types(const std::vector<std::string>& groups, Notes& notes) {
  std::map<int, std::string> types;
  std::vector<std::string> others;
  for (const std::string& group : groups) {
    const auto type = type_of_group(group);
    const bool is_new = type && types.emplace(*type, group).second;
    if (!is_new) others.push_back(group);
  }
  if (!types.empty()) {
    for (const std::string& group : others) {
      const auto type = type_of_group(group);
      notes.push_back(
          type ? fmt::format("group {} is left out: {} has the particles of type {}", group,
                             types.at(*type), *type)
               : fmt::format("group {} is left out: its name is no type of particles", group));
    }
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

// Those that are the group or lie in it.
std::vector<std::string> groups_below(const std::vector<std::string>& groups,
                                      const std::string& wanted) {
  std::vector<std::string> below;
  for (const std::string& group : groups) {
    const std::vector<std::string> outer = with_outer_groups(group);
    if (std::find(outer.begin(), outer.end(), wanted) != outer.end()) below.push_back(group);
  }
  return below;
}

// The innermost group that holds all of these.
std::string common_group(const std::vector<std::string>& groups) {
  for (const std::string& outer : with_outer_groups(groups.front())) {
    if (groups_below(groups, outer).size() == groups.size()) return outer;
  }
  return "/";
}

std::string name_groups(const Hdf5File& file, const std::vector<std::string>& groups) {
  constexpr std::size_t most_named = 3;
  const std::vector<std::string> steps = find_steps(file, groups);
  if (steps.size() <= most_named) return fmt::format("one of {}", fmt::join(groups, ", "));
  return fmt::format("one of {} steps in time, {} to {}", steps.size(), steps.front(),
                     steps.back());
}

// Of groups that are steps in time those of one: that which is asked for, or the last.
std::vector<std::string> choose_step(const Hdf5File& file, const std::vector<std::string>& groups,
                                     const std::string& wanted, Notes& notes) {
  if (!wanted.empty()) {
    std::vector<std::string> below = groups_below(groups, "/" + wanted);
    if (!below.empty()) return below;
    throw DataError(fmt::format("{}: found no particles in a group {}, expected {}",
                                file.path().string(), wanted, name_groups(file, groups)));
  }
  const std::vector<std::string> steps = find_steps(file, groups);
  if (steps.empty()) return groups;
  notes.push_back(fmt::format(
      "the file has {0} steps in time, {1} to {2}: the last is read; {3}{1} as the snapshot is the "
      "first, and time.snapshots may list them",
      steps.size(), steps.front(), steps.back(), file.path().string()));
  return groups_below(groups, steps.back());
}

// Whoever keeps masses apart from positions misses them.
void note_columns_elsewhere(const Hdf5File& file, const std::string& group, std::uint64_t rows,
                            Notes& notes) {
  const std::string parent = group == "/" ? group : with_outer_groups(group)[1];
  const std::vector<std::string> used = columns_in(file, parent).used_groups;
  for (const std::string& name : file.groups(parent)) {
    const std::string path = parent == "/" ? parent + name : parent + "/" + name;
    if (path == group || std::find(used.begin(), used.end(), name) != used.end()) continue;
    std::vector<std::string> names;
    const std::vector<Hdf5Column> columns = columns_in(file, path).columns;
    if (find_positions(names_of(columns))) continue;
    for (const Hdf5Column& column : columns) {
      if (column.rows == rows) names.push_back(column.name);
    }
    if (names.empty()) continue;
    notes.push_back(
        fmt::format("left out of {}, which has no positions: {}; read.columns may name "
                    "datasets of several groups",
                    path, fmt::join(names, ", ")));
  }
}

// Of a small dataset; empty where it is none of numbers, or longer.
std::vector<double> few_numbers(const Hdf5File& file, const char* name) {
  constexpr std::uint64_t most = 3;
  if (!file.has(name)) return {};
  const Hdf5Dataset dataset = file.dataset(name);
  const std::uint64_t count = dataset.rows() * dataset.values_per_row();
  std::vector<double> numbers(dataset.is_number() && count <= most ? count : 0);
  if (!numbers.empty()) file.read_rows(dataset, 0, dataset.rows(), numbers.data());
  return numbers;
}

// The first of these attributes that is a number, or a dataset of a single one.
std::optional<double> find_number(const Hdf5File& file, const std::vector<const char*>& names,
                                  const std::string& group = "/") {
  std::vector<std::string> objects = with_outer_groups(group);
  objects.emplace_back("Header");
  for (const std::string& object : objects) {
    for (const char* name : names) {
      if (const auto number = file.number(object, name)) return number;
    }
  }
  for (const char* name : names) {
    if (const std::vector<double> numbers = few_numbers(file, name); numbers.size() == 1)
      return numbers.front();
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
    const double scale_factor =
        find_number(file, {"scale_factor", "expansion_factor"}, group).value_or(0);
    if (!info.redshift && scale_factor > 0 && std::isfinite(scale_factor))
      info.redshift = 1 / scale_factor - 1;
  }
  const double hubble_parameter = hubble_parameter_of(
      find_number(file, {"HubbleParam", "hubble_constant"}).value_or(0), info.notes);
  if (hubble_parameter > 0) info.hubble_parameter = hubble_parameter;
}

void read_box(const Hdf5File& file, SnapshotInfo& info) {
  constexpr std::array<const char*, 3> names = {"box_size", "BoxSize", "boxsize"};
  for (const char* const object : {"/", "Header"}) {
    for (const char* const name : names) {
      if (const auto sides = file.numbers(object, name))
        info.box_size = box_stated(*sides, info.notes);
      if (info.box_size) return;
    }
  }
  for (const char* const name : names) {
    if (!info.box_size) info.box_size = box_stated(few_numbers(file, name), info.notes);
  }
}

}  // namespace

bool is_plain_hdf5(const Hdf5File& file) {
  return !file.numbers("Header", "NumPart_ThisFile") && !find_particle_groups(file).empty();
}

namespace {

std::string format_name(const Hdf5File& file, bool is_of_yt) {
  if (is_of_yt) return "HDF5 by yt's save_as_dataset";
  return file.text("/", "openPMD") ? "HDF5 of openPMD" : "HDF5 without a header";
}

// What all of plain HDF5 has in common.
class PlainHdf5 {
 public:
  explicit PlainHdf5(const std::filesystem::path& path)
      : file_(path),
        is_of_yt_(file_.text("/", "data_type").value_or("").compare(0, 3, "yt_") == 0) {
    info_.format = format_name(file_, is_of_yt_);
    info_.files = {path};
  }
  // Of a group, or of a step in time in its table.
  std::unique_ptr<Snapshot> open(const std::string& wanted);
  std::unique_ptr<Snapshot> open_named(const std::string& wanted,
                                       const std::vector<std::string>& columns);

 private:
  void add_table(int type, std::unique_ptr<const Table> table);
  // The only group, or the root; and the step in its tables.
  std::unique_ptr<Snapshot> make_snapshot(const std::string& group, const std::string& step);

  Hdf5File file_;
  bool is_of_yt_;
  SnapshotInfo info_;
  TablesByType tables_;
};

void PlainHdf5::add_table(int type, std::unique_ptr<const Table> table) {
  tables_.emplace(type, with_flat_positions(std::move(table), info_.notes));
}

std::unique_ptr<Snapshot> PlainHdf5::make_snapshot(const std::string& group,
                                                   const std::string& step) {
  // By now it has been asked for all groups.
  info_.files_beside.assign(file_.links().followed.begin(), file_.links().followed.end());
  note_refused(file_.links(), info_.notes);
  read_numbers(file_, group, info_);
  const std::vector<TableColumn>& columns = tables_.begin()->second->columns();
  const auto positions = find_positions(columns);
  // What yt hands on of the simulation's header is in other units than what it writes.
  if (!is_of_yt_) read_box(file_, info_);
  if (!info_.box_size && positions) {
    info_.box_size =
        find_domain(file_, split_unit(columns[*positions].name).unit, unit_factors(info_));
  }
  for (auto& [type, table] : tables_)
    table = with_one_step(std::move(table), step, info_);
  return make_table_snapshot(std::move(tables_), std::move(info_));
}

std::unique_ptr<Snapshot> PlainHdf5::open(const std::string& wanted) {
  const auto [wanted_group, step] = split_step(wanted);
  const std::vector<std::string> groups =
      choose_step(file_, find_particle_groups(file_), wanted_group, info_.notes);
  for (const auto& [type, group] : choose_types(groups, info_.notes)) {
    auto table = std::make_unique<Hdf5Table>(file_.path(), group, info_.notes);
    if (table->rows() > 0) {
      add_table(type, std::move(table));
    } else {
      info_.notes.push_back(fmt::format("{} is left out: its positions have no rows", group));
    }
  }
  if (groups.size() == 1 && !tables_.empty())
    note_columns_elsewhere(file_, groups.front(), tables_.begin()->second->rows(), info_.notes);
  if (tables_.empty()) {
    throw DataError(fmt::format("{}: the positions in {} have no rows; expected particles",
                                file_.path().string(), fmt::join(groups, ", ")));
  }
  return make_snapshot(groups.size() == 1 ? groups.front() : common_group(groups), step);
}

std::unique_ptr<Snapshot> PlainHdf5::open_named(const std::string& wanted,
                                                const std::vector<std::string>& columns) {
  const auto [group, step] = split_step(wanted);
  std::vector<Hdf5Column> named = named_columns(file_, group, columns);
  const std::string owner = named.front().owner;
  add_table(type_of_group(owner).value_or(0),
            std::make_unique<Hdf5Table>(file_.path(), std::move(named)));
  return make_snapshot(with_outer_groups(owner)[1], step);
}

}  // namespace

std::unique_ptr<Snapshot> open_plain_hdf5(const std::filesystem::path& path,
                                          const std::string& wanted_group) {
  return PlainHdf5(path).open(wanted_group);
}

std::unique_ptr<Snapshot> open_named_columns(const std::filesystem::path& path,
                                             const std::string& group,
                                             const std::vector<std::string>& columns) {
  return PlainHdf5(path).open_named(group, columns);
}

}  // namespace splotchcl
