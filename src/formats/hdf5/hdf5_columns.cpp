#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "common/words.h"
#include "formats/hdf5/hdf5_table.h"
#include "formats/snapshot_format.h"
#include "formats/table.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

std::string path_in(const std::string& group, const std::string& name) {
  return group == "/" ? group + name : group + "/" + name;
}

std::string last_name(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

// yt's names of particles' fields begin with "particle_"; its index is the identifier.
std::string field_label(const std::string& label) {
  const std::string prefix = "particle_";
  if (label.compare(0, prefix.size(), prefix) != 0 || label.size() == prefix.size()) return label;
  const std::string name = label.substr(prefix.size());
  return name == "index" ? "ids" : name;
}

bool is_column(const Hdf5Dataset& dataset) {
  const std::uint64_t values = dataset.values_per_row();
  return dataset.is_number() && !dataset.shape.empty() && (values == 1 || values == 3);
}

// Of three or two rows that are long: the axes of a vector one after the other.
bool has_axes_first(const Hdf5Dataset& dataset) {
  return dataset.is_number() && dataset.member.empty() && dataset.shape.size() == 2 &&
         (dataset.shape[0] == 2 || dataset.shape[0] == 3) && dataset.shape[1] > 3;
}

Hdf5Column column_of(const std::string& name, const std::string& owner, Hdf5Dataset dataset) {
  Hdf5Column column;
  column.name = name;
  column.owner = owner;
  column.values = static_cast<int>(dataset.values_per_row());
  column.rows = dataset.rows();
  column.terms.push_back({std::move(dataset), 1});
  return column;
}

// Rows of two numbers where particles have positions and velocities in a plane.
bool is_plane(const Hdf5Dataset& dataset) {
  const std::string field = canonical_field_name(dataset.label());
  return dataset.is_number() && dataset.shape.size() == 2 && dataset.values_per_row() == 2 &&
         (field == "position" || field == "velocity");
}

void add_two_axes(const std::string& name, const Hdf5Dataset& dataset, Hdf5Columns& found) {
  for (std::uint64_t axis = 0; axis < 2; ++axis) {
    Hdf5Dataset part = dataset;
    part.column = axis;
    const std::string label = fmt::format("{} {}", name, axis == 0 ? 'x' : 'y');
    found.columns.push_back(column_of(label, dataset.path, std::move(part)));
  }
}

void add_dataset(Hdf5Dataset dataset, Hdf5Columns& found) {
  const std::string name = field_label(dataset.label()), path = dataset.path;
  dataset.has_axes_first = has_axes_first(dataset);
  if (is_column(dataset)) {
    found.columns.push_back(column_of(name, path, std::move(dataset)));
  } else if (is_plane(dataset)) {
    add_two_axes(name, dataset, found);
  } else {
    found.others.push_back(dataset.label());
  }
}

// As openPMD writes what is the same for all: no dataset but its value.
std::optional<Hdf5Column> constant_in(const Hdf5File& file, const std::string& name,
                                      const std::string& group) {
  const auto value = file.number(group, "value");
  const auto shape = file.numbers(group, "shape");
  if (!value || !shape || !file.dataset_names(group).empty()) return std::nullopt;
  Hdf5Column column;
  column.name = name;
  column.owner = group;
  column.constant = *value;
  const bool is_count = shape->size() == 1 && shape->front() >= 0 && shape->front() < 1e18;
  column.rows = is_count ? static_cast<std::uint64_t>(shape->front()) : 0;
  return column;
}

// A single mass or smoothing length is that of every particle.
void add_number_for_all(const Hdf5File& file, const Hdf5Dataset& dataset, Hdf5Columns& found) {
  const std::string name = field_label(dataset.label()), field = canonical_field_name(name);
  const bool is_for_all = field == "mass" || field == "smoothing_length" || field == "density";
  if (!is_for_all || !dataset.is_number()) return;
  Hdf5Column column;
  column.name = name;
  column.owner = dataset.path;
  file.read_rows(dataset, 0, 1, &column.constant);
  found.columns.push_back(std::move(column));
}

bool is_axis(const std::string& name) {
  constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
  return std::find(axes.begin(), axes.end(), lower_case(name)) != axes.end();
}

// A group of datasets x, y, z is a vector.
bool add_axes(const Hdf5File& file, const std::string& group, Hdf5Columns& found) {
  const std::vector<std::string> datasets = file.dataset_names(group), groups = file.groups(group);
  const bool are_axes = datasets.size() + groups.size() >= 2 &&
                        std::all_of(datasets.begin(), datasets.end(), is_axis) &&
                        std::all_of(groups.begin(), groups.end(), is_axis);
  if (!are_axes) return false;
  const std::string vector = field_label(last_name(group));
  Hdf5Columns axes;
  for (const std::string& axis : datasets) {
    Hdf5Dataset dataset = file.dataset(path_in(group, axis));
    if (!is_column(dataset) || dataset.values_per_row() != 1) return false;
    const std::string name = vector + " " + lower_case(axis), path = dataset.path;
    axes.columns.push_back(column_of(name, path, std::move(dataset)));
  }
  for (const std::string& axis : groups) {
    auto column = constant_in(file, vector + " " + lower_case(axis), path_in(group, axis));
    if (!column) return false;
    axes.columns.push_back(std::move(*column));
  }
  std::move(axes.columns.begin(), axes.columns.end(), std::back_inserter(found.columns));
  return true;
}

// A group of one dataset "data" is that, as vaex writes columns. Where some values do not count, a
// dataset beside it says so, and the column is none for us.
bool add_data(const Hdf5File& file, const std::string& group, Hdf5Columns& found) {
  const std::vector<std::string> names = file.dataset_names(group);
  for (const char* const name : {"data", "values", "value"}) {
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    Hdf5Dataset dataset = file.dataset(path_in(group, name));
    if (names.size() > 1 || !is_column(dataset)) {
      found.others.push_back(last_name(group));
    } else {
      found.columns.push_back(column_of(field_label(last_name(group)), group, std::move(dataset)));
    }
    return true;
  }
  return false;
}

// Columns of one type together, with their names beside them, as pandas keeps data frames.
void add_data_frame(const Hdf5File& file, const std::string& group, Hdf5Columns& found) {
  for (int block = 0;; ++block) {
    const std::string items = path_in(group, fmt::format("block{}_items", block));
    const std::string values = path_in(group, fmt::format("block{}_values", block));
    if (!file.has(items) || !file.has(values)) return;
    const std::vector<std::string> names = file.lines(items);
    const Hdf5Dataset dataset = file.dataset(values);
    const bool is_table = dataset.is_number() && dataset.shape.size() == 2 &&
                          dataset.values_per_row() == names.size();
    for (std::size_t i = 0; is_table && i < names.size(); ++i) {
      Hdf5Dataset part = dataset;
      part.column = i;
      found.columns.push_back(column_of(names[i], dataset.path, std::move(part)));
    }
  }
}

double size_in_si(const Hdf5File& file, const std::string& object) {
  const double size = file.number(object, "unitSI").value_or(1);
  return size > 0 ? size : 1;
}

// openPMD's positions are from a point that is near to each particle: position + positionOffset.
void add_offsets(const Hdf5File& file, Hdf5Columns& found) {
  const std::string what = "positionOffset ";
  for (Hdf5Column& position : found.columns) {
    if (position.name.compare(0, 9, "position ") != 0) continue;
    const auto offset = std::find_if(
        found.columns.begin(), found.columns.end(),
        [&](const Hdf5Column& column) { return column.name == what + position.name.substr(9); });
    if (offset == found.columns.end()) continue;
    const double ratio = size_in_si(file, offset->owner) / size_in_si(file, position.owner);
    position.constant += ratio * offset->constant;
    if (!position.rows || position.terms.empty()) position.rows = offset->rows;
    for (const Hdf5Column::Term& term : offset->terms)
      position.terms.push_back({term.dataset, ratio * term.factor});
  }
  const auto is_offset = [&](const Hdf5Column& column) {
    return column.name.compare(0, what.size(), what) == 0;
  };
  found.columns.erase(std::remove_if(found.columns.begin(), found.columns.end(), is_offset),
                      found.columns.end());
}

// The texts of a list that Python has pickled in letters, "(lp0\nVx\np1\naVy\np2\na."; none for
// anything else.
std::vector<std::string> texts_in_pickle(const std::string& pickle) {
  std::vector<std::string> texts;
  std::istringstream lines(pickle);
  std::string line;
  if (!std::getline(lines, line) || line.compare(0, 2, "(l") != 0) return {};
  while (std::getline(lines, line)) {
    if (!line.empty() && line.front() == 'a') line.erase(0, 1);
    if (line.empty()) return {};
    const bool is_mark = line.front() == 'p' || line == ".";
    if (is_mark) continue;
    if (line.front() != 'V') return {};
    texts.push_back(line.substr(1));
  }
  return texts;
}

// pandas' format="table": columns of one type are an array in each record, whose names an attribute
// of the dataset tells. False for other members.
bool add_values_block(const Hdf5File& file, const Hdf5Dataset& member, Hdf5Columns& found) {
  const std::string label = member.label();
  if (label.rfind("values_block_", 0) != 0 || !member.is_number()) return false;
  const auto pickle = file.text(member.path, label + "_kind");
  const std::vector<std::string> names = texts_in_pickle(pickle.value_or(""));
  if (names.empty() || names.size() != member.values_per_row()) return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Hdf5Dataset part = member;
    if (names.size() > 1) part.column = i;
    found.columns.push_back(column_of(names[i], member.path, std::move(part)));
  }
  return true;
}

Hdf5Columns columns_of_records(const Hdf5File& file, const Hdf5Dataset& records) {
  Hdf5Columns found;
  for (Hdf5Dataset& member : file.members(records)) {
    member.path = records.path;
    if (add_values_block(file, member, found)) continue;
    if (is_column(member)) {
      const std::string label = field_label(member.label());
      found.columns.push_back(column_of(label, records.path, std::move(member)));
    } else {
      found.others.push_back(member.label());
    }
  }
  return found;
}

// h5py's complex numbers are records of two.
bool are_complex(const Hdf5File& file, const Hdf5Dataset& records) {
  const std::vector<Hdf5Dataset> members = file.members(records);
  return members.size() == 2 && members[0].label() == "r" && members[1].label() == "i";
}

Hdf5Columns columns_of_group(const Hdf5File& file, const std::string& group) {
  Hdf5Columns found;
  for (Hdf5Dataset& dataset : file.datasets(group)) {
    if (dataset.kind == Hdf5Dataset::Kind::records) {
      if (are_complex(file, dataset)) found.others.push_back(dataset.label());
      continue;
    }
    if (dataset.shape.empty()) {
      add_number_for_all(file, dataset, found);
      continue;
    }
    add_dataset(std::move(dataset), found);
  }
  for (const std::string& name : file.groups(group)) {
    const std::string path = path_in(group, name);
    auto constant = constant_in(file, name, path);
    const bool is_used = constant || add_axes(file, path, found) || add_data(file, path, found);
    if (constant) found.columns.push_back(std::move(*constant));
    if (is_used) found.used_groups.push_back(name);
  }
  add_data_frame(file, group, found);
  add_offsets(file, found);
  return found;
}

bool is_dataset(const Hdf5File& file, const std::string& place) {
  if (place == "/") return false;
  const std::size_t end = place.rfind('/');
  const std::vector<std::string> names = file.dataset_names(end == 0 ? "/" : place.substr(0, end));
  return std::find(names.begin(), names.end(), place.substr(end + 1)) != names.end();
}

// Goes through a file's groups, but not without end: links may lead in circles. Other names of what
// has been found would count particles twice; they are followed where nothing else is there.
class GroupSearch {
 public:
  explicit GroupSearch(const Hdf5File& file) : file_(file) {}
  std::vector<std::string> find() {
    search("/", 0);
    follows_other_names_ = true;
    if (found_.empty()) search("/", 0);
    return std::move(found_);
  }

 private:
  static constexpr int deepest = 6;
  static constexpr std::size_t most_groups = 100000;

  void search(const std::string& group, int depth) {
    if (++visited_ > most_groups) return;
    const Hdf5Columns here = columns_in(file_, group);
    const bool is_one = have_positions(here, depth);
    if (is_one) found_.push_back(group);
    for (const Hdf5Dataset& dataset : file_.datasets(group)) {
      const bool are_records = dataset.kind == Hdf5Dataset::Kind::records &&
                               dataset.shape.size() == 1 && counts(dataset.path);
      if (are_records && have_positions(columns_of_records(file_, dataset), depth))
        found_.push_back(dataset.path);
    }
    if (depth == deepest) return;
    for (const std::string& name : file_.groups(group)) {
      const bool is_used = is_one && std::find(here.used_groups.begin(), here.used_groups.end(),
                                               name) != here.used_groups.end();
      const std::string path = path_in(group, name);
      if (!is_used && counts(path)) search(path, depth + 1);
    }
  }
  bool counts(const std::string& path) const {
    return follows_other_names_ || !file_.is_soft_link(path);
  }
  // What has another name is taken for positions only where particles usually are.
  static bool have_positions(const Hdf5Columns& found, int depth) {
    const std::vector<TableColumn> names = names_of(found.columns);
    if (const auto first = find_positions(names)) {
      const std::string y = with_axis(names[*first].name, 1);
      return names[*first].values_per_row == 3 ||
             std::any_of(names.begin(), names.end(),
                         [&](const TableColumn& column) { return column.name == y; });
    }
    return depth <= 1 && guess_positions(names);
  }

  const Hdf5File& file_;
  std::vector<std::string> found_;
  std::size_t visited_ = 0;
  bool follows_other_names_ = false;
};

void list_group(const Hdf5File& file, const std::string& group, int depth, std::size_t most,
                std::vector<std::string>& contents) {
  for (const Hdf5Dataset& dataset : file.datasets(group)) {
    if (contents.size() == most) return;
    const char* const what = dataset.kind == Hdf5Dataset::Kind::records ? " records"
                             : dataset.is_number()                      ? ""
                                                                        : ", no plain numbers";
    contents.push_back(
        fmt::format("{} ({}{})", dataset.path.substr(1), fmt::join(dataset.shape, " x "), what));
  }
  constexpr int deepest = 6;
  const std::vector<std::string> groups = file.groups(group);
  for (const std::string& name : groups) {
    if (contents.size() == most) return;
    const std::size_t before = contents.size();
    if (depth < deepest) list_group(file, path_in(group, name), depth + 1, most, contents);
    if (contents.size() == before) contents.push_back(path_in(group, name).substr(1));
  }
}

}  // namespace

Hdf5Columns columns_in(const Hdf5File& file, const std::string& place) {
  return is_dataset(file, place) ? columns_of_records(file, file.dataset(place))
                                 : columns_of_group(file, place);
}

std::vector<TableColumn> names_of(const std::vector<Hdf5Column>& columns) {
  std::vector<TableColumn> names;
  for (const Hdf5Column& column : columns)
    names.push_back({column.name, column.values});
  return names;
}

std::vector<std::string> find_particle_groups(const Hdf5File& file) {
  return GroupSearch(file).find();
}

std::vector<std::string> list_contents(const Hdf5File& file, std::size_t most) {
  std::vector<std::string> contents;
  list_group(file, "/", 0, most, contents);
  return contents;
}

}  // namespace splotchcl
