#include "device/opencl/local_compiler.h"

#include <exception>

#include "device/opencl/device_context.h"
#include "device/opencl/program_build.h"

namespace splotchcl {

const compute::context* LocalCompiler::context_on(const std::string& device) {
  const auto known = contexts_.find(device);
  if (known != contexts_.end()) return &known->second;
  for (const compute::device& found : compute::system::devices()) {
    if (full_name_of(found) == device)
      return &contexts_.emplace(device, compute::context(found)).first->second;
  }
  return nullptr;
}

std::string LocalCompiler::compile(const ProgramToCompile& program) {
  try {
    const compute::context* const context = context_on(program.device);
    if (context == nullptr) return {};
    return binary_of(build_program(*context, {program.options, program.source}, "a program"));
  } catch (const std::exception&) {
    return {};  // who asked compiles it, and tells why that fails
  }
}

}  // namespace splotchcl
