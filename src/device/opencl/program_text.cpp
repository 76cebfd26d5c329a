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

}  // namespace

ProgramText text_of(const ProgramSource& source) {
  std::string text = source.defines;
  for (const std::string& file : source.files)
    text += kernel_text(file);
  return {source.denormals_are_zero ? zero_denormals : "", text + source.more};
}

ProgramText short_text_of(const ProgramSource& source) {
  const ProgramText text = text_of(source);
  const std::string others = text.options.empty() ? "" : " " + text.options;
  return {without_declarations + others, kernel_text("builtins.h") + text.source};
}

bool is_pocl(const compute::device& device) {
  return device.platform().name() == "Portable Computing Language";
}

std::string names_of(const ProgramSource& source) {
  std::string names;
  for (const std::string& file : source.files)
    names += (names.empty() ? "" : " + ") + file;
  return names;
}

}  // namespace splotchcl
