#pragma once

#include <optional>
#include <string>

#include "device/opencl/opencl.h"
#include "device/opencl/program_text.h"

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

}  // namespace splotchcl
