#pragma once

#include <map>
#include <string>

#include "splotchcl/scene.h"

namespace splotchcl::scene_file {

// Where each key's value was given, for messages.
struct Origins {
  std::string name;                          // of the whole: a file
  std::map<std::string, std::string> where;  // "component.0.size.field" -> "scene.toml:12"
  bool contains(const std::string& label) const { return where.count(label) > 0; }
  const std::string& at(const std::string& label) const;
};

[[noreturn]] void refuse(const std::string& where, const std::string& label,
                         const std::string& found, const std::string& expected,
                         const std::string& advice = "");

// What no single key can know: values that do not fit each other. Throws UsageError.
void check_scene(const Scene& scene, const Origins& origins);

}  // namespace splotchcl::scene_file
