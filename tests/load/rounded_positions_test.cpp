// Doubles that single precision cannot hold well enough are told of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "load/placement.h"

namespace splotchcl {
namespace {

using ::testing::HasSubstr;

// Floats from 2^20 to 2^21 are 0.125 apart.
DrawnComponent component(const std::vector<float>& along_x, float h, double origin) {
  DrawnComponent component;
  component.name = "gas";
  std::vector<float> position, sizes;
  for (const float x : along_x) {
    position.insert(position.end(), {x, 0, 0});
    sizes.push_back(h);
  }
  component.particles.count = along_x.size();
  component.particles.origin = {{origin, 0, 0}};
  component.particles.position = Column::owning(std::move(position));
  component.particles.smoothing_length = Column::owning(std::move(sizes));
  return component;
}

std::optional<std::string> note_on(const DrawnComponent& component) {
  return tell_rounded_positions(component, ParticlePass(component.particles.count));
}

TEST(RoundedPositions, AreCountedWithTheWorst) {
  const auto note = note_on(component({1, 1.5e6F, 1.1e6F}, 0.5F, 3e7));
  ASSERT_TRUE(note);
  EXPECT_THAT(*note, HasSubstr("component gas: 2 of 3 particles"));
  EXPECT_THAT(*note, HasSubstr("at worst 0.25"));
}

TEST(RoundedPositions, MayBeATenthOfTheSizeThatIsDrawn) {
  EXPECT_FALSE(note_on(component({1.5e6F}, 1.25F, 3e7)));
  DrawnComponent smaller = component({1.5e6F}, 1.25F, 3e7);
  smaller.size_factor = 0.9;
  EXPECT_TRUE(note_on(smaller));
}

TEST(RoundedPositions, OfFilesOfFloatsAreAsTheFileHasThem) {
  EXPECT_FALSE(note_on(component({1.5e6F}, 1e-3F, 0)));
}

}  // namespace
}  // namespace splotchcl
