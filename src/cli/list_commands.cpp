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
      ->check(CLI::NonNegativeNumber);
  sub.add_flag("--json", options.json, wrapped("Print JSON"));
}

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

}  // namespace splotchcl::cli
