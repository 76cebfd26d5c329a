// Preloaded into the program (LD_PRELOAD), stands for libraries that a damaged file makes crash:
// SPLOTCHCL_CRASH names the function, of HDF5 or libpng, that does, and SPLOTCHCL_CRASH_IN the
// program, if it is another than splotchcl. Others do what they do.
#include <dlfcn.h>
#include <signal.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

extern "C" char* program_invocation_short_name;

namespace {

template <typename Function>
Function* original_or_crash(Function*, const char* name) {
  const char* const asked = std::getenv("SPLOTCHCL_CRASH");
  const char* const program = std::getenv("SPLOTCHCL_CRASH_IN");
  if (asked != nullptr && std::strcmp(asked, name) == 0 &&
      std::strcmp(program_invocation_short_name, program == nullptr ? "splotchcl" : program) == 0) {
    ::raise(SIGSEGV);
  }
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// As the libraries declare them, with pointers for pointers.
extern "C" std::int64_t H5Fopen(const char* name, unsigned flags, std::int64_t properties) {
  return original_or_crash(&H5Fopen, "H5Fopen")(name, flags, properties);
}

extern "C" std::int64_t H5Dopen2(std::int64_t where, const char* name, std::int64_t properties) {
  return original_or_crash(&H5Dopen2, "H5Dopen2")(where, name, properties);
}

extern "C" void* png_create_read_struct(const char* version, void* pointer, void* fail,
                                        void* warn) {
  return original_or_crash(&png_create_read_struct, "png_create_read_struct")(version, pointer,
                                                                              fail, warn);
}
