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

// All that the compiled program depends on; a platform's version names its compiler's.
std::string key_of(const compute::device& device, const std::string& options,
                   const std::string& source) {
  return device.platform().version() + '\n' + device.name() + '\n' + device.driver_version() +
         '\n' + options + '\n' + source;
}

compute::program build(const compute::context& context, const std::string& source,
                       const std::string& options, const std::string& names) {
  compute::program program = compute::program::create_with_source(source, context);
  try {
    program.build(options);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("device " + context.get_device().name() + " cannot compile " + names + ": " +
                      error.error_string() + "\n" + program.build_log());
  }
  return program;
}

// Empty where the driver has none to give.
std::string binary_of(const compute::program& program) {
  try {
    const std::vector<unsigned char> binary = program.binary();
    return std::string(binary.begin(), binary.end());
  } catch (const compute::opencl_error&) {
    return {};
  }
}

}  // namespace

// A driver may refuse what an earlier run left, for reasons of its own.
std::optional<compute::program> ProgramCache::restore(const std::string& key,
                                                      const std::string& options) {
  const std::optional<std::string> binary = binaries_.find(key);
  if (!binary) return std::nullopt;
  try {
    compute::program program = compute::program::create_with_binary(
        reinterpret_cast<const unsigned char*>(binary->data()), binary->size(), context_);
    program.build(options);
    return program;
  } catch (const compute::opencl_error&) {
    return std::nullopt;
  }
}

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
  const std::string key = key_of(context_.get_device(), options, source);
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second;

  const auto start = std::chrono::steady_clock::now();
  std::optional<compute::program> program = restore(key, options);
  if (!program) {
    program = build(context_, source, options, names);
    binaries_.keep(key, binary_of(*program));
  }
  build_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  programs_.emplace(key, *program);
  return *program;
}

}  // namespace splotchcl
