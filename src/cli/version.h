#pragma once

#include <string>

namespace splotchcl::cli {

// What --version says, in lines: the version and the commit, OpenCL's loader, the libraries that
// the program was built with.
std::string version_text();

}  // namespace splotchcl::cli
