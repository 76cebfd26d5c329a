#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "scene_file/key_builder.h"
#include "snapshot/snapshot_files.h"

namespace splotchcl::scene_file {

namespace {

std::optional<std::string> name_and_column(const toml::key& name, const toml::node& node) {
  if (name.str().empty() || name.str().find('=') != std::string_view::npos) return std::nullopt;
  const std::string start = std::string(name.str()) + "=";
  if (const auto number = node.value_exact<std::int64_t>()) return start + std::to_string(*number);
  const auto column = node.value_exact<std::string>();
  return column && !column->empty() ? std::optional(start + *column) : std::nullopt;
}

std::optional<std::vector<std::string>> read_column_table(const toml::table& table) {
  std::vector<std::string> columns;
  for (const auto& [name, node] : table) {
    auto column = name_and_column(name, node);
    if (!column) return std::nullopt;
    columns.push_back(std::move(*column));
  }
  return columns.empty() ? std::nullopt : std::optional(std::move(columns));
}

// Names in their order, or what each name is in the file.
ValueType<std::vector<std::string>> column_names() {
  const ValueType<std::vector<std::string>> list = texts();
  const auto read = [list](const toml::node& node) {
    const toml::table* const table = node.as_table();
    return table != nullptr ? read_column_table(*table) : list.read(node);
  };
  return {"an array of strings, or a table of strings by name", read, list.write};
}

// The unit of each field, also in a list of "field=unit"; or the name of a system of units, alone
// or in the list.
ValueType<std::vector<std::string>> field_units() {
  const ValueType<std::vector<std::string>> units = column_names();
  const auto read = [units](const toml::node& node) {
    const auto system = node.value_exact<std::string>();
    return system && !system->empty() ? std::optional(std::vector<std::string>{*system})
                                      : units.read(node);
  };
  return {"a table of units by field, such as {mass = \"Msun\"}, or `gadget`, `cgs` or `si`", read,
          units.write};
}

}  // namespace

Keys read_keys() {
  constexpr int most = 2147483647;
  constexpr int most_neighbors = 4096;
  return {
      key<ReadSettings, std::vector<std::string>>(
          "read.columns", column_names(),
          [](const ReadSettings& read) {
            return read.columns.empty() ? std::nullopt : std::optional(read.columns);
          },
          [](ReadSettings& read, const std::vector<std::string>& value) { read.columns = value; },
          {"Names for the columns of a text table or plain NumPy array, in order; `-` skips one. "
           "Or names for columns, arrays and HDF5's datasets that are called otherwise. See "
           "formats.md.",
           "", "those in the file"}),
      key<ReadSettings, std::vector<std::string>>(
          "read.units", field_units(),
          [](const ReadSettings& read) {
            return read.units.empty() ? std::nullopt : std::optional(read.units);
          },
          [](ReadSettings& read, const std::vector<std::string>& value) { read.units = value; },
          {"Units of fields that the file does not say, or says wrongly; numbers stay.", "",
           "those in the file"}),
      key<ReadSettings, int>(
          "read.skip_lines", integer(0, most),
          [](const ReadSettings& read) {
            return read.skip_lines == 0 ? std::nullopt : std::optional(read.skip_lines);
          },
          [](ReadSettings& read, int value) { read.skip_lines = value; },
          {"Lines at the beginning of a text table that are no part of it.", "", "`0`"}),
      excluding(key<ReadSettings, int>(
                    "read.every", integer(1, most),
                    [](const ReadSettings& read) {
                      return read.max_particles ? std::nullopt : std::optional(read.every);
                    },
                    [](ReadSettings& read, int value) {
                      read.every = value;
                      read.max_particles.reset();
                    },
                    {"Draw every N-th particle of each type, brighter by as much as is left out."}),
                {"read.max_particles"}),
      key<ReadSettings, int>(
          "read.max_particles", integer(1, most),
          [](const ReadSettings& read) { return read.max_particles; },
          [](ReadSettings& read, int value) {
            read.max_particles = value;
            read.every = 1;
          },
          {"Draw at most this many particles, chosen at random and brighter likewise.", "", "all"}),
      key("read.seed", integer(0, most), &ReadSettings::seed, {"The seed of that choice."}),
      key("read.neighbours", integer(1, most_neighbors), &ReadSettings::neighbors,
          {"If the file has no smoothing lengths: how many particles their spheres hold."}),
      key("read.cache_smoothing_lengths", boolean(), &ReadSettings::cache_smoothing_lengths,
          {"Store smoothing lengths that had to be found in a file beside the snapshot, for "
           "reuse."}),
  };
}

namespace {

// A list of paths, or a pattern of them.
struct SnapshotNames {
  std::vector<std::string> list;
  std::string pattern;
};

ValueType<SnapshotNames> snapshot_names() {
  const ValueType<std::vector<std::string>> paths = texts();
  const auto read = [paths](const toml::node& node) -> std::optional<SnapshotNames> {
    if (const auto pattern = node.value_exact<std::string>()) {
      if (!is_snapshot_pattern(*pattern)) return std::nullopt;
      return SnapshotNames{{}, *pattern};
    }
    const auto list = paths.read(node);
    return list ? std::optional(SnapshotNames{*list, ""}) : std::nullopt;
  };
  const auto write = [paths](const SnapshotNames& names) {
    return names.pattern.empty() ? paths.write(names.list) : write_text(names.pattern);
  };
  return {"a list of paths, or one path with %d or %03d where the number stands", read, write};
}

// A value that means nothing without a sequence is not written.
template <class V>
auto if_set(V SequenceSettings::*member) {
  return [member](const SequenceSettings& time) {
    return time.is_set() ? std::optional<V>(time.*member) : std::nullopt;
  };
}

Key number_key(const std::string& name, const Range& range,
               std::optional<double> SequenceSettings::*member, const Text& text) {
  return key("time." + name, number(range), member, text);
}

}  // namespace

Keys time_keys() {
  constexpr int largest = 999999999;
  return {
      key<SequenceSettings, SnapshotNames>(
          "time.snapshots", snapshot_names(),
          [](const SequenceSettings& time) {
            return time.is_set() ? std::optional(SnapshotNames{time.snapshots, time.pattern})
                                 : std::nullopt;
          },
          [](SequenceSettings& time, const SnapshotNames& names) {
            time.snapshots = names.list;
            time.pattern = names.pattern;
          },
          {"Instead of `snapshot`: successive snapshots of one run; see time.md.", "",
           "none: a single snapshot"}),
      key("time.first", integer(0, largest), &SequenceSettings::first,
          {"The lowest number of a pattern. Numbers without a file are left out.", "", "0"}),
      key("time.last", integer(0, largest), &SequenceSettings::last,
          {"The highest number of a pattern.", "", "9999"}),
      key("time.index", number(), &SequenceSettings::index,
          {"The moment drawn: a snapshot's number in a pattern, or its place in a list, from 0. "
           "2.25 is a quarter of the way from 2 to 3.",
           "", "the first"}),
      key<SequenceSettings, Interpolation>(
          "time.interpolation",
          choice<Interpolation>({{"none", Interpolation::none},
                                 {"linear", Interpolation::linear},
                                 {"hermite", Interpolation::hermite}}),
          if_set(&SequenceSettings::interpolation),
          [](SequenceSettings& time, Interpolation value) { time.interpolation = value; },
          {"Between snapshots: the earlier one, straight lines, or cubics along the velocities.",
           "", "`\"linear\"`"}),
      number_key("omega_matter", at_least(0), &SequenceSettings::omega_matter,
                 {"For `hermite`: density of matter today.", "", "the snapshots'"}),
      number_key("omega_lambda", {}, &SequenceSettings::omega_lambda,
                 {"For `hermite`: density of dark energy today.", "", "the snapshots'"}),
      number_key(
          "hubble_rate", more_than(0), &SequenceSettings::hubble_rate,
          {"For `hermite`: H0; 0.1 for km/s and kpc/h.", "velocity / length", "the snapshots'"}),
  };
}

namespace {

ValueType<BoxSides> box_sides() {
  const auto read = [](const toml::node& node) -> std::optional<BoxSides> {
    std::vector<double> sides;
    if (const auto side = number().read(node)) sides = {*side};
    if (const auto all = vector().read(node)) sides.assign(all->a, all->a + 3);
    return box_of(sides);
  };
  const auto write = [](const BoxSides& box) {
    return box.is_cube() ? write_number(box[0]) : vector().write(box.vector());
  };
  return {"a number > 0, or [x, y, z], each > 0", read, write};
}

}  // namespace

Keys periodic_keys() {
  return written_if_set({
      key("periodic.wrap", boolean(), &PeriodicSettings::wrap,
          {"Draw each particle at its periodic image nearest to `camera.look_at`."}),
      key("periodic.box", box_sides(), &PeriodicSettings::box,
          {"Side of the periodic box, or one for each axis.", "length",
           "as the snapshot's header says"}),
  });
}

}  // namespace splotchcl::scene_file
