#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "splotchcl/film.h"
#include "splotchcl/finish.h"
#include "splotchcl/frame.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/plan.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene.h"

namespace splotchcl::cli {

// An option that would do nothing beside others.
struct GivenOption {
  const char* name;
  bool is_given;
};
// Throw UsageError for the first one that is given: those that only a device heeds, of all
// DrawOptions and of one command, and those that need something drawn.
void refuse_beside_reference(const DrawOptions& options, std::vector<GivenOption> of_device);
void refuse_without_output(const std::vector<GivenOption>& of_drawing);

// What --explain prints: the plan, and what it will take to draw, as comments; then the scene. So
// the whole is a scene file. `pictures` are how many frames of a film look like this one.
void print_explanation(const FramePlan& plan, const Frame& frame, const Scene& scene,
                       const DrawOptions& options, int pictures);

// What --stats tells of a picture.
struct RenderReport {
  std::string scene, snapshot, output;
  bool reference = false;  // drawn by the reference instead of a device
  Frame frame;
  FramePlan plan;
  RenderStats stats;
  TreeStats tree;
  std::optional<FinishSettings> finish;  // as DrawnFrame has it
  double read_seconds = 0, draw_seconds = 0, write_seconds = 0;
};

// One frame of a film, of all its views together.
struct FilmFrameStats {
  int frame = 0;
  RenderStats stats;
};

// What --stats tells of a film: of the frames that this run has drawn.
struct FilmStats {
  std::string scene, output;
  bool reference = false;
  FilmResult result;
  std::vector<FilmFrameStats> frames;
};
void write_stats(const std::filesystem::path& path, const FilmStats& stats);

// As JSON; appears only when complete.
void write_stats(const std::filesystem::path& path, const RenderReport& report);

}  // namespace splotchcl::cli
