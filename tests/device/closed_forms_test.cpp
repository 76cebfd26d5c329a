#include "device/cases.h"
#include "device/pictures.h"
#include "scene/particle_rules.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Pictures that can be worked out on paper.

constexpr int width = 60, height = 44;

// The mean over pixel i of exp(-(t - centre)^2 / sigma^2).
double axis_mean(double center, double sigma, int i) {
  return 0.5 * std::sqrt(pi) * sigma *
         (std::erf((i + 1 - center) / sigma) - std::erf((i - center) / sigma));
}

// X of a cloud in a pixel of the frames below.
double column_in(const Cloud& cloud, int x, int y) {
  return cloud.column * axis_mean(0.5 * width + cloud.x, cloud.sigma, x) *
         axis_mean(0.5 * height + cloud.y, cloud.sigma, y);
}

// Makes the frame need this plan although E = A for every particle.
Frame equal_light(Frame frame, LightPlan plan) {
  for (DrawnComponent& component : frame.components) {
    if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
    if (plan == LightPlan::ordered) component.palette.absorption = component.palette.emission;
  }
  EXPECT_EQ(choose_light(frame), plan);
  return frame;
}

class ClosedForms : public PictureTest, public testing::WithParamInterface<PlanAndShape> {
 protected:
  LightPlan plan() const { return std::get<0>(GetParam()); }

  // Light of optical depth x in front of `behind`, with E = A, or with A = 0.
  double light(double x, double behind = 0) const {
    return plan() == LightPlan::emission ? x + behind : -std::expm1(-x) + std::exp(-x) * behind;
  }

  // Every pixel's red within the tolerance of value(x, y).
  void expect_picture(const Frame& frame, const std::function<double(int, int)>& value) const {
    const Image image = draw(frame, std::get<1>(GetParam()));
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const double expected = value(x, y);
        ASSERT_NEAR(static_cast<double>(image.at(x, y)[0]), expected,
                    frame.tolerance * std::max(1.0, expected))
            << "pixel " << x << ", " << y;
      }
    }
  }
};

TEST_P(ClosedForms, OneGaussian) {
  for (const double sigma : {0.02, 0.5, 1.5, 1.96, 1.98, 2.5, 6.0, 20.0}) {
    const Cloud cloud = {0.3, -1.7, 1, sigma, 2};
    SCOPED_TRACE(sigma);
    expect_picture(
        equal_light(frame_of(width, height, {component_of({cloud}, one_color(1, 1, 1))}), plan()),
        [&](int x, int y) { return light(column_in(cloud, x, y)); });
  }
}

TEST_P(ClosedForms, OneGaussianAtPixelCenters) {
  const Cloud cloud = {0.3, -1.7, 1, 3, 2};
  Frame frame =
      equal_light(frame_of(width, height, {component_of({cloud}, one_color(1, 1, 1))}), plan());
  frame.kernel.sampling = Sampling::center;
  expect_picture(frame, [&](int x, int y) {
    const double dx = x + 0.5 - 0.5 * width - cloud.x, dy = y + 0.5 - 0.5 * height - cloud.y;
    return light(2 * std::exp(-(dx * dx + dy * dy) / 9));
  });
}

// All pixels lie within every disc: depths simply add up.
TEST_P(ClosedForms, AColumnOfEqualAbsorbers) {
  for (const int count : {1, 7, 1000, 20000}) {
    const Cloud cloud = {0.2, 0.1, 1, 30, 3.0 / count};
    const std::vector<Cloud> clouds(static_cast<std::size_t>(count), cloud);
    SCOPED_TRACE(count);
    Frame frame =
        equal_light(frame_of(width, height, {component_of(clouds, one_color(1, 1, 1))}), plan());
    frame.background = {0.5, 0.5, 0.5};
    expect_picture(frame, [&](int x, int y) { return light(count * column_in(cloud, x, y), 0.5); });
  }
}

TEST_P(ClosedForms, ABackgroundThroughACloud) {
  const Cloud cloud = {0.3, -1.7, 1, 12, 1.5};
  Frame frame =
      equal_light(frame_of(width, height, {component_of({cloud}, one_color(1, 1, 1))}), plan());
  frame.background = {3, 3, 3};
  expect_picture(frame, [&](int x, int y) { return light(column_in(cloud, x, y), 3); });
}

// Only order tells these apart.
class OrderedForms : public ClosedForms {
 protected:
  // A star that does not absorb and a cloud of emission 0.4 A.
  Frame star_and_cloud(double depth_of_star, double depth_of_cloud) const {
    star.z = depth_of_star;
    cloud.z = depth_of_cloud;
    DrawnComponent stars = component_of({star}, one_color(1, 1, 1));
    stars.absorption = {Absorption::Kind::none, 0};
    DrawnComponent clouds = component_of({cloud}, one_color(0.4f, 0.4f, 0.4f));
    clouds.palette.absorption = {Rgb{1, 1, 1}};
    return frame_of(width, height, {stars, clouds});
  }
  static inline Cloud star = {5.2, 3.4, 2, 0.8, 4};
  static inline Cloud cloud = {0.3, -1.7, 1, 9, 1.8};
  static constexpr double cloud_source = static_cast<double>(0.4f);
};

TEST_P(OrderedForms, AStarBehindACloud) {
  expect_picture(star_and_cloud(2, 1), [](int x, int y) {
    const double depth = column_in(cloud, x, y);
    return -cloud_source * std::expm1(-depth) + std::exp(-depth) * column_in(star, x, y);
  });
}

TEST_P(OrderedForms, AStarBeforeACloud) {
  expect_picture(star_and_cloud(1, 2), [](int x, int y) {
    const double depth = column_in(cloud, x, y);
    return -cloud_source * std::expm1(-depth) + column_in(star, x, y);
  });
}

TEST_P(OrderedForms, AStarBehindACloudThatIsSortedFarToNear) {
  Frame frame = star_and_cloud(2, 1);
  frame.sort.descending = true;
  expect_picture(frame, [](int x, int y) {
    return -cloud_source * std::expm1(-column_in(cloud, x, y)) + column_in(star, x, y);
  });
}

// N bright and N dark layers, taking turns: the sum of a geometric series.
TEST_P(OrderedForms, AlternatingLayers) {
  for (const int pairs : {1, 10, 3000}) {
    SCOPED_TRACE(pairs);
    std::vector<Cloud> layers;
    std::vector<float> colors;
    for (int i = 0; i < 2 * pairs; ++i) {
      layers.push_back({0.2, 0.1, 1.0 + i, 30, 1.0 / pairs});
      colors.push_back(static_cast<float>(i % 2));
    }
    DrawnComponent component = component_of(layers, one_color(1, 1, 1));
    component.particles.color = Column::owning(colors);
    component.palette.emission = {Rgb{1, 1, 1}, Rgb{0, 0, 0}};
    component.palette.absorption = {Rgb{1, 1, 1}, Rgb{1, 1, 1}};
    expect_picture(frame_of(width, height, {component}), [&](int x, int y) {
      const double depth = column_in(layers.front(), x, y);
      return -std::expm1(-depth) * std::expm1(-2 * pairs * depth) / std::expm1(-2 * depth);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, ClosedForms, each_plan_and_shape(), name_of_case);
INSTANTIATE_TEST_SUITE_P(Plans, OrderedForms,
                         testing::Combine(testing::Values(LightPlan::ordered), both_shapes()),
                         name_of_case);

// In optically thin scenes the light of a picture, added up, is that of its particles: at
// any resolution, wherever they fall between pixels, and however small they are.

// A sum of emission may lose or gain the tolerance, as a part of itself. Behind absorption
// the same tolerance allows a part e of every splat with 0.37 e <= tolerance, since depths
// x show as 1 - exp(-x), whose error is e x exp(-x) (docs/dev/accuracy.md).
double flux_bound(const Frame& frame, LightPlan plan) {
  return plan == LightPlan::emission ? frame.tolerance : frame.tolerance / 0.367;
}

Frame thin(Frame frame, LightPlan plan) {
  for (DrawnComponent& component : frame.components) {
    if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
    if (plan == LightPlan::ordered) component.palette.absorption = component.palette.emission;
  }
  EXPECT_EQ(choose_light(frame), plan);
  return frame;
}

class Flux : public PictureTest, public testing::WithParamInterface<LightPlan> {};

// h from 1e-4 pixels on, so sigma = h: the frames of tests have kernel.width 1.
TEST_P(Flux, OfOneParticleDependsNeitherOnItsSizeNorOnItsPlaceBetweenPixels) {
  for (const double sigma :
       {1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.7, 1.0, 1.5, 1.9, 2.0, 2.1, 3.0, 5.0, 8.0}) {
    for (const double shift : {0.0, 0.13, 0.5, 0.77}) {
      // A depth of 1e-5 in the brightest pixel: absorption takes 5e-6 of the light.
      const double column = 1e-5 / std::min(1.0, pi * sigma * sigma);
      const Frame frame = thin(
          frame_of(
              96, 80,
              {component_of({{1 + shift, 2 - 0.6 * shift, 1, sigma, column}}, one_color(1, 1, 1))}),
          GetParam());
      const double expected = column * pi * sigma * sigma;
      EXPECT_NEAR(sum_of_light(draw(frame)) / expected, 1, flux_bound(frame, GetParam()))
          << "sigma " << sigma << ", shift " << shift;
    }
  }
}

// Clouds of sizes from 1e-4 to 1/12 of the picture's width, all of whose light is in it.
DrawnComponent field_of_clouds(double world) {
  Random random(91);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 300; ++i) {
    const double sigma = world * random.logarithmic(1e-5, 0.06);
    // Equal light from each, spread over a part of the picture of 1e-4 optical depths.
    clouds.push_back({world * random.uniform(-0.2, 0.2), world * random.uniform(-0.2, 0.2),
                      random.uniform(1, 10), sigma, 1e-9 * world * world / (sigma * sigma)});
  }
  return component_of(clouds, one_color(1, 1, 1));
}

TEST_P(Flux, OfASceneIsTheSameAtAnyResolution) {
  constexpr double world = 100;
  double expected = 0;
  const DrawnComponent clouds = field_of_clouds(world);
  for (std::size_t i = 0; i < clouds.particles.count; ++i)
    expected += static_cast<double>(clouds.particles.weight[i]);
  for (const int width : {16, 33, 100, 257, 640}) {
    Frame frame = thin(frame_of(width, width, {clouds}), GetParam());
    frame.camera.pixels_per_length = width / world;
    const double pixel_area = world * world / (width * width);
    EXPECT_NEAR(sum_of_light(draw(frame)) * pixel_area / expected, 1, flux_bound(frame, GetParam()))
        << width << " pixels";
  }
}

TEST_P(Flux, OfASceneIsTheSameAtAnyShift) {
  const DrawnComponent clouds = field_of_clouds(100);
  double expected = 0;
  for (std::size_t i = 0; i < clouds.particles.count; ++i)
    expected += static_cast<double>(clouds.particles.weight[i]);
  for (const double shift : {0.01, 0.25, 0.5, 0.99}) {
    Frame frame = thin(frame_of(100, 100, {clouds}), GetParam());
    frame.camera.center_x += shift;
    frame.camera.center_y -= 0.7 * shift;
    EXPECT_NEAR(sum_of_light(draw(frame)) / expected, 1, flux_bound(frame, GetParam()))
        << "shift " << shift;
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, Flux,
                         testing::Values(LightPlan::emission, LightPlan::proportional,
                                         LightPlan::ordered),
                         [](const auto& info) { return std::string(name(info.param)); });

// Columns beyond single precision: stars whose width is next to nothing, and masses of any size.

// A particle of a thousandth of white's light in its pixel, whatever its width.
DrawnComponent star(WeightModel weight, double sigma) {
  const double column = 1e-3 / (pi * sigma * sigma);
  DrawnComponent component = component_of({{0.3, 0.2, 1, sigma, 1}}, one_color(1, 1, 1));
  component.weight = weight;
  component.absorption = {Absorption::Kind::none, 0};
  const double value = column / central_column(weight, 1, sigma, sigma);
  component.particles.weight = Column::owning({static_cast<float>(value)});
  return component;
}

class ExtremeValues : public PictureTest, public testing::WithParamInterface<CompositeShape> {};

TEST_P(ExtremeValues, OfWidthsLeaveAStarItsLight) {
  const std::vector<std::pair<WeightModel, double>> narrowest = {
      {WeightModel::mass, 1e-37}, {WeightModel::constant, 1e-30}, {WeightModel::density, 1e-13}};
  for (const auto& [weight, least] : narrowest) {
    for (const double sigma : {1e-5, 1e-7, 1e-10, 1e-13, 1e-20, 1e-25, 1e-30, 1e-37}) {
      if (sigma < 0.99 * least) continue;
      for (const double tolerance : {1e-3, 1e-5, 0.0}) {
        Frame frame = frame_of(20, 16, {star(weight, sigma)});
        frame.tolerance = tolerance;
        EXPECT_NEAR(sum_of_light(draw(frame, GetParam())), 1e-3, 2e-9)
            << "weight " << static_cast<int>(weight) << ", sigma " << sigma << ", tolerance "
            << tolerance;
      }
    }
  }
}

// A colour of an absorption of its own makes the plan an ordered one.
DrawnComponent giants(bool absorbs, bool is_ordered) {
  std::vector<float> position, h, mass;
  for (const float size : {1e-38f, 1e-30f, 1e-10f, 1e-3f, 1.0f, 1e10f, 1e30f, 3e38f}) {
    for (const float weight : {0.0f, 1e-38f, 1.0f, 1e20f, 3e38f}) {
      position.insert(position.end(), {0.1f, -0.1f, 1});
      h.push_back(size);
      mass.push_back(weight);
    }
  }
  DrawnComponent component;
  component.particles.count = h.size();
  component.particles.position = Column::owning(position);
  component.particles.smoothing_length = Column::owning(h);
  component.particles.weight = Column::owning(mass);
  component.palette = one_color(1, 0.5f, 0);
  if (is_ordered) component.palette.absorption = {Rgb{0.3f, 0.2f, 1}};
  if (!absorbs) component.absorption = {Absorption::Kind::none, 0};
  return component;
}

TEST_P(ExtremeValues, OfMassesAndWidthsMakeNumbersOfAllPixels) {
  for (const double tolerance : {1e-3, 1e-5, 0.0}) {
    for (const auto& [absorbs, is_ordered] :
         {std::pair(false, false), std::pair(true, false), std::pair(true, true)}) {
      Frame frame = frame_of(20, 16, {giants(absorbs, is_ordered)});
      frame.tolerance = tolerance;
      for (const float value : draw(frame, GetParam()).pixels) {
        ASSERT_FALSE(std::isnan(value))
            << "tolerance " << tolerance << ", absorbs " << absorbs << ", ordered " << is_ordered;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ExtremeValues,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const auto& shape) {
                           return shape.param == CompositeShape::rows ? "Rows" : "Groups";
                         });

}  // namespace
}  // namespace splotchcl::test
