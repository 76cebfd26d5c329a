#pragma once

#include <functional>
#include <memory>
#include <string>

namespace splotchcl {

// A program of OpenCL C and where it is to run.
struct ProgramToCompile {
  std::string device;   // all of a device's names: platform, device
  std::string options;  // of the compiler
  std::string source;
};

// Compiles programs in another process. OpenCL's compilers hold a lock, so that the threads of one
// process compile no faster than one of them does. Used by one thread at a time.
class ProgramCompiler {
 public:
  virtual ~ProgramCompiler() = default;
  // The program's binary, as the device's driver gives it; empty where there is none, for whatever
  // reason: then it is compiled by who asked.
  virtual std::string compile(const ProgramToCompile& program) = 0;
};

// Starts a compiler; it ends with the object. Null where it cannot be started. Called by several
// threads.
using StartCompiler = std::function<std::unique_ptr<ProgramCompiler>()>;

}  // namespace splotchcl
