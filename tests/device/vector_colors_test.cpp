// Particles with red, green and blue of their own, and palettes of their own for absorption.
#include "device/pictures.h"
#include "device/stages.h"
#include "splotchcl/plan.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Column random_vectors(std::size_t count, std::uint64_t seed, double brightest = 1) {
  Random random(seed);
  std::vector<float> values;
  for (std::size_t i = 0; i < 3 * count; ++i) {
    values.push_back(static_cast<float>(random.uniform(0, brightest)));
  }
  return Column::owning(std::move(values));
}

Palette white() {
  return one_color(1, 1, 1);
}

DrawnComponent with_vectors(DrawnComponent component, std::uint64_t seed, double brightest = 1) {
  component.particles.color_vector = random_vectors(component.particles.count, seed, brightest);
  component.particles.color = Column();
  component.palette = white();
  return component;
}

using Kind = Absorption::Kind;

class VectorColors : public PictureTest, public testing::WithParamInterface<CompositeShape> {
 protected:
  void expect_within_tolerance(const Frame& frame, LightPlan light) {
    ASSERT_EQ(choose_light(frame), light);
    const ReferenceImage exact = reference::render(frame);
    ASSERT_GT(largest_value(exact), 0.05);
    EXPECT_LE(largest_error(draw(frame, GetParam()), exact), frame.tolerance);
  }
  static Frame frame_with(Absorption absorption, double brightest = 1) {
    const CloudSetup setup;
    DrawnComponent component = with_vectors(random_clouds(setup), 5, brightest);
    component.absorption = absorption;
    return frame_of(setup.width, setup.height, {component});
  }
};

TEST_P(VectorColors, AgreeWithTheOracleInEveryPlan) {
  expect_within_tolerance(frame_with({Kind::none, 0}), LightPlan::emission);
  expect_within_tolerance(frame_with({Kind::as_emission, 0}), LightPlan::proportional);
  expect_within_tolerance(frame_with({Kind::factor, 0.5}), LightPlan::proportional);
  expect_within_tolerance(frame_with({Kind::gray, 0.2}), LightPlan::ordered);
}

TEST_P(VectorColors, AgreeWhereTheyAreFarBrighterThanWhite) {
  expect_within_tolerance(frame_with({Kind::none, 0}, 300), LightPlan::emission);
  expect_within_tolerance(frame_with({Kind::as_emission, 0}, 300), LightPlan::proportional);
  expect_within_tolerance(frame_with({Kind::gray, 3}, 300), LightPlan::ordered);
}

TEST_P(VectorColors, AgreeBesideComponentsWithPalettes) {
  CloudSetup setup;
  DrawnComponent gas = random_clouds(setup);
  setup.seed = 2;
  DrawnComponent stars = with_vectors(random_clouds(setup), 6, 2);
  stars.absorption.kind = Kind::none;
  gas.absorption = {Kind::factor, 2};
  expect_within_tolerance(frame_of(setup.width, setup.height, {gas, stars}), LightPlan::ordered);
}

TEST_P(VectorColors, AgreeWithAbsorptionFromAPalette) {
  Frame frame = frame_with({Kind::factor, 3}, 4);
  DrawnComponent& component = frame.components.front();
  component.palette.absorption = {Rgb{0.1f, 0.5f, 1.0f}, Rgb{1.0f, 0.2f, 0.1f}, Rgb{0, 0, 0}};
  component.particles.color = random_clouds({}).particles.color;
  expect_within_tolerance(frame, LightPlan::ordered);
}

TEST_P(VectorColors, LeaveOutParticlesWhoseColorIsNone) {
  Frame frame = frame_with({Kind::none, 0});
  std::vector<float> colors(3 * frame.components[0].particles.count, 0.5f);
  colors[4] = -0.25f;
  colors[9] = std::numeric_limits<float>::quiet_NaN();
  colors[14] = std::numeric_limits<float>::infinity();
  frame.components[0].particles.color_vector = Column::owning(colors);
  EXPECT_EQ(reference::count_bad(frame), 3u);
  expect_within_tolerance(frame, LightPlan::emission);
  EXPECT_EQ(renderer(GetParam()).stats().bad_particles, 3u);
}

TEST_P(VectorColors, OfOneForAllDrawThePaletteItself) {
  const CloudSetup setup;
  DrawnComponent component = random_clouds(setup);
  const Frame plain = frame_of(setup.width, setup.height, {component});
  component.particles.color_vector =
      Column::owning(std::vector<float>(3 * component.particles.count, 1.0f));
  const Frame vectors = frame_of(setup.width, setup.height, {component});
  EXPECT_EQ(draw(plain, GetParam()).pixels, draw(vectors, GetParam()).pixels);
}

TEST_P(VectorColors, TintOneOpaqueCloud) {
  DrawnComponent component = component_of({{0, 0, 1, 20, 3}}, white());
  component.particles.color_vector = Column::owning({0.25f, 0.5f, 0.0f});
  component.absorption.kind = Kind::none;
  const Frame frame = frame_of(33, 33, {component});
  const Image image = draw(frame, GetParam());
  const std::size_t middle = 4 * (16 * 33 + 16);
  // X at the centre is the column, less the pixel's mean of 1 - d^2 / sigma^2: 1 / (6 sigma^2).
  EXPECT_NEAR(image.pixels[middle], 0.75, 2e-3);
  EXPECT_NEAR(image.pixels[middle + 1], 1.5, 2e-3);
  EXPECT_EQ(image.pixels[middle + 2], 0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, VectorColors,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const auto& info) {
                           return info.param == CompositeShape::rows ? "rows" : "groups";
                         });

// On a GPU particles are projected one at a time, on a processor eight.
TEST(VectorColorLanes, PassTheColorsOnEitherWay) {
  const CloudSetup setup;
  Frame frame = frame_of(setup.width, setup.height, {with_vectors(random_clouds(setup), 5)});
  frame.components.push_back(random_clouds(setup));  // has none, and shows its palette's
  frame.components[0].absorption = {Kind::gray, 0.2};
  std::vector<std::set<float>> found;
  for (const bool lanes : {false, true}) {
    DeviceContext device(choose_device(""));
    Stages stages(device, frame, lanes);
    stages.project();
    const std::size_t count = stages.keys().size();
    const std::size_t floats = stages.context().variant.splat_bytes() / sizeof(float);
    constexpr std::size_t red_of_splat = sizeof(shared::Splat) / sizeof(float);
    ASSERT_GT(count, 500u);
    const std::vector<std::uint32_t> slots = stages.slots();
    const std::vector<float> splats =
        stages.read_as<float>(stages.keyed().splats, (slots.back() + 1) * floats);
    std::set<float> reds;
    for (const std::uint32_t slot : slots)
      reds.insert(splats[slot * floats + red_of_splat]);
    const Column& own = frame.components[0].particles.color_vector;
    EXPECT_EQ(reds.count(1.0f), 1u);
    for (const float red : reds) {
      const bool is_known = red == 1.0f || std::find(own.data(), own.data() + own.size(), red) !=
                                               own.data() + own.size();
      EXPECT_TRUE(is_known) << red;
    }
    found.push_back(std::move(reds));
  }
  EXPECT_EQ(found[0], found[1]);
}

class AbsorptionPalettes : public PictureTest {};

TEST_F(AbsorptionPalettes, MayHaveKnotsOfAnotherNumber) {
  for (const std::size_t knots : {1u, 2u, 7u}) {
    const CloudSetup setup;
    DrawnComponent component = random_clouds(setup);
    Random random(knots);
    for (std::size_t k = 0; k < knots; ++k) {
      component.palette.absorption.push_back({static_cast<float>(random.uniform(0.1, 1)),
                                              static_cast<float>(random.uniform(0.1, 1)),
                                              static_cast<float>(random.uniform(0.1, 1))});
    }
    const Frame frame = frame_of(setup.width, setup.height, {component});
    ASSERT_EQ(choose_light(frame), LightPlan::ordered);
    EXPECT_LE(largest_error(draw(frame), reference::render(frame)), frame.tolerance) << knots;
  }
}

}  // namespace
}  // namespace splotchcl::test
