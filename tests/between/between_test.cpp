// Between two moments: what is interpolated, and how.
#include <atomic>

#include "between/interpolation.h"
#include "device/frame/particle_store.h"
#include "splotchcl/particles.h"
#include "testing.h"

namespace splotchcl {
namespace {

using Ids = std::vector<std::uint64_t>;

// The device's columns between two snapshots are the host's, bit for bit.

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
  if (is_periodic)
    setting.period = PeriodicRange{{{0, 0, -40}}, BoxSides(Vec3{{100.1, 70.3, 130}})};
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
    const std::uint64_t number = store_.begin_frame();
    const ParticleBuffers buffers = store_.get(particles, {0, 0, 0});
    std::vector<float> values(column.size());
    device_.queue.enqueue_read_buffer(buffers.position, 0, values.size() * sizeof(float),
                                      values.data());
    store_.end_frame(number);
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
  EXPECT_THAT(device_.timer.times(), IsEmpty());
}

// Columns whose values are made when they are wanted.

// Value i is 2 i; counts how many were made.
class Doubles : public ColumnSource {
 public:
  std::size_t size() const override { return 1000; }
  void make(std::size_t begin, std::size_t end, float* values) const override {
    made += end - begin;
    for (std::size_t i = begin; i < end; ++i)
      values[i - begin] = static_cast<float>(2 * i);
  }
  mutable std::atomic<std::size_t> made{0};
};

class LaterValues : public ::testing::Test {
 protected:
  std::shared_ptr<const Doubles> source_ = std::make_shared<const Doubles>();
  Column column_ = Column::made_by(source_);
};

TEST_F(LaterValues, AreNotMadeBeforeTheyAreWanted) {
  EXPECT_TRUE(column_.is_array());
  EXPECT_EQ(column_.size(), 1000U);
  EXPECT_EQ(column_.source(), source_);
  EXPECT_EQ(source_->made, 0U);
}

TEST_F(LaterValues, AreMadeOneByOneForASample) {
  EXPECT_EQ(column_[500], 1000);
  EXPECT_EQ(column_[3], 6);
  EXPECT_EQ(source_->made, 2U);
}

TEST_F(LaterValues, AreMadeOnceForAllCopies) {
  const Column copy = column_;
  EXPECT_EQ(copy.data()[999], 1998);
  EXPECT_EQ(column_.data(), copy.data());
  EXPECT_EQ(column_[1], 2);
  EXPECT_EQ(source_->made, 1000U);
}

TEST_F(LaterValues, AreMadeAllWhereManyAreWantedOneByOne) {
  for (std::size_t i = 0; i < 1000; ++i)
    ASSERT_EQ(column_[i], static_cast<float>(2 * i));
  EXPECT_LT(source_->made, 1100U);
}

// Particles of two snapshots are found in each other by their ids, however many there are.

// More than one block and many buckets.
constexpr std::size_t many = 300000;

Ids ids_in_any_order(std::size_t count, std::uint64_t first, std::uint64_t step, unsigned seed) {
  Ids ids;
  for (std::uint64_t i = 0; i < count; ++i)
    ids.push_back(first + step * i);
  std::shuffle(ids.begin(), ids.end(), std::mt19937_64(seed));
  return ids;
}

void expect_each_finds_its_own(const Ids& first, const Ids& second) {
  const IdMatch match = match_ids(first, second);
  ASSERT_EQ(match.place_in_second.size(), first.size());
  EXPECT_EQ(match.in_common, first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    ASSERT_EQ(second.at(match.place_in_second[i]), first[i]);
}

TEST(MatchedIds, AreThoseOfTheSameParticleInAnyOrder) {
  expect_each_finds_its_own(ids_in_any_order(many, 1, 1, 1), ids_in_any_order(many, 1, 1, 2));
}

TEST(MatchedIds, MayDifferInTheirUpperBitsAlone) {
  constexpr std::uint64_t step = std::uint64_t{1} << 45;
  expect_each_finds_its_own(ids_in_any_order(many, 3, step, 1), ids_in_any_order(many, 3, step, 2));
}

TEST(MatchedIds, LeaveOutWhatVanishesAndAppears) {
  const Ids first = ids_in_any_order(many, 0, 1, 1),
            second = ids_in_any_order(many, many / 3, 1, 2);
  const IdMatch match = match_ids(first, second);
  EXPECT_EQ(match.in_common, many - many / 3);
  EXPECT_EQ(match.appearing.size(), many / 3);
  EXPECT_TRUE(std::is_sorted(match.appearing.begin(), match.appearing.end()));
  for (const std::uint32_t place : match.appearing)
    ASSERT_GE(second[place], many);
  for (std::size_t i = 0; i < first.size(); ++i)
    ASSERT_EQ(match.place_in_second[i] == IdMatch::nobody, first[i] < many / 3);
  EXPECT_EQ(match.ambiguous, 0U);
}

TEST(MatchedIds, ThatAreSharedMatchNobody) {
  Ids first(many, 7);
  first.push_back(8);
  const IdMatch match = match_ids(first, {8, 7});
  EXPECT_EQ(match.in_common, 1U);
  EXPECT_EQ(match.place_in_second.back(), 0U);
  EXPECT_EQ(match.ambiguous, many);
  EXPECT_THAT(match.appearing, ElementsAre(1));
}

TEST(MatchedIds, OfNobodyAreNone) {
  const IdMatch vanishing = match_ids({1, 2}, {});
  EXPECT_THAT(vanishing.place_in_second, Each(IdMatch::nobody));
  EXPECT_THAT(vanishing.appearing, IsEmpty());
  EXPECT_THAT(match_ids({}, {5, 4}).appearing, ElementsAre(0, 1));
}

// Single values between two snapshots against double precision.

// Of one particle that both have.
float between(float a, float b, double fraction, ColumnBetween::Kind kind) {
  auto match = std::make_shared<IdMatch>();
  match->place_in_second = {0};
  ColumnBetween column;
  column.match = match;
  column.kind = kind;
  column.first = Column::owning({a});
  column.second = Column::owning({b});
  column.fraction = static_cast<float>(fraction);
  float value = 0;
  interpolate(column, 0, 1, &value);
  return value;
}

constexpr auto linear = ColumnBetween::Kind::linear;
constexpr auto logarithmic = ColumnBetween::Kind::logarithmic;

// Each of three roundings of a sum of at most |octaves| errs by 2^-24 of it, the series of the
// logarithms by 2e-8 each, the rest by four roundings; ln 2 of that is the relative error.
double bound_of_logarithmic(double octaves) {
  const double rounding = std::ldexp(1.0, -24);
  return std::log(2.0) * (3 * rounding * std::abs(octaves) + 4e-8 + 2 * rounding) + 4 * rounding;
}

TEST(LogarithmicValues, AreGeometricMeansToSinglePrecision) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> exponent(-30, 30), part(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const float a = std::exp2(exponent(random)), b = std::exp2(exponent(random)), f = part(random);
    const double x = static_cast<double>(a), y = static_cast<double>(b);
    const double exact = x * std::pow(y / x, static_cast<double>(f));
    const double found = static_cast<double>(between(a, b, static_cast<double>(f), logarithmic));
    ASSERT_LE(std::abs(found / exact - 1), bound_of_logarithmic(std::log2(y / x)))
        << a << " to " << b << " at " << f;
  }
}

TEST(LogarithmicValues, SpanAllOfSinglePrecision) {
  constexpr float least = std::numeric_limits<float>::min();
  constexpr float most = std::numeric_limits<float>::max();
  EXPECT_NEAR(std::log2(between(least, most, 0.5, logarithmic)), 1, 1e-4);
  EXPECT_NEAR(std::log2(between(most, least, 0.5, logarithmic)), 1, 1e-4);
  EXPECT_EQ(between(most, most, 0.3, logarithmic), most);
}

TEST(LogarithmicValues, LieBetweenTheirEnds) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> value(1, 1.000001F), part(0, 1);
  for (int i = 0; i < 5000; ++i) {
    const float a = value(random), b = value(random);
    const float found = between(a, b, static_cast<double>(part(random)), logarithmic);
    ASSERT_GE(found, std::min(a, b));
    ASSERT_LE(found, std::max(a, b));
  }
}

TEST(LogarithmicValues, AreLinearWhereAnEndHasNoLogarithm) {
  EXPECT_EQ(between(8, 0, 0.25, logarithmic), 6);
  EXPECT_EQ(between(-8, 8, 0.25, logarithmic), -4);
}

TEST(ValuesBetween, AreNotFiniteWhereAnEndIsNot) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(std::isfinite(between(1, infinity, 0.5, logarithmic)));
  EXPECT_FALSE(std::isfinite(between(std::nanf(""), 1, 0.5, linear)));
}

TEST(ValuesBetween, ThatAreTheSameStayTheSame) {
  EXPECT_EQ(between(0.1F, 0.1F, 0.7, linear), 0.1F);
  EXPECT_EQ(between(0.1F, 0.1F, 0.7, logarithmic), 0.1F);
}

std::shared_ptr<const IdMatch> one_of_each() {
  auto match = std::make_shared<IdMatch>();
  match->place_in_second = {IdMatch::nobody, 0};
  match->appearing = {1};
  return match;
}

ColumnBetween fade_of(const std::shared_ptr<const IdMatch>& match) {
  ColumnBetween fade;
  fade.match = match;
  fade.first = fade.second = Column::uniform(1);
  fade.fraction = 0.25F;
  fade.fades = true;
  fade.vanishing = 0.75F;
  fade.appearing = 0.25F;
  return fade;
}

TEST(FadedColumns, AreProductsThatAreStillMadeWhenWanted) {
  const auto match = one_of_each();
  ColumnBetween mass;
  mass.match = match;
  mass.first = Column::owning({8, 2});
  mass.second = Column::owning({4, 16});
  mass.fraction = 0.25F;
  const Column fade = column_between(fade_of(match));
  const Column product = faded(column_between(mass), fade, 3);
  EXPECT_NE(interpolated(product), nullptr);
  EXPECT_THAT(std::vector<float>(product.data(), product.data() + 3), ElementsAre(6, 2.5F, 4));
  const Column of_one_mass = faded(Column::uniform(2), fade, 3);
  EXPECT_NE(interpolated(of_one_mass), nullptr);
  EXPECT_THAT(std::vector<float>(of_one_mass.data(), of_one_mass.data() + 3),
              ElementsAre(1.5F, 2, 0.5F));
}

TEST(FadedColumns, OfOtherValuesAreProductsAtOnce) {
  const Column product =
      faded(Column::owning({1, 2, 3}), column_between(fade_of(one_of_each())), 3);
  EXPECT_EQ(interpolated(product), nullptr);
  EXPECT_THAT(std::vector<float>(product.data(), product.data() + 3), ElementsAre(0.75F, 2, 0.75F));
}

}  // namespace
}  // namespace splotchcl
