// The parts of a frame that more cores do not shorten.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

class SerialTimes : public PictureTest {
 protected:
  // Enough for several groups of work-items in every kernel that walks particles or pixels.
  static std::vector<std::string> parts_of(const Absorption& absorption) {
    Random random(5);
    std::vector<Cloud> clouds;
    for (int i = 0; i < 20000; ++i) {
      clouds.push_back({random.uniform(-90, 90), random.uniform(-60, 60), random.uniform(1, 100),
                        random.logarithmic(0.1, 2), random.logarithmic(1e-3, 1e-1)});
    }
    DrawnComponent component = component_of(clouds, two_colors());
    component.absorption = absorption;
    draw(frame_of(180, 120, {component}), CompositeShape::rows);
    std::vector<std::string> parts;
    for (const StageTime& part : renderer(CompositeShape::rows).stats().serial)
      parts.push_back(part.stage);
    return parts;
  }
};

TEST_F(SerialTimes, NameEachPartOnce) {
  const std::vector<std::string> parts = parts_of({Absorption::Kind::gray, 0.2});
  EXPECT_EQ(std::set<std::string>(parts.begin(), parts.end()).size(), parts.size());
}

TEST_F(SerialTimes, HaveTheHostTheCheckAndCopies) {
  EXPECT_THAT(parts_of({Absorption::Kind::none, 0}),
              testing::IsSupersetOf({"host", "check", "copies"}));
}

TEST_F(SerialTimes, HaveTheScansOfASort) {
  EXPECT_THAT(parts_of({Absorption::Kind::gray, 0.2}), testing::Contains("sort"));
}

TEST_F(SerialTimes, HaveNothingOfStagesThatAllCoresShare) {
  EXPECT_THAT(parts_of({Absorption::Kind::none, 0}), testing::Not(testing::Contains("resolve")));
}

}  // namespace
}  // namespace splotchcl::test
