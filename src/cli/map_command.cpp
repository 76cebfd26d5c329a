#include "cli/map_command.h"

#include "cli/commands.h"

namespace splotchcl::cli {
namespace {

void add_quantity_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--quantity", options.quantity,
                 wrapped("surface_density (the default), counts, line_of_sight_velocity, or a "
                         "field (splotchcl fields lists them)"))
      ->type_name("NAME");
  sub.add_option("--statistic", options.statistic,
                 wrapped("What to make of a field along each line of sight: mean (the default), "
                         "dispersion or integral"))
      ->type_name("NAME");
  sub.add_option("--weight", options.weight,
                 wrapped("Weight of means: mass (the default), volume, constant, or a field"))
      ->type_name("NAME");
  sub.add_flag(
      "--slice", options.slice,
      wrapped("Values in the plane through the centre instead of along the line of sight"));
  sub.add_option("--types", options.types, wrapped("Particle types: gas,stars or 0,4"))
      ->type_name("LIST");
  sub.add_option(
         "--select", options.select,
         wrapped("Only particles that fulfil this, such as 'temperature > 1e6'; can be repeated"))
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  sub.add_option("--unit", options.unit, wrapped("Unit of the map, such as Msun/pc^2, g/cm^2 or K"))
      ->type_name("UNIT");
  sub.add_flag("--noise", options.noise,
               wrapped("Add a second plane: the effective number of particles in each pixel"));
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
  sub.add_option(
         "--view", options.view,
         wrapped(
             "xy (the default), xz or yz: the axes to the right and up; camera: the scene's view"))
      ->type_name("NAME");
  sub.add_option(
         "--center", options.center,
         wrapped("Centre of the map: X,Y,Z in the snapshot's lengths, or in a unit that the last "
                 "has: 25,25,25Mpc; or box, mass or densest"))
      ->type_name("PLACE");
  sub.add_option("--width", options.width,
                 wrapped("Width of the map, in the snapshot's lengths or with a unit: 4Mpc"))
      ->type_name("LENGTH");
  sub.add_option("--distance", options.distance,
                 wrapped("Distance of the observer, such as '16.5 Mpc', or redshift: adds "
                         "coordinates on the sky"))
      ->type_name("LENGTH");
  sub.add_option("--sky", options.sky,
                 wrapped("Right ascension and declination of the centre in degrees"))
      ->type_name("RA,DEC");
  sub.add_option("--contours", options.contours,
                 wrapped("Contour lines on figures: how many, or at which values"))
      ->type_name("N|V,V,...");
  sub.add_option("--depth", options.depth,
                 wrapped("Depth along the line of sight, likewise; particles outside are left out"))
      ->type_name("LENGTH");
  sub.add_option("--units", options.units,
                 wrapped("Units of a snapshot that does not say them: gadget stands for a kpc/h, "
                         "1e10 Msun/h and a^0.5 km/s"))
      ->type_name("NAME")
      ->check(CLI::IsMember({"gadget"}));
  sub.add_option("--size", options.size, wrapped("Size of the map, in pixels"))->type_name("WxH");
}

void add_drawing_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--device", options.device,
                 wrapped("Part of an OpenCL device's name; splotchcl devices lists them"))
      ->type_name("NAME");
  sub.add_option("--set", options.settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--tolerance", options.tolerance,
                 wrapped("Largest error of each sum, relative to it, or to map.floor if it is "
                         "below that; 0: 1e-6. Default: the scene's, or 0.001"))
      ->type_name("X");
  sub.add_option("--every", options.every, wrapped("Read every N-th particle"))->type_name("N");
  sub.add_option("--max-particles", options.max_particles, wrapped("Read at most N, at random"))
      ->type_name("N");
  sub.add_flag(
      "--cache-smoothing-lengths", options.cache_smoothing_lengths,
      wrapped("Store computed smoothing lengths in a file beside the snapshot, and reuse them"));
  sub.add_flag("--reference", options.reference,
               wrapped("Draw with the slow reference renderer in double precision"));
}

}  // namespace

void add_map(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* const sub =
      add_command<MapOptions>(app, run, "map", "Make a map of a quantity in its unit", options,
                              [&console](const MapOptions& o) { return run_map(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file (.toml) or a snapshot"))
      ->required();
  sub->add_option("-o,--output", options->outputs,
                  wrapped("The map; its ending chooses the format: .fits, .hdf5, .npy and .exr "
                          "hold the numbers, .png, .pdf and others a figure; can be repeated"))
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
