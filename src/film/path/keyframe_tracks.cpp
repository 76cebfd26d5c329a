#include "film/path/keyframe_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cstddef>
#include <optional>
#include <utility>

#include "film/path/path_table.h"
#include "scene/curves.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

bool stops_at(const Stop& stop) {
  return stop.is_eased || stop.dwell > 0;
}

}  // namespace

bool KeyframePace::changes(const std::vector<Stop>& stops) {
  return std::any_of(stops.begin(), stops.end(), stops_at);
}

double KeyframePace::place_at(double frame) const {
  const auto after = std::find_if(stops_.begin(), stops_.end(),
                                  [frame](const Stop& stop) { return stop.frame > frame; });
  if (after == stops_.begin() || after == stops_.end()) {
    return after == stops_.end() ? stops_.back().frame : frame;
  }
  const Stop &from = *(after - 1), &to = *after;
  const double begin = from.frame + from.dwell;
  if (frame <= begin) return from.frame;
  const double width = to.frame - begin, way = to.frame - from.frame;
  const double t = (frame - begin) / width;
  // The cubic of a way that has these speeds at its ends.
  const double first = stops_at(from) ? 0 : width, last = stops_at(to) ? 0 : width;
  const double moved =
      way * t * t * (3 - 2 * t) + first * t * (1 - t) * (1 - t) + last * t * t * (t - 1);
  return from.frame + moved;
}

namespace {

using scene_file::write_number;

const std::string position_key = "camera.position", look_at_key = "camera.look_at",
                  sky_key = "camera.sky";

// What keyframes say of one key.
struct Knots {
  std::vector<double> frames;
  std::vector<std::string> values;
  std::vector<Stop> stops;
};

// A number, or an array of them.
struct Numbers {
  std::vector<double> values;
  bool is_array = false;
};

std::optional<double> number_of(const toml::node& node) {
  if (const auto integer = node.value_exact<std::int64_t>()) return static_cast<double>(*integer);
  return node.value_exact<double>();
}

std::optional<Numbers> numbers_of(const std::string& text) {
  const toml::table table = scene_file::parse_value(text);
  const toml::node& node = *table.get("value");
  if (const auto number = number_of(node)) return Numbers{{*number}, false};
  const toml::array* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  Numbers numbers{{}, true};
  for (const toml::node& element : *array) {
    const std::optional<double> number = number_of(element);
    if (!number) return std::nullopt;
    numbers.values.push_back(*number);
  }
  return numbers;
}

std::string written(const Numbers& numbers) {
  std::vector<std::string> texts;
  for (const double value : numbers.values)
    texts.push_back(write_number(value));
  const std::string list = fmt::format("{}", fmt::join(texts, ", "));
  return numbers.is_array ? "[" + list + "]" : list;
}

// Words and the like stay until the next keyframe.
std::function<std::string(double)> steps(const Knots& knots) {
  return [knots](double place) {
    std::size_t last = 0;
    while (last + 1 < knots.frames.size() && knots.frames[last + 1] <= place)
      ++last;
    return knots.values[last];
  };
}

[[noreturn]] void refuse_kinds(const std::string& key, double frame) {
  throw UsageError(
      fmt::format("path.keyframes: {} at frame {} is of another kind than at the keyframe before, "
                  "expected both to be a number, or as many numbers",
                  key, write_number(frame)));
}

// As numbers, or nothing where none is one.
std::optional<std::vector<Numbers>> all_numbers(const std::string& key, const Knots& knots) {
  std::vector<Numbers> all;
  for (std::size_t i = 0; i < knots.values.size(); ++i) {
    const std::optional<Numbers> numbers = numbers_of(knots.values[i]);
    const bool is_first = i == 0;
    const bool was_numbers = all.size() == i;
    if (!is_first && numbers.has_value() != (!all.empty() && was_numbers)) {
      refuse_kinds(key, knots.frames[i]);
    }
    if (!numbers) continue;
    if (!all.empty() && (all.front().is_array != numbers->is_array ||
                         all.front().values.size() != numbers->values.size())) {
      refuse_kinds(key, knots.frames[i]);
    }
    all.push_back(*numbers);
  }
  return all.empty() ? std::nullopt : std::optional(all);
}

// One spline for each of the numbers.
std::function<std::string(double)> splines(const Knots& knots, const std::vector<Numbers>& all,
                                           SplineKind kind) {
  std::vector<Spline> curves;
  for (std::size_t i = 0; i < all.front().values.size(); ++i) {
    std::vector<double> values;
    for (const Numbers& numbers : all)
      values.push_back(numbers.values[i]);
    curves.emplace_back(knots.frames, values, kind);
  }
  return [curves, is_array = all.front().is_array](double place) {
    Numbers at{{}, is_array};
    for (const Spline& curve : curves)
      at.values.push_back(curve.at(place));
    return written(at);
  };
}

// Points in space move as smoothly as they can; other values must not leave their range.
SplineKind kind_of(const std::string& key, bool is_smooth) {
  if (!is_smooth) return SplineKind::linear;
  const std::string last = key.substr(key.rfind('.') + 1);
  const bool is_point = last == "position" || last == "look_at" || last == "origin";
  return is_point ? SplineKind::natural : SplineKind::monotone;
}

Vec3 vector_of(const std::string& key, const std::string& text) {
  const std::optional<Numbers> numbers = numbers_of(text);
  if (!numbers || numbers->values.size() != 3) {
    throw UsageError(fmt::format("path.keyframes: found {} for {}, expected [x, y, z]",
                                 scene_file::one_line(text), key));
  }
  return {{numbers->values[0], numbers->values[1], numbers->values[2]}};
}

std::string written(const Vec3& v) {
  return written(Numbers{{v.a[0], v.a[1], v.a[2]}, true});
}

[[noreturn]] void refuse_direction(const std::string& key, double frame,
                                   const std::string& problem) {
  throw UsageError(fmt::format("path.keyframes: {} at frame {} {}, expected any direction", key,
                               write_number(frame), problem));
}

std::function<std::string(double)> sky_track(const Knots& knots, bool is_smooth) {
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < knots.frames.size(); ++i) {
    directions.push_back(vector_of(sky_key, knots.values[i]));
    if (!(boost::qvm::mag(directions.back()) > 0)) {
      refuse_direction(sky_key, knots.frames[i], "has no length");
    }
  }
  const DirectionTrack track(knots.frames, directions, is_smooth);
  return [track](double place) { return written(track.at(place)); };
}

// The view as it turns, seen from where the camera is.
std::function<std::string(double)> look_track(const Knots& knots,
                                              const std::function<Vec3(double)>& position,
                                              bool is_smooth) {
  std::vector<Vec3> directions;
  std::vector<double> distances;
  const KeyframePace pace(knots.stops);
  for (std::size_t i = 0; i < knots.frames.size(); ++i) {
    directions.push_back(vector_of(look_at_key, knots.values[i]) - position(knots.frames[i]));
    distances.push_back(boost::qvm::mag(directions.back()));
    if (!(distances.back() > 0)) {
      refuse_direction(look_at_key, knots.frames[i], "is where the camera stands");
    }
  }
  const DirectionTrack track(knots.frames, directions, is_smooth);
  const Spline distance(knots.frames, distances,
                        is_smooth ? SplineKind::monotone : SplineKind::linear);
  return [track, distance, position, pace](double frame) {
    const double place = pace.place_at(frame);
    return written(Vec3(position(frame) + distance.at(place) * track.at(place)));
  };
}

std::map<std::string, Knots> knots_by_key(const std::vector<Keyframe>& keyframes) {
  std::map<std::string, Knots> knots;
  for (const Keyframe& keyframe : keyframes) {
    for (const auto& [key, value] : keyframe.values) {
      knots[key].frames.push_back(keyframe.frame);
      knots[key].values.push_back(value);
      knots[key].stops.push_back({keyframe.frame, keyframe.dwell, keyframe.is_eased});
    }
  }
  return knots;
}

}  // namespace

KeyframeTracks::KeyframeTracks(const Scene& scene) {
  const std::string in_keyframes = "path.keyframes";
  const PathSettings& path = scene.path;
  std::map<std::string, Knots> knots = knots_by_key(path.keyframes);
  for (const auto& [key, of_key] : knots) {
    check_may_change(scene_file::locate(key, scene, in_keyframes).path, key, in_keyframes);
    if (key == sky_key) {
      tracks_[key] = sky_track(of_key, path.is_smooth);
    } else if (const auto numbers = all_numbers(key, of_key)) {
      tracks_[key] = splines(of_key, *numbers, kind_of(key, path.is_smooth));
    } else {
      tracks_[key] = steps(of_key);
    }
    if (KeyframePace::changes(of_key.stops)) {
      tracks_[key] = [track = tracks_[key], pace = KeyframePace(of_key.stops)](double frame) {
        return track(pace.place_at(frame));
      };
    }
  }
  const auto look = knots.find(look_at_key);
  if (path.look == PathSettings::Look::point || look == knots.end()) return;
  const auto moving = tracks_.find(position_key);
  std::function<Vec3(double)> position = [at = scene.camera.value_or(Camera()).position](double) {
    return at;
  };
  if (moving != tracks_.end()) {
    position = [track = moving->second](double place) {
      return vector_of(position_key, track(place));
    };
  }
  tracks_[look_at_key] = look_track(look->second, position, path.is_smooth);
}

std::vector<std::string> KeyframeTracks::settings(double frame) const {
  std::vector<std::string> settings;
  for (const auto& [key, track] : tracks_)
    settings.push_back(key + "=" + track(frame));
  return settings;
}

}  // namespace splotchcl
