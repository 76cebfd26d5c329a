// The device's columns between two snapshots are the host's, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

#include "between/interpolation.h"
#include "device/frame/particle_store.h"

namespace splotchcl {
namespace {

// No multiple of what a work-item walks.
constexpr std::size_t in_both = 20011, vanishing = 301, appearing = 407;

std::shared_ptr<const IdMatch> shuffled_match() {
  std::mt19937 random(3);
  std::vector<std::uint32_t> places(in_both + appearing);
  std::iota(places.begin(), places.end(), 0U);
  std::shuffle(places.begin(), places.end(), random);
  auto match = std::make_shared<IdMatch>();
  match->place_in_second.assign(places.begin(), places.begin() + in_both);
  match->place_in_second.insert(match->place_in_second.begin() + 77, vanishing, IdMatch::nobody);
  match->appearing.assign(places.begin() + in_both, places.end());
  return match;
}

// With some that no picture shows.
Column random_column(std::size_t size, float least, float most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(least, most);
  std::vector<float> values(size);
  for (float& v : values)
    v = value(random);
  values[5] = 0;
  values[6] = -1;
  values[7] = std::numeric_limits<float>::infinity();
  return Column::owning(std::move(values));
}

ColumnBetween random_between(ColumnBetween::Kind kind, std::size_t width) {
  ColumnBetween column;
  column.match = shuffled_match();
  column.kind = kind;
  column.values_per_particle = static_cast<int>(width);
  column.first = random_column(width * (in_both + vanishing), 0.01F, 100, 1);
  column.second = random_column(width * (in_both + appearing), 0.01F, 100, 2);
  column.fraction = 0.3F;
  return column;
}

ColumnBetween random_paths(bool is_straight, bool is_periodic) {
  ColumnBetween column = random_between(ColumnBetween::Kind::position, 3);
  PathSetting setting;
  setting.first_origin = {{1e6, 0, -3e5}};
  setting.second_origin = {{1e6 + 0.1, 0.01, -3e5}};
  setting.first_rate = 0.7;
  setting.second_rate = 0.9;
  setting.is_straight = is_straight;
  if (is_periodic) setting.period = PeriodicRange{0, 100.1};
  column.path = make_path_numbers(setting, 0.3);
  if (!is_straight) {
    column.first_velocity = random_column(3 * (in_both + vanishing), -50, 50, 3);
    column.second_velocity = random_column(3 * (in_both + appearing), -50, 50, 4);
  }
  return column;
}

class DeviceColumns : public ::testing::TestWithParam<bool> {
 protected:
  DeviceColumns() : device_(choose_device("")), store_(device_) {
    device_.traits.rows = GetParam();
  }

  std::vector<float> on_device(const Column& column) {
    Particles particles;
    particles.position = column;
    store_.begin_frame();
    const ParticleBuffers buffers = store_.get(particles, {0, 0, 0});
    std::vector<float> values(column.size());
    device_.queue.enqueue_read_buffer(buffers.position, 0, values.size() * sizeof(float),
                                      values.data());
    store_.end_frame();
    return values;
  }

  // What is not a number may differ in its bits.
  void expect_same_bits(const ColumnBetween& between) {
    const Column column = column_between(between);
    const std::vector<float> found = on_device(column);
    std::size_t finite = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (std::isnan(found[i]) && std::isnan(column.data()[i])) continue;
      ASSERT_EQ(std::memcmp(&found[i], column.data() + i, sizeof(float)), 0)
          << "value " << i << ": " << found[i] << " and " << column.data()[i];
      finite += std::isfinite(found[i]) ? 1 : 0;
    }
    EXPECT_GT(finite, in_both);
  }

  DeviceContext device_;
  ParticleStore store_;
};
INSTANTIATE_TEST_SUITE_P(InBothShapes, DeviceColumns, ::testing::Bool());

TEST_P(DeviceColumns, HaveTheHostsBits) {
  expect_same_bits(random_between(ColumnBetween::Kind::linear, 1));
  expect_same_bits(random_between(ColumnBetween::Kind::linear, 3));
  expect_same_bits(random_between(ColumnBetween::Kind::logarithmic, 1));
}

TEST_P(DeviceColumns, HaveTheHostsBitsOnPaths) {
  for (const bool is_straight : {true, false}) {
    for (const bool is_periodic : {true, false})
      expect_same_bits(random_paths(is_straight, is_periodic));
  }
}

TEST_P(DeviceColumns, HaveTheHostsBitsWhereTheyFade) {
  ColumnBetween column = random_between(ColumnBetween::Kind::linear, 1);
  column.fades = true;
  column.vanishing = 0.7F;
  column.appearing = 0.3F;
  expect_same_bits(column);
  column.first = column.second = Column::uniform(0.1F);
  expect_same_bits(column);
}

TEST_P(DeviceColumns, TakeTheMemoryOfTheLastFrames) {
  ColumnBetween column = random_between(ColumnBetween::Kind::linear, 1);
  on_device(column_between(column));
  const std::uint64_t bytes = store_.device_bytes();
  for (const float fraction : {0.4F, 0.5F, 0.6F}) {
    column.fraction = fraction;
    expect_same_bits(column);
    EXPECT_EQ(store_.device_bytes(), bytes);
  }
}

TEST_P(DeviceColumns, AreMadeOnceForAllViewsOfAFrame) {
  const Column column = column_between(random_between(ColumnBetween::Kind::linear, 1));
  on_device(column);
  device_.timer.clear();
  on_device(column);
  EXPECT_THAT(device_.timer.times(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace splotchcl
