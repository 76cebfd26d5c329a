#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "device/binary_cache.h"
#include "device/opencl.h"

namespace splotchcl {

// Compiled programs of one context, keyed on device, driver, options and source.
// Sources are concatenated rather than included: every cache then sees every change.
// Binaries of earlier runs are taken from the user's cache folder.
class ProgramCache {
 public:
  explicit ProgramCache(const compute::context& context)
      : context_(context), binaries_(BinaryCache::user_folder()) {}

  // `files` are names in kernels/, put together in order after parameters.h and the
  // lines of `defines`; `more` source comes after them. Throws DeviceError with the compiler's
  // first message.
  compute::program get(const std::string& defines, const std::vector<std::string>& files,
                       const std::string& options = "", const std::string& more = "");

  double build_seconds() const { return build_seconds_; }

 private:
  std::optional<compute::program> restore(const std::string& key, const std::string& options);

  compute::context context_;
  BinaryCache binaries_;
  std::map<std::string, compute::program> programs_;
  double build_seconds_ = 0;
};

}  // namespace splotchcl
