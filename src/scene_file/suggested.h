#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl::scene_file {

// apply_settings for a scene that began as one suggested for a snapshot. What is still as it was
// suggested was given by nobody, and gives way where it belongs to what the settings replace: the
// range of another field, the field of view of another projection, the size of what is no panorama.
// `suggested` is null for a scene that began otherwise, of which all was given.
Scene apply_settings_to_suggested(const Scene& scene, const Scene* suggested,
                                  const std::vector<std::string>& settings);

// read_scene_file for a file that completes a scene suggested for its snapshot. What neither the
// file nor the settings give is as it was suggested.
Scene read_scene_file_on(const Scene& suggested, const std::filesystem::path& path,
                         const std::vector<std::string>& settings);

}  // namespace splotchcl::scene_file
