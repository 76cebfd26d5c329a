#include "device/opencl/program_cache.h"

#include <chrono>

#include "device/opencl/runtime_lock.h"
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

// Relaxed math is unfit for keys and for expm1: no flags.
constexpr char build_options[] = "";

// All that the compiled program depends on; a platform's version names its compiler's.
std::string key_of(const compute::device& device, const std::string& source) {
  return device.platform().version() + '\n' + device.name() + '\n' + device.driver_version() +
         '\n' + build_options + '\n' + source;
}

std::string text_of(const ProgramSource& source) {
  std::string text = source.defines;
  for (const std::string& file : source.files)
    text += kernel_text(file);
  return text + source.more;
}

std::string names_of(const ProgramSource& source) {
  std::string names;
  for (const std::string& file : source.files)
    names += (names.empty() ? "" : " + ") + file;
  return names;
}

compute::program build(const compute::context& context, const std::string& text,
                       const std::string& names) {
  compute::program program = compute::program::create_with_source(text, context);
  try {
    program.build(build_options);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("device " + context.get_device().name() + " cannot compile " + names + ": " +
                      error.error_string() +
                      "; see that there is memory and room in the folder for temporary files, or "
                      "choose another device: " +
                      program.build_log());
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
std::optional<compute::program> ProgramCache::restore(const std::string& key) {
  const std::optional<std::string> binary = binaries_.find(key);
  if (!binary) return std::nullopt;
  try {
    compute::program program = compute::program::create_with_binary(
        reinterpret_cast<const unsigned char*>(binary->data()), binary->size(), context_);
    program.build(build_options);
    return program;
  } catch (const compute::opencl_error&) {
    return std::nullopt;
  }
}

compute::program ProgramCache::get(const ProgramSource& source) {
  const std::string text = text_of(source);
  const std::string key = key_of(context_.get_device(), text);
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second;

  const auto lock = lock_runtime();
  const auto start = std::chrono::steady_clock::now();
  std::optional<compute::program> program = restore(key);
  if (!program) {
    program = build(context_, text, names_of(source));
    binaries_.keep(key, binary_of(*program));
  }
  build_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  programs_.emplace(key, *program);
  return *program;
}

}  // namespace splotchcl
