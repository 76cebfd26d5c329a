#include "device/program_cache.h"

#include <chrono>

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

}  // namespace

compute::program ProgramCache::get(const std::string& defines,
                                   const std::vector<std::string>& files,
                                   const std::string& options, const std::string& more) {
  std::string source = defines + kernel_text("parameters.h");
  std::string names;
  for (const std::string& file : files) {
    source += kernel_text(file);
    names += (names.empty() ? "" : " + ") + file;
  }
  source += more;
  const compute::device device = context_.get_device();
  const std::string key =
      device.name() + '\n' + device.driver_version() + '\n' + options + '\n' + source;
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second;

  const auto start = std::chrono::steady_clock::now();
  compute::program program = compute::program::create_with_source(source, context_);
  try {
    program.build(options);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("device " + device.name() + " cannot compile " + names + ": " +
                      error.error_string() + "\n" + program.build_log());
  }
  build_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  programs_.emplace(key, program);
  return program;
}

}  // namespace splotchcl
