#pragma once

#include <string>
#include <vector>

namespace splotchcl::scene_file {

// All keys of a scene, "image.width"; "component.palette" stands for that of every component.
std::vector<std::string> key_names();

}  // namespace splotchcl::scene_file
