#include <limits>
#include <utility>

#include "scene_file/key_builder.h"
#include "snapshot/snapshot_list.h"

namespace splotchcl::scene_file {
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
      key<SequenceSettings, double>(
          "time.index", number(), if_set(&SequenceSettings::index),
          [](SequenceSettings& time, double value) { time.index = value; },
          {"The moment drawn: a snapshot's number in a pattern, or its place in a list, from 0. "
           "2.25 is a quarter of the way from 2 to 3.",
           "", "`0.0`"}),
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

}  // namespace splotchcl::scene_file
