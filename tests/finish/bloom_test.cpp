#include "finish/bloom.h"

#include "finish/finish_pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr int width = 120, height = 90;

Image bloomed(Image image, double part) {
  add_bloom(image, part);
  return image;
}

Image point(int x, int y) {
  Image image(width, height);
  std::fill_n(image.at(x, y), 3, 1000.0F);
  return image;
}

Image random_light() {
  std::mt19937 random(3);
  std::exponential_distribution<float> light(0.2F);
  Image image(width, height);
  for (float& value : image.pixels)
    value = light(random);
  return image;
}

double sum_of(const Image& image, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += 4)
    sum += static_cast<double>(image.pixels[i]);
  return sum;
}

TEST(Bloom, KeepsAllLight) {
  const Image image = random_light();
  for (const double part : {0.14, 1.0}) {
    for (const std::size_t channel : {0, 1, 2}) {
      const double before = sum_of(image, channel);
      EXPECT_NEAR(sum_of(bloomed(image, part), channel), before, 1e-4 * before);
    }
  }
}

TEST(Bloom, KeepsTheLightOfAPointInACorner) {
  EXPECT_NEAR(sum_of(bloomed(point(0, 0), 1), 0), 1000, 0.1);
}

TEST(Bloom, IsTheSameAroundEveryPoint) {
  const Image one = bloomed(point(50, 40), 0.5), other = bloomed(point(57, 45), 0.5);
  for (int y = -25; y <= 25; ++y) {
    for (int x = -25; x <= 25; ++x)
      EXPECT_NEAR(one.at(50 + x, 40 + y)[0], other.at(57 + x, 45 + y)[0], 1e-4);
  }
}

TEST(Bloom, AddsUpAsLightDoes) {
  Image both = random_light();
  const Image one = bloomed(both, 0.3), other = bloomed(point(30, 60), 0.3);
  for (std::size_t c = 0; c < 3; ++c)
    both.at(30, 60)[c] += 1000;
  const Image together = bloomed(both, 0.3);
  for (std::size_t i = 0; i < together.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    EXPECT_NEAR(together.pixels[i], one.pixels[i] + other.pixels[i], 1e-3);
  }
}

TEST(Bloom, MakesBellsOfThePointsThatItBlurs) {
  constexpr double two_pi = 6.283185307179586;
  for (const double deviation : {2.0, 5.5}) {
    const Image bell = blurred(point(60, 45), deviation);
    const double peak = 1000 / (two_pi * deviation * deviation);
    for (int x = 0; x < 20; ++x) {
      const double expected = peak * std::exp(-0.5 * x * x / (deviation * deviation));
      EXPECT_NEAR(bell.at(60 + x, 45)[0], expected, 0.08 * peak) << deviation << " at " << x;
      EXPECT_NEAR(bell.at(60 + x, 45)[0], bell.at(60 - x, 45)[0], 1e-9);
    }
  }
}

TEST(Bloom, HasTheWidthThatIsAskedFor) {
  for (const double deviation : {0.3, 1.0, 3.7}) {
    const Image bell = blurred(point(60, 45), deviation);
    double squares = 0;
    for (int x = -40; x <= 40; ++x) {
      for (int y = -40; y <= 40; ++y)
        squares += x * x * static_cast<double>(bell.at(60 + x, 45 + y)[0]) / 1000;
    }
    EXPECT_NEAR(squares, deviation * deviation, 1e-3);
  }
}

TEST(Bloom, OfNoPartChangesNothing) {
  const Image image = random_light();
  EXPECT_EQ(bloomed(image, 0).pixels, image.pixels);
}

TEST(Bloom, LeavesOpacityAlone) {
  const Image image = random_light(), changed = bloomed(image, 0.7);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    EXPECT_EQ(changed.pixels[i], image.pixels[i]);
}

TEST(Bloom, FitsIntoThePictureOfOnePixel) {
  EXPECT_EQ(bloomed(plain_image(1, 1, {2, 3, 4}), 0.5).at(0, 0)[1], 3);
}

}  // namespace
}  // namespace splotchcl::test
