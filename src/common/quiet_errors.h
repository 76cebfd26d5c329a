#pragma once

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

}  // namespace splotchcl
