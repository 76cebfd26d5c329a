// A loader is asked by this function: the one that takes its place asks a platform.
#define CL_USE_DEPRECATED_OPENCL_1_1_APIS
#include <dlfcn.h>

#include <string>

#include "device/opencl/opencl.h"
#include "splotchcl/renderer.h"

namespace splotchcl {
namespace {

// Of the extension cl_loader_info, which not all headers have.
constexpr cl_uint loader_version = 2;
constexpr cl_uint loader_name = 3;
using LoaderInfo = cl_int(CL_API_CALL*)(cl_uint, std::size_t, void*, std::size_t*);

std::string ask(LoaderInfo info, cl_uint what) {
  char text[256] = "";
  return info(what, sizeof(text) - 1, text, nullptr) == CL_SUCCESS ? text : "";
}

std::string name_and_version() {
  void* const function = clGetExtensionFunctionAddress("clGetICDLoaderInfoOCLICD");
  if (function == nullptr) return "";
  const auto info = reinterpret_cast<LoaderInfo>(function);
  return ask(info, loader_name) + ' ' + ask(info, loader_version) + ", ";
}

}  // namespace

std::string opencl_loader() {
  Dl_info file;
  const bool is_known = dladdr(reinterpret_cast<void*>(&clGetPlatformIDs), &file) != 0;
  return name_and_version() + (is_known ? file.dli_fname : "of an unknown file");
}

}  // namespace splotchcl
