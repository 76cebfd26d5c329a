// Projection, binning and resolving of a clustered universe, each alone.
#include "stages/stage_rig.h"
#include "stages/timed.h"
#include "synthetic.h"

namespace splotchcl::bench {
namespace {

Frame universe(bool quick, LightPlan light) {
  UniverseSetup setup;
  setup.particles = quick ? 200000 : 2000000;
  Frame frame = quick ? universe_frame(make_universe(setup), 700, 525)
                      : universe_frame(make_universe(setup), 1400, 1050);
  set_light(frame, light);
  return frame;
}

void project(benchmark::State& state, DeviceContext& device, const Frame& frame) {
  StageRig rig(device, frame);
  rig.project();
  rig.finish();
  PieceTimer timer(state);
  for (auto _ : state) {
    timer.time([&] {
      rig.project();
      rig.finish();
    });
    device.timer.clear();
  }
  timer.count("particles", static_cast<double>(rig.particle_count()));
}

void bin(benchmark::State& state, DeviceContext& device, const Frame& frame) {
  StageRig rig(device, frame);
  const std::uint32_t splats = rig.prepare_lists();
  PieceTimer timer(state);
  for (auto _ : state) {
    rig.project_chunk();
    rig.finish();
    timer.time([&] {
      rig.bin();
      rig.finish();
    });
    device.timer.clear();
  }
  timer.count("splats", splats);
  timer.count_nanoseconds("entry", static_cast<double>(rig.lists().entry_count));
}

void resolve(benchmark::State& state, DeviceContext& device, const Frame& frame) {
  StageRig rig(device, frame);
  PieceTimer timer(state);
  for (auto _ : state) {
    rig.clear();
    rig.finish();
    timer.time([&] {
      rig.resolve();
      rig.finish();
    });
    device.timer.clear();
  }
  timer.count("pixels", static_cast<double>(frame.width) * frame.height);
}

}  // namespace

void add_stage_benchmarks(const Setting& setting) {
  using Body = void (*)(benchmark::State&, DeviceContext&, const Frame&);
  const std::pair<const char*, Body> stages[] = {
      {"project", project}, {"bin", bin}, {"resolve", resolve}};
  DeviceContext& device = setting.device;
  for (const LightPlan light : {LightPlan::proportional, LightPlan::ordered}) {
    const auto frame = std::make_shared<Lazy<Frame>>(
        [quick = setting.quick, light] { return universe(quick, light); });
    for (const auto& [name, body] : stages) {
      add_benchmark(std::string(name) + "/universe/" + splotchcl::name(light),
                    [frame, body = body, &device](benchmark::State& state) {
                      body(state, device, frame->get());
                    });
    }
  }
}

}  // namespace splotchcl::bench
