#pragma once

#include <functional>
#include <string>

#include "splotchcl/scene.h"

// The names of files in scenes. They stand relative to the file in which they are written.
namespace splotchcl::scene_file {

using ChangeName = std::function<std::string(const std::string& name)>;

// Puts another name in place of every one in the scene, its keyframes included, but for
// patterns of snapshots, which are no names.
void change_file_names(Scene& scene, const ChangeName& change);

// A key's value as settings have it, TOML or a bare word: the same, or with the other name
// where it is one. `path` as the list of keys has it: "component.palette".
std::string with_file_name(const std::string& path, const std::string& value,
                           const ChangeName& change);

}  // namespace splotchcl::scene_file
