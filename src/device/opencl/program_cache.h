#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "device/opencl/binary_cache.h"
#include "device/opencl/opencl.h"

namespace splotchcl {

// What a program is made of: lines of #defines, then files in kernels/ in their order, and
// source that is no file (tests). Sources are put together rather than included, so that
// every cache sees every change.
struct ProgramSource {
  std::string defines;
  std::vector<std::string> files;
  std::string more = {};
};

// Compiled programs of one context, keyed on device, driver, options and source.
// Binaries of earlier runs are taken from the user's cache folder.
class ProgramCache {
 public:
  explicit ProgramCache(const compute::context& context)
      : context_(context), binaries_(BinaryCache::user_folder()) {}

  // Throws DeviceError with the compiler's first message.
  compute::program get(const ProgramSource& source);

  double build_seconds() const { return build_seconds_; }
  // Why compiled programs are not kept from run to run; empty: they are, or need not be.
  const std::string& note() const { return binaries_.note(); }

 private:
  std::optional<compute::program> restore(const std::string& key);

  compute::context context_;
  BinaryCache binaries_;
  std::map<std::string, compute::program> programs_;
  double build_seconds_ = 0;
};

}  // namespace splotchcl
