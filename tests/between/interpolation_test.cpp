// Single values between two snapshots against double precision.
#include "between/interpolation.h"

#include "testing.h"

namespace splotchcl {
namespace {

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
