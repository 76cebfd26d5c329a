#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/palette_file.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Scene files are TOML; docs/scene.md lists every key. Unknown keys, wrong types and
// values out of range throw UsageError with file, line, key and the nearest known key.
// `settings` are "key=value" strings (--set) that override the file. Relative paths in a file are
// relative to it, those in text and settings to the current folder. Throws also DataError for a
// file that cannot be read.
Scene read_scene_file(const std::filesystem::path& path,
                      const std::vector<std::string>& settings = {});
Scene parse_scene(const std::string& text, const std::string& name_for_messages,
                  const std::vector<std::string>& settings = {});
// Applies "key=value" strings to a scene that came from elsewhere.
Scene apply_settings(const Scene& scene, const std::vector<std::string>& settings);

// The scene as the text of a scene file; parse_scene(format_scene(s)) is s.
std::string format_scene(const Scene& scene);

}  // namespace splotchcl
