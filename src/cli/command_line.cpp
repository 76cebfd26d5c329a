#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_builder.h"
#include "cli/commands.h"
#include "cli/pages.h"
#include "cli/processes.h"
#include "cli/scene_options.h"
#include "common/words.h"
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

const std::map<std::string, TreeUse> tree_names = {
    {"auto", TreeUse::automatic}, {"never", TreeUse::never}, {"only", TreeUse::only}};

// From its name to its number.
const CLI::Validator tree_by_name(
    [](std::string& name) {
      const auto use = tree_names.find(CLI::detail::to_lower(name));
      if (use == tree_names.end()) return "found " + name + ", expected auto, never or only";
      name = std::to_string(static_cast<int>(use->second));
      return std::string();
    },
    "");

void add_look(CLI::App& sub, DrawOptions& options) {
  sub.add_option("--look", options.look,
                 wrapped("What a snapshot's picture looks like: press, classic or paper. Default: "
                         "press"))
      ->type_name("NAME");
}

// What render and movie take alike.
void add_draw_options(CLI::App& sub, DrawOptions& options) {
  add_scene_options(sub, options);
  add_number(sub, "--tolerance", options.tolerance, "X",
             "Largest error of a pixel, in units of the display's white; 0: as exact as possible. "
             "Default: the scene's, or 0.001");
  add_look(sub, options);
  sub.add_option(
         "--tree", options.tree,
         wrapped("When to draw from the tree of merged particles that splotchcl tree wrote: "
                 "auto, where it pays, never, or only. Its tolerance is an estimate, checked "
                 "on blocks of every picture. Default: auto"))
      ->transform(tree_by_name)
      ->type_name("WHEN");
  sub.add_flag("--explain", options.explain,
               wrapped("Print the plan, the memory and time it needs, and the complete scene file; "
                       "draw nothing unless --output is given"));
  sub.add_flag(
      "--display", options.display,
      wrapped("Files of floats (.exr, .tif, .hdr) hold what a display shows, with exposure "
              "and tone. Default: scene-linear light as drawn"));
  sub.add_option("--memory", options.memory_bytes,
                 wrapped("Device memory to use, such as 1500MB or 2GiB; what does not fit is drawn "
                         "in several passes. Default: what is available"))
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
                 "snapshot; for a snapshot camera, palettes and ranges are chosen from the data"))
      ->required();
  sub->add_option(
         "-o,--output", options->output,
         wrapped(
             "The picture; its ending chooses the format: .png, .jpg and others hold 8 bits, .exr "
             "and .tif linear floats. Default: the scene's name with .png, in the current folder"))
      ->type_name("FILE");
  add_draw_options(*sub, *options);
  sub->add_option("--crop", options->crop, wrapped("Draw only this part of the picture, in pixels"))
      ->type_name("X,Y,W,H");
  sub->add_flag(
      "--certify", options->certify,
      wrapped(
          "Prove the tolerance by a bound instead of an estimate; takes 5 to 20 times as long"));
  sub->add_option("--shape", options->shape,
                  wrapped("Kernels to draw with: rows (for processors) or groups (for GPUs). "
                          "Default: automatic, by the device's type"))
      ->transform(shape_by_name)
      ->type_name("SHAPE");
  sub->add_option("--error-map", options->error_map,
                  wrapped("Certify, and write the error bound of each pixel as an image; .exr "
                          "holds the numbers"))
      ->type_name("FILE");
  sub->footer(
      "Started by mpirun or srun, several processes draw one picture together.\n"
      "Examples:\n"
      "  splotchcl render snapshot_006 -o universe.png\n"
      "  splotchcl render snapshot_006 --size 1920x1080\n"
      "  splotchcl render snapshot_006 --explain > scene.toml\n"
      "  splotchcl render scene.toml -o light.exr --crop 256,256,128,128\n"
      "  mpirun -n 8 splotchcl render scene.toml -o large.png");
}

void add_publish(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<PublishOptions>();
  CLI::App* const sub = add_command<PublishOptions>(
      app, run, "publish", "Make a page for the web that one looks around in", options,
      [&console](const PublishOptions& o) { return run_publish(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file, or a snapshot, as for render"))
      ->required();
  sub->add_option("-o,--output", options->output,
                  wrapped("The page (.html), or a folder for it; it needs no other file. Or splats "
                          "for other viewers: .ply, .glb (glTF), .usda (OpenUSD)"))
      ->required()
      ->type_name("FILE");
  add_scene_options(*sub, *options);
  add_look(*sub, *options);
  add_number(*sub, "--splats", options->splats, "N",
             "How many splats of light stand for the particles at most, up to 4000000; a million "
             "takes some 15 MB. Default: 400000, for other viewers 100000",
             std::pair(1, 4000000));
  sub->add_option("--title", options->title,
                  wrapped("What the page is called. Default: the scene's title, or its name"))
      ->type_name("TEXT");
  sub->footer(
      "In splats for other viewers light has to add up: what hides matter behind it is refused.\n"
      "Examples:\n"
      "  splotchcl publish snapshot_006 -o universe.html --title \"A small universe\"\n"
      "  splotchcl publish snapshot_006 -o universe.ply");
}

void add_convert(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* const sub = add_command<ConvertOptions>(
      app, run, "convert", "Convert a parameter file of the original Splotch to a scene file",
      options, [&console](const ConvertOptions& o) { return run_convert(o, console); });
  sub->add_option("FILE", options->par, wrapped("A parameter file (.par)"))->required();
  sub->add_option("-o,--output", options->output, wrapped("The scene file (.toml)"))
      ->required()
      ->type_name("FILE");
  sub->add_option("--set", options->settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub->footer(
      "Keys without a counterpart are listed. render and movie also read .par files directly.\n"
      "Example:\n"
      "  splotchcl convert demo.par -o demo.toml");
}

void add_movie(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<MovieOptions>();
  CLI::App* const sub = add_command<MovieOptions>(
      app, run, "movie", "Make a film", options,
      [&console](const MovieOptions& o) { return run_movie(o, console); });
  sub->add_option("SCENE", options->scene,
                  wrapped("A scene file (.toml) with a [path], a snapshot, or a sequence such as "
                          "snapshot_%03d: without a path it is turned about, through all its time"))
      ->required();
  sub->add_option("-o,--output", options->output,
                  wrapped("The film (.mp4 .mov .mkv .webm, encoded by ffmpeg), or numbered images "
                          "such as frame_%04d.png"))
      ->type_name("FILE");
  add_draw_options(*sub, *options);
  sub->add_option("--frames", options->frames,
                  wrapped("Only these frames, counted from 0: FIRST:END:STEP without END; "
                          "100:200:2 is 100, 102, ... 198"))
      ->type_name("RANGE");
  sub->add_option(
         "--part", options->part,
         wrapped(
             "Draw the K-th of N shares of the frames; the process that ends last makes the film"))
      ->type_name("K/N");
  CLI::Option* const dive =
      sub->add_option("--dive", options->dive,
                      wrapped("Go from all that is shown to the densest place, or to the halo of a "
                              "catalog: densest or halo=N"))
          ->type_name("WHERE");
  sub->add_option("--follow", options->follow, wrapped("Orbit around it, wherever it goes"))
      ->excludes(dive)
      ->type_name("WHERE");
  add_number(*sub, "--dome", options->dome, "SIZE",
             "A master for planetariums, of so many pixels, 64 to 8192: 180 degrees, what the "
             "camera looks at in front, at the bottom, 15 degrees above the rim, 30 frames per "
             "second",
             std::pair(64, 8192));
  sub->add_flag(
      "--test-frame", options->test_frame,
      wrapped("Draw, instead of the film, one picture that shows whether a dome shows all "
              "of its fisheye, upright and with what is in front in front"));
  sub->add_option("--timeline", options->timeline,
                  wrapped("Write when each part of each frame was read, drawn and written, as "
                          "JSON that Perfetto shows"))
      ->type_name("FILE");
  sub->add_option("--audio", options->audio, wrapped("Lay this file's sound under the film"))
      ->type_name("FILE");
  sub->add_flag("--join", options->join,
                wrapped("Only make the film from frames that are already drawn"));
  sub->footer(
      "The same command continues an interrupted film: frames are kept in FILE.frames until it is\n"
      "complete. Started by mpirun or srun, several processes draw each frame together.\n"
      "Examples:\n"
      "  splotchcl movie flight.toml -o flight.mp4\n"
      "  splotchcl movie flight.toml --explain\n"
      "  splotchcl movie snapshot_006 -o turn.mp4\n"
      "  splotchcl movie snapshot_%03d --dive densest -o dive.mp4\n"
      "  splotchcl movie flight.toml -o frame_%04d.exr --frames 0:100 --part 3/8");
}

void add_path(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<PathOptions>();
  CLI::App* const sub =
      add_command<PathOptions>(app, run, "path", "Plot the camera path of a film", options,
                               [&console](const PathOptions& o) { return run_path(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file (.toml) with a [path]"))
      ->required();
  sub->add_option("-o,--output", options->output, wrapped("The picture"))
      ->required()
      ->type_name("FILE");
  sub->add_option("--set", options->settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub->footer(
      "Shows from two sides the particles and their densest places, the camera's path, what it\n"
      "looks at, its sky and view at some frames, and the second eye of a stereo pair.\n"
      "Example:\n"
      "  splotchcl path flight.toml -o path.png");
}

void add_compare(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const sub = add_command<CompareOptions>(
      app, run, "compare", "Measure how far two pictures differ", options,
      [&console](const CompareOptions& o) { return run_compare(o, console); });
  sub->add_option("A", options->image, wrapped("A picture"))->required();
  sub->add_option("B", options->reference, wrapped("The picture to compare with, of the same size"))
      ->required();
  add_number(*sub, "--limit", options->limit, "X",
             "Count the pixels with |A - B| > X max(1, |B|) in any channel; 1 is the display's "
             "white");
  sub->add_option("--diff", options->difference,
                  wrapped("Write a picture of A - B: grey if equal, brighter where A is brighter, "
                          "darker where A is darker"))
      ->type_name("FILE");
  sub->add_flag("--json", options->json, wrapped("Print JSON"));
  sub->footer(
      "Exit code 1 if a pixel exceeds the limit, 2 for pictures of different sizes.\n"
      "Examples:\n"
      "  splotchcl compare device.exr reference.exr --limit 0.001\n"
      "  splotchcl compare old.png new.png --diff difference.png");
}

void add_devices(CLI::App& app, Run& run) {
  const auto options = std::make_shared<DevicesOptions>();
  CLI::App* const sub =
      add_command<DevicesOptions>(app, run, "devices", "List the OpenCL devices", options,
                                  [](const DevicesOptions& o) { return run_devices(o); });
  sub->add_flag("--json", options->json, wrapped("Print JSON"));
  sub->footer("Example:\n  splotchcl devices");
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
  const std::string twice = ": At Most 1 required but received ";
  if (const std::size_t place = text.find(twice); place != std::string::npos) {
    text = text.substr(0, place) + ": found it " + text.substr(place + twice.size()) +
           " times, expected it once";
  }
  if (used.empty()) return text + "; see splotchcl --help";
  return command.get_name() + ": " + text + "; see splotchcl " + command.get_name() + " --help";
}

// Taken before the command and after it.
void add_verbosity(CLI::App& app, bool& is_verbose, bool& is_quiet) {
  app.add_flag("-v,--verbose", is_verbose,
               wrapped("Report each step on standard error, with times"));
  app.add_flag("-q,--quiet", is_quiet, wrapped("Print errors only: no notes, no progress"));
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
  add_publish(app, run, console);
  add_map(app, run, console);
  add_convert(app, run, console);
  add_movie(app, run, console);
  add_path(app, run, console);
  add_info(app, run, console);
  add_index(app, run, console);
  add_tree(app, run, console);
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
      "splotchcl COMMAND --help shows a command's options. Exit codes: 0 done; 1 the data or the\n"
      "device failed; 2 the call or the scene is wrong.\n"
      "Examples:\n"
      "  splotchcl info snapshot_006                       what the file holds\n"
      "  splotchcl render snapshot_006 -o picture.png      a first picture\n"
      "  splotchcl view snapshot_006                       find camera and colours in a browser");
  if (argc <= 1) {
    std::cout << app.help();
    return 0;
  }
  if (argv[1][0] != '-') check_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw UsageError(explain(error, app));
  }
  for (const CLI::App* command : app.get_subcommands())
    console.set_options(TypedOptions(*command));
  console.set_verbosity(chosen_verbosity(is_verbose, is_quiet));
  return run();
}

}  // namespace splotchcl::cli
