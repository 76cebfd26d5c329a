#include "cli/galaxy_commands.h"

#include "cli/commands.h"

namespace splotchcl::cli {
namespace {

// Where the galaxy is in the picture, and which part of the picture's light is its own.
void add_picture_options(CLI::App& sub, GalaxyOptions& options) {
  GalaxySettings& s = options.settings;
  sub.add_option("--center,--centre", s.center,
                 wrapped("The galaxy's centre in pixels from the left and top. Default: the centre "
                         "of light"))
      ->type_name("X,Y")
      ->delimiter(',');
  sub.add_option("--inclination", s.inclination_degrees,
                 wrapped("Degrees by which the disk is tilted, 0 (face-on) to 80"))
      ->type_name("DEG")
      ->capture_default_str();
  sub.add_option("--position-angle", s.position_angle_degrees,
                 wrapped("Degrees from up, counter-clockwise, of the tilted disk's longest "
                         "diameter"))
      ->type_name("DEG")
      ->capture_default_str();
  sub.add_option("--radius", s.radius_pixels,
                 wrapped("Where the galaxy ends, in pixels along its longest diameter; keeps a "
                         "companion out. Default: the whole picture"))
      ->type_name("PIXELS");
  sub.add_option("--size", s.size_kpc, wrapped("Length of the picture's longer side, in kpc"))
      ->type_name("KPC")
      ->capture_default_str();
  sub.add_option("--gamma", options.gamma,
                 wrapped("Light = value^gamma. Default: 2.2 for whole numbers, 1 for floats"))
      ->type_name("G");
  sub.add_option("--threshold", s.threshold,
                 wrapped("Pixels count that exceed the sky, the median of the picture's border, by "
                         "so many deviations of its noise"))
      ->type_name("K")
      ->capture_default_str();
  sub.add_flag_callback(
      "--keep-stars", [&s] { s.removes_stars = false; },
      wrapped("Keep the points of light that are taken for stars of the Milky Way"));
}

void add_matter_options(CLI::App& sub, GalaxySettings& s) {
  const auto add = [&sub](const char* name, auto& value, const char* type, const char* help) {
    sub.add_option(name, value, wrapped(help))->type_name(type)->capture_default_str();
  };
  add("--gas-height", s.gas_height_kpc, "KPC", "Standard deviation of the gas clouds' heights");
  add("--cloud-points", s.cloud_points, "N", "Gas particles for each pixel");
  add("--cloud-radius", s.cloud_radius_pixels, "PIXELS", "How far colours of pixels reach");
  add("--dust", s.dust, "FACTOR", "How much dust; 0 is none");
  add("--dust-height", s.dust_height_kpc, "KPC", "Standard deviation of its heights");
  add("--dust-points", s.dust_points, "N", "Dust particles for each pixel");
  add("--disk-stars", s.disk_stars, "N", "Stars of the disk");
  add("--disk-width", s.disk_width, "FRACTION",
      "Standard deviation of their places, of the galaxy's radius");
  add("--disk-height", s.disk_height_kpc, "KPC", "Standard deviation of their heights");
  add("--disk-light", s.disk_light, "FRACTION", "Their part of the picture's light");
  add("--bulge-stars", s.bulge_stars, "N", "Stars of the bulge");
  add("--bulge-radius", s.bulge_radius_kpc, "KPC", "Its Plummer radius");
  add("--bulge-light", s.bulge_light, "FRACTION", "Its part of the light at the centre");
  add("--clusters", s.clusters, "N", "Globular clusters");
  add("--cluster-stars", s.cluster_stars, "N", "Stars of one, as a median: the number is random");
  add("--cluster-light", s.cluster_light, "FRACTION", "Their part of the picture's light");
  add("--detail", s.detail, "FACTOR",
      "Factor on the numbers of all particles but the clusters': more for views from close by");
  add("--seed", s.seed, "N", "The same seed makes the same galaxy");
}

void add_rotation_options(CLI::App& sub, GalaxyOptions& options) {
  sub.add_option("--speed", options.speed, wrapped("Speed of the flat rotation curve"))
      ->type_name("KM/S")
      ->capture_default_str();
  sub.add_option("--core", options.core,
                 wrapped("Radius inside of which it turns like a solid body"))
      ->type_name("KPC")
      ->capture_default_str();
  sub.add_option("--rotation-curve", options.rotation_curve,
                 wrapped("A file of two columns, kpc and km/s, instead"))
      ->type_name("FILE");
  sub.add_flag("--clockwise", options.settings.turns_clockwise,
               wrapped("Turn clockwise in the picture"));
}

}  // namespace

void add_galaxy(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<GalaxyOptions>();
  CLI::App* const sub = add_command<GalaxyOptions>(
      app, run, "galaxy", "Make a galaxy in three dimensions from a picture of one", options,
      [&console](const GalaxyOptions& o) { return run_galaxy(o, console); });
  sub->add_option("IMAGE", options->image,
                  wrapped("A picture of a spiral galaxy, in any format; averaged down to 1024 "
                          "pixels"))
      ->required();
  sub->add_option("-o,--output", options->output, wrapped("The snapshot, Gadget HDF5"))
      ->required()
      ->type_name("FILE");
  sub->add_option("--scene", options->scene,
                  wrapped("Write a scene file that draws it from any side, too"))
      ->type_name("FILE");
  add_picture_options(*sub, *options);
  add_matter_options(*sub, options->settings);
  add_rotation_options(*sub, *options);
  sub->footer(
      "Makes gas (type 0), disk stars (2), a bulge (3) and globular clusters (4), each particle\n"
      "with a Color, and dust (5) with an Opacity, around the origin, in kpc and km/s.\n"
      "docs/galaxy.md says how.\n"
      "Example:\n"
      "  splotchcl galaxy m51.jpg -o m51.hdf5 --scene m51.toml --radius 700 --size 25\n"
      "  splotchcl render m51.toml -o m51.png");
}

void add_evolve(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<EvolveOptions>();
  CLI::App* const sub = add_command<EvolveOptions>(
      app, run, "evolve", "Turn a galaxy and draw it as it turns", options,
      [&console](const EvolveOptions& o) { return run_evolve(o, console); });
  sub->add_option("GALAXY", options->galaxy, wrapped("A snapshot that splotchcl galaxy made"))
      ->required();
  sub->add_option("SCENE", options->scene,
                  wrapped("A scene file that draws it, as its snapshot or as that of a component. "
                          "Not needed for --snapshots alone"));
  sub->add_option("-o,--output", options->output,
                  wrapped("Numbered pictures, such as turn_%04d.png"))
      ->type_name("FILES");
  sub->add_option("--snapshots", options->snapshots,
                  wrapped("Write the galaxy of each frame, too, such as turn_%04d.hdf5"))
      ->type_name("FILES");
  sub->add_option("--duration", options->duration_myr,
                  wrapped("From the first frame to the last, in million years. Default: as long as "
                          "the arms hold, or one turn of the pattern"))
      ->type_name("MYR");
  sub->add_option("--frames", options->frames, wrapped("How many frames"))
      ->type_name("N")
      ->capture_default_str();
  sub->add_flag("--first-order", options->first_order,
                wrapped("Steps along the tangent, as in the paper, instead of exact circles"));
  sub->add_option("--step", options->step_myr,
                  wrapped("Length of such a step. Default: from one frame to the next"))
      ->type_name("MYR");
  sub->add_option("--speed", options->speed,
                  wrapped("Speed of a flat rotation curve. Default: the galaxy's own velocities"))
      ->type_name("KM/S");
  sub->add_option("--core", options->core,
                  wrapped("Radius inside of which that curve is that of a solid body. Default: 1"))
      ->type_name("KPC");
  sub->add_option("--rotation-curve", options->rotation_curve,
                  wrapped("A file of two columns, kpc and km/s, instead"))
      ->type_name("FILE");
  sub->add_option(
         "--pattern-speed", options->pattern_speed,
         wrapped("Turn the arms as a whole, at this speed; for films that last longer than "
                 "the arms hold"))
      ->type_name("KM/S/KPC");
  sub->add_option("--part", options->part,
                  wrapped("Make only the K-th of N shares of the frames, so that N processes share "
                          "the work"))
      ->type_name("K/N");
  sub->add_option("--device", options->device, wrapped("A part of an OpenCL device's name"))
      ->type_name("NAME");
  sub->add_option("--set", options->settings,
                  wrapped("Override a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub->footer(
      "Examples:\n"
      "  splotchcl evolve m51.hdf5 m51.toml -o turn_%04d.png --frames 250\n"
      "  splotchcl evolve m51.hdf5 m51.toml -o long_%04d.png --pattern-speed 40 --frames 500\n"
      "  splotchcl evolve m51.hdf5 --snapshots m51_%03d.hdf5 --duration 50 --frames 11");
}

}  // namespace splotchcl::cli
