#include "splotchcl/program_compiler.h"

#include "device/opencl/device_context.h"
#include "device/opencl/program_build.h"
#include "splotchcl/error.h"

namespace splotchcl {

std::string compile_program(const ProgramToCompile& program) {
  try {
    for (const compute::device& device : compute::system::devices()) {
      if (full_name_of(device) != program.device) continue;
      const compute::context context(device);
      return binary_of(build_program(context, {program.options, program.source}, "a program"));
    }
  } catch (const std::exception&) {
    // Who asked compiles it, and tells why that fails.
  }
  return {};
}

}  // namespace splotchcl
