#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl::scene_file {

// One key of a scene file. The list of them drives reading, the messages for what is
// wrong, writing, and the reference in docs/scene.md.
struct Key {
  std::string path;      // "image.width"; "component.size.field" stands for every component
  std::string expected;  // completes "expected ..."
  std::string unit;      // empty: none
  std::string absent;    // what counts when it is not given; empty: the default below
  std::string meaning;
  std::vector<std::string> excludes;  // keys that must not be given together with it

  // False, and nothing changed: wrong type, or out of range. The camera and the component
  // exist already.
  std::function<bool(Scene&, std::size_t component, const toml::node&)> set;
  // The value as TOML; nothing when it is absent.
  std::function<std::optional<std::string>(const Scene&, std::size_t component)> get;
  bool is_written = true;             // false: another key writes the same value
  bool is_written_by_default = true;  // false: the default is left out
};

// In the order in which they are documented and written.
const std::vector<Key>& all_keys();

const Key* find_key(const std::string& path);
bool is_table(const std::string& path);                            // "camera", "component.size"
std::vector<std::string> names_in_table(const std::string& path);  // "": the top level

// The reference for docs/scene.md, as Markdown.
std::string key_reference();

// All keys of a scene, "image.width"; "component.palette" stands for that of every component.
std::vector<std::string> key_names();

// The names of files in scenes. They stand relative to the file in which they are written.

using ChangeName = std::function<std::string(const std::string& name)>;

// Puts another name in place of every one in the scene, its keyframes included, but for
// patterns of snapshots, which are no names.
void change_file_names(Scene& scene, const ChangeName& change);

// A key's value as settings have it, TOML or a bare word: the same, or with the other name
// where it is one. `path` as the list of keys has it: "component.palette".
std::string with_file_name(const std::string& path, const std::string& value,
                           const ChangeName& change);

}  // namespace splotchcl::scene_file
