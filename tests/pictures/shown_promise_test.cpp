// Errors count in units of what is shown as white, whatever exposure and tone make of light.
#include "device/pictures.h"
#include "finish/tone.h"
#include "frames/random_frames.h"
#include "pictures/other_scenes.h"
#include "pictures/units_of_white.h"
#include "reference/frames.h"
#include "splotchcl/reference.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

FinishSettings random_finish(Random& random) {
  FinishSettings finish;
  finish.exposure = random.uniform(-3, 14);
  constexpr ToneCurve curves[] = {ToneCurve::linear, ToneCurve::asinh, ToneCurve::filmic};
  finish.tone = curves[static_cast<int>(random.uniform(0, 3))];
  finish.white = random.logarithmic(0.3, 30);
  finish.saturation = random.uniform(0, 2);
  finish.contrast = random.uniform(1, 1.5);
  return finish;
}

Image shown(Image light, const FinishSettings& finish) {
  adjust_light(light, finish, 2.2);
  return light;
}

// The largest over what is promised of what is shown; beyond what places are known to, which is
// that of other tests.
double error_of_promise(const Image& light, const Image& exact, const Frame& frame,
                        const FinishSettings& finish) {
  const Image picture = shown(light, finish), reference = shown(exact, finish);
  double worst = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double right = static_cast<double>(reference.pixels[i]);
    const double error = std::abs(static_cast<double>(picture.pixels[i]) - right);
    worst = std::max(worst, error / (frame.tolerance * std::max(1.0, right)));
  }
  return worst;
}

// Clouds of some pixels, whose places are known well enough at any exposure.
Frame frame_of_wide_clouds(std::uint64_t seed) {
  Frame frame = SceneMaker(seed).make();
  frame.kernel = {};
  frame.kernel.min_radius_pixels = 4;
  frame.tolerance = 1e-2;
  return frame;
}

class ShownPromise : public PictureTest {};

TEST_F(ShownPromise, HoldsAtRandomExposures) {
  int broken_where_light_counts = 0;
  const auto draw = [](const Frame& frame) { return renderer().render(frame); };
  for (const std::uint64_t seed : seeds(1, 400, 2)) {
    Random random(seed);
    const Frame frame = frame_of_wide_clouds(seed);
    const FinishSettings finish = random_finish(random);
    const Image exact = reference::render(frame).to_float();
    const Image counted = with_errors_counted(draw, display_gain(finish, 2.2))(frame);
    EXPECT_LE(error_of_promise(counted, exact, frame, finish), 1)
        << "seed " << seed << ", exposure " << *finish.exposure << ", white " << *finish.white;
    broken_where_light_counts += error_of_promise(draw(frame), exact, frame, finish) > 1;
  }
  EXPECT_GT(broken_where_light_counts, 0) << "these scenes put nothing to the test";
}

TEST(DisplayGain, IsThatOfExposure) {
  FinishSettings finish;
  finish.exposure = 7;
  EXPECT_EQ(display_gain(finish, 2.2).total(), 128);
  finish.white = 4;
  EXPECT_EQ(display_gain(finish, 2.2).total(), 32);
}

TEST(DisplayGain, TakesInWhereACurveIsSteepest) {
  for (const ToneCurve curve : {ToneCurve::asinh, ToneCurve::filmic}) {
    for (const double white : {0.05, 1.0, 40.0}) {
      const double slope = steepest_slope(curve, white);
      for (double light = 1e-5; light < white; light *= 1.1) {
        const double step = 1e-4 * light;
        EXPECT_LE((tone(curve, light + step, white) - tone(curve, light, white)) / step,
                  1.001 * slope)
            << light;
      }
    }
  }
}

TEST(DisplayGain, LoosensNoPromise) {
  FinishSettings finish;
  finish.exposure = -5;
  EXPECT_EQ(display_gain(finish, 2.2).total(), 1);
}

// A picture that leaves its exposure open, and how bright the backgrounds were that it was drawn
// on.
std::vector<double> backgrounds_drawn(bool keeps_promise) {
  const Scene scene = apply_settings(
      Scene(), {"camera.position=[0,0,-1]", "camera.look_at=[0,0,0]", "finish.exposure=auto"});
  Frame frame = empty_frame(4, 4);
  frame.background = {1e-3, 1e-3, 1e-3};
  std::vector<double> backgrounds;
  const auto draw = [&](const Frame& drawn) {
    backgrounds.push_back(drawn.background[0]);
    Image image(4, 4);
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<float>(drawn.background[0]));
    return image;
  };
  std::vector<std::string> notes;
  OtherScenes others;
  draw_pictures(scene, frame, SnapshotInfo(), draw, notes, others, PictureLight::shown,
                [&](double) { return keeps_promise; });
  return backgrounds;
}

TEST(FoundExposure, HasPicturesDrawnAgainThatAreNotGoodEnoughUnderIt) {
  const std::vector<double> backgrounds = backgrounds_drawn(false);
  ASSERT_EQ(backgrounds.size(), 2U);
  EXPECT_GE(backgrounds[1], 250 * backgrounds[0]);
}

TEST(FoundExposure, LeavesPicturesThatAreGoodEnough) {
  EXPECT_EQ(backgrounds_drawn(true).size(), 1U);
}

}  // namespace
}  // namespace splotchcl::test
