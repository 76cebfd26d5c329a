#pragma once

#include <map>
#include <string>

#include "device/opencl/opencl.h"
#include "splotchcl/program_compiler.h"

namespace splotchcl {

// The other process's part: compiles in this one, on the first device of the names that are asked
// for. Gives nothing where that fails. Keeps what PoCL has read for its first program.
class LocalCompiler : public ProgramCompiler {
 public:
  std::string compile(const ProgramToCompile& program) override;

 private:
  const compute::context* context_on(const std::string& device);  // null: there is no such device

  std::map<std::string, compute::context> contexts_;
};

}  // namespace splotchcl
