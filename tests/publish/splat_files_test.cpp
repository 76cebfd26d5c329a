#include "frames/random_frames.h"
#include "publish/viewer_splats.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr int side = 96;

// Looks at the origin; half of the picture's width there is 1.
Frame frame_without_light() {
  Camera camera;
  camera.position = {{0, 0, -4}};
  camera.look_at = {{0, 0, 0}};
  camera.width = 2;
  Frame frame;
  frame.width = frame.height = side;
  frame.crop = {0, 0, side, side};
  frame.camera = make_camera_frame(camera, side, side);
  return frame;
}

ViewerSplat red_splat() {
  ViewerSplat splat;
  splat.deviation = 0.1F;
  splat.color = {1, 0, 0};
  splat.opacity = 0.5F;
  return splat;
}

TEST(ViewerPictures, LetNearSplatsLieOverFarOnes) {
  ViewerSplat near = red_splat(), far = red_splat();
  near.place = {0, 0, -0.5F};
  far.place = {0, 0, 0.5F};
  far.color = {0, 1, 0};
  const Image image = picture_of_viewers({far, near}, frame_without_light());
  const float* const middle = image.at(side / 2, side / 2);
  EXPECT_NEAR(middle[0], 0.5, 0.01);
  EXPECT_NEAR(middle[1], 0.25, 0.01);
  EXPECT_NEAR(middle[3], 0.75, 0.01);
}

TEST(ViewerPictures, LeaveOutWhatIsLessThanAStep) {
  ViewerSplat dim = red_splat();
  dim.opacity = 0.5F / 255;
  EXPECT_EQ(picture_of_viewers({dim}, frame_without_light()).at(side / 2, side / 2)[3], 0);
}

std::vector<LightSplat> lone_splats() {
  std::vector<LightSplat> splats;
  for (const float x : {-0.6F, 0.0F, 0.6F}) {
    LightSplat splat;
    splat.place = {x, 0.3F, 0};
    splat.sigma = 0.15F;
    splat.light = {0.4F, 0.2F, 0.1F};
    splats.push_back(splat);
  }
  return splats;
}

TEST(NearestSplats, ShowLoneSplatsOfLightAsTheyAre) {
  const Frame frame = frame_without_light();
  const std::vector<LightSplat> splats = lone_splats();
  const Image exact = reference::render(as_on_page(frame, splats)).to_float();
  const NearestSplats nearest = nearest_splats(splats, frame, exact, {FinishSettings{}, 2.2});
  EXPECT_LT(nearest.rms_difference, 3.0 / 255);
  EXPECT_LT(nearest.opacity.exponent, 0.6);
}

TEST(NearestSplats, AreNoFartherThanTheFirstGuess) {
  const Frame frame = frame_without_light();
  const DisplayLight display = {FinishSettings{}, 2.2};
  std::vector<LightSplat> splats = lone_splats();
  for (int i = 0; i < 6; ++i)
    splats.insert(splats.end(), splats.begin(), splats.begin() + 3);
  const Image exact = reference::render(as_on_page(frame, splats)).to_float();
  const Image shown = displayed(exact, display);
  const NearestSplats nearest = nearest_splats(splats, frame, exact, display);
  const Image guess =
      picture_of_viewers(viewer_splats(splats, frame, display, LightToOpacity{}), frame);
  double sum = 0;
  for (std::size_t i = 0; i < guess.pixels.size(); ++i) {
    if (i % 4 != 3) sum += std::pow(guess.pixels[i] - shown.pixels[i], 2);
  }
  EXPECT_LT(nearest.rms_difference,
            0.9 * std::sqrt(sum / (0.75 * static_cast<double>(guess.pixels.size()))));
}

TEST(SplatFiles, OfGltfAreAsLongAsTheySay) {
  const std::string file = as_glb({red_splat(), red_splat()}, frame_without_light(), "two");
  const auto number_at = [&](std::size_t place) {
    std::size_t number = 0;
    for (std::size_t i = 4; i-- > 0;)
      number = number << 8 | static_cast<unsigned char>(file[place + i]);
    return number;
  };
  EXPECT_EQ(file.substr(0, 4), "glTF");
  EXPECT_EQ(number_at(8), file.size());
  const std::size_t second_chunk = 20 + number_at(12);
  EXPECT_EQ(second_chunk % 4, 0U);
  EXPECT_EQ(second_chunk + 8 + number_at(second_chunk), file.size());
}

TEST(SplatFiles, OfPlyHaveANumberForEachProperty) {
  const std::string file = as_ply({red_splat(), red_splat(), red_splat()}, "three");
  const std::size_t end = file.find("end_header\n") + 11;
  EXPECT_THAT(file.substr(0, end), HasSubstr("element vertex 3\n"));
  EXPECT_EQ(file.size() - end, 3U * 17 * 4);
}

}  // namespace
}  // namespace splotchcl::test
