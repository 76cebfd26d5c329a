// Particles with bad values are counted as the oracle counts them, and leave no trace.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "device/stages.h"

namespace splotchcl::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr std::size_t particle_total = 21;  // no multiple of eight

// Clouds with every column present.
DrawnComponent full_component() {
  CloudSetup setup;
  setup.count = static_cast<int>(particle_total);
  DrawnComponent component = random_clouds(setup);
  component.particles.intensity = Column::owning(std::vector<float>(particle_total, 0.7f));
  component.particles.sort_field = Column::owning(std::vector<float>(particle_total, 3.0f));
  return component;
}

struct Field {
  std::string name;
  Column Particles::*column;
  std::size_t stride, offset;
};

std::vector<Field> all_fields() {
  return {{"x", &Particles::position, 3, 0},
          {"y", &Particles::position, 3, 1},
          {"z", &Particles::position, 3, 2},
          {"smoothing length", &Particles::smoothing_length, 1, 0},
          {"weight", &Particles::weight, 1, 0},
          {"color", &Particles::color, 1, 0},
          {"intensity", &Particles::intensity, 1, 0},
          {"sort field", &Particles::sort_field, 1, 0}};
}

void set_value(DrawnComponent& component, const Field& field, std::size_t particle, float value) {
  Column& column = component.particles.*field.column;
  std::vector<float> values(column.data(), column.data() + column.size());
  values[particle * field.stride + field.offset] = value;
  column = Column::owning(values);
}

std::uint64_t count_of_device(DeviceContext& device, const Frame& frame, bool lanes) {
  Stages stages(device, frame, lanes);
  stages.project();
  return stages.keyed().particles.bad;
}

class BadValues : public StageTest, public testing::WithParamInterface<bool> {
 protected:
  void expect_bad(const DrawnComponent& component, std::uint64_t expected) {
    const Frame frame = frame_of(100, 70, {component});
    EXPECT_EQ(reference::count_bad(frame), expected);
    EXPECT_EQ(count_of_device(device(), frame, GetParam()), expected);
  }
};

TEST_P(BadValues, AreCountedInEveryField) {
  for (const Field& field : all_fields()) {
    for (const float value : {nan, infinite, -infinite}) {
      SCOPED_TRACE(field.name + " = " + std::to_string(value));
      DrawnComponent component = full_component();
      // The first, one in the middle and the last particle.
      set_value(component, field, 0, value);
      set_value(component, field, 12, value);
      set_value(component, field, particle_total - 1, value);
      expect_bad(component, 3);
    }
  }
}

TEST_P(BadValues, AreSmoothingLengthsThatAreNotPositiveAndNegativeWeights) {
  const std::vector<Field> fields = all_fields();
  const Field& size = fields[3];
  const Field& weight = fields[4];
  constexpr float denormal = std::numeric_limits<float>::denorm_min();
  DrawnComponent component = full_component();
  set_value(component, size, 1, 0.0f);
  set_value(component, size, 2, -0.0f);
  set_value(component, size, 3, -1.0f);
  set_value(component, size, 4, -denormal);
  set_value(component, weight, 5, -1.0f);
  set_value(component, weight, 6, -denormal);
  set_value(component, weight, 7, -0.0f);  // is zero: good
  set_value(component, weight, 8, 0.0f);   // good
  set_value(component, size, 9, 1e-37f);   // good
  expect_bad(component, 6);
}

TEST_P(BadValues, AreCountedWhereverTheyLie) {
  DrawnComponent component = full_component();
  for (std::size_t i = 0; i < particle_total; ++i)
    set_value(component, all_fields()[0], i, 1e6f);  // far off the picture
  set_value(component, all_fields()[4], 5, nan);
  set_value(component, all_fields()[2], 6, nan);
  expect_bad(component, 2);
}

TEST_P(BadValues, OfAUniformColumnMakeEveryParticleBad) {
  DrawnComponent component = full_component();
  component.particles.smoothing_length = Column::uniform(nan);
  expect_bad(component, particle_total);
  component.particles.smoothing_length = Column::uniform(2);
  expect_bad(component, 0);
}

TEST_P(BadValues, AreCountedOncePerParticle) {
  DrawnComponent component = full_component();
  for (const Field& field : all_fields())
    set_value(component, field, 11, nan);
  expect_bad(component, 1);
}

TEST_P(BadValues, OfAnAbsentColumnAreNone) {
  DrawnComponent component = full_component();
  component.particles.weight = Column();
  component.particles.color = Column();
  component.particles.intensity = Column();
  component.particles.sort_field = Column();
  component.weight = WeightModel::constant;
  expect_bad(component, 0);
}

INSTANTIATE_TEST_SUITE_P(Lanes, BadValues, testing::Bool(), [](const auto& info) {
  return std::string(info.param ? "eight" : "one");
});

}  // namespace
}  // namespace splotchcl::test
