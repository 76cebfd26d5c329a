#include "cli/scene_options.h"

#include "cli/command_builder.h"

namespace splotchcl::cli {
namespace {

void add_choices(CLI::App& sub, DrawOptions& options) {
  sub.add_option("--types", options.types, wrapped("Only these particle types: gas,stars or 0,4"))
      ->type_name("LIST");
  sub.add_option("--where,--select", options.where,
                 wrapped("Only particles that fulfil this, such as 'temperature > 1e6 && x < 5'; "
                         "can be repeated"))
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  sub.add_option("--field", options.field,
                 wrapped("The field that is shown, or a formula of fields, such as "
                         "'log10(density * temperature)'"))
      ->type_name("FIELD");
  sub.add_option("--palette", options.palette,
                 wrapped("Its palette; splotchcl palettes lists them, or a file"))
      ->type_name("NAME");
  sub.add_option("--center", options.center,
                 wrapped("What is in the middle: X,Y,Z in the snapshot's lengths, or in a unit "
                         "that the last has: 25,25,25Mpc; or box, mass, densest or halo=N"))
      ->type_name("PLACE");
  sub.add_option("--width", options.width,
                 wrapped("Width that is shown, in the snapshot's lengths or with a unit: 4Mpc"))
      ->type_name("LENGTH");
  sub.add_option("--size", options.size, wrapped("Width and height in pixels"))
      ->type_name("WIDTHxHEIGHT");
}

void add_reading(CLI::App& sub, DrawOptions& options) {
  sub.add_option("--units", options.units,
                 wrapped("Units of a snapshot that does not say them: cgs, si, or gadget, which "
                         "stands for a kpc/h, 1e10 Msun/h and a^0.5 km/s"))
      ->type_name("NAME")
      ->check(CLI::IsMember({"gadget", "cgs", "si"}));
  sub.add_option("--every", options.every,
                 wrapped("Use every N-th particle, which counts for as much as is left out: a "
                         "quick look at much data"))
      ->type_name("N");
  sub.add_option("--max-particles", options.max_particles,
                 wrapped("Use at most N particles, chosen at random, likewise"))
      ->type_name("N");
  sub.add_flag(
      "--cache-smoothing-lengths", options.cache_smoothing_lengths,
      wrapped("Store computed smoothing lengths in a file beside the snapshot, and reuse them"));
}

void add_drawing(CLI::App& sub, DrawOptions& options) {
  sub.add_option("--device", options.device,
                 wrapped("Part of an OpenCL device's name; splotchcl devices lists them. Default: "
                         "a GPU if there is one"))
      ->type_name("NAME");
  sub.add_option("--set", options.settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void add_live_options(CLI::App& sub, DrawOptions& options) {
  add_choices(sub, options);
  add_reading(sub, options);
  add_drawing(sub, options);
}

void add_scene_options(CLI::App& sub, DrawOptions& options) {
  add_live_options(sub, options);
  sub.add_flag(
      "--reference", options.reference,
      wrapped("Draw with the slow reference renderer in double precision instead of a device"));
}

}  // namespace splotchcl::cli
