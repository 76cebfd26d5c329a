#include <gtest/gtest.h>

#include <cmath>

#include "finish/finish_pictures.h"
#include "finish/joined_pictures.h"

namespace splotchcl::test {
namespace {

FinishSettings fading(double fade) {
  FinishSettings finish;
  finish.fade = fade;
  finish.fade_color = {0.5, 0, 1};
  return finish;
}

TEST(Fade, OfZeroLeavesEveryBit) {
  Image image = plain_image(2, 2, {0.1F, 0.2F, 9});
  const Image before = image;
  fade_to_color(image, fading(0), 2.2);
  EXPECT_EQ(image.pixels, before.pixels);
}

// What is left is what the display shows as the colour, after gamma.
TEST(Fade, OfOneIsTheColorAsDisplayed) {
  Image image = plain_image(2, 2, {0.1F, 0.2F, 9});
  fade_to_color(image, fading(1), 2.2);
  EXPECT_NEAR(std::pow(static_cast<double>(image.at(1, 1)[0]), 1 / 2.2), 0.5, 1e-6);
  EXPECT_EQ(image.at(1, 1)[1], 0.0F);
  EXPECT_EQ(image.at(1, 1)[2], 1.0F);
  EXPECT_EQ(image.at(1, 1)[3], 1.0F);
}

TEST(Fade, MixesLinearLight) {
  Image image = plain_image(2, 2, {0.1F, 0.2F, 9});
  fade_to_color(image, fading(0.25), 1);
  EXPECT_FLOAT_EQ(image.at(0, 1)[0], 0.75F * 0.1F + 0.25F * 0.5F);
  EXPECT_FLOAT_EQ(image.at(0, 1)[1], 0.75F * 0.2F);
}

TEST(CrossFadeMix, TakesThePartOfTheOther) {
  Image image = plain_image(2, 1, {1, 0, 4});
  mix(image, plain_image(2, 1, {0, 2, 4}), 0.25);
  EXPECT_FLOAT_EQ(image.at(1, 0)[0], 0.75F);
  EXPECT_FLOAT_EQ(image.at(1, 0)[1], 0.5F);
  EXPECT_FLOAT_EQ(image.at(1, 0)[2], 4.0F);
}

}  // namespace
}  // namespace splotchcl::test
