#pragma once

namespace splotchcl {

// A library that runs out of memory may abort, and one that meets a damaged file may crash: no
// exception comes out of there. With the guard the program ends with one line and exit code 1, and
// its unfinished files are removed; so where a library calls exit(). Call it once, from main:
// signals are the program's, not a library's. With SPLOTCHCL_CORE set the signals do what they do,
// for debuggers.
void guard_crashes();

// From now on a library may end the program by exit(): MPI does when processes are told to stop.
void let_libraries_exit();

}  // namespace splotchcl
