#include "cli/list_commands.h"

#include "cli/commands.h"

namespace splotchcl::cli {
namespace {

// What info and fields take alike.
void add_snapshot_question(CLI::App& sub, SnapshotQuestion& options) {
  sub.add_option("FILE", options.snapshot, wrapped("A snapshot; of several files, any one of them"))
      ->required();
  sub.add_option("--columns", options.columns,
                 wrapped("Names for the columns of a text table or a plain NumPy array, in their "
                         "order; - for one that is not needed"))
      ->type_name("NAME,...")
      ->delimiter(',');
  sub.add_flag("--json", options.json, wrapped("For programs rather than people"));
}

}  // namespace

void add_info(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* const sub =
      add_command<InfoOptions>(app, run, "info", "Tell what a snapshot holds", options,
                               [&console](const InfoOptions& o) { return run_info(o, console); });
  add_snapshot_question(*sub, *options);
  sub->add_flag("--header", options->header,
                wrapped("Only what is known without reading particles: no ranges, means and "
                        "scene. At once, for files of any size"));
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
      app, run, "index", "Keep beside a snapshot where its particles are", options,
      [&console](const IndexOptions& o) { return run_index(o, console); });
  sub->add_option("SNAPSHOT", options->snapshot,
                  wrapped("A snapshot; of several files, any one of them"))
      ->required();
  sub->footer(
      "Writes SNAPSHOT.splotchcl_index: boxes around blocks of 8192 particles, 28 bytes for each.\n"
      "With it, a view of a part of a large snapshot reads only blocks that it may see. It is "
      "never\n"
      "needed, changes no picture, and is not used once a file of the snapshot has changed.\n"
      "Example:\n"
      "  splotchcl index huge_snapshot.0.hdf5");
}

void add_fields(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<SnapshotQuestion>();
  CLI::App* const sub = add_command<SnapshotQuestion>(
      app, run, "fields", "List a snapshot's fields by the names that scenes use", options,
      [&console](const SnapshotQuestion& o) { return run_fields(o, console); });
  add_snapshot_question(*sub, *options);
  sub->footer(
      "A line per type and field: particles, range, bad values (not a number, or infinite), unit.\n"
      "Derived fields are not in the file but follow from it, and are used like the others.\n"
      "splotchcl info tells more of the file.\n"
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
                  wrapped("Only these: names, or palette files. Default: the program's own, and "
                          "those in the folder that SPLOTCHCL_PALETTES names"));
  sub->add_option("--preview", options->preview,
                  wrapped("Write a picture of them with their names"))
      ->type_name("FILE");
  sub->add_flag("--json", options->json, wrapped("For programs rather than people"));
  sub->footer(
      "A line for each: its name, its number of knots, its file or its colours.\n"
      "NAME_r is the palette NAME reversed.\n"
      "Examples:\n"
      "  splotchcl palettes --preview palettes.png\n"
      "  splotchcl palettes magma_r mine.txt --preview two.png");
}

}  // namespace splotchcl::cli
