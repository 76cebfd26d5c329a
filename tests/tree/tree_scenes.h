#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "scene/constants.h"
#include "splotchcl/frame.h"
#include "tree/build_tree.h"

// Made-up matter with a tree of it, and frames that show it.
namespace splotchcl::test {

struct Matter {
  std::vector<float> position, h, mass, color;
  std::size_t count() const { return h.size(); }

  void add(double x, double y, double z, double h_of, double mass_of, double color_of) {
    position.insert(position.end(),
                    {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    h.push_back(static_cast<float>(h_of));
    mass.push_back(static_cast<float>(mass_of));
    color.push_back(static_cast<float>(color_of));
  }
};

// Clumps of a temperature each, of particles as wide as they lie apart, in a cube of side 1.
inline Matter clumps(std::size_t count, std::uint64_t seed, double color_spread = 0.3) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  struct Center {
    double x, y, z, size, temperature;
  };
  std::vector<Center> centers;
  for (int c = 0; c < 40; ++c)
    centers.push_back({uniform(random), uniform(random), uniform(random),
                       0.1 * std::pow(0.02, uniform(random)), 2 * normal(random)});
  Matter matter;
  for (std::size_t i = 0; i < count; ++i) {
    const Center& at = centers[static_cast<std::size_t>(uniform(random) * 40)];
    const double away = std::abs(normal(random));
    const double apart =
        at.size * (0.1 + away * away) * 3 / std::cbrt(static_cast<double>(count) / 40);
    matter.add(at.x + at.size * away * normal(random), at.y + at.size * away * normal(random),
               at.z + at.size * away * normal(random), 2 * apart, 1,
               std::exp(at.temperature + color_spread * normal(random)));
  }
  return matter;
}

inline TreeSource source_of(const Matter& matter) {
  TreeSource source;
  source.count = matter.count();
  source.position = Column::owning(matter.position);
  source.smoothing_length = Column::owning(matter.h);
  source.weights = Column::owning(matter.mass);
  source.fields = {{"temperature", Column::owning(matter.color)}};
  return source;
}

inline std::shared_ptr<const TreeOfType> tree_of(const Matter& matter, unsigned least = 4) {
  return std::make_shared<const TreeOfType>(build_tree(source_of(matter), {least, 0}));
}

// The cube from its side, so that most of it is seen, with a footprint of half a pixel.
inline Frame frame_of(const Matter& matter, int width, int height) {
  Camera camera;
  camera.position = {{0.5, -1.6, 0.7}};
  camera.look_at = {{0.5, 0.5, 0.5}};
  camera.field_of_view_degrees = 40;
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.crop = {0, 0, width, height};
  frame.camera = make_camera_frame(camera, width, height);
  frame.kernel.footprint_pixels = 0.5;
  frame.tolerance = 1e-2;
  DrawnComponent component;
  component.name = "gas";
  component.particles.count = matter.count();
  component.particles.position = Column::owning(matter.position);
  component.particles.smoothing_length = Column::owning(matter.h);
  component.particles.weight = Column::owning(matter.mass);
  component.particles.color = Column::owning(matter.color);
  component.color = {Scaling::log, -2, 2};
  component.palette.emission = {Rgb{0.1f, 0.2f, 1}, Rgb{1, 0.5f, 0.2f}, Rgb{1, 1, 1}};
  component.absorption.kind = Absorption::Kind::none;
  // A light of 0.3 over the middle of the picture.
  const double per_length = frame.camera.pixels_per_length;
  component.reference_column =
      static_cast<double>(matter.count()) * per_length * per_length / (0.3 * width * height);
  frame.components = {component};
  return frame;
}

// The same of a tree whose nodes have the mean colors that the frame shows.
inline std::shared_ptr<const TreeOfType> tree_of(const Matter& matter, const Frame& frame,
                                                 unsigned least = 4) {
  TreeSource source = source_of(matter);
  const DrawnComponent& drawn = frame.components.front();
  source.colors = ColorRule{0, -1, drawn.color, drawn.intensity, drawn.palette};
  return std::make_shared<const TreeOfType>(build_tree(source, {least, 0}));
}

inline void plant(Frame& frame, const std::shared_ptr<const TreeOfType>& tree) {
  auto of_component = std::make_shared<TreeOfComponent>();
  of_component->parts = {{tree, 0, 0, -1}};
  frame.components.front().particles.tree = of_component;
}

}  // namespace splotchcl::test
