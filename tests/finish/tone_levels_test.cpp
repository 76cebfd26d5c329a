// What a scene leaves to its picture: exposure and white.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "finish/finish_pictures.h"
#include "finish/tone.h"

namespace splotchcl::test {
namespace {

FinishSettings open(ToneCurve curve) {
  FinishSettings finish;
  finish.tone = curve;
  finish.exposure.reset();
  finish.white.reset();
  return finish;
}

// Gray light over many powers of ten, in a part of the picture.
Image field_of_light(double filled, double octaves, double factor = 1) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  Image image(200, 200);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    if (unit(random) >= filled) continue;
    const auto light = static_cast<float>(factor * std::exp2(octaves * unit(random)));
    std::fill_n(&image.pixels[i], 3, light);
  }
  return image;
}

LightHistogram histogram(const Image& image) {
  LightHistogram light;
  light.add(image);
  return light;
}

FinishSettings levels(const FinishSettings& finish, const Image& image) {
  return with_any_tone(finish, histogram(image));
}

// The part of all pixels whose brightest channel is at least this after finishing.
double part_from(double least, Image image, const FinishSettings& finish) {
  adjust_light(image, finish, 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    if (std::max({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}) >= least) ++count;
  }
  return 4 * static_cast<double>(count) / static_cast<double>(image.pixels.size());
}

TEST(ToneLevels, StayWhereTheSceneGivesThem) {
  FinishSettings finish;
  finish.exposure = -2;
  finish.white = 3;
  const FinishSettings found = levels(finish, field_of_light(1, 10));
  EXPECT_EQ(found.exposure, -2);
  EXPECT_EQ(found.white, 3);
}

TEST(ToneLevels, LetHardlyAnythingBeWhite) {
  for (const ToneCurve curve : {ToneCurve::linear, ToneCurve::asinh, ToneCurve::filmic}) {
    for (const double octaves : {0.0, 3.0, 12.0, 24.0}) {
      const Image image = field_of_light(0.7, octaves, 1e-3);
      EXPECT_LE(part_from(0.996, image, levels(open(curve), image)), 0.005) << octaves;
    }
  }
}

TEST(ToneLevels, ShowAQuarterOfThePicture) {
  for (const ToneCurve curve : {ToneCurve::asinh, ToneCurve::filmic}) {
    for (const double octaves : {0.0, 3.0, 12.0, 24.0}) {
      const Image image = field_of_light(0.7, octaves, 1e3);
      EXPECT_GE(part_from(0.02, image, levels(open(curve), image)), 0.25) << octaves;
    }
  }
}

TEST(ToneLevels, ShowAsMuchAsMatterFills) {
  const Image image = field_of_light(0.1, 8);
  EXPECT_GE(part_from(0.02, image, levels(open(ToneCurve::filmic), image)), 0.098);
}

TEST(ToneLevels, AreNotLedAstrayByAFewBrightStars) {
  Image image = field_of_light(0.9, 6);
  const FinishSettings without = levels(open(ToneCurve::asinh), image);
  for (std::size_t i = 0; i < 20; ++i)
    image.pixels[4000 * i] = 1e20F;
  const FinishSettings with = levels(open(ToneCurve::asinh), image);
  EXPECT_NEAR(*with.exposure, *without.exposure, 0.1);
  EXPECT_NEAR(*with.white / *without.white, 1, 0.05);
}

TEST(ToneLevels, FollowTheUnitOfLight) {
  const FinishSettings once = levels(open(ToneCurve::filmic), field_of_light(1, 10));
  const FinishSettings dimmer = levels(open(ToneCurve::filmic), field_of_light(1, 10, 1.0 / 1024));
  EXPECT_NEAR(*dimmer.exposure, *once.exposure + 10, 1e-9);
  EXPECT_EQ(dimmer.white, once.white);
}

TEST(ToneLevels, DoNotHangOnLastDigits) {
  const Image image = field_of_light(1, 10);
  Image other = image;
  for (float& value : other.pixels)
    value *= 1 + 1e-6F;
  const FinishSettings a = levels(open(ToneCurve::filmic), image);
  const FinishSettings b = levels(open(ToneCurve::filmic), other);
  EXPECT_EQ(a.exposure, b.exposure);
  EXPECT_EQ(a.white, b.white);
}

TEST(ToneLevels, ExposeForTheWhiteThatIsGiven) {
  FinishSettings finish = open(ToneCurve::asinh);
  finish.white = 4;
  const Image image = field_of_light(1, 10);
  const FinishSettings found = levels(finish, image);
  EXPECT_EQ(found.white, 4);
  EXPECT_LE(part_from(1, image, found), 0.003);
  EXPECT_GT(part_from(0.95, image, found), 0.003);
}

TEST(ToneLevels, FindNothingInABlackPicture) {
  const Image black(4, 4);
  EXPECT_FALSE(with_tone_of(open(ToneCurve::filmic), histogram(black)));
  const FinishSettings any = levels(open(ToneCurve::filmic), black);
  EXPECT_EQ(any.exposure, 0);
  EXPECT_EQ(any.white, 1);
}

TEST(ToneLevels, OfOneAreTakenWhereAnotherLeavesThemOpen) {
  FinishSettings found;
  found.exposure = 3;
  found.white = 5;
  FinishSettings finish;
  finish.exposure = -1;
  finish.white.reset();
  take_tone(found, finish);
  EXPECT_EQ(finish.exposure, -1);
  EXPECT_EQ(finish.white, 5);
}

}  // namespace
}  // namespace splotchcl::test
