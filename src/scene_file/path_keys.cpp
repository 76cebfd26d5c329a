#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "scene_file/key_builder.h"
#include "scene_file/values.h"
#include "splotchcl/path.h"

namespace splotchcl::scene_file {
namespace {

// A value as text that reads back as the same; nothing for dates, which no key takes.
std::optional<std::string> write_value(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return write_text(*text);
  if (const auto number = node.value_exact<double>()) return write_number(*number);
  if (const auto integer = node.value_exact<std::int64_t>()) return std::to_string(*integer);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  const toml::array* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  std::vector<std::string> elements;
  for (const toml::node& element : *array) {
    const std::optional<std::string> text = write_value(element);
    if (!text) return std::nullopt;
    elements.push_back(*text);
  }
  return fmt::format("[{}]", fmt::join(elements, ", "));
}

// The camera's vectors may be written without its name.
std::string full_key(const std::string& key) {
  const bool is_short = key == "position" || key == "look_at" || key == "sky";
  return is_short ? "camera." + key : key;
}

// Keys and those of tables in the table, with dots. False: a value that no key takes, or a
// key for the second time.
bool collect(const toml::table& table, const std::string& prefix,
             std::map<std::string, std::string>& values) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (key == "frame" || key == "ease" || key == "dwell") continue;
    if (const toml::table* inner = node.as_table()) {
      if (!collect(*inner, key + ".", values)) return false;
      continue;
    }
    const std::optional<std::string> value = write_value(node);
    if (!value || !values.emplace(full_key(key), *value).second) return false;
  }
  return true;
}

// How the keys go through the keyframe. False: a value of another kind.
bool read_speed(const toml::table& table, Keyframe& keyframe) {
  if (const toml::node* const ease = table.get("ease")) {
    const std::optional<bool> is_eased = boolean().read(*ease);
    if (!is_eased) return false;
    keyframe.is_eased = *is_eased;
  }
  if (const toml::node* const dwell = table.get("dwell")) {
    const std::optional<double> frames = number(at_least(0)).read(*dwell);
    if (!frames) return false;
    keyframe.dwell = *frames;
  }
  return true;
}

std::optional<Keyframe> read_keyframe(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return std::nullopt;
  const toml::node* frame = table->get("frame");
  if (frame == nullptr) return std::nullopt;
  Range range;
  range.at_least = 0;
  const std::optional<double> place = number(range).read(*frame);
  Keyframe keyframe;
  const bool has_speed = read_speed(*table, keyframe);
  if (!place || !has_speed || !collect(*table, "", keyframe.values) || keyframe.values.empty()) {
    return std::nullopt;
  }
  keyframe.frame = *place;
  return keyframe;
}

std::optional<std::vector<Keyframe>> read_keyframes(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) return std::nullopt;
  std::vector<Keyframe> keyframes;
  for (const toml::node& element : *array) {
    const std::optional<Keyframe> keyframe = read_keyframe(element);
    const bool is_in_order =
        keyframe &&
        (keyframes.empty() || keyframes.back().frame + keyframes.back().dwell < keyframe->frame);
    if (!is_in_order) return std::nullopt;
    keyframes.push_back(*keyframe);
  }
  return keyframes;
}

std::string write_keyframes(const std::vector<Keyframe>& keyframes) {
  std::vector<std::string> tables;
  for (const Keyframe& keyframe : keyframes) {
    std::string table = "frame = " + write_number(keyframe.frame);
    if (keyframe.is_eased) table += ", ease = true";
    if (keyframe.dwell > 0) table += ", dwell = " + write_number(keyframe.dwell);
    for (const auto& [key, value] : keyframe.values)
      table += fmt::format(", {} = {}", write_text(key), value);
    tables.push_back(fmt::format("  {{ {} }},\n", table));
  }
  return fmt::format("[\n{}]", fmt::join(tables, ""));
}

std::optional<std::vector<Vec3>> read_points(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() < 2) return std::nullopt;
  std::vector<Vec3> points;
  for (const toml::node& element : *array) {
    const std::optional<Vec3> point = vector().read(element);
    if (!point) return std::nullopt;
    points.push_back(*point);
  }
  return points;
}

std::string write_points(const std::vector<Vec3>& points) {
  std::vector<std::string> texts;
  for (const Vec3& point : points)
    texts.push_back(vector().write(point));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

// An array of tables, each with a frame and keys of the scene.
ValueType<std::vector<Keyframe>> keyframes() {
  return {
      "tables in increasing order of frame, each with frame, a number >= 0, and one or more keys "
      "of a scene; also ease, true or false, and dwell, a number >= 0",
      read_keyframes, write_keyframes};
}

// [[x, y, z], ...], two at least.
ValueType<std::vector<Vec3>> points() {
  return {"two or more of [x, y, z], each a finite number", read_points, write_points};
}

const std::vector<std::string> orbit_paths = {"path.orbit.degrees", "path.orbit.center",
                                              "path.orbit.axis", "path.orbit.radius",
                                              "path.orbit.ease"};
const std::vector<std::string> fly_paths = {"path.fly.through", "path.fly.look_at",
                                            "path.fly.ease"};

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// A file, an orbit and a fly-through replace each other.
Orbit& orbit_of(PathSettings& path) {
  path.file.clear();
  path.fly.reset();
  return path.orbit ? *path.orbit : path.orbit.emplace();
}

FlyThrough& fly_of(PathSettings& path) {
  path.file.clear();
  path.orbit.reset();
  return path.fly ? *path.fly : path.fly.emplace();
}

template <class V, class Member>
Key orbit_key(const std::string& path, const ValueType<V>& type, Member Orbit::*member,
              const Text& text) {
  return excluding(
      key<PathSettings, V>(
          path, type,
          [member](const PathSettings& settings) {
            return settings.orbit ? std::optional<V>((*settings.orbit).*member) : std::nullopt;
          },
          [member](PathSettings& settings, const V& value) { orbit_of(settings).*member = value; },
          text),
      fly_paths);
}

template <class V, class Member>
Key fly_key(const std::string& path, const ValueType<V>& type, Member FlyThrough::*member,
            const Text& text) {
  return key<PathSettings, V>(
      path, type,
      [member](const PathSettings& settings) {
        return settings.fly ? std::optional<V>((*settings.fly).*member) : std::nullopt;
      },
      [member](PathSettings& settings, const V& value) { fly_of(settings).*member = value; }, text);
}

ValueType<bool> ease() {
  return choice<bool>({{"none", false}, {"both", true}});
}

Keys orbit_keys() {
  return {
      orbit_key(
          "path.orbit.degrees", number(), &Orbit::degrees,
          {"How far the camera turns over the film, counterclockwise seen from the axis' tip.",
           "degrees", "no orbit; 360 if another key of it is set"}),
      orbit_key("path.orbit.center", vector(), &Orbit::center,
                {"What the camera turns about.", "length", "the camera's look-at point"}),
      orbit_key("path.orbit.axis", vector(), &Orbit::axis,
                {"The direction of the axis.", "", "the camera's sky"}),
      orbit_key("path.orbit.radius", number(more_than(0)), &Orbit::radius,
                {"The camera's distance from the center.", "length", "as the camera stands"}),
      orbit_key("path.orbit.ease", ease(), &Orbit::is_eased,
                {"`both`: it starts and ends slowly.", "", "`\"none\"`"}),
  };
}

Keys fly_keys() {
  return {
      fly_key("path.fly.through", points(), &FlyThrough::through,
              {"The camera flies through these points on a smooth curve at constant speed.",
               "length", "no fly-through; required for one"}),
      fly_key("path.fly.look_at", vector(), &FlyThrough::look_at,
              {"What it looks at.", "length", "ahead, along the curve"}),
      fly_key("path.fly.ease", ease(), &FlyThrough::is_eased,
              {"`both`: the flight speeds up at its start and slows down at its end.", "",
               "`\"none\"`"}),
  };
}

// A point, or a word for one that is found: then nothing.
ValueType<std::optional<Vec3>> point_or(const std::string& word) {
  using Place = std::optional<Vec3>;
  return {"[x, y, z], each a finite number, or \"" + word + "\"",
          [word](const toml::node& node) -> std::optional<Place> {
            if (node.value_exact<std::string>() == word) return std::optional<Place>(std::in_place);
            const std::optional<Vec3> point = vector().read(node);
            return point ? std::optional<Place>(std::in_place, *point) : std::nullopt;
          },
          [word](const Place& point) { return point ? vector().write(*point) : write_text(word); }};
}

Keys followed_keys() {
  using Place = std::optional<Vec3>;
  return {
      excluding(key<Follow, std::uint64_t>(
                    "path.follow.halo", identifier(), [](const Follow& f) { return f.halo; },
                    [](Follow& f, std::uint64_t value) {
                      f.halo = value;
                      f.sphere_center.reset();
                      f.sphere_radius.reset();
                    },
                    {"The camera follows this halo; "
                     "see movies.md.",
                     "", "none"}),
                {"path.follow.sphere.center", "path.follow.sphere.radius"}),
      key<Follow, std::string>(
          "path.follow.catalog", text(),
          [](const Follow& f) {
            return f.catalog.empty() ? std::nullopt : std::optional(f.catalog);
          },
          [](Follow& f, const std::string& value) { f.catalog = value; },
          {"The catalog for `halo`.", "", "the snapshot's group ids, else a catalog beside it"}),
      key<Follow, Place>(
          "path.follow.sphere.center", point_or("densest"),
          [](const Follow& f) {
            return f.halo ? std::nullopt : std::optional<Place>(std::in_place, f.sphere_center);
          },
          [](Follow& f, const Place& value) {
            f.halo.reset();
            f.sphere_center = value;
          },
          {"The camera follows what is in this sphere.", "length", "none"}),
      key<Follow, double>(
          "path.follow.sphere.radius", number(more_than(0)),
          [](const Follow& f) { return f.sphere_radius; },
          [](Follow& f, double value) {
            f.halo.reset();
            f.sphere_radius = value;
          },
          {"The sphere's radius.", "length", "200 times as dense as the mean"}),
  };
}

Keys follow_keys() {
  Keys keys = followed_keys();
  append(keys,
         {
             key<Follow, double>(
                 "path.follow.snapshot", number(), [](const Follow& f) { return f.snapshot; },
                 [](Follow& f, double value) { f.snapshot = value; },
                 {"The `time.index` at which it is looked up.", "", "the last"}),
             key<Follow, double>(
                 "path.follow.size", number(more_than(0)), [](const Follow& f) { return f.size; },
                 [](Follow& f, double value) { f.size = value; },
                 {"The picture's shorter side.", "radii", "4"}),
             key<Follow, Follow::Up>(
                 "path.follow.up",
                 choice<Follow::Up>({{"camera", Follow::Up::camera},
                                     {"angular_momentum", Follow::Up::angular_momentum}}),
                 [](const Follow& f) { return f.up; },
                 [](Follow& f, Follow::Up value) { f.up = value; },
                 {"`angular_momentum`: its own; the path turns with it.", "", "`\"camera\"`"}),
         });
  return keys;
}

Keys approach_keys() {
  using Place = std::optional<Vec3>;
  return {
      key<Approach, Place>(
          "path.approach.to", point_or("followed"),
          [](const Approach& a) { return std::optional<Place>(std::in_place, a.to); },
          [](Approach& a, const Place& value) { a.to = value; },
          {"The camera goes here from what it shows.", "length", "none"}),
      key<Approach, double>(
          "path.approach.width", number(more_than(0)), [](const Approach& a) { return a.width; },
          [](Approach& a, double value) { a.width = value; },
          {"Across the picture in the end.", "length", "as `path.follow.size` says"}),
  };
}

}  // namespace

Keys path_keys() {
  Keys keys = {
      excluding(
          key<PathSettings, std::string>(
              "path.file", text(),
              [](const PathSettings& path) {
                return path.file.empty() ? std::nullopt : std::optional(path.file);
              },
              [](PathSettings& path, const std::string& value) {
                path.orbit.reset();
                path.fly.reset();
                path.file = value;
              },
              {"A text file with a row of values for each frame; see movies.md.", "", "none"}),
          both(orbit_paths, fly_paths)),
  };
  append(keys, orbit_keys());
  append(keys, fly_keys());
  append(keys, follow_keys());
  append(keys, approach_keys());
  append(keys,
         {
             key<PathSettings, std::vector<Keyframe>>(
                 "path.keyframes", keyframes(),
                 [](const PathSettings& path) {
                   return path.keyframes.empty() ? std::nullopt : std::optional(path.keyframes);
                 },
                 [](PathSettings& path, const std::vector<Keyframe>& value) {
                   path.keyframes = value;
                 },
                 {"`[[path.keyframes]]`: values of keys at some frames, counted from 0; see "
                  "movies.md.",
                  "", "none"}),
             key("path.interpolation", choice<bool>({{"smooth", true}, {"linear", false}}),
                 &PathSettings::is_smooth,
                 {"Keyframes are joined by smooth curves or straight lines."}),
             key("path.look",
                 choice<PathSettings::Look>({{"point", PathSettings::Look::point},
                                             {"direction", PathSettings::Look::direction}}),
                 &PathSettings::look,
                 {"What moves between keyframes: the look-at point, or the view's direction."}),
             key("path.max_turn_rate", number(more_than(0)), &PathSettings::max_turn_rate,
                 {"The view turns no faster: it looks ahead.", "degrees/s", "no limit"}),
             written_if_set(
                 key("path.simplify", number(more_than(0)), &PathSettings::simplified_within,
                     {"Leaves out keyframes without which the film is off by less; see movies.md.",
                      "", "all stay"})),
         });
  return keys;
}

namespace {

Range shutter_range() {
  Range range = more_than(0);
  range.at_most = 1;
  return range;
}

}  // namespace

Keys movie_keys() {
  return {
      key("movie.frames", integer(1, 1000000), &MovieSettings::frames,
          {"How many frames the film has.", "",
           "the rows of the path's file, else up to its last keyframe"}),
      key("movie.frames_per_second", number(between(0.01, 1000)), &MovieSettings::frames_per_second,
          {"The film's speed.", "1/s"}),
      key("movie.codec",
          choice<Codec>({{"h264", Codec::h264},
                         {"h265", Codec::h265},
                         {"vp9", Codec::vp9},
                         {"av1", Codec::av1},
                         {"prores", Codec::prores},
                         {"dnxhr", Codec::dnxhr},
                         {"hap", Codec::hap},
                         {"ffv1", Codec::ffv1}}),
          &MovieSettings::codec,
          {"How the film is encoded; see movies.md.", "", "`\"vp9\"` for .webm, else `\"h264\"`"}),
      key("movie.rate_factor", integer(0, 51), &MovieSettings::rate_factor,
          {"The encoder's constant rate factor: 18 looks lossless; 6 more halve the file."}),
      key("movie.bits", bits({8, 10}), &MovieSettings::bits,
          {"Bits per channel. 10 avoid steps in faint light; many players cannot show 10-bit "
           "`h264`."}),
      key<MovieSettings, std::string>(
          "movie.audio", text(),
          [](const MovieSettings& movie) {
            return movie.audio.empty() ? std::nullopt : std::optional(movie.audio);
          },
          [](MovieSettings& movie, const std::string& value) { movie.audio = value; },
          {"A file whose sound lies under the film.", "", "none"}),
      key("movie.motion_blur.shutter", number(shutter_range()), &MotionBlur::shutter,
          {"Frames are means over this part of their time.", "", "no motion blur, or 0.5"}),
      key("movie.motion_blur.samples", integer(2, 1000), &MotionBlur::samples,
          {"Pictures for a frame.", "", "no motion blur, or 8"}),
  };
}

}  // namespace splotchcl::scene_file
