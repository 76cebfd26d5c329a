#include "device/opencl/program_text.h"

#include "device/opencl/kernel_text.h"
#include "device/opencl/quirks.h"

namespace splotchcl {
namespace {

// Relaxed math is unfit for keys and for expm1.
constexpr char zero_denormals[] = "-cl-denorms-are-zero";
// As if opencl-c.h, of clang's headers, had been read.
constexpr char without_declarations[] = "-D_OPENCL_H_";
// What compilers have beyond the language (common.cl, flags.cl).
constexpr char with_prefetch[] = "-DHAS_PREFETCH";
constexpr char with_ballot[] = "-DHAS_BALLOT";
// Of who compiles a kernel several times (common.cl).
constexpr char with_bodies[] = "-DCALLS_BODIES";

std::string include_of(const std::string& file) {
  return "#include \"" + file + "\"\n";
}

std::string joined(const std::string& a, const std::string& b) {
  return a + (a.empty() || b.empty() ? "" : " ") + b;
}

std::string extras_of(const compute::device& device) {
  const Quirks quirks = quirks_of(device);
  const std::string extensions =
      joined(quirks.has_prefetch ? with_prefetch : "", quirks.has_ballot ? with_ballot : "");
  return joined(extensions, quirks.compiles_bodies_again ? with_bodies : "");
}

}  // namespace

std::string define(const std::string& choice) {
  return "#define " + choice + "\n";
}

ProgramSource program_source(const std::string& file, const Choices& choices) {
  ProgramSource source;
  source.file = file;
  for (const std::string& choice : choices)
    source.defines += define(choice);
  return source;
}

ProgramText text_of(const ProgramSource& source, const compute::device& device) {
  const std::string file = source.file.empty() ? "" : include_of(source.file);
  const std::string text = flattened(file + source.more);
  return {joined(source.denormals_are_zero ? zero_denormals : "", extras_of(device)),
          source.defines + mentioned(source.variant, text) + text};
}

ProgramText short_text_of(const ProgramText& text) {
  return {joined(without_declarations, text.options),
          flattened(include_of("kernels/common/builtins.h")) + text.source};
}

}  // namespace splotchcl
