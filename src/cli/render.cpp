#include <fmt/format.h>

#include <charconv>
#include <future>
#include <map>

#include "cli/commands.h"
#include "cli/draw_options.h"
#include "cli/processes.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "open_scene/input_files.h"
#include "ranks/exchange.h"
#include "splotchcl/error.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/plan.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::cli {
namespace {

// X,Y,W,H
Rectangle parse_crop(const std::string& text) {
  int numbers[4];
  const char* next = text.data();
  const char* const end = next + text.size();
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    if (i > 0) good = next != end && *next++ == ',';
    const auto [after, error] = std::from_chars(next, end, numbers[i]);
    good = good && error == std::errc();
    next = after;
  }
  if (!good || next != end) {
    throw UsageError("--crop: found '" + text +
                     "', expected X,Y,W,H, four whole numbers of pixels such as 0,0,256,256");
  }
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

Rectangle choose_crop(const std::string& text, int width, int height) {
  if (text.empty()) return {0, 0, width, height};
  const Rectangle crop = parse_crop(text);
  const bool inside = crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0 &&
                      crop.width <= width - crop.x && crop.height <= height - crop.y;
  if (!inside) {
    throw UsageError(fmt::format("--crop: {} does not lie inside the picture of {}x{} pixels", text,
                                 width, height));
  }
  return crop;
}

// The scene's name; a folder's too, however its path is written.
std::string name_of(const std::filesystem::path& scene) {
  std::filesystem::path name = scene.filename();
  if (name.empty() || name == "." || name == "..") {
    std::error_code ignored;
    name = (std::filesystem::canonical(scene, ignored) / "").parent_path().filename();
  }
  return name.empty() ? "picture" : name.stem().string();
}

// --explain without --output only explains.
std::optional<std::filesystem::path> choose_output(const RenderOptions& options) {
  if (options.output) return options.output;
  if (options.explain) return std::nullopt;
  return name_of(options.scene) + ".png";
}

LoadProgress show_progress(Console& console) {
  return [&console](const std::string& what, double fraction) { console.progress(what, fraction); };
}

// A device that does not open ends the reading, which may take minutes.
Frame read_frame(const SceneWithSnapshot& source, const RenderOptions& options,
                 const std::optional<FrameDrawer>& drawer, Console& console) {
  const LoadProgress show = show_progress(console);
  const LoadProgress progress = [&](const std::string& what, double fraction) {
    if (drawer) drawer->check_device();
    show(what, fraction);
  };
  console.status("reading " + source.snapshot->info().files.front().filename().string());
  std::vector<std::string> notes = source.snapshot->info().notes;
  Frame frame = load_frame(source.scene, *source.snapshot, notes, progress);
  console.note_each_once(notes);
  frame.crop = choose_crop(options.crop, frame.width, frame.height);
  return frame;
}

// The pictures' files by suffix, and whether each could be written.
std::vector<OutputFile> check_pictures(const std::filesystem::path& output, const Scene& scene,
                                       int view_width, int view_height) {
  std::vector<OutputFile> files;
  for (const PictureSize& size : picture_sizes(scene, view_width, view_height)) {
    const std::filesystem::path path = picture_path(output, size.suffix);
    check_image_path(path);
    check_image_size(path, size.width, size.height);
    check_image_bits(path, scene.image.bits);
    files.push_back({path, "--output"});
  }
  return files;
}

// Why a first run takes so much longer than the next.
std::string compilation(const RenderStats& stats) {
  constexpr double worth_telling_seconds = 1;  // kernels that are found compiled take a tenth
  if (stats.build_seconds < worth_telling_seconds) return "";
  return fmt::format(", of it {:.1f} s to compile kernels, this once", stats.build_seconds);
}

std::map<std::string, std::string> metadata(const Scene& scene, const RenderOptions& options,
                                            const RenderStats& stats) {
  std::map<std::string, std::string> texts = {{"splotchcl:scene", format_scene(scene)},
                                              {"splotchcl:device", stats.device}};
  if (!options.crop.empty()) texts["splotchcl:crop"] = options.crop;
  return texts;
}

// The bound of each pixel's error over max(1, its light).
Image make_error_map(const FrameCheck& check, const Rectangle& crop) {
  if (check.blocks.columns != BlockErrors::blocks_along(crop.width)) {
    throw UsageError(
        "--error-map: the scene has several views (eyes, faces, an inset), expected one");
  }
  Image map(crop.width, crop.height);
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      float* const pixel = map.at(x, y);
      std::fill_n(pixel, 3, check.blocks.at(x, y));
      pixel[3] = 1;
    }
  }
  return map;
}

// Everything up to the frame. Only one process looks at what is to be written.
SceneWithSnapshot open_checked(const RenderOptions& options,
                               const std::optional<std::filesystem::path>& output,
                               const std::shared_ptr<Communicator>& ranks, Console& console) {
  const bool writes = writes_files(ranks);
  if (writes && output) check_image_path(*output);
  if (writes && options.stats) check_output_path(*options.stats);
  if (options.error_map) {
    if (options.reference) throw UsageError("--error-map: the reference has no errors to be drawn");
    if (writes) check_image_path(*options.error_map);
  }
  const Rectangle wanted = options.crop.empty() ? Rectangle() : parse_crop(options.crop);
  SceneWithSnapshot source = open_scene(options.scene, settings_of(options), ranks);
  console.note_each_once(source.notes);
  if (!writes) return source;
  const ImageSettings& picture = source.scene.image;
  std::vector<OutputFile> outputs;
  if (output) {
    const bool cropped = wanted.width > 0;
    outputs = check_pictures(*output, source.scene, cropped ? wanted.width : picture.width,
                             cropped ? wanted.height : picture.height);
  }
  if (options.stats) outputs.push_back({*options.stats, "--stats"});
  if (options.error_map) outputs.push_back({*options.error_map, "--error-map"});
  check_outputs(outputs, [&] { return files_read(options.scene, source.scene, *source.snapshot); });
  return source;
}

FrameDrawerOptions drawer_options(const RenderOptions& options,
                                  const std::shared_ptr<Communicator>& ranks, Console& console) {
  FrameDrawerOptions of_drawer{options.device,         options.reference,
                               show_progress(console), options.certify || options.error_map,
                               options.shape,          false,
                               options.memory_bytes};
  of_drawer.ranks = ranks;
  of_drawer.tree = options.tree;
  of_drawer.opens_later = !ranks;
  of_drawer.start_compiler = compiler_processes(ranks);
  const std::optional<std::filesystem::path> output = choose_output(options);
  if (output && !options.display) of_drawer.light = light_of_file(*output);
  return of_drawer;
}

// The pictures, and what was asked for beside them.
void write_all(const RenderOptions& options, const std::filesystem::path& output,
               const SceneWithSnapshot& source, const DrawnFrame& drawn, RenderReport& report,
               Console& console) {
  std::optional<Image> map;
  if (options.error_map) map = make_error_map(report.stats.check, report.frame.crop);
  const Stopwatch writing;
  console.status("writing " + output.string());
  Scene drawn_scene = source.scene;
  if (drawn.finish) drawn_scene.finish = *drawn.finish;
  write_pictures(output, drawn.pictures,
                 image_file_options(drawn_scene, metadata(drawn_scene, options, drawn.stats)));
  if (map) write_image(*options.error_map, *map, image_file_options(source.scene, {}));
  report.write_seconds = writing.seconds();
  if (!options.stats) return;
  report.scene = options.scene.string();
  report.output = output.string();
  report.reference = options.reference;
  write_stats(*options.stats, report);
}

std::string by_processes(const RenderStats& stats) {
  return stats.processes.empty() ? "" : fmt::format(" by {} processes", stats.processes.size());
}

}  // namespace

int run_render(const RenderOptions& options, Console& console) {
  refuse_beside_reference(options, {{"--certify", options.certify},
                                    {"--shape", options.shape != CompositeShape::automatic}});
  const std::shared_ptr<Communicator> ranks = join_processes(console);
  const bool writes = writes_files(ranks);
  // Whatever would fail at the end is tried first.
  const std::optional<std::filesystem::path> output = choose_output(options);
  if (!output) refuse_without_output({{"--stats", options.stats.has_value()}});
  std::optional<SceneWithSnapshot> opened;
  std::optional<FrameDrawer> drawer;
  RenderReport report;
  // One process opens the device while it reads; the console's thread is made before.
  if (output && !options.reference) console.status("starting the device");
  if (output && !ranks) drawer.emplace(drawer_options(options, ranks, console));
  agree(ranks.get(), [&] {
    if (options.reference) expect_one_process(ranks.get(), "--reference");
    opened.emplace(open_checked(options, output, ranks, console));
  });
  const SceneWithSnapshot& source = *opened;
  const WatchedFiles inputs = watched_files(source.scene, *source.snapshot);
  if (ranks) {
    ContentMarks marks;
    require_same_files(*ranks, files_read(options.scene, source.scene, *source.snapshot), marks);
  }
  if (output && ranks) drawer.emplace(drawer_options(options, ranks, console));
  agree(ranks.get(), [&] {
    const Stopwatch reading;
    report.frame = read_frame(source, options, drawer, console);
    report.read_seconds = reading.seconds();
    if (options.explain || options.stats) {
      PlanOptions plan;
      plan.certify = options.certify || options.error_map;
      report.plan = make_plan(report.frame, plan);
    }
    if (options.explain && writes) {
      DrawOptions explained = options;
      if (options.certify) explained.tree = TreeUse::never;
      print_explanation(report.plan, report.frame, source.scene, explained, 1);
    }
  });
  if (!output) return 0;

  const Stopwatch drawing;
  console.status(fmt::format("drawing {} particles", particle_count(report.frame)));
  const DrawnFrame drawn = inputs.unchanged_during(
      [&] { return drawer->draw(source.scene, report.frame, source.snapshot->info()); });
  agree(ranks.get(), [&] { inputs.check_in_place(); });
  report.stats = drawn.stats;
  report.tree = drawn.tree;
  report.finish = drawn.finish;
  console.note_each_once(drawn.all_notes());
  report.draw_seconds = drawing.seconds();
  report.snapshot = source.snapshot->info().files.front().string();
  // To give so much memory back, the device's and that of files, takes as long as to write a
  // picture. Not of several processes: MPI may allow calls by one thread only.
  std::future<void> given_back;
  if (!ranks) {
    // Never, where there is no thread to be had: the end of the program does it then.
    given_back = std::async(std::launch::async | std::launch::deferred, [&] {
      drawer.reset();
      report.frame.components.clear();
      opened->snapshot.reset();
    });
  }
  agree(ranks.get(), [&] {
    if (writes) write_all(options, *output, source, drawn, report, console);
  });
  const Picture& picture = drawn.pictures.front();
  const Image& image = picture.image.pixels.empty() ? picture.light : picture.image;
  console.done(fmt::format(
      "{}: {}x{} pixels, {} particles, read {:.2f} s, drawn {:.2f} s on {}{}{}", output->string(),
      image.width, image.height, report.stats.particles, report.read_seconds, report.draw_seconds,
      report.stats.device, by_processes(report.stats), compilation(report.stats)));
  return 0;
}

}  // namespace splotchcl::cli
