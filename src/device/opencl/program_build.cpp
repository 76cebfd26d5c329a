#include "device/opencl/program_build.h"

#include <exception>
#include <string>
#include <vector>

#include "device/opencl/device_context.h"
#include "device/opencl/pocl_cache.h"
#include "splotchcl/error.h"

namespace splotchcl {

compute::program build_program(const compute::context& context, const ProgramText& text,
                               const std::string& names) {
  compute::program program = compute::program::create_with_source(text.source, context);
  try {
    program.build(text.options);
  } catch (const compute::opencl_error& error) {
    const std::string cache = unwritable_pocl_cache();
    const std::string hint =
        cache.empty() ? "see that there is memory and room in the folder for temporary files, or "
                        "choose another device: "
                      : "PoCL cannot write to its cache folder, " + cache +
                            ": set POCL_CACHE_DIR to one that can be written to: ";
    throw DeviceError("device " + context.get_device().name() + " cannot compile " + names + ": " +
                      error.error_string() + "; " + hint + program.build_log());
  }
  return program;
}

std::optional<compute::program> program_of_binary(const compute::context& context,
                                                  const std::string& options,
                                                  const std::string& binary) {
  try {
    compute::program program = compute::program::create_with_binary(
        reinterpret_cast<const unsigned char*>(binary.data()), binary.size(), context);
    program.build(options);
    return program;
  } catch (const compute::opencl_error&) {
    return std::nullopt;
  }
}

std::string binary_of(const compute::program& program) {
  try {
    const std::vector<unsigned char> binary = program.binary();
    return std::string(binary.begin(), binary.end());
  } catch (const compute::opencl_error&) {
    return {};
  }
}

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
