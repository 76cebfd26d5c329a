#pragma once

#include <string>

namespace splotchcl {

// PoCL has no device where it cannot write to its cache folder.

// The folder in which PoCL would keep what it compiles, where that cannot be written to; else "".
std::string unwritable_pocl_cache();

// Names a folder for temporary files to PoCL where its own cannot be written to, for as long as the
// process lasts. For a program, before OpenCL is opened and threads are started: it changes the
// environment.
void give_pocl_a_cache();

}  // namespace splotchcl
