#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace splotchcl {

// Libraries write lines of their own to standard error (libpng, OpenCL compilers), beside the one
// that the exception becomes. While one of these lives, they go nowhere, once a program has asked
// for it: standard error is the program's, not a library's.
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
};

// Called once, from main, before there are other threads.
void let_errors_be_quiet();

// Standard error as the program was given it, also while errors are quiet: for what the program
// says itself, and the descriptor for signal handlers.
std::FILE* error_stream();
int error_descriptor();

// A program that reads memory of a mapped file which another program has made shorter gets the
// signal SIGBUS, wherever it may be: in a kernel, in a library, in any thread. No exception can
// come out of there. With the guard the program ends with one line that names the file and with
// exit code 1, instead of "Bus error". Call it once, from main: signals are the program's, not a
// library's.
void guard_mapped_files();

// For a module of a program that must not end: what is no longer there of a mapped file reads as
// zeros from then on, and whoever reads asks afterwards whether that has happened. Signals of other
// memory go where they went before.
void survive_cut_files();
// How often it has happened in this process, and the file of the last time; null: none.
std::uint64_t cut_file_count();
const char* last_cut_file();
// Whether it has happened to this mapping.
bool is_cut(const std::byte* begin);

// What the guard knows: mapped memory and the name of its file, which must stay as long. Signal
// handlers can only look at global data. Beyond a thousand mapped files there is no guard.
void register_mapping(const std::byte* begin, std::uint64_t size, const char* path);
void forget_mapping(const std::byte* begin);

// A library that runs out of memory may abort, and one that meets a damaged file may crash: no
// exception comes out of there. With the guard the program ends with one line and exit code 1, and
// its unfinished files are removed; so where a library calls exit(). Call it once, from main:
// signals are the program's, not a library's. With SPLOTCHCL_CORE set the signals do what they do,
// for debuggers.
void guard_crashes();

// From now on a library may end the program by exit(): MPI does when processes are told to stop.
void let_libraries_exit();

}  // namespace splotchcl
