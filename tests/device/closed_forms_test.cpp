// Pictures that can be worked out on paper.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "device/cases.h"
#include "device/pictures.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
