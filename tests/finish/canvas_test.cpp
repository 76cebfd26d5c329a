#include <gtest/gtest.h>

#include "finish/finish_pictures.h"
#include "finish/overlay.h"

namespace splotchcl::test {
namespace {

TEST(Canvas, CoversPartsOfPixelsInPart) {
  Image image(4, 3);
  Canvas canvas(image, {0, 0, 4, 3});
  canvas.fill({0.25, 1, 2.5, 1.5}, {1, 2, 4});
  EXPECT_FLOAT_EQ(image.at(0, 1)[0], 0.375F);
  EXPECT_FLOAT_EQ(image.at(1, 1)[1], 1.0F);
  EXPECT_FLOAT_EQ(image.at(2, 1)[2], 1.0F);
  EXPECT_EQ(image.at(3, 1)[0], 0.0F);
  EXPECT_EQ(image.at(1, 0)[0], 0.0F);
  EXPECT_EQ(image.at(1, 2)[0], 0.0F);
}

TEST(Canvas, LeavesWhatIsNotCovered) {
  Image image = plain_image(2, 1, {1, 1, 1});
  Canvas canvas(image, {0, 0, 2, 1});
  canvas.cover(0, 0, {0, 0, 0}, 0.25F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0.75F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[3], 0.25F);
  EXPECT_FLOAT_EQ(image.at(1, 0)[0], 1.0F);
}

// A bright spot would outshine letters through any shade.
TEST(Canvas, ShadesLightAboveWhiteAsWhite) {
  Image image = plain_image(2, 1, {9, 0.5F, 1});
  Canvas canvas(image, {0, 0, 2, 1});
  TextMask mask;
  mask.width = 1;
  mask.height = 1;
  mask.coverage = {1};
  canvas.shade(mask, 0, 0, {0, 0, 0}, 0.75F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0.25F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[1], 0.125F);
  EXPECT_EQ(image.at(1, 0)[0], 9.0F);
}

TEST(Canvas, OfAPartTakesThePartsPixels) {
  Image part(2, 2);
  Canvas canvas(part, {3, 5, 2, 2});
  canvas.fill({0, 0, 4, 6}, {1, 1, 1});
  EXPECT_EQ(part.at(0, 0)[0], 1.0F);
  EXPECT_EQ(part.at(1, 0)[0], 0.0F);
  EXPECT_EQ(part.at(0, 1)[0], 0.0F);
}

}  // namespace
}  // namespace splotchcl::test
