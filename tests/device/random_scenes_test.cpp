// Random small scenes over all settings keep their tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

class SceneMaker {
 public:
  explicit SceneMaker(std::uint64_t seed) : random_(seed) {}

  Frame make() {
    Frame frame;
    frame.width = integer(1, 70);
    frame.height = integer(1, 60);
    frame.crop = random_crop(frame.width, frame.height);
    choose_camera(frame);
    choose_kernel(frame);
    constexpr double tolerances[] = {1e-2, 1e-3, 1e-3, 1e-4, 1e-5};
    frame.tolerance = tolerances[integer(0, 4)];
    if (chance(0.4)) frame.background = {random_.uniform(), random_.uniform(), 0.0};
    frame.sort.descending = chance(0.3);
    if (chance(0.3)) frame.sort.by = SortOrder::By::field;
    const int kind = integer(0, 3);
    const int component_count = integer(1, 3);
    for (int i = 0; i < component_count; ++i)
      frame.components.push_back(make_component(frame, kind));
    return frame;
  }

 private:
  int integer(int low, int high) { return static_cast<int>(random_.uniform(low, high + 1)); }
  bool chance(double probability) { return random_.uniform() < probability; }

  Rectangle random_crop(int width, int height) {
    if (chance(0.6)) return {0, 0, width, height};
    const int x = integer(0, width - 1), y = integer(0, height - 1);
    return {x, y, integer(1, width - x), integer(1, height - y)};
  }

  // Particles lie in a ball of radius 1 around the look-at point.
  void choose_camera(Frame& frame) {
    Camera camera;
    camera.look_at = {{random_.uniform(-5, 5), random_.uniform(-5, 5), random_.uniform(-5, 5)}};
    const double field_of_view = random_.uniform(1, 110);
    camera.field_of_view_degrees = field_of_view;
    const double distance = random_.uniform(0.3, 1.5) / std::tan(0.5 * field_of_view * pi / 180);
    camera.position = camera.look_at + Vec3{{0.48, -0.6, 0.64}} * distance;
    camera.sky = {{random_.uniform(-1, 1), 1, random_.uniform(-1, 1)}};
    if (chance(0.4)) camera.projection = Projection::orthographic;
    frame.camera = make_camera_frame(camera, frame.width, frame.height);
    frame.projection = camera.projection;
    if (chance(0.3)) frame.near_limit = distance - random_.uniform(0, 1);
    if (chance(0.3)) frame.far_limit = distance + random_.uniform(0, 1);
    centre_ = camera.look_at;
    pixel_ = 1 / frame.camera.pixels_per_length;
  }

  void choose_kernel(Frame& frame) {
    if (chance(0.3)) {
      frame.kernel.cut = random_.uniform(1.5, 3);
      if (chance(0.5)) frame.kernel.sampling = Sampling::center;
    }
    if (chance(0.2)) frame.kernel.min_radius_pixels = random_.uniform(0.1, 2);
  }

  Palette random_palette(bool own_absorption) {
    Palette palette;
    const int knots = integer(1, 6);
    for (int i = 0; i < knots; ++i) {
      palette.emission.push_back(random_color());
      if (own_absorption) palette.absorption.push_back(random_color());
    }
    return palette;
  }
  Rgb random_color() {
    const auto channel = [this] {
      return chance(0.2) ? 0.0f : static_cast<float>(random_.uniform());
    };
    return {channel(), channel(), channel()};
  }

  ScalarMap random_map() {
    const int scaling = integer(0, 2);
    if (scaling == 0) return {Scaling::linear, -0.5, 2};
    if (scaling == 1) return {Scaling::log, -2, 0.5};
    return {Scaling::asinh, -1, 1};
  }

  DrawnComponent make_component(const Frame& frame, int kind) {
    DrawnComponent component;
    component.absorption = random_absorption(kind);
    component.palette = random_palette(kind == 3 && chance(0.5));
    component.brightness = chance(0.1) ? random_.logarithmic(3, 1e4) : random_.logarithmic(0.3, 3);
    component.size_factor = random_.uniform(0.5, 2);
    component.color = random_map();
    component.intensity = random_map();
    component.weight = static_cast<WeightModel>(integer(0, 2));
    component.reference_column = random_.logarithmic(0.1, 10);
    fill_particles(component, frame);
    return component;
  }

  Absorption random_absorption(int kind) {
    switch (kind) {
      case 0:
        return {Absorption::Kind::none, 0};
      case 1:
        return {Absorption::Kind::as_emission, 0};
      case 2:
        return {Absorption::Kind::factor, random_.logarithmic(0.1, 10)};
      default:
        return {static_cast<Absorption::Kind>(integer(0, 3)), random_.logarithmic(0.1, 10)};
    }
  }

  // Widths from a twentieth of a pixel to a third of the ball, and values that make columns
  // around 1 in every model of weights, with less from grains: what a grain on a pixel's
  // edge shows depends on its centre's last digits.
  void fill_particles(DrawnComponent& component, const Frame& frame) {
    const std::size_t count = static_cast<std::size_t>(integer(0, 300));
    Particles& particles = component.particles;
    particles.count = count;
    particles.origin = chance(0.5) ? centre_ : Vec3{{0, 0, 0}};
    std::vector<float> positions, sizes, weights, colors, intensities, keys, vectors;
    const bool crowded = chance(0.15);
    const double smallest = 0.05 * pixel_ / frame.kernel.width / component.size_factor;
    double h = 1;
    for (std::size_t i = 0; i < count; ++i) {
      const bool again = crowded && i % 100 != 0;  // the place and width of the one before
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double place = centre_.a[axis] + random_.uniform(-1, 1);
        positions.push_back(again ? positions[positions.size() - 3]
                                  : static_cast<float>(place - particles.origin.a[axis]));
        vectors.push_back(static_cast<float>(random_.uniform()));
      }
      if (!again) h = random_.logarithmic(smallest, std::max(1.0, 2 * smallest));
      const double sigma = frame.kernel.width * component.size_factor * h;
      const double column = component.reference_column * random_.logarithmic(0.01, 1.5);
      sizes.push_back(static_cast<float>(h));
      weights.push_back(static_cast<float>(component.weight == WeightModel::mass
                                               ? column * pi * sigma * sigma
                                               : column / (sigma * std::sqrt(pi))));
      colors.push_back(static_cast<float>(random_.uniform(-1, 3)));
      intensities.push_back(static_cast<float>(random_.uniform(-0.5, 3)));
      keys.push_back(static_cast<float>(integer(-20, 20)));
    }
    if (component.weight == WeightModel::constant) {
      // w = 1 / h: the narrowest has the largest.
      component.reference_column = 1 / smallest;
    }
    if (chance(0.3)) spoil(positions);
    if (chance(0.3)) spoil(weights);
    if (chance(0.3)) spoil(sizes);
    particles.position = Column::owning(positions);
    particles.smoothing_length = Column::owning(sizes);
    if (component.weight != WeightModel::constant) particles.weight = Column::owning(weights);
    if (chance(0.8)) particles.color = Column::owning(colors);
    if (chance(0.1)) particles.color_vector = Column::owning(vectors);
    if (chance(0.4)) particles.intensity = Column::owning(intensities);
    if (frame.sort.by == SortOrder::By::field) particles.sort_field = Column::owning(keys);
  }

  void spoil(std::vector<float>& values) {
    constexpr float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()};
    for (std::size_t i = 3; i < values.size(); i += 41)
      values[i] = bad[i % 3];
  }

  Random random_;
  Vec3 centre_{};
  double pixel_ = 1;
};

// docs/accuracy.md, what single precision of places does to each pixel, in its brightest
// colour: a splat that moves by `known_to` pixels changes a pixel's light by as much as it
// slopes there, and the pixels on the edge of a cut disc may be in or out. Places are known to
// 2e-4 pixels in these pictures of up to 70.
std::vector<double> light_of_places(const Frame& frame, double known_to) {
  std::vector<double> light(static_cast<std::size_t>(frame.crop.width) *
                            static_cast<std::size_t>(frame.crop.height));
  for (const reference::Splat& splat : reference::project(frame)) {
    const double brightest =
        splat.weight * std::max(*std::max_element(splat.emission, splat.emission + 3),
                                *std::max_element(splat.absorption, splat.absorption + 3));
    // The mean over a pixel of a cloud of this width is as steep as that of one of a pixel.
    const double flux = brightest * std::min(1.0, pi * splat.sigma * splat.sigma);
    const double sigma = std::max(splat.sigma, 1e-3);
    std::size_t i = 0;
    for (int y = frame.crop.y; y < frame.crop.y + frame.crop.height; ++y) {
      for (int x = frame.crop.x; x < frame.crop.x + frame.crop.width; ++x, ++i) {
        const double dx = std::abs(x + 0.5 - splat.x), dy = std::abs(y + 0.5 - splat.y);
        // Of the pixel's edges the nearer; half a pixel is all that a mean can hide.
        const double u = std::max(std::hypot(dx, dy) - 0.8, 0.0) / sigma;
        light[i] += known_to * flux * 1.8 / sigma * (1 + u) * std::exp(-u * u);
        if (!frame.kernel.cut) continue;
        const double cut = *frame.kernel.cut;
        if (std::abs(std::hypot(dx, dy) - cut * splat.sigma) > known_to) continue;
        light[i] += brightest * std::exp(-cut * cut);
      }
    }
  }
  return light;
}

std::string describe(const Frame& frame) {
  std::ostringstream out;
  out << name(make_plan(frame).light) << ", " << frame.crop.width << " x " << frame.crop.height
      << ", cut " << frame.kernel.cut.value_or(0)
      << (frame.kernel.sampling == Sampling::mean ? ", means" : ", centres") << ", min_radius "
      << frame.kernel.min_radius_pixels << ", tolerance " << frame.tolerance << ", components "
      << frame.components.size();
  return out.str();
}

// As largest_error(), where each pixel's error may be larger by `ambiguous` light.
double largest_error_beyond(const Image& image, const ExactImage& exact,
                            const std::vector<double>& ambiguous) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double error = std::abs(static_cast<double>(image.pixels[i]) - exact.pixels[i]);
    const double beyond = error - ambiguous[i / 4];
    worst = std::max(
        worst, std::isfinite(beyond) ? beyond / std::max(1.0, std::abs(exact.pixels[i])) : 1e300);
  }
  return worst;
}

class RandomScenes : public PictureTest {};

TEST_F(RandomScenes, KeepTheirTolerance) {
  int lit = 0;
  for (std::uint64_t seed = 1; seed <= 240; ++seed) {
    const Frame frame = SceneMaker(seed).make();
    const ExactImage exact = reference::render(frame);
    lit += largest_value(exact) > 0.05;
    const CompositeShape shape = seed % 3 == 0 ? CompositeShape::groups : CompositeShape::rows;
    const double worst =
        largest_error_beyond(draw(frame, shape), exact, light_of_places(frame, 2e-4));
    EXPECT_LE(worst, frame.tolerance) << "seed " << seed << ": " << describe(frame);
    EXPECT_EQ(renderer(shape).stats().bad_particles, reference::count_bad(frame))
        << "seed " << seed;
  }
  EXPECT_GT(lit, 150) << "most scenes should have something to see";
}

// At tolerance 0 with numbers that are doubles and pairs of floats in turn; places are known
// to 2^-40 of coordinates, which are some ten lengths or hundreds of pixels.
TEST_F(RandomScenes, KeepThePromiseOfToleranceZero) {
  Renderer pairs({"", CompositeShape::automatic, false});
  for (std::uint64_t seed = 1001; seed <= 1080; ++seed) {
    Frame frame = SceneMaker(seed).make();
    frame.tolerance = 0;
    const ExactImage exact = reference::render(frame);
    const Image image = seed % 2 == 0 ? pairs.render(frame) : draw(frame);
    EXPECT_LE(largest_error_beyond(image, exact, light_of_places(frame, 1e-9)),
              most_exact_tolerance)
        << "seed " << seed << ": " << describe(frame);
    const RenderStats& stats = seed % 2 == 0 ? pairs.stats() : renderer().stats();
    EXPECT_EQ(stats.bad_particles, reference::count_bad(frame)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace splotchcl::test
