#pragma once

#include <map>
#include <optional>
#include <string>

#include "device/opencl/opencl.h"
#include "device/opencl/program_text.h"
#include "splotchcl/program_compiler.h"

namespace splotchcl {

// Throws DeviceError with the compiler's first message; `names` says of what.
compute::program build_program(const compute::context& context, const ProgramText& text,
                               const std::string& names);

// Nothing where the driver refuses the binary: it may, for reasons of its own.
std::optional<compute::program> program_of_binary(const compute::context& context,
                                                  const std::string& options,
                                                  const std::string& binary);

// Of all its kernels, compiled. Empty where the driver has none to give.
std::string binary_of(const compute::program& program);

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
