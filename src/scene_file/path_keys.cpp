#include "scene_file/key_builder.h"
#include "scene_file/keyframe_values.h"

namespace splotchcl::scene_file {
namespace {

const std::vector<std::string> orbit_paths = {"path.orbit.degrees", "path.orbit.center",
                                              "path.orbit.axis", "path.orbit.radius"};
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
  };
}

Keys fly_keys() {
  return {
      fly_key("path.fly.through", points(), &FlyThrough::through,
              {"The camera flies through these points on a smooth curve at constant speed.",
               "length", "no fly-through; required for one"}),
      fly_key("path.fly.look_at", vector(), &FlyThrough::look_at,
              {"What it looks at.", "length", "ahead, along the curve"}),
      fly_key("path.fly.ease", choice<bool>({{"none", false}, {"both", true}}),
              &FlyThrough::is_eased,
              {"`both`: the flight speeds up at its start and slows down at its end.", "",
               "`\"none\"`"}),
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
         });
  return keys;
}

Keys movie_keys() {
  return {
      key("movie.frames", integer(1, 1000000), &MovieSettings::frames,
          {"How many frames the film has.", "",
           "the rows of the path's file, else up to its last keyframe"}),
      key("movie.frames_per_second", number(between(0.01, 1000)), &MovieSettings::frames_per_second,
          {"The film's speed.", "1/s"}),
      key("movie.codec",
          choice<Codec>({{"h264", Codec::h264}, {"h265", Codec::h265}, {"vp9", Codec::vp9}}),
          &MovieSettings::codec,
          {"How the film is encoded.", "", "`\"vp9\"` for .webm, else `\"h264\"`"}),
      key("movie.rate_factor", integer(0, 51), &MovieSettings::rate_factor,
          {"The encoder's constant rate factor: 18 looks lossless; 6 more halve the file."}),
      key("movie.bits", bits({8, 10}), &MovieSettings::bits,
          {"Bits per channel. 10 avoid steps in faint light; many players cannot show 10-bit "
           "`h264`."}),
  };
}

}  // namespace splotchcl::scene_file
