// Spheres whose particles fade towards their surface, and components that are dark.
#include "load/particles.h"
#include "splotchcl/load.h"
#include "splotchcl/map.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Gas at 0, 1, 2, ... along x with masses 1, 2, 3, ...
Component within(double center, double radius, double rim) {
  Component component = gas();
  component.weight = WeightModel::mass;
  component.select.sphere_center = Vec3{{center, 0, 0}};
  component.select.sphere_radius = radius;
  component.select.sphere_rim = rim;
  return component;
}

std::vector<float> weights_of(const Component& component) {
  const Particles particles = load(component, gas_row()).particles;
  std::vector<float> weights;
  for (std::size_t i = 0; i < particles.count; ++i)
    weights.push_back(particles.weight[i]);
  return weights;
}

TEST(SoftRim, LeavesWhatIsInsideAndFadesToNothing) {
  const std::vector<float> weights = weights_of(within(0, 4, 2));
  ASSERT_EQ(weights.size(), 5U);
  EXPECT_EQ(weights[0], 1);
  EXPECT_EQ(weights[2], 3);
  EXPECT_FLOAT_EQ(weights[3], 0.5F * 4);
  EXPECT_EQ(weights[4], 0);
}

// What particles 0 to 5 weigh, also where they are left out, over their masses.
std::vector<double> light_with_sphere_at(double center) {
  std::vector<double> light(6, 0);
  const Particles particles = load(within(center, 1.5, 1), gas_row()).particles;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const auto at = static_cast<std::size_t>(
        std::lround(particles.origin.a[0] + static_cast<double>(particles.position[3 * i])));
    light.at(at) = static_cast<double>(particles.weight[i]) / static_cast<double>(at + 1);
  }
  return light;
}

// From one frame to the next a sphere moves by a tenth of its rim: the light of no particle changes
// by more than the steepest part of the rim times that.
TEST(SoftRim, LetsNoParticleStepAtTheSpheresEdge) {
  constexpr double step = 0.1, steepest = 1.5;
  double largest = 0;
  std::vector<double> before = light_with_sphere_at(0);
  for (int i = 1; i <= 50; ++i) {
    const std::vector<double> now = light_with_sphere_at(step * i);
    for (std::size_t p = 0; p < now.size(); ++p)
      largest = std::max(largest, std::abs(now[p] - before[p]));
    before = now;
  }
  EXPECT_LE(largest, steepest * step * (1 + 1e-6));
  EXPECT_GT(largest, step);  // light did change
}

TEST(SoftRim, IsRefusedByMaps) {
  std::vector<std::string> notes;
  EXPECT_THAT([&] { draw_map(scene_of({within(0, 4, 2)}), gas_row(), {}, notes); },
              ThrowsMessage<UsageError>(HasSubstr("rim")));
}

TEST(DarkComponent, ReadsAndDrawsNothing) {
  Component dark = gas();
  dark.brightness = 0;
  dark.weight = WeightModel::mass;
  dark.reference_column = 1;
  const NumberedSnapshot snapshot = gas_row();
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene_of({dark}), snapshot, notes);
  EXPECT_EQ(frame.components.at(0).particles.count, 0U);
  EXPECT_THAT(snapshot.fields_read(), IsEmpty());
}

TEST(DarkComponent, IsDrawnWhereItStillAbsorbs) {
  Component dark = gas();
  dark.brightness = 0;
  dark.absorption = {Absorption::Kind::factor, 2};
  EXPECT_EQ(load(dark, gas_row()).particles.count, 6U);
}

// Just before it is dark there is hardly any light: nothing pops.
TEST(DarkComponent, IsWhatAlmostDarkOnesBecome) {
  Component almost = gas();
  almost.brightness = 1e-6;
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene_of({almost}), gas_row(), notes);
  const Image image = reference::render(frame).to_float();
  EXPECT_LT(*std::max_element(image.pixels.begin(), image.pixels.end() - 1), 1.0001F);
  float brightest = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % 4 != 3) brightest = std::max(brightest, image.pixels[i]);
  EXPECT_LT(brightest, 1e-4F);
}

}  // namespace
}  // namespace splotchcl::test
