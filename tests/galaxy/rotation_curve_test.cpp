#include "splotchcl/rotation_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "splotchcl/error.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

std::string refusal_of_curve(const std::string& text) {
  try {
    parse_rotation_curve(text, "curve.txt");
  } catch (const DataError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RotationCurve, DefaultIsLinearInsideAndFlatOutside) {
  const RotationCurve curve = RotationCurve::flat(200, 1);
  EXPECT_NEAR(curve.speed(1e-3), 0.2, 1e-6);
  EXPECT_NEAR(curve.speed(100), 200, 0.02);
  EXPECT_NEAR(curve.angular_speed(0), 200 / myr_per_kpc_s_km, 1e-12);
}

TEST(RotationCurve, TableIsLinearBetweenItsPoints) {
  const RotationCurve curve = parse_rotation_curve("# kpc km/s\n1 100\n3, 200\n", "curve.txt");
  EXPECT_DOUBLE_EQ(curve.speed(0.5), 50);
  EXPECT_DOUBLE_EQ(curve.speed(2), 150);
  EXPECT_DOUBLE_EQ(curve.speed(30), 200);
  EXPECT_DOUBLE_EQ(curve.angular_speed(0), 100 / myr_per_kpc_s_km);
  EXPECT_DOUBLE_EQ(curve.angular_speed(2), 75 / myr_per_kpc_s_km);
}

TEST(RotationCurve, OneRowIsRefused) {
  EXPECT_THAT(refusal_of_curve("1 100\n"), HasSubstr("curve.txt: found 1 line with"));
  EXPECT_THAT(refusal_of_curve("# nothing\n"), HasSubstr("found 0 lines"));
}

TEST(RotationCurve, UnsortedRadiiAreRefused) {
  EXPECT_THAT(refusal_of_curve("1 100\n3 200\n2 150\n"),
              HasSubstr("curve.txt:3: radius 2 follows 3"));
  EXPECT_THAT(refusal_of_curve("1 100\n1 200\n"), HasSubstr("curve.txt:2: radius 1 follows 1"));
}

TEST(RotationCurve, NegativeNumbersAreRefused) {
  EXPECT_THAT(refusal_of_curve("1 100\n2 -5\n"), HasSubstr("curve.txt:2: the speed is -5"));
  EXPECT_THAT(refusal_of_curve("-1 100\n2 5\n"), HasSubstr("curve.txt:1: the radius is -1"));
}

TEST(RotationCurve, OtherTextIsRefused) {
  EXPECT_THAT(refusal_of_curve("1\n2 3\n"),
              HasSubstr("curve.txt:1: found '1', expected two numbers"));
  EXPECT_THAT(refusal_of_curve("1 2 3\n"), HasSubstr("expected two numbers"));
  EXPECT_THAT(refusal_of_curve("1 two\n"), HasSubstr("expected two numbers"));
  EXPECT_THAT(refusal_of_curve("0 100\n1 100\n"), HasSubstr("speed 100 at radius 0"));
  EXPECT_THROW(RotationCurve::flat(-1, 1), UsageError);
  EXPECT_THROW(RotationCurve::flat(100, 0), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
