#pragma once

#include <string>

namespace splotchcl {

// Where to load a module from: beside the program or library that this is part of, where it is
// there (in a build folder, and with the address sanitizer, whose own dlopen does not look where
// we would). Else its name alone, so that it is looked for where the loader looks for us.
std::string module_file(const std::string& module_name);

}  // namespace splotchcl
