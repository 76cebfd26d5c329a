#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

// Seeded particles and frames, the same on every machine and with every standard library.
namespace splotchcl::bench {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double logarithmic(double low, double high);
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_() >> 32); }
  Vec3 direction();

 private:
  std::mt19937_64 engine_;
};

enum class FileOrder {
  haloes,    // neighbours lie near each other, as a simulation writes them
  shuffled,  // any order
};

// A box of side 1: half of the particles in haloes of all sizes, half between them. h
// holds about 64 neighbours, as in a snapshot, so most splats are small.
struct UniverseSetup {
  std::size_t particles = 1000000;
  FileOrder order = FileOrder::haloes;
  std::uint64_t seed = 1;
};
Particles make_universe(const UniverseSetup& setup);

// The box from outside, filling the picture at 30 degrees.
Frame universe_frame(const Particles& particles, int width, int height,
                     double field_of_view_degrees = 30);

// Clouds spread evenly over the picture and a little beyond.
struct CloudSetup {
  std::size_t count = 100000;
  int width = 800, height = 600;
  double sigma_low = 1, sigma_high = 2;  // pixels, evenly in the logarithm
  double column_low = 0.01, column_high = 0.01;
  double depth_low = 1, depth_high = 100;
  std::uint64_t seed = 1;
};
DrawnComponent make_clouds(const CloudSetup& setup);

// A frame whose pixels are the clouds' length unit.
Frame cloud_frame(int width, int height, std::vector<DrawnComponent> components);

// The same particles in another light. Where order matters, components after the first only
// emit.
void set_light(Frame& frame, LightPlan light);

Palette three_colors();  // blue, green, red
Palette warm_white();    // one colour

}  // namespace splotchcl::bench
