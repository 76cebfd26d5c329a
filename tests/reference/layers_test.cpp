// Layers and pictures of several clouds, against closed forms.
#include "reference/frames.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl {
namespace {

using reference::Layer;
using namespace test;

const double* pixel(const ReferenceImage& image, int x, int y) {
  return &image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(x))];
}

Layer random_layer(std::mt19937& random) {
  std::uniform_real_distribution<double> exponent(-12, 2);
  Layer layer;
  for (int c = 0; c < 3; ++c) {
    layer.optical_depth[c] = std::pow(10, exponent(random));
    layer.source[c] = std::pow(10, exponent(random));
  }
  return layer;
}

void expect_same(const Layer& a, const Layer& b, double relative) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(a.optical_depth[c], b.optical_depth[c], relative * a.optical_depth[c]);
    EXPECT_NEAR(a.source[c], b.source[c], relative * a.source[c]);
  }
}

TEST(Over, IsAssociative) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Layer a = random_layer(random), b = random_layer(random), c = random_layer(random);
    // Rounding: a relative step per operation, and exp's error grows with its argument.
    expect_same(over(over(a, b), c), over(a, over(b, c)), 1e-13);
  }
}

TEST(Over, HasTheEmptyLayerAsIdentity) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Layer a = random_layer(random);
    expect_same(over(a, Layer{}), a, 0);
    expect_same(over(Layer{}, a), a, 0);
  }
}

TEST(Over, IsNotCommutative) {
  Layer dark, bright;
  dark.optical_depth[0] = 1;
  bright.source[0] = 1;
  EXPECT_NEAR(over(dark, bright).source[0], std::exp(-1), 1e-15);
  EXPECT_NEAR(over(bright, dark).source[0], 1, 1e-15);
}

TEST(Render, ColumnOfEqualAbsorbersApproachesItsSource) {
  const double tau = 0.3;
  for (const int count : {1, 4, 40}) {
    std::vector<Cloud> column;
    for (int i = 0; i < count; ++i)
      column.push_back(Cloud{0.5, 0.5, 1.0 + i, 50, tau});
    DrawnComponent component = component_of(column, one_color(1, 1, 1));
    component.absorption = {Absorption::Kind::factor, 1};
    component.brightness = 0.7;  // q = E / A = 0.7
    Frame frame = frame_of(16, 16, {component});
    frame.kernel.sampling = Sampling::center;
    const ReferenceImage image = reference::render(frame);
    EXPECT_NEAR(pixel(image, 8, 8)[0], 0.7 * (1 - std::exp(-count * tau)), 2e-7);
    EXPECT_NEAR(pixel(image, 8, 8)[3], 1 - std::exp(-count * tau), 2e-7);
  }
}

// Two clouds on the optical axis: `star` only emits, `cloud` only absorbs.
Frame star_and_cloud(double star_z, double cloud_z) {
  DrawnComponent star = component_of({Cloud{0.5, 0.5, star_z, 2, 3}}, one_color(1, 1, 1));
  star.absorption.kind = Absorption::Kind::none;
  DrawnComponent cloud = component_of({Cloud{0.5, 0.5, cloud_z, 20, 1}}, one_color(1, 1, 1));
  cloud.palette.absorption = {Rgb{0.5f, 1, 2}};
  cloud.palette.emission = {Rgb{0, 0, 0}};
  cloud.absorption = {Absorption::Kind::factor, 1};
  Frame frame = frame_of(16, 16, {star, cloud});
  frame.kernel.sampling = Sampling::center;
  return frame;
}

TEST(Render, StarBehindACloudIsReddened) {
  const ReferenceImage image = reference::render(star_and_cloud(5, 3));
  EXPECT_NEAR(pixel(image, 8, 8)[0], 3 * std::exp(-0.5), 1e-6);
  EXPECT_NEAR(pixel(image, 8, 8)[1], 3 * std::exp(-1), 1e-6);
  EXPECT_NEAR(pixel(image, 8, 8)[2], 3 * std::exp(-2), 1e-6);
}

TEST(Render, StarInFrontOfACloudIsNot) {
  const ReferenceImage image = reference::render(star_and_cloud(2, 3));
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(pixel(image, 8, 8)[c], 3, 1e-6);
}

TEST(Render, BackgroundShinesThroughWhatAbsorbs) {
  Frame frame = star_and_cloud(2, 3);
  frame.components.erase(frame.components.begin());
  frame.background = {1, 2, 3};
  const ReferenceImage image = reference::render(frame);
  EXPECT_NEAR(pixel(image, 8, 8)[0], std::exp(-0.5), 1e-6);
  EXPECT_NEAR(pixel(image, 8, 8)[1], 2 * std::exp(-1), 1e-6);
  EXPECT_NEAR(pixel(image, 8, 8)[2], 3 * std::exp(-2), 1e-6);
}

std::vector<Cloud> random_clouds(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-20, 20), depth(1, 9), width(-3, 1), column(-2, 1);
  std::vector<Cloud> clouds;
  for (int i = 0; i < count; ++i) {
    const Cloud cloud{place(random), place(random), depth(random), std::pow(10, width(random)),
                      std::pow(10, column(random))};
    clouds.push_back(cloud);
  }
  return clouds;
}

// X of every splat, summed over the list, in one pixel.
double summed_column(const std::vector<reference::Splat>& splats, int x, int y) {
  double sum = 0;
  for (const auto& splat : splats)
    sum += splat.weight * shape(splat, x, y, KernelSettings{});
  return sum;
}

TEST(Render, EmissionEqualToAbsorptionNeedsNoOrder) {
  Frame frame = frame_of(40, 40, {component_of(random_clouds(300, 4), one_color(1, 0.5f, 0.1f))});
  frame.background = {0.3, 0, 2};
  const ReferenceImage image = reference::render(frame);
  const auto splats = reference::project(frame);
  const double color[3] = {1, 0.5, static_cast<double>(0.1f)};
  for (int y = 0; y < 40; y += 7) {
    for (int x = 0; x < 40; x += 3) {
      const double column = summed_column(splats, x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = 1 + (frame.background[c] - 1) * std::exp(-color[c] * column);
        EXPECT_NEAR(pixel(image, x, y)[c], expected, 1e-11);
      }
    }
  }
}

TEST(Render, WithoutAbsorptionIsAPlainSum) {
  DrawnComponent component = component_of(random_clouds(300, 5), one_color(1, 0.5f, 0.1f));
  component.absorption.kind = Absorption::Kind::none;
  const Frame frame = frame_of(40, 40, {component});
  const ReferenceImage image = reference::render(frame);
  const auto splats = reference::project(frame);
  for (int y = 0; y < 40; y += 7) {
    for (int x = 0; x < 40; x += 3) {
      const double column = summed_column(splats, x, y);
      EXPECT_NEAR(pixel(image, x, y)[0], column, 1e-11 * (1 + column));
      EXPECT_EQ(pixel(image, x, y)[3], 0);
    }
  }
}

TEST(Render, OrderMattersWhenEmissionAndAbsorptionDiffer) {
  const ReferenceImage front = reference::render(star_and_cloud(2, 3));
  const ReferenceImage behind = reference::render(star_and_cloud(4, 3));
  EXPECT_GT(pixel(front, 8, 8)[0], 1.5 * pixel(behind, 8, 8)[0]);
}

TEST(Render, AgreesWithTheListOfOnePixel) {
  DrawnComponent component = component_of(random_clouds(300, 6), one_color(1, 0.5f, 0.1f));
  component.absorption = {Absorption::Kind::gray, 0.2};
  Frame frame = frame_of(40, 40, {component});
  frame.kernel.cut = 2.5;
  frame.crop = {3, 5, 20, 17};
  const ReferenceImage image = reference::render(frame);
  auto splats = reference::project(frame);
  reference::sort(splats, frame.sort);
  for (int y = 0; y < frame.crop.height; ++y) {
    for (int x = 0; x < frame.crop.width; ++x) {
      const Layer layer = composite_pixel(splats, x + frame.crop.x, y + frame.crop.y, frame);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(image, x, y)[c], layer.source[c], 1e-11);
    }
  }
}

TEST(Render, GrayAbsorptionTendsToAmplitudeOverAmplitudePlusGray) {
  // A single opaque cloud shows its source q = e / (e + gray), e with its whole weight.
  DrawnComponent component = component_of({Cloud{0.5, 0.5, 1, 10, 40}}, one_color(1, 0.5f, 0.25f));
  component.absorption = {Absorption::Kind::gray, 20};
  Frame frame = frame_of(16, 16, {component});
  frame.kernel.sampling = Sampling::center;
  const ReferenceImage image = reference::render(frame);
  EXPECT_NEAR(pixel(image, 8, 8)[0], 40.0 / 60 * (1 - std::exp(-40.0)), 1e-6);
  EXPECT_NEAR(pixel(image, 8, 8)[1], 20.0 / 40 * (1 - std::exp(-20.0)), 1e-6);
  EXPECT_NEAR(pixel(image, 8, 8)[2], 10.0 / 30 * (1 - std::exp(-10.0)), 1e-6);
}

TEST(Render, ReportsProgressFromNothingToAll) {
  std::vector<double> reported;
  const Frame frame = frame_of(8, 8, {component_of(random_clouds(10, 7), one_color(1, 1, 1))});
  reference::render(frame, [&reported](double done) { reported.push_back(done); });
  ASSERT_FALSE(reported.empty());
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_EQ(reported.back(), 1);
}

}  // namespace
}  // namespace splotchcl
