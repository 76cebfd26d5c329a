#include "cli/map_command.h"

#include "cli/commands.h"

namespace splotchcl::cli {
namespace {

void add_quantity_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--quantity", options.quantity,
                 wrapped("surface_density (the default), counts, line_of_sight_velocity, or a "
                         "field, see splotchcl fields"))
      ->type_name("NAME");
  sub.add_option("--statistic", options.statistic,
                 wrapped("Of a field along each line of sight: mean (the default), dispersion or "
                         "integral"))
      ->type_name("NAME");
  sub.add_option("--weight", options.weight,
                 wrapped("Of means: mass (the default), volume, constant, or a field"))
      ->type_name("NAME");
  sub.add_flag("--slice", options.slice,
               wrapped("In the plane through the center instead of along the line of sight"));
  sub.add_option("--types", options.types, wrapped("Particle types: gas,stars or 0,4"))
      ->type_name("LIST");
  sub.add_option("--select", options.select,
                 wrapped("Only particles of which this holds, such as 'temperature > 1e6'; can be "
                         "repeated"))
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  sub.add_option("--unit", options.unit, wrapped("Of the map: Msun/pc^2, g/cm^2, K"))
      ->type_name("UNIT");
  sub.add_flag("--noise", options.noise,
               wrapped("A second plane: the effective number of particles in each pixel"));
}

void add_velocity_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--channels", options.channels,
                 wrapped("A cube: the sum in so many channels of velocity along the line of sight"))
      ->type_name("N");
  sub.add_option("--velocity-range", options.velocity_range,
                 wrapped("Of the channels, in the snapshot's unit; default: all velocities"))
      ->type_name("V,V");
  sub.add_option("--line-mass", options.line_mass,
                 wrapped("Lines of a cube have the thermal width of particles of so many proton "
                         "masses"))
      ->type_name("M");
}

void add_view_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--view", options.view,
                 wrapped("xy (the default), xz or yz: the axes to the right and upwards; camera: "
                         "the scene's"))
      ->type_name("NAME");
  sub.add_option(
         "--center", options.center,
         wrapped("X,Y,Z in the snapshot's lengths, or in a unit that the last has: 25,25,25Mpc; "
                 "or box, mass or densest"))
      ->type_name("PLACE");
  sub.add_option("--width", options.width,
                 wrapped("Of the map, in the snapshot's lengths or with a unit: 4Mpc"))
      ->type_name("LENGTH");
  sub.add_option(
         "--distance", options.distance,
         wrapped("From where the center is seen, such as '16.5 Mpc', or redshift: for coordinates "
                 "on the sky"))
      ->type_name("LENGTH");
  sub.add_option("--sky", options.sky,
                 wrapped("Right ascension and declination of the center in degrees"))
      ->type_name("RA,DEC");
  sub.add_option("--contours", options.contours,
                 wrapped("Lines on figures: how many, or at which values of the map"))
      ->type_name("N|V,V,...");
  sub.add_option("--depth", options.depth, wrapped("Along the line of sight, likewise"))
      ->type_name("LENGTH");
  sub.add_option("--units", options.units,
                 wrapped("Of a snapshot that does not say them: gadget stands for a kpc/h, 1e10 "
                         "Msun/h and a^0.5 km/s"))
      ->type_name("NAME")
      ->check(CLI::IsMember({"gadget"}));
  sub.add_option("--size", options.size, wrapped("Of the map, in pixels"))->type_name("WxH");
}

void add_drawing_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--device", options.device,
                 wrapped("A part of an OpenCL device's name, see splotchcl devices"))
      ->type_name("NAME");
  sub.add_option("--set", options.settings, wrapped("Override a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--tolerance", options.tolerance,
                 wrapped("Largest error of each sum, relative to it or to the floor "
                         "(map.floor); 0: 1e-6. Default: the scene's, 0.001"))
      ->type_name("X");
  sub.add_option("--every", options.every, wrapped("Read every N-th particle"))->type_name("N");
  sub.add_option("--max-particles", options.max_particles, wrapped("Read at most N, at random"))
      ->type_name("N");
  sub.add_flag("--cache-smoothing-lengths", options.cache_smoothing_lengths,
               wrapped("Keep smoothing lengths that had to be found in a file beside the "
                       "snapshot, and use those that are there"));
  sub.add_flag("--reference", options.reference,
               wrapped("Draw with the slow reference renderer in double precision"));
}

}  // namespace

void add_map(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* const sub =
      add_command<MapOptions>(app, run, "map", "Map a quantity in its unit", options,
                              [&console](const MapOptions& o) { return run_map(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file (.toml) or a snapshot"))
      ->required();
  sub->add_option("-o,--output", options->outputs,
                  wrapped("The map; its ending chooses the format: .fits .hdf5 .npy .exr hold the "
                          "numbers, .png .pdf ... a figure; can be repeated"))
      ->required()
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_quantity_options(*sub, *options);
  add_velocity_options(*sub, *options);
  add_view_options(*sub, *options);
  add_drawing_options(*sub, *options);
  sub->footer(
      "Examples:\n"
      "  splotchcl map snapshot_006 -o density.png\n"
      "  splotchcl map snapshot_006 --quantity temperature --view xy --unit K -o t.fits -o t.png\n"
      "  splotchcl map snapshot_006 --quantity temperature --slice --center densest -o slice.npy");
}

}  // namespace splotchcl::cli
