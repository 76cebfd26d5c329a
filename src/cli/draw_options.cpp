#include <fmt/format.h>

#include "cli/commands.h"

namespace splotchcl::cli {

std::vector<std::string> settings_of(const DrawOptions& options) {
  std::vector<std::string> settings = options.settings;
  if (options.size) settings.push_back("image.size=" + *options.size);
  if (options.tolerance) settings.push_back(fmt::format("tolerance={}", *options.tolerance));
  if (options.every) settings.push_back(fmt::format("read.every={}", *options.every));
  if (options.max_particles) {
    settings.push_back(fmt::format("read.max_particles={}", *options.max_particles));
  }
  if (options.cache_smoothing_lengths) settings.push_back("read.cache_smoothing_lengths=true");
  return settings;
}

}  // namespace splotchcl::cli
