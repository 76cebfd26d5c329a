#include "device/opencl/program_cache.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "device/opencl/device_context.h"
#include "device/opencl/device_traits.h"
#include "device/opencl/pocl_cache.h"
#include "device/opencl/runtime_lock.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

class Threads {
 public:
  // Where there is none to be had, others do the work.
  void start(const std::function<void()>& work) {
    try {
      threads_.emplace_back(work);
    } catch (const std::system_error&) {
    }
  }
  ~Threads() {
    for (std::thread& thread : threads_)
      thread.join();
  }

 private:
  std::vector<std::thread> threads_;
};

// All that the compiled program depends on; a platform's version names its compiler's.
std::string key_of(const compute::device& device, const ProgramText& text) {
  return device.platform().version() + '\n' + device.name() + '\n' + device.driver_version() +
         '\n' + text.options + '\n' + text.source;
}

std::string key_of(const ProgramSource& source) {
  return source.file + (source.denormals_are_zero ? "\n0\n" : "\n") + source.defines + '\n' +
         source.variant + '\n' + source.more;
}

std::size_t count_of(const std::string& word, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

// How long compiling takes beside other programs: each kernel is linked by itself.
std::size_t work_of(const ProgramText& text) {
  constexpr std::size_t bytes_of_linking = 10000;
  return text.source.size() + bytes_of_linking * count_of("__kernel void", text.source);
}

// Empty where there is none. Called in threads of their own, which no exception must leave.
std::string binary_by(ProgramCompiler& compiler, const std::string& device,
                      const ProgramText& text) {
  try {
    return compiler.compile({device, text.options, text.source});
  } catch (const std::exception&) {
    return {};
  }
}

class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Nothing where the driver refuses the binary: it may, for reasons of its own.
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

// Of all its kernels, compiled. Empty where the driver has none to give.
std::string binary_of(const compute::program& program) {
  try {
    const std::vector<unsigned char> binary = program.binary();
    return std::string(binary.begin(), binary.end());
  } catch (const compute::opencl_error&) {
    return {};
  }
}

}  // namespace

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

void share_work(std::size_t count, const std::function<void(std::size_t item)>& here,
                const std::vector<std::function<bool(std::size_t item)>>& elsewhere) {
  std::atomic<std::size_t> next{0};
  Threads threads;
  for (const auto& one : elsewhere) {
    threads.start([&next, count, &one] {
      for (std::size_t item = next++; item < count && one(item); item = next++) {
      }
    });
  }
  try {
    for (std::size_t item = next++; item < count; item = next++)
      here(item);
  } catch (...) {
    next = count;
    throw;
  }
}

compute::kernel Program::create_kernel(const std::string& name) const {
  return cache_->compiled(*entry_).create_kernel(name);
}

Program ProgramCache::get(const ProgramSource& source) {
  std::string asked = key_of(source);
  const auto known = asked_for_.find(asked);
  if (known != asked_for_.end()) return Program(*this, *known->second);
  Entry entry = entry_of(source);
  Entry& program = programs_.try_emplace(entry.key, std::move(entry)).first->second;
  asked_for_.emplace(std::move(asked), &program);
  return Program(*this, program);
}

ProgramCache::Entry ProgramCache::entry_of(const ProgramSource& source) const {
  const compute::device device = context_.get_device();
  Entry entry;
  entry.text = text_of(source, device);
  if (quirks_of(device).reads_declarations) {
    entry.fallback = entry.text;
    entry.text = short_text_of(*entry.fallback);
  }
  entry.key = key_of(device, entry.text);
  entry.name = source.file;
  return entry;
}

const compute::program& ProgramCache::compiled(Entry& entry) {
  if (entry.compiled) return *entry.compiled;
  const auto lock = lock_runtime();
  const Stopwatch stopwatch(build_seconds_);
  if (!restore(entry)) build(entry);
  return *entry.compiled;
}

void ProgramCache::compile_all() {
  std::vector<Entry*> missing;
  const auto lock = lock_runtime();
  const Stopwatch stopwatch(build_seconds_);
  for (auto& [key, entry] : programs_) {
    if (!entry.compiled && !find_binary(entry)) missing.push_back(&entry);
  }
  build_together(missing);
}

std::vector<ProgramText> ProgramCache::texts() const {
  std::vector<ProgramText> texts;
  for (const auto& [key, entry] : programs_)
    texts.push_back(entry.fallback.value_or(entry.text));
  return texts;
}

bool ProgramCache::find_binary(Entry& entry) {
  if (!entry.binary) entry.binary = binaries_.find(entry.key);
  return entry.binary.has_value();
}

bool ProgramCache::restore(Entry& entry) {
  if (!find_binary(entry)) return false;
  entry.compiled = program_of_binary(context_, entry.text.options, *entry.binary);
  entry.binary.reset();
  return entry.compiled.has_value();
}

void ProgramCache::build(Entry& entry) {
  has_built_ = true;
  try {
    entry.compiled = build_program(context_, entry.text, entry.name);
  } catch (const DeviceError&) {
    if (!entry.fallback) throw;
    entry.compiled = build_program(context_, *entry.fallback, entry.name);
  }
  binaries_.keep(entry.key, binary_of(*entry.compiled));
}

// A compiler takes half a second to start, as long as three programs or four.
std::size_t ProgramCache::compilers_for(std::size_t programs) const {
  const compute::device device = context_.get_device();
  if (!start_compiler_ || !binaries_.is_used() || has_built_) return 0;
  if (!quirks_of(device).shares_binaries) return 0;
  const std::size_t cores = std::min(std::size_t{device.compute_units()},
                                     std::size_t{std::thread::hardware_concurrency()});
  if (programs < 3 || cores < 2) return 0;
  return std::min(cores - 1, (programs - 1) / 2);
}

void ProgramCache::build_together(std::vector<Entry*> missing) {
  std::sort(missing.begin(), missing.end(),
            [](const Entry* a, const Entry* b) { return work_of(a->text) > work_of(b->text); });
  const std::string device = full_name_of(context_.get_device());
  std::vector<std::string> binaries(missing.size());
  std::vector<std::unique_ptr<ProgramCompiler>> compilers;
  std::vector<std::function<bool(std::size_t)>> elsewhere;
  for (std::size_t i = compilers_for(missing.size()); i > 0; --i) {
    compilers.push_back(start_compiler_());
    if (!compilers.back()) break;
    elsewhere.emplace_back([&, compiler = compilers.back().get()](std::size_t program) {
      binaries[program] = binary_by(*compiler, device, missing[program]->text);
      return !binaries[program].empty();
    });
  }
  share_work(
      missing.size(), [&](std::size_t program) { build(*missing[program]); }, elsewhere);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    Entry& entry = *missing[i];
    if (entry.compiled) continue;
    entry.compiled = program_of_binary(context_, entry.text.options, binaries[i]);
    if (entry.compiled)
      binaries_.keep(entry.key, binaries[i]);
    else
      build(entry);
  }
}

}  // namespace splotchcl
