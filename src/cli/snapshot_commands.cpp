#include "cli/command_builder.h"
#include "cli/commands.h"
#include "snapshot/field_names.h"

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
  add_number(sub, "--skip-lines", options.skip_lines, "N",
             "Lines at the beginning of a text table that are no part of it");
  sub.add_flag("--json", options.json, wrapped("Print JSON"));
}

// From its name to its number, as scenes have them.
const CLI::Validator type_by_name(
    [](std::string& name) {
      const std::optional<int> type = find_particle_type(name);
      if (type) name = std::to_string(*type);
      return type || parse_whole_number(name)
                 ? std::string()
                 : "found " + name + ", expected a particle type, such as gas or 0";
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
  sub->add_option("--types", options->types,
                  wrapped("Only these particle types: gas,stars or 0,4. Default: all"))
      ->type_name("LIST")
      ->transform(type_by_name)
      ->delimiter(',');
  sub->add_option("--fields", options->fields,
                  wrapped("Fields to color by, at most four, which all these types have. Default: "
                          "those of the scene"))
      ->type_name("NAME,...")
      ->delimiter(',');
  sub->add_option("--scene", options->scene,
                  wrapped("A scene file: of its colors, nodes have the mean of all their "
                          "particles; of others, that of eight. Default: the first picture's"))
      ->type_name("FILE");
  add_number(*sub, "--least", options->least, "N",
             "Particles of a node at least, 2 to 32. Default: 4; 8 takes half the room and serves "
             "less exact pictures as well",
             std::pair(2, 32));
  sub->add_flag("--with-particles", options->with_particles,
                wrapped("Keep what scenes ask of the particles in the tree, too, exactly and in "
                        "its order: 20 bytes each and more, so that what lies together in space "
                        "is read together"));
  sub->footer(
      "Writes SNAPSHOT.splotchcl_tree, some 14 bytes per particle. Scenes with kernel.footprint "
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
      ->check(one_of({"universe", "cluster", "halo"}));
  sub->add_option("-o,--output", options->output,
                  wrapped("The snapshot, Gadget format 2; of a universe of more than 30 million "
                          "particles in files FILE.0, FILE.1, ..."))
      ->required()
      ->type_name("FILE");
  GenerateSettings& settings = options->settings;
  add_number(*sub, "--particles", settings.particles, "N", "Number of gas and star particles")
      ->capture_default_str();
  add_number(*sub, "--stars", settings.star_fraction, "FRACTION",
             "The fraction of them that are stars")
      ->capture_default_str();
  add_number(*sub, "--seed", settings.seed, "N", "The same seed makes the same particles")
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
      ->check(any_number())
      ->delimiter(',');
  add_number(sub, "--inclination", s.inclination_degrees, "DEG",
             "Degrees by which the disk is tilted, 0 (face-on) to 80")
      ->capture_default_str();
  add_number(sub, "--position-angle", s.position_angle_degrees, "DEG",
             "Degrees from up, counter-clockwise, of the tilted disk's longest "
             "diameter")
      ->capture_default_str();
  add_number(sub, "--radius", s.radius_pixels, "PIXELS",
             "Radius of the galaxy in pixels along its longest diameter; excludes "
             "companions. Default: the whole picture");
  add_number(sub, "--size", s.size_kpc, "KPC", "Length of the picture's longer side, in kpc")
      ->capture_default_str();
  add_number(sub, "--gamma", options.gamma, "G",
             "Light = value^gamma. Default: 2.2 for whole numbers, 1 for floats");
  add_number(sub, "--threshold", s.threshold, "K",
             "How far a pixel must exceed the sky, in standard deviations of the border's noise")
      ->capture_default_str();
  sub.add_flag_callback(
      "--keep-stars", [&s] { s.removes_stars = false; },
      wrapped("Keep points of light that look like foreground stars"));
}

void add_matter_options(CLI::App& sub, GalaxySettings& s) {
  const auto add = [&sub](const char* name, auto& value, const char* type, const char* help) {
    add_number(sub, name, value, type, help)->capture_default_str();
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
  add_number(sub, "--speed", options.speed, "KM/S", "Speed of the flat rotation curve")
      ->capture_default_str();
  add_number(sub, "--core", options.core, "KPC", "Radius within which it turns like a solid body")
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
  add_number(*sub, "--duration", options->duration_myr, "MYR",
             "Time from the first frame to the last, in Myr. Default: until the arms "
             "wind up, or one turn of the pattern");
  add_number(*sub, "--frames", options->frames, "N", "Number of frames")->capture_default_str();
  sub->add_flag("--first-order", options->first_order,
                wrapped("Take steps along the tangent, as in the paper, instead of exact circles"));
  add_number(*sub, "--step", options->step_myr, "MYR",
             "Length of such a step. Default: from one frame to the next");
  add_number(*sub, "--speed", options->speed, "KM/S",
             "Speed of a flat rotation curve. Default: the galaxy's own velocities");
  add_number(*sub, "--core", options->core, "KPC",
             "Radius within which that curve is a solid body's. Default: 1");
  sub->add_option("--rotation-curve", options->rotation_curve,
                  wrapped("Use a rotation curve from a file of two columns, kpc and km/s"))
      ->type_name("FILE");
  add_number(*sub, "--pattern-speed", options->pattern_speed, "KM/S/KPC",
             "Turn the arms as a whole at this speed, for long films");
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
