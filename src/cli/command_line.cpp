#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_builder.h"
#include "cli/command_tree.h"
#include "cli/commands.h"
#include "cli/compiler_process.h"
#include "cli/galaxy_commands.h"
#include "cli/list_commands.h"
#include "cli/map_command.h"
#include "cli/pages.h"
#include "cli/version.h"
#include "cli/view_command.h"
#include "common/nearest_name.h"
#include "splotchcl/error.h"

namespace splotchcl::cli {
namespace {

const std::map<std::string, CompositeShape> shape_names = {{"automatic", CompositeShape::automatic},
                                                           {"rows", CompositeShape::rows},
                                                           {"groups", CompositeShape::groups}};

// From words such as 2GiB to bytes. Further on 0 stands for no limit, and a size below it would be
// the largest that there is.
const CLI::Validator size_in_bytes(
    [](std::string& size) {
      const std::string refusal = "found " + size + ", expected a size such as 1500MB or 2GiB";
      if (size.rfind('-', 0) == 0) return refusal;
      try {
        if (!CLI::AsSizeValue(true)(size).empty()) return refusal;
      } catch (const CLI::ValidationError&) {
        return refusal;
      }
      return size == "0" ? refusal : std::string();
    },
    "");

// From its name to its number.
const CLI::Validator shape_by_name(
    [](std::string& name) {
      const auto shape = shape_names.find(CLI::detail::to_lower(name));
      if (shape == shape_names.end())
        return "found " + name + ", expected automatic, rows or groups";
      name = std::to_string(static_cast<int>(shape->second));
      return std::string();
    },
    "");

// Without it -1 is read as the largest number that there is.
const CLI::Validator not_negative(
    [](const std::string& number) {
      return number.rfind('-', 0) == 0 ? "found " + number + ", expected a whole number >= 0"
                                       : std::string();
    },
    "");

// What render and movie take alike.
void add_draw_options(CLI::App& sub, DrawOptions& options) {
  sub.add_option(
         "--device", options.device,
         wrapped("A part of an OpenCL device's name, see splotchcl devices. Default: a GPU, "
                 "else the CPU"))
      ->type_name("NAME");
  sub.add_option("--set", options.settings, wrapped("Override a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--size", options.size, wrapped("Width and height of the picture, in pixels"))
      ->type_name("WIDTHxHEIGHT");
  sub.add_option(
         "--tolerance", options.tolerance,
         wrapped("Largest error of a pixel, in units of the display's white; 0: as exact as "
                 "the device can. Default: the scene's, 0.001"))
      ->type_name("X");
  sub.add_option("--every", options.every,
                 wrapped("Draw every N-th particle, brighter by as much as is left out: a quick "
                         "look at much data"))
      ->type_name("N");
  sub.add_option("--max-particles", options.max_particles,
                 wrapped("Draw at most N particles, chosen at random, brighter likewise"))
      ->type_name("N");
  sub.add_flag("--cache-smoothing-lengths", options.cache_smoothing_lengths,
               wrapped("Keep smoothing lengths that had to be found in a file beside the "
                       "snapshot, and use those that are there"));
  sub.add_flag(
      "--reference", options.reference,
      wrapped("Draw with the slow reference renderer in double precision instead of a device"));
  sub.add_flag("--explain", options.explain,
               wrapped("Print how it is drawn, the memory and the time that it will take, and the "
                       "equivalent scene file; draws nothing unless there is an --output"));
  sub.add_option(
         "--memory", options.memory_bytes,
         wrapped(
             "Memory of the device for drawing, such as 1500MB or 2GiB. Ordered pictures of more "
             "particles than fit are drawn in parts of their depth. Default: what there "
             "is room for"))
      ->transform(size_in_bytes)
      ->type_name("SIZE");
  sub.add_option("--stats", options.stats,
                 wrapped("Write times in seconds, counts and memory as JSON"))
      ->type_name("FILE");
}

void add_render(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* const sub = add_command<RenderOptions>(
      app, run, "render", "Draw a scene or a snapshot", options,
      [&console](const RenderOptions& o) { return run_render(o, console); });
  sub->add_option(
         "SCENE", options->scene,
         wrapped("A scene file (.toml), a parameter file of the original Splotch (.par), or a "
                 "snapshot: then camera, palette and ranges are chosen from the data"))
      ->required();
  sub->add_option(
         "-o,--output", options->output,
         wrapped("The picture; its ending chooses the format: .png .jpg .tga ... hold 8 bits, "
                 ".exr and .tif linear floats and alpha. Default: the scene's name with .png, "
                 "in the current folder"))
      ->type_name("FILE");
  add_draw_options(*sub, *options);
  sub->add_option("--crop", options->crop, wrapped("Draw only this part of the picture, in pixels"))
      ->type_name("X,Y,W,H");
  sub->add_flag("--certify", options->certify,
                wrapped("Draw until a bound, not an estimate, says that the picture keeps its "
                        "tolerance"));
  sub->add_option("--shape", options->shape,
                  wrapped("Which kernels draw: rows, those for processors, or groups, those for "
                          "GPUs. Default: automatic, by the device's type"))
      ->transform(shape_by_name)
      ->type_name("SHAPE");
  sub->add_option("--error-map", options->error_map,
                  wrapped("Certify, and write the bound of each pixel's error, over its light "
                          "where that is more than 1, as an image: an .exr has the numbers"))
      ->type_name("FILE");
  sub->footer(
      "Started by mpirun or srun, several processes draw the picture together, to the same bits.\n"
      "Examples:\n"
      "  splotchcl render snapshot_006 -o universe.png\n"
      "  splotchcl render snapshot_006 --size 1920x1080\n"
      "  splotchcl render snapshot_006 --explain > scene.toml\n"
      "  splotchcl render scene.toml -o light.exr --crop 256,256,128,128\n"
      "  mpirun -n 8 splotchcl render scene.toml -o large.png");
}

void add_convert(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* const sub = add_command<ConvertOptions>(
      app, run, "convert", "Make a scene file of a parameter file of the original Splotch", options,
      [&console](const ConvertOptions& o) { return run_convert(o, console); });
  sub->add_option("FILE", options->par, wrapped("A parameter file (.par)"))->required();
  sub->add_option("-o,--output", options->output, wrapped("The scene file (.toml)"))
      ->required()
      ->type_name("FILE");
  sub->add_option("--set", options->settings,
                  wrapped("Override a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub->footer(
      "Keys without a counterpart are named. render and movie take a .par file as it is, too.\n"
      "Example:\n"
      "  splotchcl convert demo.par -o demo.toml");
}

void add_movie(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<MovieOptions>();
  CLI::App* const sub = add_command<MovieOptions>(
      app, run, "movie", "Draw the frames of a film", options,
      [&console](const MovieOptions& o) { return run_movie(o, console); });
  sub->add_option("SCENE", options->scene,
                  wrapped("A scene file (.toml) with a [path], or a snapshot and settings"))
      ->required();
  sub->add_option("-o,--output", options->output,
                  wrapped("The film (.mp4 .mov .mkv .webm, made by ffmpeg), or numbered images: a "
                          "name with %d or %04d and the ending of a picture"))
      ->type_name("FILE");
  add_draw_options(*sub, *options);
  sub->add_option("--frames", options->frames,
                  wrapped("Only these frames, from 0: FIRST:END:STEP, END left out; 100:200:2 is "
                          "100, 102, ... 198"))
      ->type_name("RANGE");
  sub->add_option("--part", options->part,
                  wrapped("Draw the K-th of N shares of the frames, for N processes; the one that "
                          "ends last makes the film"))
      ->type_name("K/N");
  sub->add_flag("--join", options->join,
                wrapped("Draw nothing: make the film of frames that are all there"));
  sub->footer(
      "A film that was interrupted is continued by the same command: its frames are kept in\n"
      "FILE.frames until it is complete. Started by mpirun or srun, several processes draw each\n"
      "frame together.\n"
      "Examples:\n"
      "  splotchcl movie flight.toml -o flight.mp4\n"
      "  splotchcl movie flight.toml --explain\n"
      "  splotchcl movie snapshot_006 --set path.orbit.degrees=360 --set movie.frames=250 "
      "-o turn.mp4\n"
      "  splotchcl movie flight.toml -o frame_%04d.exr --frames 0:100 --part 3/8");
}

void add_path(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<PathOptions>();
  CLI::App* const sub =
      add_command<PathOptions>(app, run, "path", "Plot the set-up of a film", options,
                               [&console](const PathOptions& o) { return run_path(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file (.toml) with a [path]"))
      ->required();
  sub->add_option("-o,--output", options->output, wrapped("The picture of it"))
      ->required()
      ->type_name("FILE");
  sub->add_option("--set", options->settings,
                  wrapped("Override a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub->footer(
      "Shows, from two sides, the particles and their densest places, the camera's way with what\n"
      "it looks at, its sky and its view at some frames, and the second eye of a pair.\n"
      "Example:\n"
      "  splotchcl path flight.toml -o path.png");
}

void add_compare(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const sub = add_command<CompareOptions>(
      app, run, "compare", "Tell how far two pictures differ", options,
      [&console](const CompareOptions& o) { return run_compare(o, console); });
  sub->add_option("A", options->image, wrapped("A picture"))->required();
  sub->add_option("B", options->reference, wrapped("The picture it should be, of the same size"))
      ->required();
  sub->add_option("--limit", options->limit,
                  wrapped("Count the pixels where |A - B| > X max(1, |B|) in any channel; 1 is the "
                          "display's white"))
      ->type_name("X");
  sub->add_option(
         "--diff", options->difference,
         wrapped("Write a picture of A - B: grey where they are equal, up to white where A is "
                 "brighter, down to black where it is darker by the largest difference"))
      ->type_name("FILE");
  sub->add_flag("--json", options->json, wrapped("For programs rather than people"));
  sub->footer(
      "Exit code 1 when a pixel lies beyond the limit, 2 for pictures of different sizes.\n"
      "Examples:\n"
      "  splotchcl compare device.exr reference.exr --limit 0.001\n"
      "  splotchcl compare old.png new.png --diff difference.png");
}

void add_devices(CLI::App& app, Run& run) {
  const auto options = std::make_shared<DevicesOptions>();
  CLI::App* const sub =
      add_command<DevicesOptions>(app, run, "devices", "List the OpenCL devices", options,
                                  [](const DevicesOptions& o) { return run_devices(o); });
  sub->add_flag("--json", options->json, wrapped("For programs rather than people"));
  sub->footer("Example:\n  splotchcl devices");
}

void add_generate(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<GenerateOptions>();
  CLI::App* const sub = add_command<GenerateOptions>(
      app, run, "generate", "Make up a snapshot to try things on", options,
      [&console](const GenerateOptions& o) { return run_generate(o, console); });
  sub->add_option("WHAT", options->what,
                  wrapped("universe: cosmic web and haloes in a box of 50000 kpc/h; cluster: a "
                          "cluster of galaxies, with groups and cold streams that fall in; halo: a "
                          "spiral galaxy with satellites in hot gas"))
      ->required()
      ->check(CLI::IsMember({"universe", "cluster", "halo"}));
  sub->add_option("-o,--output", options->output, wrapped("The snapshot, Gadget format 2"))
      ->required()
      ->type_name("FILE");
  sub->add_option("--particles", options->settings.particles, wrapped("Gas and stars together"))
      ->type_name("N")
      ->check(not_negative)
      ->capture_default_str();
  sub->add_option("--stars", options->settings.star_fraction,
                  wrapped("The part of them that are stars"))
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

// For the build, which installs what it writes. Hidden: it has no group in the help.
void add_pages(CLI::App& app, Run& run) {
  const auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* const sub = app.add_subcommand("pages", "Write manual pages and completion of shells");
  sub->group("");
  sub->add_option("FOLDER", *folder, wrapped("Where they are written"))->required();
  sub->callback([&run, &app, folder] {
    run = [&app, folder] { return write_pages(describe_commands(app), *folder); };
  });
}

// For the program itself. Hidden as well.
void add_compiler(CLI::App& app, Run& run) {
  CLI::App* const sub = app.add_subcommand(compiler_command, "Compile for another splotchcl");
  sub->group("");
  sub->callback([&run] { run = run_compiler; });
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CommandWords& command : describe_commands(app).commands)
    names.push_back(command.name);
  return names;
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

// CLI11 would report an unknown command as an unexpected argument.
void check_command(const CLI::App& app, const std::string& word) {
  const auto is_meant = [&word](const CLI::App* sub) { return sub->get_name() == word; };
  if (!app.get_subcommands(is_meant).empty()) return;
  const std::vector<std::string> names = command_names(app);
  std::error_code error;
  if (std::filesystem::exists(word, error)) {
    throw UsageError("'" + word + "' is a file, not a command; did you mean splotchcl render " +
                     word + "?");
  }
  throw UsageError("there is no command '" + word + "' among " + join(names) +
                   did_you_mean(nearest_name(word, names)));
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
  }
  return names;
}

// The first argument that looks like an option and is none. CLI11 may complain about
// something else that is missing just because of it.
std::optional<std::string> unknown_option(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  const auto found = std::find_if(left.begin(), left.end(),
                                  [](const std::string& word) { return word.rfind("-", 0) == 0; });
  if (found == left.end()) return std::nullopt;
  return found->substr(0, found->find('='));
}

// What the parser did not understand, as a line that says what to do.
std::string explain(const CLI::ParseError& error, const CLI::App& app) {
  const auto used = app.get_subcommands();
  const CLI::App& command = used.empty() ? app : *used.front();
  std::string text = error.what();
  if (const std::optional<std::string> option = unknown_option(app)) {
    text = "there is no option " + *option +
           did_you_mean(nearest_name(*option, option_names(command)));
  }
  if (used.empty()) return text + "; see splotchcl --help";
  return command.get_name() + ": " + text + "; see splotchcl " + command.get_name() + " --help";
}

// Taken before the command and after it.
void add_verbosity(CLI::App& app, bool& is_verbose, bool& is_quiet) {
  app.add_flag("-v,--verbose", is_verbose,
               wrapped("Say on standard error what is being done, and when"));
  app.add_flag("-q,--quiet", is_quiet, wrapped("Say nothing but errors: no notes, no progress"));
}

Verbosity chosen_verbosity(bool is_verbose, bool is_quiet) {
  if (is_verbose && is_quiet) {
    throw UsageError("--quiet: found beside --verbose, expected one of the two");
  }
  return is_quiet ? Verbosity::quiet : is_verbose ? Verbosity::verbose : Verbosity::normal;
}

}  // namespace

int run_command_line(int argc, char** argv, Console& console) {
  CLI::App app("Draws particle simulations of the universe, with OpenCL.", "splotchcl");
  Run run;
  app.set_version_flag("--version", &version_text);
  app.require_subcommand(1);
  app.get_formatter()->column_width(name_column);
  add_render(app, run, console);
  add_view(app, run, console);
  add_map(app, run, console);
  add_convert(app, run, console);
  add_movie(app, run, console);
  add_path(app, run, console);
  add_info(app, run, console);
  add_index(app, run, console);
  add_fields(app, run, console);
  add_palettes(app, run, console);
  add_compare(app, run, console);
  add_devices(app, run);
  add_generate(app, run, console);
  add_galaxy(app, run, console);
  add_evolve(app, run, console);
  add_pages(app, run);
  add_compiler(app, run);
  bool is_verbose = false, is_quiet = false;
  add_verbosity(app, is_verbose, is_quiet);
  for (CLI::App* const sub : app.get_subcommands([](const CLI::App*) { return true; }))
    add_verbosity(*sub, is_verbose, is_quiet);
  app.footer(
      "splotchcl COMMAND --help tells more. Off a terminal, what takes long says every 30 s how "
      "far\n"
      "it is.\n"
      "Exit codes: 0 done; 1 the data or the device failed; 2 the call or the scene is wrong.");
  if (argc > 1 && argv[1][0] != '-') check_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw UsageError(explain(error, app));
  }
  console.set_verbosity(chosen_verbosity(is_verbose, is_quiet));
  return run();
}

}  // namespace splotchcl::cli
