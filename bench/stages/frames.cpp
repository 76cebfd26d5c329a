// Whole frames of a clustered universe as a user draws them, and the reference's for the
// smallest of them.
#include "splotchcl/reference.h"
#include "splotchcl/renderer.h"
#include "stages/timed.h"
#include "synthetic.h"

namespace splotchcl::bench {
namespace {

Frame universe(const Particles& particles, int width, int height, LightPlan light) {
  Frame frame = universe_frame(particles, width, height);
  set_light(frame, light);
  return frame;
}

void draw(benchmark::State& state, const std::string& device, const Frame& frame) {
  Renderer renderer(RendererOptions{device, CompositeShape::automatic});
  renderer.render(frame);
  PieceTimer timer(state);
  for (auto _ : state)
    timer.time([&] { renderer.render(frame); });
  const RenderStats& stats = renderer.stats();
  timer.count("particles", static_cast<double>(stats.particles));
  state.counters["drawn"] = static_cast<double>(stats.drawn_particles);
  state.counters["entries"] = static_cast<double>(stats.tile_entries);
  state.counters["bytes/particle"] =
      static_cast<double>(stats.device_bytes) / static_cast<double>(stats.particles);
}

void draw_reference(benchmark::State& state, const Frame& frame) {
  PieceTimer timer(state);
  for (auto _ : state)
    timer.time([&] { reference::render(frame); });
  timer.count("particles", static_cast<double>(frame.components.front().particles.count));
}

}  // namespace

void add_frame_benchmarks(const Setting& setting) {
  struct Size {
    const char* name;
    std::size_t particles;
    int width, height;
  };
  constexpr Size smallest = {"2k_160x120", 2000, 160, 120};
  std::vector<Size> sizes = {smallest, {"200k_700x525", 200000, 700, 525}};
  if (!setting.quick) sizes.push_back({"2M_1400x1050", 2000000, 1400, 1050});
  if (setting.large) sizes.push_back({"16M_1400x1050", 16000000, 1400, 1050});
  for (const Size& size : sizes) {
    const auto particles = std::make_shared<Lazy<Particles>>([size] {
      UniverseSetup setup;
      setup.particles = size.particles;
      return make_universe(setup);
    });
    for (const LightPlan light :
         {LightPlan::emission, LightPlan::proportional, LightPlan::ordered}) {
      const std::string name = std::string("/") + splotchcl::name(light) + "/" + size.name;
      const auto frame = [particles, size, light] {
        return universe(particles->get(), size.width, size.height, light);
      };
      add_benchmark("frame" + name, [frame, device = setting.device_name](benchmark::State& state) {
        draw(state, device, frame());
      });
      if (size.particles > smallest.particles) continue;
      add_benchmark("frame_reference" + name,
                    [frame](benchmark::State& state) { draw_reference(state, frame()); });
    }
  }
}

}  // namespace splotchcl::bench
