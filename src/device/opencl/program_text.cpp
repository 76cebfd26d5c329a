#include "device/opencl/program_text.h"

#include "splotchcl/error.h"
#include "splotchcl_embedded/kernels.h"

namespace splotchcl {
namespace {

std::string kernel_text(const std::string& name) {
  for (const embedded::TextFile& file : embedded::kernels()) {
    if (name == file.name) return std::string(file.text);
  }
  throw DeviceError("kernel source " + name + " is not part of this build");
}

// Relaxed math is unfit for keys and for expm1.
constexpr char zero_denormals[] = "-cl-denorms-are-zero";
// As if opencl-c.h, of clang's headers, had been read.
constexpr char without_declarations[] = "-D_OPENCL_H_";
// What compilers have beyond the language (prefetch.cl, flags.cl). NVIDIA's is clang, too, and
// refuses its builtin for prefetching; a GPU has other work while it waits.
constexpr char with_prefetch[] = "-DHAS_PREFETCH";
constexpr char with_ballot[] = "-DHAS_BALLOT";
// PoCL compiles a kernel three times, and what it calls once (common.cl).
constexpr char with_bodies[] = "-DCALLS_BODIES";
// What compilers for processors cannot inline (wide_angle_extended.cl).
constexpr char with_calls[] = "-DCALLS_TURN";

std::string joined(const std::string& a, const std::string& b) {
  return a + (a.empty() || b.empty() ? "" : " ") + b;
}

std::string extras_of(const compute::device& device) {
  if (is_nvidia(device)) return with_ballot;
  if (is_pocl_processor(device)) return joined(joined(with_prefetch, with_bodies), with_calls);
  return (device.type() & CL_DEVICE_TYPE_CPU) != 0 ? with_calls : "";
}

}  // namespace

ProgramText text_of(const ProgramSource& source, const compute::device& device) {
  std::string text = source.defines;
  for (const std::string& file : source.files)
    text += kernel_text(file);
  return {joined(source.denormals_are_zero ? zero_denormals : "", extras_of(device)),
          text + source.more};
}

ProgramText short_text_of(const ProgramSource& source, const compute::device& device) {
  const ProgramText text = text_of(source, device);
  return {joined(without_declarations, text.options), kernel_text("builtins.h") + text.source};
}

bool is_pocl(const compute::device& device) {
  return device.platform().name() == "Portable Computing Language";
}

bool is_pocl_processor(const compute::device& device) {
  return (device.type() & CL_DEVICE_TYPE_CPU) != 0 && is_pocl(device);
}

bool is_nvidia(const compute::device& device) {
  return device.platform().name() == "NVIDIA CUDA";
}

std::string names_of(const ProgramSource& source) {
  std::string names;
  for (const std::string& file : source.files)
    names += (names.empty() ? "" : " + ") + file;
  return names;
}

}  // namespace splotchcl
