#include <fmt/format.h>

#include "cli/commands.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "generate/large_universe.h"
#include "splotchcl/error.h"
#include "splotchcl/galaxy.h"
#include "splotchcl/generate.h"

namespace splotchcl::cli {
namespace {

int generate_large_universe(const GenerateOptions& options, Console& console) {
  const Stopwatch stopwatch;
  const WrittenUniverse made = write_large_universe(
      options.output, options.settings, {},
      [&](const std::string& stage, double fraction) { console.progress(stage, fraction); });
  console.done(fmt::format("{} to {}: {} gas and {} star particles, {:.1f} s",
                           made.files.front().string(), made.files.back().filename().string(),
                           made.gas, made.stars, stopwatch.seconds()));
  return 0;
}

}  // namespace

int run_generate(const GenerateOptions& options, Console& console) {
  check_output_path(options.output);
  if (is_hdf5_ending(lower_ending(options.output))) {
    throw UsageError(fmt::format(
        "--output: found {}, expected a name that does not end as HDF5 does: the snapshot is in "
        "Gadget's format 2",
        options.output.string()));
  }
  if (options.what == "universe" && options.settings.particles > LargeUniverse::least)
    return generate_large_universe(options, console);
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

namespace {

void write_scene(const std::filesystem::path& path, const std::filesystem::path& snapshot,
                 const Galaxy& galaxy) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  const std::filesystem::path from_there =
      std::filesystem::absolute(snapshot).lexically_normal().lexically_proximate(
          folder.lexically_normal());
  const std::string text = galaxy_scene(galaxy, from_there);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
}

}  // namespace

int run_galaxy(const GalaxyOptions& options, Console& console) {
  check_output_path(options.output);
  std::vector<OutputFile> outputs = {{options.output, "--output"}};
  if (options.scene) {
    check_output_path(*options.scene);
    outputs.push_back({*options.scene, "--scene"});
  }
  check_outputs(outputs, [&] {
    std::set<std::filesystem::path> inputs = {options.image};
    if (options.rotation_curve) inputs.insert(*options.rotation_curve);
    return inputs;
  });
  if (!is_hdf5_ending(lower_ending(options.output))) {
    throw UsageError(fmt::format(
        "--output: found {}, expected a name that ends in .hdf5 or .h5: the snapshot's format",
        options.output.string()));
  }
  GalaxySettings settings = options.settings;
  settings.rotation = options.rotation_curve ? read_rotation_curve(*options.rotation_curve)
                                             : RotationCurve::flat(options.speed, options.core);
  const Stopwatch stopwatch;
  console.status("making a galaxy from " + options.image.string());
  const Galaxy galaxy = read_galaxy(options.image, settings, options.gamma);
  console.status("writing " + options.output.string());
  write_galaxy(options.output, galaxy);
  if (options.scene) write_scene(*options.scene, options.output, galaxy);
  console.done(
      fmt::format("{}: {} gas, {} disk, {} bulge, {} cluster and {} dust particles, centre at "
                  "pixel {:.0f},{:.0f}, {} "
                  "pixels of stars removed, {:.1f} s",
                  options.output.string(), galaxy.gas.count(), galaxy.disk.count(),
                  galaxy.bulge.count(), galaxy.clusters.count(), galaxy.dust.count(),
                  galaxy.center[0], galaxy.center[1], galaxy.pixels_of_stars, stopwatch.seconds()));
  return 0;
}

}  // namespace splotchcl::cli
