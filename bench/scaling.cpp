// How the time of a frame grows with one thing at a time: particles, pixels, field of view,
// the size of splats, the order of the particles in the file. The number of threads is the
// device's: run it again with another (scripts/bench does).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "arguments.h"
#include "machine.h"
#include "measure.h"
#include "synthetic.h"
#include "table.h"
#include "yardstick.h"

namespace splotchcl::bench {
namespace {

constexpr double pi = 3.14159265358979323846;

// How far the sweeps go.
struct Extent {
  std::size_t particles = 1000000;  // where something else varies
  std::vector<std::size_t> particle_counts = {10000, 100000, 1000000, 4000000};
  std::vector<double> megapixels = {0.1, 0.4, 1.5, 6, 16};
  std::vector<double> fields_of_view = {60, 30, 15, 8, 4, 2, 1};
  std::vector<double> sigmas = {0.1, 0.3, 1, 3, 10, 30, 100, 300};
};

Extent quick_extent() {
  Extent extent;
  extent.particles = 50000;
  extent.particle_counts = {10000, 30000, 100000};
  extent.megapixels = {0.1, 0.4, 1.5};
  extent.fields_of_view = {60, 15, 4, 1};
  extent.sigmas = {0.1, 1, 10, 100};
  return extent;
}

Extent large_extent() {
  Extent extent;
  extent.particles = 4000000;
  extent.particle_counts.insert(extent.particle_counts.end(), {16000000, 64000000});
  extent.megapixels.push_back(64);
  return extent;
}

// Pictures of 4:3.
void size_of(double megapixels, int& width, int& height) {
  height = static_cast<int>(std::lround(std::sqrt(1e6 * megapixels * 3 / 4)));
  width = static_cast<int>(std::lround(4.0 / 3.0 * height));
}

class Scaling {
 public:
  Scaling(const std::string& device, int threads, int runs)
      : renderer_(RendererOptions{device, CompositeShape::automatic}),
        threads_(threads),
        runs_(runs) {}

  // Times the frame in both a plan of sums and an ordered one.
  void add(const std::string& sweep, const std::string& value, Frame frame) {
    for (const LightPlan light : {LightPlan::proportional, LightPlan::ordered}) {
      std::fprintf(stderr, "%s %s, %s\n", sweep.c_str(), value.c_str(), name(light));
      set_light(frame, light);
      const Runs runs = measure(runs_, [&] { renderer_.render(frame); });
      const RenderStats& stats = renderer_.stats();
      const auto particles = static_cast<double>(std::max<std::uint64_t>(1, stats.particles));
      table_.add({sweep, name(light), value, std::to_string(threads_),
                  std::to_string(stats.particles), std::to_string(stats.drawn_particles),
                  std::to_string(stats.tile_entries), std::to_string(frame.width),
                  std::to_string(frame.height), milliseconds(runs.median().wall_seconds),
                  milliseconds(runs.minimum().wall_seconds),
                  milliseconds(runs.median().cpu_seconds),
                  fixed(1e9 * runs.median().wall_seconds / particles, 1)});
    }
  }

  const Table& table() const { return table_; }

 private:
  Renderer renderer_;
  int threads_, runs_;
  Table table_{{"sweep", "plan", "value", "threads", "particles", "drawn", "entries", "width",
                "height", "median_ms", "minimum_ms", "cpu_ms", "ns_per_particle"}};
};

Particles universe_of(std::size_t count, FileOrder order = FileOrder::haloes) {
  UniverseSetup setup;
  setup.particles = count;
  setup.order = order;
  return make_universe(setup);
}

void sweep_particles(const Extent& extent, Scaling& scaling) {
  for (const std::size_t count : extent.particle_counts) {
    scaling.add("particles", std::to_string(count), universe_frame(universe_of(count), 1400, 1050));
  }
}

void sweep_pixels(const Extent& extent, Scaling& scaling) {
  const Particles particles = universe_of(extent.particles);
  for (const double megapixels : extent.megapixels) {
    int width = 0, height = 0;
    size_of(megapixels, width, height);
    scaling.add("megapixels", fixed(megapixels, 1), universe_frame(particles, width, height));
  }
}

void sweep_field_of_view(const Extent& extent, Scaling& scaling) {
  const Particles particles = universe_of(extent.particles);
  for (const double degrees : extent.fields_of_view) {
    scaling.add("field_of_view", fixed(degrees, 0), universe_frame(particles, 1400, 1050, degrees));
  }
}

// Fewer splats where they are wider, so that each point takes about as long: the time per
// particle is what counts.
void sweep_splat_size(const Extent& extent, Scaling& scaling) {
  constexpr double pixel_updates = 1e9;
  for (const double sigma : extent.sigmas) {
    CloudSetup setup;
    setup.width = 1400;
    setup.height = 1050;
    const double disc = pi * std::pow(1.8 * sigma, 2);
    setup.count = static_cast<std::size_t>(std::clamp(pixel_updates / disc, 1000.0, 200000.0));
    setup.sigma_low = sigma / 1.5;
    setup.sigma_high = sigma * 1.5;
    // Optical depth about 1 over the picture, however wide the splats.
    const double covered = static_cast<double>(setup.count) * pi * sigma * sigma / (1400.0 * 1050);
    setup.column_low = setup.column_high = std::min(1.0, 1 / covered);
    scaling.add("sigma", fixed(sigma, 1), cloud_frame(1400, 1050, {make_clouds(setup)}));
  }
}

void sweep_order(const Extent& extent, Scaling& scaling) {
  scaling.add("order", "haloes", universe_frame(universe_of(extent.particles), 1400, 1050));
  scaling.add("order", "shuffled",
              universe_frame(universe_of(extent.particles, FileOrder::shuffled), 1400, 1050));
}

void run(const Arguments& arguments) {
  const std::string device = arguments.text("device", "");
  const Machine machine = describe_machine(device);
  std::printf("%s\n", describe(machine).c_str());
  const Extent extent = arguments.has("quick")   ? quick_extent()
                        : arguments.has("large") ? large_extent()
                                                 : Extent();
  Scaling scaling(device, machine.threads(), arguments.number("runs", 3));
  const std::string wanted = arguments.text("sweep", "");
  const std::pair<const char*, void (*)(const Extent&, Scaling&)> sweeps[] = {
      {"particles", sweep_particles},
      {"pixels", sweep_pixels},
      {"field_of_view", sweep_field_of_view},
      {"sigma", sweep_splat_size},
      {"order", sweep_order}};
  for (const auto& [sweep, add_points] : sweeps) {
    if (wanted.empty() || wanted == sweep) add_points(extent, scaling);
  }
  std::printf("\n%s\n%s\n", scaling.table().text().c_str(),
              describe(measure_yardstick(machine.threads())).c_str());
  if (arguments.has("csv")) scaling.table().write_csv(arguments.text("csv", ""));
}

}  // namespace
}  // namespace splotchcl::bench

int main(int count, char** words) {
  return splotchcl::bench::run_main(
      count, words,
      {"quick: few particles", "large: up to 64 M particles and 64 M pixels",
       "sweep=NAME: only particles, pixels, field_of_view, sigma or order",
       "runs=COUNT: how often each frame is timed (3)", "device=NAME: part of a device's name",
       "csv=FILE: where the table goes, for scripts/plot_bench"},
      splotchcl::bench::run);
}
