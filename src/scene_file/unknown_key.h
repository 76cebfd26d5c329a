#pragma once

#include <string>

#include "scene_file/setting.h"

namespace splotchcl::scene_file {

// "camera" and "near" are "camera.near"; a table without a name is the top level.
std::string join(const std::string& table, const std::string& name);

// Throws UsageError, which names the keys of the table and the one that was probably meant. The
// name may have dots, where it is that of a key in a table of the table.
[[noreturn]] void refuse_unknown_key(const KeyAddress& table, const std::string& name,
                                     const std::string& where);

}  // namespace splotchcl::scene_file
