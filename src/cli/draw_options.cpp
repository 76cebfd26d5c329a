#include "cli/draw_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <numeric>
#include <sstream>

#include "cli/commands.h"
#include "cli/json_answer.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "estimate/frame_estimate.h"
#include "film/drawing/tree_choice.h"
#include "pictures/units_of_white.h"
#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/views.h"
#include "tree/merged_drawing.h"

namespace splotchcl::cli {
namespace {

// Which the user must not name in two ways.
void check_units(const DrawOptions& options) {
  const auto names_units = [](const std::string& setting) {
    return setting.rfind("read.units", 0) == 0;
  };
  const auto& settings = options.settings;
  const auto found = std::find_if(settings.begin(), settings.end(), names_units);
  if (options.units.empty() || found == settings.end()) return;
  throw UsageError(
      fmt::format("--units {}: found --set {} beside it, expected one of them; both are --set "
                  "'read.units=[\"{}\", \"mass=Msun\"]'",
                  options.units, *found, options.units));
}

}  // namespace

void refuse_beside_reference(const DrawOptions& options, std::vector<GivenOption> of_device) {
  if (!options.reference) return;
  of_device.push_back({"--device", !options.device.empty()});
  of_device.push_back({"--memory", options.memory_bytes > 0});
  of_device.push_back({"--tree", options.tree == TreeUse::only});
  for (const GivenOption& option : of_device) {
    if (!option.is_given) continue;
    throw UsageError(
        fmt::format("{}: found it beside --reference, which draws without a device, expected one "
                    "of the two",
                    option.name));
  }
}

void refuse_without_output(const std::vector<GivenOption>& of_drawing) {
  for (const GivenOption& option : of_drawing) {
    if (!option.is_given) continue;
    throw UsageError(fmt::format(
        "{}: found it beside --explain without --output, where nothing is drawn, expected --output",
        option.name));
  }
}

std::vector<std::string> settings_of(const DrawOptions& options) {
  std::vector<std::string> settings = common_settings_of(options);
  const auto add = [&settings](const char* key, const std::string& value) {
    if (!value.empty()) settings.push_back(fmt::format("{}={}", key, value));
  };
  add("types", options.types);
  for (const std::string& condition : options.where)
    settings.push_back("where=" + condition);
  add("field", options.field);
  add("palette", options.palette);
  add("center", options.center);
  add("width", options.width);
  return settings;
}

std::vector<std::string> common_settings_of(const DrawOptions& options) {
  std::vector<std::string> settings;
  check_units(options);
  if (!options.units.empty()) settings.push_back(fmt::format("read.units='{}'", options.units));
  settings.insert(settings.end(), options.settings.begin(), options.settings.end());
  if (options.size) settings.push_back("image.size=" + *options.size);
  if (options.look) settings.push_back("look=" + *options.look);
  if (options.tolerance) settings.push_back(fmt::format("tolerance={}", *options.tolerance));
  if (options.every) settings.push_back(fmt::format("read.every={}", *options.every));
  if (options.max_particles) {
    settings.push_back(fmt::format("read.max_particles={}", *options.max_particles));
  }
  if (options.cache_smoothing_lengths) settings.push_back("read.cache_smoothing_lengths=true");
  return settings;
}

namespace {

std::string explain_estimate(const FramePlan& plan, const Frame& frame, const Scene& scene,
                             const DrawOptions& options, int pictures) {
  if (options.reference) return "time: no estimate for the reference renderer\n";
  try {
    const int drawings = pictures * static_cast<int>(views_of(scene, frame).size());
    return explain(estimate_frame(frame, plan, options.device, options.memory_bytes), drawings);
  } catch (const DeviceError&) {
    return "memory and time: no estimate without an OpenCL device\n";
  }
}

// How often errors count under what is done to light.
std::string explain_display(const Scene& scene) {
  if (!scene.finish.exposure || !scene.finish.white)
    return "exposure: found by a first drawing; errors count as often as it lifts them\n";
  const double gain = display_gain(scene.finish, scene.image.gamma).total();
  if (gain == 1) return {};
  return fmt::format("exposure: errors of light count {:.3g} times, as it is shown\n", gain);
}

std::string explain_nodes(const Frame& frame, const DrawOptions& options) {
  if (options.reference || !uses_tree(frame, options.tree)) return {};
  return explain_tree(frame);
}

}  // namespace

void print_explanation(const FramePlan& plan, const Frame& frame, const Scene& scene,
                       const DrawOptions& options, int pictures) {
  std::istringstream lines(explain(plan, frame) + explain_display(scene) +
                           explain_estimate(plan, frame, scene, options, pictures) +
                           explain_nodes(frame, options));
  for (std::string line; std::getline(lines, line);)
    std::cout << "# " << printable(line) << "\n";
  std::cout << "\n" << format_scene(scene);
}

namespace {

Json particles_to_json(const RenderStats& stats) {
  return {
      {"total", stats.particles}, {"bad", stats.bad_particles}, {"drawn", stats.drawn_particles}};
}

Json plan_to_json(const FramePlan& plan) {
  return {{"light", name(plan.light)},
          {"precision", name(plan.precision)},
          {"source", plan.source},
          {"needs_sort", plan.needs_sort()},
          {"truncation_share", plan.shares.truncation},
          {"coarse_share", plan.shares.coarse_grids},
          {"arithmetic_share", plan.shares.arithmetic()}};
}

Json check_to_json(const FrameCheck& check) {
  return {{"is_bound", check.is_bound}, {"errors_of_promise", check.errors_of_promise},
          {"ends", check.worst.ends},   {"even", check.worst.even},
          {"peaks", check.worst.peaks}, {"slabs", check.worst.slabs},
          {"rest", check.worst.rest}};
}

double sum_of(const std::vector<StageTime>& times) {
  return std::accumulate(times.begin(), times.end(), 0.0,
                         [](double sum, const StageTime& time) { return sum + time.seconds; });
}

Json seconds_to_json(const RenderReport& report) {
  return {{"read", report.read_seconds},
          {"draw", report.draw_seconds},
          {"serial", sum_of(report.stats.serial)},
          {"compile", report.stats.build_seconds},
          {"write", report.write_seconds}};
}

Json stages_to_json(const std::vector<StageTime>& times) {
  Json stages = Json::array();
  for (const StageTime& stage : times) {
    stages.push_back({{"stage", stage.stage}, {"seconds", stage.seconds}});
  }
  return stages;
}

// One process has nobody to share with.
Json processes_to_json(const std::vector<ProcessStats>& processes) {
  Json ranks = Json::array();
  for (const ProcessStats& process : processes) {
    ranks.push_back({{"host", process.host},
                     {"particles", process.particles},
                     {"splats", process.splats},
                     {"sent_bytes", process.sent_bytes},
                     {"seconds", process.seconds}});
  }
  return {{"number", std::max<std::size_t>(1, processes.size())}, {"ranks", ranks}};
}

// What a scene may leave to its picture.
Json finish_to_json(const std::optional<FinishSettings>& finish) {
  if (!finish || !finish->exposure || !finish->white) return nullptr;
  return {{"exposure", *finish->exposure}, {"white", *finish->white}};
}

// Nothing where the particles were drawn.
Json tree_to_json(const TreeStats& tree) {
  if (tree.cuts == 0) return nullptr;
  return {{"nodes", tree.nodes},
          {"particles", tree.particles},
          {"visited", tree.visited},
          {"bytes", tree.bytes},
          {"estimate_of_promise", tree.estimate},
          {"cuts", tree.cuts},
          {"verified_blocks", tree.verified_blocks},
          {"found_of_promise", tree.found}};
}

Json to_json(const RenderReport& report) {
  const Frame& frame = report.frame;
  return {{"version", SPLOTCHCL_VERSION},
          {"scene", report.scene},
          {"snapshot", report.snapshot},
          {"output", report.output},
          {"width", frame.width},
          {"height", frame.height},
          {"crop", {frame.crop.x, frame.crop.y, frame.crop.width, frame.crop.height}},
          {"tolerance", frame.tolerance},
          {"plan", plan_to_json(report.plan)},
          {"finish", finish_to_json(report.finish)},
          {"check", check_to_json(report.stats.check)},
          {"tree", tree_to_json(report.tree)},
          {"renderer", report.reference ? "reference" : "device"},
          {"device", report.stats.device},
          {"particles", particles_to_json(report.stats)},
          {"drawn_most_exactly", report.stats.drawn_most_exactly},
          {"tile_entries", report.stats.tile_entries},
          {"blocks_left_out", report.stats.blocks_left_out},
          {"windows", report.stats.windows},
          {"device_bytes", report.stats.device_bytes},
          {"processes", processes_to_json(report.stats.processes)},
          {"seconds", seconds_to_json(report)},
          {"stages", stages_to_json(report.stats.stages)},
          {"serial", stages_to_json(report.stats.serial)}};
}

Json to_json(const FilmFrameStats& frame) {
  return {{"frame", frame.frame},
          {"particles", particles_to_json(frame.stats)},
          {"tile_entries", frame.stats.tile_entries},
          {"blocks_left_out", frame.stats.blocks_left_out},
          {"windows", frame.stats.windows},
          {"device_bytes", frame.stats.device_bytes},
          {"processes", processes_to_json(frame.stats.processes)},
          {"seconds",
           {{"draw", frame.stats.total_seconds},
            {"serial", sum_of(frame.stats.serial)},
            {"compile", frame.stats.build_seconds}}},
          {"stages", stages_to_json(frame.stats.stages)},
          {"serial", stages_to_json(frame.stats.serial)}};
}

Json to_json(const FilmStats& film) {
  Json frames = Json::array();
  double draw_seconds = 0;
  for (const FilmFrameStats& frame : film.frames) {
    frames.push_back(to_json(frame));
    draw_seconds += frame.stats.total_seconds;
  }
  return {{"version", SPLOTCHCL_VERSION},
          {"scene", film.scene},
          {"output", film.output},
          {"width", film.result.width},
          {"height", film.result.height},
          {"renderer", film.reference ? "reference" : "device"},
          {"device", film.frames.empty() ? "" : film.frames.front().stats.device},
          {"frames_of_film", film.result.frames},
          {"seconds", {{"draw", draw_seconds}}},
          {"frames", frames}};
}

void write(const std::filesystem::path& path, const Json& json) {
  const std::string text = json_text(json);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
}

}  // namespace

void write_stats(const std::filesystem::path& path, const RenderReport& report) {
  write(path, to_json(report));
}

void write_stats(const std::filesystem::path& path, const FilmStats& stats) {
  write(path, to_json(stats));
}

}  // namespace splotchcl::cli
