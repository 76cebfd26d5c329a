#include "splotchcl/galaxy.h"

#include <fmt/format.h>

#include "cli/commands.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"

namespace splotchcl::cli {

int run_galaxy(const GalaxyOptions& options, Console& console) {
  check_output_path(options.output);
  check_outputs({{options.output, "--output"}}, [&] {
    std::set<std::filesystem::path> inputs = {options.image};
    if (options.rotation_curve) inputs.insert(*options.rotation_curve);
    return inputs;
  });
  GalaxySettings settings = options.settings;
  settings.rotation = options.rotation_curve ? read_rotation_curve(*options.rotation_curve)
                                             : RotationCurve::flat(options.speed, options.core);
  const Stopwatch stopwatch;
  console.status("making a galaxy from " + options.image.string());
  const Galaxy galaxy = read_galaxy(options.image, settings, options.gamma);
  console.status("writing " + options.output.string());
  write_galaxy(options.output, galaxy);
  console.done(fmt::format(
      "{}: {} gas, {} disk, {} bulge and {} cluster particles, centre at pixel {:.0f},{:.0f}, {} "
      "pixels of stars removed, {:.1f} s",
      options.output.string(), galaxy.gas.count(), galaxy.disk.count(), galaxy.bulge.count(),
      galaxy.clusters.count(), galaxy.center[0], galaxy.center[1], galaxy.pixels_of_stars,
      stopwatch.seconds()));
  return 0;
}

}  // namespace splotchcl::cli
