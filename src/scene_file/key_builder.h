#pragma once

#include <functional>
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

// A key whose value is got from and put into a Part by functions.
template <class Part, class V>
Key key(const std::string& path, const ValueType<V>& type,
        std::function<std::optional<V>(const Part&)> get, std::function<void(Part&, const V&)> set,
        const Text& text) {
  Key key;
  key.path = path;
  key.expected = type.expected;
  key.unit = text.unit;
  key.absent = text.absent;
  key.meaning = text.meaning;
  key.set = [read = type.read, set](Scene& scene, std::size_t component, const toml::node& node) {
    const std::optional<V> value = read(node);
    if (value) set(part<Part>(scene, component), *value);
    return value.has_value();
  };
  key.get = [write = type.write, get](const Scene& scene,
                                      std::size_t component) -> std::optional<std::string> {
    if (std::is_same_v<Part, Camera> && !scene.camera) return std::nullopt;
    if (std::is_same_v<Part, Stereo> && !scene.stereo) return std::nullopt;
    const std::optional<V> value = get(part<Part>(scene, component));
    return value ? std::optional<std::string>(write(*value)) : std::nullopt;
  };
  return key;
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
