// Compositing splats of one size, to be held against the yardstick. A pixel update is a
// pixel inside 1.8 sigma, where the original cuts its Gaussian, whether the model that is
// drawn cuts there or not, and however many pixels are touched to draw it.
#include <cmath>
#include <utility>

#include "stages/stage_rig.h"
#include "stages/timed.h"
#include "synthetic.h"
#include "table.h"
#include "yardstick.h"

namespace splotchcl::bench {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double cut = 1.8;

struct SizeClass {
  double radius_pixels;
  std::size_t count;
};
constexpr SizeClass size_classes[] = {{1.5, 500000}, {5, 250000}, {20, 40000}, {100, 4000}};

struct Variant {
  const char* name;
  LightPlan light;
  bool is_cut;
  bool coarse_grids;
};
constexpr Variant variants[] = {
    {"sums", LightPlan::emission, true, true},
    {"sums_uncut", LightPlan::emission, false, true},
    {"sums_uncut_without_coarse_grids", LightPlan::emission, false, false},
    {"ordered", LightPlan::ordered, true, false},
    {"ordered_uncut", LightPlan::ordered, false, false}};

Frame clouds_of(const SizeClass& size, const Variant& variant) {
  CloudSetup setup;
  setup.count = size.count;
  setup.width = 1400;
  setup.height = 1050;
  setup.sigma_low = size.radius_pixels / cut / 1.5;
  setup.sigma_high = size.radius_pixels / cut * 1.5;
  setup.column_low = 0.005;
  setup.column_high = 0.05;
  Frame frame = cloud_frame(setup.width, setup.height, {make_clouds(setup)});
  if (variant.is_cut) {
    frame.kernel.cut = cut;
    frame.kernel.sampling = Sampling::center;
  }
  set_light(frame, variant.light);
  return frame;
}

// Pixels inside the discs of all clouds, as far as they lie in the picture.
double count_updates(const Frame& frame) {
  const Particles& particles = frame.components.front().particles;
  double updates = 0;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const auto at = [&](std::size_t axis) {
      return static_cast<double>(particles.position[3 * i + axis]);
    };
    const double radius = cut * static_cast<double>(particles.smoothing_length[i]);
    // The part of the disc's square inside the picture stands for the disc's.
    const auto inside = [radius](double center, int size) {
      const double low = std::max(center - radius, -0.5 * size);
      const double high = std::min(center + radius, 0.5 * size);
      return std::max(0.0, high - low) / (2 * radius);
    };
    updates += pi * radius * radius * inside(at(0), frame.width) * inside(at(1), frame.height);
  }
  return updates;
}

void composite(benchmark::State& state, DeviceContext& device, const Frame& frame,
               const PlanOptions& options) {
  StageRig rig(device, frame, options);
  const std::uint32_t splats = rig.prepare_lists();
  rig.clear();
  rig.composite();
  PieceTimer timer(state);
  for (auto _ : state) {
    // Empty planes each time: an opaque picture would be left at once.
    rig.clear();
    rig.finish();
    timer.time([&] {
      rig.composite();
      rig.finish();
    });
    device.timer.clear();
  }
  timer.count_nanoseconds("update", count_updates(frame));
  timer.count_nanoseconds("splat", splats);
  timer.count("entries", static_cast<double>(rig.lists().entry_count));
}

void yardstick(benchmark::State& state, const SizeClass& size, YardstickPlan plan, int threads) {
  YardstickScene scene(static_cast<float>(size.radius_pixels), static_cast<int>(size.count));
  PieceTimer timer(state);
  for (auto _ : state)
    timer.time([&] { scene.draw(plan, threads); });
  timer.count_nanoseconds("update", scene.updates());
  timer.count_nanoseconds("splat", static_cast<double>(size.count));
}

std::string in_pixels(const SizeClass& size) {
  return fixed(size.radius_pixels, size.radius_pixels < 2 ? 1 : 0) + "px";
}

}  // namespace

void add_composite_benchmarks(const Setting& setting) {
  DeviceContext& device = setting.device;
  for (const Variant& variant : variants) {
    for (const SizeClass& size : size_classes) {
      add_benchmark(std::string("composite/") + variant.name + "/" + in_pixels(size),
                    [&device, size, variant](benchmark::State& state) {
                      const Frame frame = clouds_of(size, variant);
                      composite(state, device, frame, {variant.coarse_grids});
                    });
    }
  }
}

void add_yardstick_benchmarks(const Setting& setting) {
  const std::pair<YardstickPlan, const char*> plans[] = {{YardstickPlan::sums, "additive"},
                                                         {YardstickPlan::ordered, "ordered"},
                                                         {YardstickPlan::layers, "layers"}};
  for (const SizeClass& size : size_classes) {
    for (const auto& [plan, name] : plans) {
      add_benchmark(std::string("yardstick/") + name + "/" + in_pixels(size),
                    [size, plan = plan, threads = setting.threads](benchmark::State& state) {
                      yardstick(state, size, plan, threads);
                    });
    }
  }
}

}  // namespace splotchcl::bench
