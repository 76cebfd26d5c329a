#pragma once

#include <cstddef>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene_file/keys.h"
#include "scene_file/values.h"

// The words in which the table of keys is written.
namespace splotchcl::scene_file {

using Keys = std::vector<Key>;

Keys component_keys();
Keys path_keys();
Keys map_keys();
Keys movie_keys();
Keys particle_keys();  // of components, too
Keys time_keys();
Keys finish_keys();
Keys periodic_keys();
Keys read_keys();
Keys stereo_keys();

inline void append(Keys& keys, const Keys& more) {
  keys.insert(keys.end(), more.begin(), more.end());
}

inline Range at_least(double limit) {
  Range range;
  range.at_least = limit;
  return range;
}

inline Range more_than(double limit) {
  Range range;
  range.more_than = limit;
  return range;
}

inline Range between(double lowest, double highest) {
  Range range = at_least(lowest);
  range.at_most = highest;
  return range;
}

inline Range field_of_view_range() {
  Range range = more_than(0);
  range.less_than = 180;
  return range;
}

// Factors of light end up in single precision.
inline Range light() {
  return between(0, 1e30);
}

struct Text {
  std::string meaning;
  std::string unit = "";
  std::string absent = "";
};

// What gets or puts a value: a lambda with what it captures, pointers to members at most. There are
// hundreds, and of each std::function would make the compiler a dozen functions.
template <class Signature>
class Access;

template <class Result, class... Arguments>
class Access<Result(Arguments...)> {
 public:
  template <class Lambda>
  Access(Lambda lambda) : call_(call<Lambda>) {
    static_assert(std::is_trivially_copyable_v<Lambda> && sizeof(Lambda) <= sizeof(captured_));
    new (captured_) Lambda(lambda);
  }
  Result operator()(Arguments... arguments) const { return call_(captured_, arguments...); }

 private:
  template <class Lambda>
  static Result call(const std::byte* captured, Arguments... arguments) {
    return (*std::launder(reinterpret_cast<const Lambda*>(captured)))(arguments...);
  }
  alignas(void*) std::byte captured_[2 * sizeof(void*)];
  Result (*call_)(const std::byte*, Arguments...);
};

// A part that is there as soon as one of its keys is.
template <class Part>
Part& there(std::optional<Part>& part) {
  return part ? *part : part.emplace();
}

template <class Part>
const Part& there(const std::optional<Part>& part) {
  return *part;
}

// Part of a scene by its type, const as the scene is.
template <class Part, class AnyScene>
auto& part(AnyScene& scene, std::size_t component) {
  if constexpr (std::is_same_v<Part, Scene>) {
    return scene;
  } else if constexpr (std::is_same_v<Part, ImageSettings>) {
    return scene.image;
  } else if constexpr (std::is_same_v<Part, Camera>) {
    return *scene.camera;
  } else if constexpr (std::is_same_v<Part, Stereo>) {
    return *scene.stereo;
  } else if constexpr (std::is_same_v<Part, KernelSettings>) {
    return scene.kernel;
  } else if constexpr (std::is_same_v<Part, SortOrder>) {
    return scene.sort;
  } else if constexpr (std::is_same_v<Part, PathSettings>) {
    return scene.path;
  } else if constexpr (std::is_same_v<Part, Follow>) {
    return there(scene.path.follow);
  } else if constexpr (std::is_same_v<Part, Approach>) {
    return there(scene.path.approach);
  } else if constexpr (std::is_same_v<Part, MotionBlur>) {
    return there(scene.movie.motion_blur);
  } else if constexpr (std::is_same_v<Part, MovieSettings>) {
    return scene.movie;
  } else if constexpr (std::is_same_v<Part, SequenceSettings>) {
    return scene.time;
  } else if constexpr (std::is_same_v<Part, PeriodicSettings>) {
    return scene.periodic;
  } else if constexpr (std::is_same_v<Part, FinishSettings>) {
    return scene.finish;
  } else if constexpr (std::is_same_v<Part, MapSettings>) {
    return scene.map;
  } else if constexpr (std::is_same_v<Part, ReadSettings>) {
    return scene.read;
  } else {
    static_assert(std::is_same_v<Part, Component>);
    return scene.components[component];
  }
}

template <class Part>
bool has_part(const Scene& scene) {
  if constexpr (std::is_same_v<Part, Camera>) {
    return scene.camera.has_value();
  } else if constexpr (std::is_same_v<Part, Stereo>) {
    return scene.stereo.has_value();
  } else if constexpr (std::is_same_v<Part, Follow>) {
    return scene.path.follow.has_value();
  } else if constexpr (std::is_same_v<Part, Approach>) {
    return scene.path.approach.has_value();
  } else if constexpr (std::is_same_v<Part, MotionBlur>) {
    return scene.movie.motion_blur.has_value();
  } else {
    return true;
  }
}

// A key whose value is got from and put into a scene by functions.
template <class V>
Key key_of_scene(const std::string& path, const ValueType<V>& type,
                 const Access<std::optional<V>(const Scene&, std::size_t component)>& get,
                 const Access<void(Scene&, std::size_t component, const V&)>& set,
                 const Text& text) {
  Key key;
  key.path = path;
  key.expected = type.expected;
  key.unit = text.unit;
  key.absent = text.absent;
  key.meaning = text.meaning;
  key.set = [read = type.read, set](Scene& scene, std::size_t component, const toml::node& node) {
    const std::optional<V> value = read(node);
    if (value) set(scene, component, *value);
    return value.has_value();
  };
  key.get = [write = type.write, get](const Scene& scene,
                                      std::size_t component) -> std::optional<std::string> {
    const std::optional<V> value = get(scene, component);
    return value ? std::optional<std::string>(write(*value)) : std::nullopt;
  };
  return key;
}

// The same of a Part.
template <class Part, class V, class Get, class Set>
Key key(const std::string& path, const ValueType<V>& type, Get get, Set set, const Text& text) {
  return key_of_scene<V>(
      path, type,
      [get](const Scene& scene, std::size_t component) -> std::optional<V> {
        if (!has_part<Part>(scene)) return std::nullopt;
        return get(part<Part>(scene, component));
      },
      [set](Scene& scene, std::size_t component, const V& value) {
        set(part<Part>(scene, component), value);
      },
      text);
}

// A key whose value is a member of a Part, optional or not.
template <class Part, class V, class Member>
Key key(const std::string& path, const ValueType<V>& type, Member Part::*member, const Text& text) {
  return key<Part, V>(
      path, type, [member](const Part& part) { return std::optional<V>(part.*member); },
      [member](Part& part, const V& value) { part.*member = value; }, text);
}

inline Key excluding(Key key, std::vector<std::string> paths) {
  key.excludes = std::move(paths);
  return key;
}

// What few scenes need: written only where it is not the default.
inline Key written_if_set(Key key) {
  key.is_written_by_default = false;
  return key;
}

// The same for all keys of a table.
inline Keys written_if_set(Keys keys) {
  for (Key& key : keys)
    key.is_written_by_default = false;
  return keys;
}

inline Key not_written(Key key) {
  key.is_written = false;
  return key;
}

}  // namespace splotchcl::scene_file
