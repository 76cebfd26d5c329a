#include <limits>

#include "cli/command_builder.h"
#include "cli/commands.h"

namespace splotchcl::cli {
namespace {

// What info and fields take alike.
void add_snapshot_question(CLI::App& sub, SnapshotQuestion& options) {
  sub.add_option("FILE", options.snapshot,
                 wrapped("A snapshot; for a set of files, any one of them"))
      ->required();
  sub.add_option(
         "--columns", options.columns,
         wrapped(
             "Names for the columns of a text table or a plain NumPy array, in order; - skips one. "
             "Or NAME=COLUMN for each that is called otherwise, in HDF5 NAME=DATASET"))
      ->type_name("NAME,...")
      ->delimiter(',');
  sub.add_option("--skip-lines", options.skip_lines,
                 wrapped("Lines at the beginning of a text table that are no part of it"))
      ->type_name("N")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()).description(""));
  sub.add_flag("--json", options.json, wrapped("Print JSON"));
}

// Without it -1 is read as the largest number that there is.
const CLI::Validator not_negative(
    [](const std::string& number) {
      return number.rfind('-', 0) == 0 ? "found " + number + ", expected a whole number >= 0"
                                       : std::string();
    },
    "");

}  // namespace

void add_info(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* const sub =
      add_command<InfoOptions>(app, run, "info", "Show what a snapshot holds", options,
                               [&console](const InfoOptions& o) { return run_info(o, console); });
  add_snapshot_question(*sub, *options);
  sub->add_flag(
      "--header", options->header,
      wrapped("Read only the header: no ranges, means or scene. Instant for files of any size"));
  sub->footer(
      "Lists the fields of each particle type with their range, mean and number of bad values\n"
      "(not a number, or infinite), in the file's own units, and the scene file that render\n"
      "would use.\n"
      "Examples:\n"
      "  splotchcl info snapshot_006\n"
      "  splotchcl info huge_snapshot.0.hdf5 --header\n"
      "  splotchcl info table.txt --columns x,y,z,mass,-");
}

void add_index(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<IndexOptions>();
  CLI::App* const sub = add_command<IndexOptions>(
      app, run, "index", "Write an index that speeds up views of part of a snapshot", options,
      [&console](const IndexOptions& o) { return run_index(o, console); });
  sub->add_option("SNAPSHOT", options->snapshot,
                  wrapped("A snapshot; for a set of files, any one of them"))
      ->required();
  sub->footer(
      "Writes SNAPSHOT.splotchcl_index: boxes around blocks of 8192 particles, 28 bytes each. A "
      "view\n"
      "of part of a large snapshot then reads only blocks that it may see. Pictures do not change, "
      "and\n"
      "the index is ignored once a file of the snapshot has changed.\n"
      "Example:\n"
      "  splotchcl index huge_snapshot.0.hdf5");
}

void add_tree(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<TreeCommandOptions>();
  CLI::App* const sub = add_command<TreeCommandOptions>(
      app, run, "tree", "Write a tree of merged particles, so that many draw as fast as few",
      options, [&console](const TreeCommandOptions& o) { return run_tree(o, console); });
  sub->add_option("SNAPSHOT", options->snapshot,
                  wrapped("A snapshot; for a set of files, any one of them"))
      ->required();
  sub->add_option("--types", options->types, wrapped("Particle types. Default: all"))
      ->type_name("N,...")
      ->delimiter(',');
  sub->add_option("--fields", options->fields,
                  wrapped("Fields to color by, at most four, which all these types have. Default: "
                          "what a first picture uses"))
      ->type_name("NAME,...")
      ->delimiter(',');
  sub->add_option(
         "--least", options->least,
         wrapped("Particles of a node at least, 2 to 32. Default: 4; 8 takes half the room "
                 "and serves less exact pictures as well"))
      ->type_name("N")
      ->check(CLI::Range(2, 32));
  sub->add_flag("--with-particles", options->with_particles,
                wrapped("Keep what scenes ask of the particles in the tree, too, exactly and in "
                        "its order: 20 bytes each and more, so that what lies together in space "
                        "is read together"));
  sub->footer(
      "Writes SNAPSHOT.splotchcl_tree, some 10 bytes per particle. Scenes with kernel.footprint "
      "are\n"
      "drawn from it where many particles lie over a pixel; --tree of render and movie says when.\n"
      "The tree is ignored once a file of the snapshot has changed.\n"
      "Example:\n"
      "  splotchcl tree huge_snapshot.0.hdf5\n"
      "  splotchcl render huge_snapshot.0.hdf5 --set kernel.footprint=0.5 --tolerance 0.01");
}

void add_fields(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<SnapshotQuestion>();
  CLI::App* const sub = add_command<SnapshotQuestion>(
      app, run, "fields", "List a snapshot's fields by the names that scenes use", options,
      [&console](const SnapshotQuestion& o) { return run_fields(o, console); });
  add_snapshot_question(*sub, *options);
  sub->footer(
      "One line per type and field: particles, range, bad values (NaN or infinite), unit. Derived\n"
      "fields are computed from those in the file and used like them. splotchcl info shows more.\n"
      "Examples:\n"
      "  splotchcl fields snapshot_006\n"
      "  splotchcl fields snapshot_006 | grep gas");
}

void add_palettes(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<PalettesOptions>();
  CLI::App* const sub = add_command<PalettesOptions>(
      app, run, "palettes", "List the palettes, or show them in a picture", options,
      [&console](const PalettesOptions& o) { return run_palettes(o, console); });
  sub->add_option("NAME", options->names,
                  wrapped("Only these: names or palette files. Default: all built-in ones, and "
                          "those in the folder that SPLOTCHCL_PALETTES names"));
  sub->add_option("--preview", options->preview,
                  wrapped("Write a picture of them with their names"))
      ->type_name("FILE");
  sub->add_flag("--json", options->json, wrapped("Print JSON"));
  sub->footer(
      "One line each: name, number of knots, file or colours. NAME_r is the palette NAME "
      "reversed.\n"
      "Examples:\n"
      "  splotchcl palettes --preview palettes.png\n"
      "  splotchcl palettes magma_r mine.txt --preview two.png");
}

void add_generate(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<GenerateOptions>();
  CLI::App* const sub = add_command<GenerateOptions>(
      app, run, "generate", "Make a snapshot to try things on", options,
      [&console](const GenerateOptions& o) { return run_generate(o, console); });
  sub->add_option("WHAT", options->what,
                  wrapped("universe: cosmic web and haloes in a box of 50000 kpc/h; cluster: a "
                          "cluster of galaxies with infalling groups and cold streams; halo: a "
                          "spiral galaxy with satellites in hot gas"))
      ->required()
      ->check(CLI::IsMember({"universe", "cluster", "halo"}));
  sub->add_option("-o,--output", options->output,
                  wrapped("The snapshot, Gadget format 2; of a universe of more than 30 million "
                          "particles in files FILE.0, FILE.1, ..."))
      ->required()
      ->type_name("FILE");
  sub->add_option("--particles", options->settings.particles,
                  wrapped("Number of gas and star particles"))
      ->type_name("N")
      ->check(not_negative)
      ->capture_default_str();
  sub->add_option("--stars", options->settings.star_fraction,
                  wrapped("The fraction of them that are stars"))
      ->type_name("FRACTION")
      ->capture_default_str();
  sub->add_option("--seed", options->settings.seed,
                  wrapped("The same seed makes the same particles"))
      ->type_name("N")
      ->check(not_negative)
      ->capture_default_str();
  sub->footer(
      "Units are Gadget's: kpc/h, 1e10 solar masses/h, km/s.\n"
      "Example:\n"
      "  splotchcl generate universe -o universe.gadget --particles 1000000 --seed 7");
}

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
                 wrapped("Radius of the galaxy in pixels along its longest diameter; excludes "
                         "companions. Default: the whole picture"))
      ->type_name("PIXELS");
  sub.add_option("--size", s.size_kpc, wrapped("Length of the picture's longer side, in kpc"))
      ->type_name("KPC")
      ->capture_default_str();
  sub.add_option("--gamma", options.gamma,
                 wrapped("Light = value^gamma. Default: 2.2 for whole numbers, 1 for floats"))
      ->type_name("G");
  sub.add_option(
         "--threshold", s.threshold,
         wrapped(
             "How far a pixel must exceed the sky, in standard deviations of the border's noise"))
      ->type_name("K")
      ->capture_default_str();
  sub.add_flag_callback(
      "--keep-stars", [&s] { s.removes_stars = false; },
      wrapped("Keep points of light that look like foreground stars"));
}

void add_matter_options(CLI::App& sub, GalaxySettings& s) {
  const auto add = [&sub](const char* name, auto& value, const char* type, const char* help) {
    sub.add_option(name, value, wrapped(help))->type_name(type)->capture_default_str();
  };
  add("--flare", s.flare, "X",
      "Heights at the rim are e^(X / 2) times those given here, in the middle e^(-X / 2)");
  add("--gas-height", s.gas_height_kpc, "KPC", "Standard deviation of the gas clouds' heights");
  add("--cloud-points", s.cloud_points, "N", "Gas particles for each pixel");
  add("--cloud-radius", s.cloud_radius_pixels, "PIXELS",
      "How far away, in pixels, a particle's colour may come from");
  add("--dust", s.dust, "FACTOR", "How much dust; 0 is none");
  add("--dust-height", s.dust_height_kpc, "KPC", "Standard deviation of the dust's heights");
  add("--dust-points", s.dust_points, "N", "Dust particles for each pixel");
  add("--disk-stars", s.disk_stars, "N", "Stars of the disk");
  add("--disk-width", s.disk_width, "FRACTION",
      "Standard deviation of their positions, as a fraction of the galaxy's radius");
  add("--disk-height", s.disk_height_kpc, "KPC", "Standard deviation of their heights");
  add("--disk-light", s.disk_light, "FRACTION", "Their fraction of the picture's light");
  add("--bulge-stars", s.bulge_stars, "N", "Stars of the bulge");
  add("--bulge-radius", s.bulge_radius_kpc, "KPC", "Its Plummer radius");
  add("--bulge-light", s.bulge_light, "FRACTION", "Its fraction of the light at the centre");
  add("--clusters", s.clusters, "N", "Globular clusters");
  add("--cluster-stars", s.cluster_stars, "N", "Median number of stars per cluster");
  add("--cluster-light", s.cluster_light, "FRACTION", "Their fraction of the picture's light");
  add("--detail", s.detail, "FACTOR",
      "Factor on the number of particles other than the clusters'; more for close views");
  add("--seed", s.seed, "N", "The same seed makes the same galaxy");
}

void add_rotation_options(CLI::App& sub, GalaxyOptions& options) {
  sub.add_option("--speed", options.speed, wrapped("Speed of the flat rotation curve"))
      ->type_name("KM/S")
      ->capture_default_str();
  sub.add_option("--core", options.core, wrapped("Radius within which it turns like a solid body"))
      ->type_name("KPC")
      ->capture_default_str();
  sub.add_option("--rotation-curve", options.rotation_curve,
                 wrapped("Use a rotation curve from a file of two columns, kpc and km/s"))
      ->type_name("FILE");
  sub.add_flag("--clockwise", options.settings.turns_clockwise,
               wrapped("Turn clockwise in the picture"));
}

}  // namespace

void add_galaxy(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<GalaxyOptions>();
  CLI::App* const sub = add_command<GalaxyOptions>(
      app, run, "galaxy", "Make a 3D galaxy from a picture of one", options,
      [&console](const GalaxyOptions& o) { return run_galaxy(o, console); });
  sub->add_option("IMAGE", options->image,
                  wrapped("A picture of a spiral galaxy, in any format; averaged down to 1024 "
                          "pixels"))
      ->required();
  sub->add_option("-o,--output", options->output, wrapped("The snapshot, Gadget HDF5"))
      ->required()
      ->type_name("FILE");
  sub->add_option("--scene", options->scene, wrapped("Also write a scene file that draws it"))
      ->type_name("FILE");
  add_picture_options(*sub, *options);
  add_matter_options(*sub, options->settings);
  add_rotation_options(*sub, *options);
  sub->footer(
      "Makes gas (type 0), disk stars (2), a bulge (3) and globular clusters (4), each particle\n"
      "with a Color, and dust (5) with an Opacity, around the origin, in kpc and km/s;\n"
      "see docs/galaxy.md.\n"
      "Example:\n"
      "  splotchcl galaxy m51.jpg -o m51.hdf5 --scene m51.toml --radius 700 --size 25\n"
      "  splotchcl render m51.toml -o m51.png");
}

void add_evolve(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<EvolveOptions>();
  CLI::App* const sub = add_command<EvolveOptions>(
      app, run, "evolve", "Rotate a galaxy and draw it", options,
      [&console](const EvolveOptions& o) { return run_evolve(o, console); });
  sub->add_option("GALAXY", options->galaxy, wrapped("A snapshot made by splotchcl galaxy"))
      ->required();
  sub->add_option("SCENE", options->scene,
                  wrapped("A scene file that draws it, as its snapshot or a component's. Not "
                          "needed with --snapshots alone"));
  sub->add_option("-o,--output", options->output,
                  wrapped("Numbered pictures, such as turn_%04d.png"))
      ->type_name("FILES");
  sub->add_option("--snapshots", options->snapshots,
                  wrapped("Write a snapshot of each frame, such as turn_%04d.hdf5"))
      ->type_name("FILES");
  sub->add_option("--duration", options->duration_myr,
                  wrapped("Time from the first frame to the last, in Myr. Default: until the arms "
                          "wind up, or one turn of the pattern"))
      ->type_name("MYR");
  sub->add_option("--frames", options->frames, wrapped("Number of frames"))
      ->type_name("N")
      ->capture_default_str();
  sub->add_flag("--first-order", options->first_order,
                wrapped("Take steps along the tangent, as in the paper, instead of exact circles"));
  sub->add_option("--step", options->step_myr,
                  wrapped("Length of such a step. Default: from one frame to the next"))
      ->type_name("MYR");
  sub->add_option("--speed", options->speed,
                  wrapped("Speed of a flat rotation curve. Default: the galaxy's own velocities"))
      ->type_name("KM/S");
  sub->add_option("--core", options->core,
                  wrapped("Radius within which that curve is a solid body's. Default: 1"))
      ->type_name("KPC");
  sub->add_option("--rotation-curve", options->rotation_curve,
                  wrapped("Use a rotation curve from a file of two columns, kpc and km/s"))
      ->type_name("FILE");
  sub->add_option("--pattern-speed", options->pattern_speed,
                  wrapped("Turn the arms as a whole at this speed, for long films"))
      ->type_name("KM/S/KPC");
  sub->add_option("--part", options->part, wrapped("Make only the K-th of N shares of the frames"))
      ->type_name("K/N");
  sub->add_option("--device", options->device,
                  wrapped("Part of an OpenCL device's name; splotchcl devices lists them"))
      ->type_name("NAME");
  sub->add_option("--set", options->settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub->footer(
      "Examples:\n"
      "  splotchcl evolve m51.hdf5 m51.toml -o turn_%04d.png --frames 250\n"
      "  splotchcl evolve m51.hdf5 m51.toml -o long_%04d.png --pattern-speed 40 --frames 500\n"
      "  splotchcl evolve m51.hdf5 --snapshots m51_%03d.hdf5 --duration 50 --frames 11");
}

}  // namespace splotchcl::cli
