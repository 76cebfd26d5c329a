#pragma once

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

// Called once, from main.
void let_errors_be_quiet();

// Standard error as the program was given it, for signal handlers.
int error_descriptor();

}  // namespace splotchcl
