// Profiles as ICC.1:2004-10 has them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "image/picture_encoders.h"

namespace splotchcl {
namespace {

std::uint32_t number(const std::vector<unsigned char>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | bytes.at(at + i);
  return value;
}

double fixed(const std::vector<unsigned char>& bytes, std::size_t at) {
  return static_cast<std::int32_t>(number(bytes, at)) / 65536.0;
}

std::string text(const std::vector<unsigned char>& bytes, std::size_t at) {
  return {bytes.begin() + static_cast<std::ptrdiff_t>(at),
          bytes.begin() + static_cast<std::ptrdiff_t>(at + 4)};
}

// Where each element begins.
std::map<std::string, std::size_t> elements(const std::vector<unsigned char>& profile) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < number(profile, 128); ++i) {
    const std::size_t entry = 132 + 12 * i;
    const std::size_t place = number(profile, entry + 4);
    EXPECT_EQ(place % 4, 0U);
    EXPECT_LE(place + number(profile, entry + 8), profile.size());
    places[text(profile, entry)] = place;
  }
  return places;
}

TEST(ColorProfile, SaysItsSizeAndWhatItIs) {
  for (const ColorSpace space : {ColorSpace::srgb, ColorSpace::linear}) {
    const std::vector<unsigned char> profile = color_profile(space);
    EXPECT_EQ(number(profile, 0), profile.size());
    EXPECT_EQ(text(profile, 12), "mntr");
    EXPECT_EQ(text(profile, 16), "RGB ");
    EXPECT_EQ(text(profile, 20), "XYZ ");
    EXPECT_EQ(text(profile, 36), "acsp");
  }
}

// Red, green and blue together are the white that profiles refer to.
TEST(ColorProfile, HasPrimariesThatAddUpToWhite) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::srgb);
  auto places = elements(profile);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (const char* primary : {"rXYZ", "gXYZ", "bXYZ"})
      sum += fixed(profile, places.at(primary) + 8 + 4 * axis);
    EXPECT_NEAR(sum, fixed(profile, places.at("wtpt") + 8 + 4 * axis), 5e-4);
  }
}

// The white of D65 becomes that of D50.
TEST(ColorProfile, AdaptsItsWhite) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::linear);
  const std::size_t matrix = elements(profile).at("chad") + 8;
  const double daylight[] = {0.9505, 1, 1.0890}, white[] = {0.9642, 1, 0.8249};
  for (std::size_t row = 0; row < 3; ++row) {
    double sum = 0;
    for (std::size_t column = 0; column < 3; ++column)
      sum += fixed(profile, matrix + 12 * row + 4 * column) * daylight[column];
    EXPECT_NEAR(sum, white[row], 5e-4);
  }
}

TEST(ColorProfile, HasTheCurveOfSrgb) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::srgb);
  const std::size_t curve = elements(profile).at("gTRC");
  EXPECT_EQ(text(profile, curve), "para");
  const auto parameter = [&](std::size_t i) { return fixed(profile, curve + 12 + 4 * i); };
  EXPECT_NEAR(std::pow(parameter(1) * 0.5 + parameter(2), parameter(0)), 0.21404, 1e-4);
  EXPECT_NEAR(parameter(3) * 0.04, 0.04 / 12.92, 1e-5);
}

TEST(ColorProfile, HasNoCurveForLinearLight) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::linear);
  const std::size_t curve = elements(profile).at("rTRC");
  EXPECT_EQ(text(profile, curve), "curv");
  EXPECT_EQ(number(profile, curve + 8), 0U);
}

}  // namespace
}  // namespace splotchcl
