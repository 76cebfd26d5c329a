#include <gtest/gtest.h>

#include <cmath>

#include "finish/finish_pictures.h"
#include "finish/tone.h"

namespace splotchcl::test {
namespace {

const std::array<float, 3> light = {0.7F, 0.2F, 3.5F};

Image adjusted(const FinishSettings& finish, double gamma = 1,
               const std::array<float, 3>& from = light) {
  Image image = plain_image(3, 2, from);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = 0.375F;
  adjust_light(image, finish, gamma);
  return image;
}

TEST(AdjustLight, LeavesEveryBitWhereNothingIsAskedFor) {
  FinishSettings finish;
  finish.contrast_pivot = 0.3;
  EXPECT_EQ(adjusted(finish, 2.2).pixels, adjusted({}).pixels);
  EXPECT_EQ(adjusted(finish).at(2, 1)[2], 3.5F);
}

TEST(AdjustLight, DoublesWithOneStopOfExposure) {
  FinishSettings finish;
  finish.exposure = 1;
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(adjusted(finish).at(1, 1)[c], 2 * light[static_cast<std::size_t>(c)]);
}

TEST(AdjustLight, IsGrayOfItsLuminanceWithoutSaturation) {
  FinishSettings finish;
  finish.saturation = 0;
  const float luminance = 0.2126F * light[0] + 0.7152F * light[1] + 0.0722F * light[2];
  for (int c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(adjusted(finish).at(0, 0)[c], luminance);
}

TEST(AdjustLight, KeepsGrayWithAnySaturation) {
  FinishSettings finish;
  finish.saturation = 2.5;
  for (int c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(adjusted(finish, 1, {0.4F, 0.4F, 0.4F}).at(0, 0)[c], 0.4F);
}

TEST(AdjustLight, NeverGivesNegativeLightWithMuchSaturation) {
  FinishSettings finish;
  finish.saturation = 4;
  EXPECT_EQ(adjusted(finish).at(0, 0)[1], 0.0F);
}

TEST(AdjustLight, LeavesThePivotOfContrastAndDarkness) {
  FinishSettings finish;
  finish.contrast = 1.7;
  finish.contrast_pivot = 0.7;
  EXPECT_FLOAT_EQ(adjusted(finish).at(0, 0)[0], 0.7F);
  EXPECT_EQ(adjusted(finish, 1, {0, 0, 0}).at(0, 0)[0], 0.0F);
}

// v' = pivot (v / pivot)^contrast for what the display shows, v = L^(1/gamma).
TEST(AdjustLight, ChangesContrastOfDisplayValues) {
  FinishSettings finish;
  finish.contrast = 1.5;
  finish.contrast_pivot = 0.4;
  const double gamma = 2.2;
  const Image image = adjusted(finish, gamma);
  for (std::size_t c = 0; c < 3; ++c) {
    const double shown = std::pow(static_cast<double>(light[c]), 1 / gamma);
    EXPECT_NEAR(std::pow(static_cast<double>(image.at(0, 0)[c]), 1 / gamma),
                0.4 * std::pow(shown / 0.4, 1.5), 1e-5);
  }
}

TEST(AdjustLight, ExposesBeforeItChangesContrast) {
  FinishSettings finish;
  finish.exposure = 1;
  finish.contrast = 2;
  finish.contrast_pivot = 0.4;
  // 0.2 is exposed to the pivot, which contrast leaves.
  EXPECT_FLOAT_EQ(adjusted(finish, 1, {0.2F, 0.2F, 0.2F}).at(0, 0)[0], 0.4F);
}

TEST(AdjustLight, LeavesAlpha) {
  FinishSettings finish;
  finish.exposure = 2;
  finish.saturation = 0.5;
  finish.contrast = 2;
  EXPECT_EQ(adjusted(finish).at(1, 0)[3], 0.375F);
}

}  // namespace
}  // namespace splotchcl::test
