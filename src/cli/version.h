#pragma once

#include <string>

namespace splotchcl::cli {

// What --version says, in lines: the version and the commit, OpenCL's loader, the libraries that
// the program was built with.
std::string version_text();
// The version and the commit alone.
std::string version_and_commit();

}  // namespace splotchcl::cli
