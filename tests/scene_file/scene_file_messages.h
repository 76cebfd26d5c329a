#pragma once

#include <string>
#include <vector>

#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::test {

// What a user is told about this text and these settings.
inline std::string message_for(const std::string& text,
                               const std::vector<std::string>& settings = {}) {
  try {
    parse_scene(text, "scene.toml", settings);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace splotchcl::test
