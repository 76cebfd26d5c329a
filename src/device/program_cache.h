#pragma once

#include <map>
#include <string>
#include <vector>

#include "device/opencl.h"

namespace splotchcl {

// Compiled programs of one context, keyed on device, driver, options and source.
// Sources are concatenated rather than included: a driver's disk cache then sees every
// change. The disk cache is the driver's own (PoCL and the GPU vendors have one).
class ProgramCache {
 public:
  explicit ProgramCache(const compute::context& context) : context_(context) {}

  // `files` are names in kernels/, put together in order after parameters.h and the
  // lines of `defines`; `more` source comes after them. Throws DeviceError with the compiler's
  // first message.
  compute::program get(const std::string& defines, const std::vector<std::string>& files,
                       const std::string& options = "", const std::string& more = "");

  double build_seconds() const { return build_seconds_; }

 private:
  compute::context context_;
  std::map<std::string, compute::program> programs_;
  double build_seconds_ = 0;
};

}  // namespace splotchcl
