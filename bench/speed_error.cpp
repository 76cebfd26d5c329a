// What a frame costs against how far it lies from the reference, at every tolerance. The error
// is that of the very picture that was timed, over all of its pixels.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "frame_error.h"
#include "machine.h"
#include "measure.h"
#include "splotchcl/plan.h"
#include "splotchcl/reference.h"
#include "synthetic.h"
#include "table.h"
#include "yardstick.h"

namespace splotchcl::bench {
namespace {

// What tolerance 0 keeps (docs/accuracy.md).
constexpr double bound_at_zero = 1e-6;
const std::vector<double> tolerances = {1e-2, 1e-3, 1e-4, 1e-5, 0};

double promise(double tolerance) {
  return tolerance > 0 ? tolerance : bound_at_zero;
}

struct Size {
  int width = 800, height = 600;
  double particles = 1;  // factor on the numbers below
};

struct Matter {
  std::string name;
  std::size_t count;
  double sigma_low, sigma_high;    // pixels
  double column_low, column_high;  // optical depth or light through a cloud's centre
};

const Matter small_stars = {"sparse stars", 20000, 0.2, 1.2, 0.05, 3};
const Matter large_stars = {"sparse stars", 500, 3, 10, 0.05, 3};
const Matter small_thin_gas = {"thin gas", 200000, 0.5, 2, 0.003, 0.03};
const Matter large_thin_gas = {"thin gas", 5000, 5, 30, 0.001, 0.02};
const Matter small_thick_gas = {"thick gas", 200000, 0.5, 2, 0.3, 10};
const Matter large_thick_gas = {"thick gas", 5000, 5, 30, 0.1, 3};

struct SceneToTime {
  std::string name, splats;
  Frame frame;
};

DrawnComponent make_component(const Matter& matter, const Size& size, Palette palette) {
  CloudSetup setup;
  setup.count = static_cast<std::size_t>(static_cast<double>(matter.count) * size.particles);
  setup.width = size.width;
  setup.height = size.height;
  setup.sigma_low = matter.sigma_low;
  setup.sigma_high = matter.sigma_high;
  setup.column_low = matter.column_low;
  setup.column_high = matter.column_high;
  DrawnComponent component = make_clouds(setup);
  component.name = matter.name;
  component.palette = std::move(palette);
  return component;
}

SceneToTime single(const Matter& matter, const std::string& splats, const Size& size) {
  return {matter.name, splats,
          cloud_frame(size.width, size.height, {make_component(matter, size, three_colors())})};
}

SceneToTime mixed(const Matter& gas, const Matter& stars, const std::string& splats,
                  const Size& size) {
  return {"gas and stars", splats,
          cloud_frame(size.width, size.height,
                      {make_component(gas, size, three_colors()),
                       make_component(stars, size, warm_white())})};
}

std::vector<SceneToTime> make_scenes(const Size& size) {
  UniverseSetup universe;
  universe.particles = static_cast<std::size_t>(50000 * size.particles);
  return {single(small_stars, "small", size),
          single(large_stars, "large", size),
          single(small_thin_gas, "small", size),
          single(large_thin_gas, "large", size),
          single(small_thick_gas, "small", size),
          single(large_thick_gas, "large", size),
          mixed(small_thin_gas, small_stars, "small", size),
          mixed(large_thick_gas, large_stars, "large", size),
          {"universe", "all", universe_frame(make_universe(universe), size.width, size.height)}};
}

// The largest channel of the median pixel, drawn without absorption.
double median_light(Frame frame, Renderer& renderer) {
  set_light(frame, LightPlan::emission);
  frame.tolerance = 1e-2;
  const Image image = renderer.render(frame);
  std::vector<float> light;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4)
    light.push_back(*std::max_element(&image.pixels[i], &image.pixels[i] + 3));
  const auto middle = light.begin() + static_cast<std::ptrdiff_t>(light.size() / 2);
  std::nth_element(light.begin(), middle, light.end());
  return *middle;
}

// The scene as bright as pictures are: its median pixel has a fifth of white.
SceneToTime brightened(SceneToTime scene, Renderer& renderer) {
  const double factor = 0.2 / median_light(scene.frame, renderer);
  for (DrawnComponent& component : scene.frame.components)
    component.brightness *= factor;
  scene.name = "bright " + scene.name;
  return scene;
}

std::string text_of_tolerance(double tolerance) {
  return tolerance > 0 ? "1e" + fixed(std::log10(tolerance), 0) : "0";
}

// One row per frame to read, one per point to plot.
class SpeedAndError {
 public:
  SpeedAndError(const std::string& device, int runs, std::string filter)
      : renderer_(RendererOptions{device, CompositeShape::automatic}),
        runs_(runs),
        filter_(std::move(filter)),
        summary_(summary_columns()) {}

  void add_scene(const SceneToTime& scene, LightPlan light) {
    const std::string title = scene.name + ", " + scene.splats + " splats, " + name(light);
    if (title.find(filter_) == std::string::npos) return;
    std::fprintf(stderr, "%s\n", title.c_str());
    Frame frame = scene.frame;
    set_light(frame, light);
    const Stopwatch stopwatch;
    const ReferenceImage reference_image = reference::render(frame);
    const Cost reference_cost = stopwatch.elapsed();
    std::vector<std::string> cells = {scene.name, scene.splats, name(light),
                                      std::to_string(particle_count(frame))};
    for (const double tolerance : tolerances) {
      frame.tolerance = tolerance;
      Image image;
      const Runs runs = measure(runs_, [&] { image = renderer_.render(frame); });
      const FrameError error = measure_error(image, frame.crop, reference_image, frame.crop);
      cells.push_back(milliseconds(runs.median().wall_seconds) + "  " + scientific(error.maximum) +
                      "  " + scientific(error.rms()));
      add_point(scene, light, frame, runs, error, reference_cost);
    }
    cells.push_back(milliseconds(reference_cost.wall_seconds));
    summary_.add(cells);
  }

  Renderer& renderer() { return renderer_; }
  const Table& points() const { return points_; }
  const Table& summary() const { return summary_; }
  int point_count() const { return point_count_; }
  int points_beyond() const { return points_beyond_; }

 private:
  static std::vector<std::string> summary_columns() {
    std::vector<std::string> columns = {"scene", "splats", "plan", "particles"};
    for (const double tolerance : tolerances)
      columns.push_back("ms, max, rms at " + text_of_tolerance(tolerance));
    columns.push_back("reference ms");
    return columns;
  }

  void add_point(const SceneToTime& scene, LightPlan light, const Frame& frame, const Runs& runs,
                 const FrameError& error, const Cost& reference_cost) {
    const bool kept = error.maximum <= promise(frame.tolerance);
    ++point_count_;
    points_beyond_ += kept ? 0 : 1;
    const auto count = static_cast<std::size_t>(particle_count(frame));
    const double rate = static_cast<double>(count) / runs.median().wall_seconds;
    points_.add(
        {scene.name, scene.splats, name(light), text_of_tolerance(frame.tolerance),
         scientific(promise(frame.tolerance)), std::to_string(count), std::to_string(frame.width),
         std::to_string(frame.height), milliseconds(runs.median().wall_seconds),
         milliseconds(runs.minimum().wall_seconds), milliseconds(runs.median().cpu_seconds),
         fixed(rate, 0), scientific(error.maximum), scientific(error.rms()),
         scientific(error.brightest), kept ? "yes" : "no",
         milliseconds(reference_cost.wall_seconds), milliseconds(reference_cost.cpu_seconds)});
  }

  Renderer renderer_;
  int runs_;
  std::string filter_;  // of the scenes' titles
  int point_count_ = 0, points_beyond_ = 0;
  Table summary_;
  Table points_{{"scene", "splats", "plan", "tolerance", "promise", "particles", "width", "height",
                 "median_ms", "minimum_ms", "cpu_ms", "particles_per_s", "max_error", "rms_error",
                 "brightest", "kept", "reference_ms", "reference_cpu_ms"}};
};

void run(const Arguments& arguments) {
  const std::string device = arguments.text("device", "");
  const Machine machine = describe_machine(device);
  std::printf("%s\n", describe(machine).c_str());

  Size size;
  if (arguments.has("quick")) size = {320, 240, 0.1};
  const int runs = arguments.number("runs", 5);
  SpeedAndError results(device, runs, arguments.text("filter", ""));
  std::vector<SceneToTime> scenes = make_scenes(size);
  for (const SceneToTime& dark : {scenes[2], scenes[3], scenes.back()})
    scenes.push_back(brightened(dark, results.renderer()));
  for (const SceneToTime& scene : scenes) {
    for (const LightPlan light :
         {LightPlan::emission, LightPlan::proportional, LightPlan::ordered}) {
      results.add_scene(scene, light);
    }
  }
  const Yardstick yardstick = measure_yardstick(machine.threads());
  std::printf("\n%dx%d pixels, medians of %d runs\n\n%s\n%s\n", size.width, size.height, runs,
              results.summary().text().c_str(), describe(yardstick).c_str());
  std::printf("%d of %d points lie beyond their promise (tolerance 0 promises %g)\n",
              results.points_beyond(), results.point_count(), bound_at_zero);
  if (arguments.has("csv")) results.points().write_csv(arguments.text("csv", ""));
}

}  // namespace
}  // namespace splotchcl::bench

int main(int count, char** words) {
  return splotchcl::bench::run_main(
      count, words,
      {"quick: small pictures with a tenth of the particles",
       "runs=COUNT: how often each frame is timed (5)",
       "filter=TEXT: only scenes with this in their title, as in 'universe, all splats, ordered'",
       "device=NAME: part of a device's name",
       "csv=FILE: where the table goes, for scripts/plot_bench"},
      splotchcl::bench::run);
}
