// A picture behind everything, which matter in front of it attenuates.
#include "device/cases.h"
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Every pixel and channel has its own value, so that none may stand for another.
std::shared_ptr<const Image> numbered_pixels(int width, int height, double brightest = 1) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.at(x, y)[c] =
            static_cast<float>(brightest * (1 + (x * 7 + y * 13 + c * 29) % 64) / 64);
      }
    }
  }
  return std::make_shared<const Image>(std::move(image));
}

class BackgroundImage : public PictureTest, public testing::WithParamInterface<PlanAndShape> {
 protected:
  static Frame scene_of(LightPlan plan, int width = 61, int height = 45) {
    CloudSetup setup;
    setup.width = width;
    setup.height = height;
    Frame frame = frame_of(width, height, {random_clouds(setup)});
    DrawnComponent& clouds = frame.components.front();
    if (plan == LightPlan::emission) clouds.absorption = {Absorption::Kind::none, 0};
    if (plan == LightPlan::ordered) clouds.palette.absorption = {Rgb{1, 1, 1}, Rgb{2, 1, 0.5f}};
    EXPECT_EQ(choose_light(frame), plan);
    return frame;
  }
  LightPlan plan() const { return std::get<0>(GetParam()); }
  CompositeShape shape() const { return std::get<1>(GetParam()); }
};

TEST_P(BackgroundImage, AgreesWithTheReference) {
  Frame frame = scene_of(plan());
  frame.background_image = numbered_pixels(61, 45);
  EXPECT_LE(largest_error(draw(frame, shape()), reference::render(frame)), frame.tolerance);
}

TEST_P(BackgroundImage, IsCutAsThePictureIs) {
  Frame frame = scene_of(plan());
  frame.background_image = numbered_pixels(61, 45);
  const ReferenceImage whole = reference::render(frame);
  frame.crop = {13, 7, 30, 21};
  const Image part = draw(frame, shape());
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 30; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = whole.pixels[4 * (static_cast<std::size_t>(y + 7) * 61 +
                                                  static_cast<std::size_t>(x + 13)) +
                                             c];
        ASSERT_NEAR(static_cast<double>(part.at(x, y)[c]), expected,
                    frame.tolerance * std::max(1.0, expected));
      }
    }
  }
}

TEST_P(BackgroundImage, OfOneColorIsThatColor) {
  Frame frame = scene_of(plan());
  frame.background = {0.25, 0.5, 3};
  const Image by_color = draw(frame, shape());
  Image plain(61, 45);
  for (int y = 0; y < 45; ++y) {
    for (int x = 0; x < 61; ++x) {
      plain.at(x, y)[0] = 0.25f;
      plain.at(x, y)[1] = 0.5f;
      plain.at(x, y)[2] = 3;
    }
  }
  frame.background = {0, 0, 0};
  frame.background_image = std::make_shared<const Image>(std::move(plain));
  EXPECT_EQ(draw(frame, shape()).pixels, by_color.pixels);
}

TEST_P(BackgroundImage, TakesThePlaceOfTheColor) {
  Frame frame = scene_of(plan());
  frame.background_image = numbered_pixels(61, 45);
  const Image image = draw(frame, shape());
  frame.background = {9, 9, 9};
  EXPECT_EQ(draw(frame, shape()).pixels, image.pixels);
}

// Matter so thick that a plain background would not show through it, but this one does:
// the early stop has to know the picture's brightest pixel.
TEST_P(BackgroundImage, ShinesThroughThickMatterWhereItIsBright) {
  const Cloud cloud = {0, 0, 1, 200, 10.0 / 400};
  const std::vector<Cloud> clouds(400, cloud);
  DrawnComponent matter = component_of(clouds, one_color(0.1f, 0.1f, 0.1f));
  if (plan() == LightPlan::emission) matter.absorption = {Absorption::Kind::none, 0};
  if (plan() == LightPlan::ordered) matter.palette.absorption = {Rgb{1, 1, 1}};
  if (plan() == LightPlan::proportional) matter.brightness = 10;
  Frame frame = frame_of(64, 48, {matter});
  frame.background_image = numbered_pixels(64, 48, 1e3);
  EXPECT_LE(largest_error(draw(frame, shape()), reference::render(frame)), frame.tolerance);
}

// I = E/A (1 - exp(-tau)) + exp(-tau) I_background, tau the mean column of the pixel.
TEST_P(BackgroundImage, BehindAnAbsorbingCloudIsItsClosedForm) {
  if (plan() == LightPlan::emission) return;  // nothing absorbs
  const Cloud cloud = {0.3, -1.7, 1, 9, 1.8};
  DrawnComponent clouds = component_of({cloud}, one_color(1, 1, 1));
  if (plan() == LightPlan::ordered) clouds.palette.absorption = {Rgb{1, 1, 1}};
  Frame frame = frame_of(60, 44, {clouds});
  frame.background_image = numbered_pixels(60, 44);
  const Image image = draw(frame, shape());
  const auto mean = [&cloud](double center, int i) {
    return 0.5 * std::sqrt(pi) * cloud.sigma *
           (std::erf((i + 1 - center) / cloud.sigma) - std::erf((i - center) / cloud.sigma));
  };
  for (int y = 0; y < 44; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double depth = cloud.column * mean(30 + cloud.x, x) * mean(22 + cloud.y, y);
      const double behind = static_cast<double>(frame.background_image->at(x, y)[1]);
      ASSERT_NEAR(static_cast<double>(image.at(x, y)[1]),
                  -std::expm1(-depth) + std::exp(-depth) * behind, frame.tolerance)
          << x << ", " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PlansAndShapes, BackgroundImage, each_plan_and_shape());

using BackgroundImageSize = PictureTest;

TEST_F(BackgroundImageSize, OtherThanThePicturesIsRefused) {
  Frame frame = frame_of(20, 10, {component_of({Cloud{}}, one_color(1, 1, 1))});
  frame.background_image = numbered_pixels(10, 20);
  EXPECT_THROW(draw(frame), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
