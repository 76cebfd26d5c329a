#include "splotchcl/generate.h"

#include <fmt/format.h>

#include "cli/commands.h"
#include "common/unfinished_file.h"

namespace splotchcl::cli {

int run_generate(const GenerateOptions& options, Console& console) {
  check_output_path(options.output);
  const Stopwatch stopwatch;
  console.status(fmt::format("making {} particles", options.settings.particles));
  const GeneratedSnapshot snapshot = options.what == "halo" ? generate_halo(options.settings)
                                     : options.what == "cluster"
                                         ? generate_cluster(options.settings)
                                         : generate_universe(options.settings);
  write_gadget2(options.output, snapshot);
  console.done(fmt::format("{}: {} gas and {} star particles, {:.1f} s", options.output.string(),
                           snapshot.gas.count(), snapshot.stars.count(), stopwatch.seconds()));
  return 0;
}

}  // namespace splotchcl::cli
