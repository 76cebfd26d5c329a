// How the views of a scene become pictures.
#include "pictures/other_scenes.h"
#include "splotchcl/picture.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot.h"
#include "testing.h"

namespace splotchcl {
namespace {

constexpr int width = 4, height = 4;

Scene scene_with(const std::vector<std::string>& settings) {
  const Scene usual = apply_settings(
      Scene(), {"camera.position=[0,0,-1]", "camera.look_at=[0,0,0]", "image.size=[4,4]"});
  return apply_settings(usual, settings);
}

Frame frame_of(const Scene& scene) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.crop = {0, 0, width, height};
  frame.background = {1, 1, 1};
  frame.projection = scene.camera->projection;
  frame.camera = make_camera_frame(*scene.camera, width, height);
  return frame;
}

// Every view is filled with its number, from 1, in the order of drawing.
std::vector<Picture> numbered(const Scene& scene, std::vector<Frame>* frames = nullptr) {
  float number = 0;
  const auto draw = [&](const Frame& frame) {
    if (frames != nullptr) frames->push_back(frame);
    Image image(frame.crop.width, frame.crop.height);
    ++number;
    for (float& value : image.pixels)
      value = number;
    return image;
  };
  std::vector<std::string> notes;
  return draw_pictures(scene, frame_of(scene), SnapshotInfo(), draw, notes);
}

// The numbers of the views that a picture is put together of, row by row.
std::vector<int> parts(const Picture& picture) {
  std::vector<int> numbers;
  for (int y = 0; y < picture.image.height; y += height) {
    for (int x = 0; x < picture.image.width; x += width)
      numbers.push_back(static_cast<int>(picture.image.at(x + width - 1, y + height - 1)[2]));
  }
  return numbers;
}

std::vector<std::string> suffixes(const std::vector<Picture>& pictures) {
  std::vector<std::string> all;
  for (const Picture& picture : pictures)
    all.push_back(picture.suffix);
  return all;
}

// Light that rises to the right, doubles from drawing to drawing, and is as many times brighter as
// the background.
DrawFrame rising_light() {
  return [number = 0](const Frame& frame) mutable {
    Image image(frame.crop.width, frame.crop.height);
    const auto factor = static_cast<float>(frame.background[0] * (1 << number++));
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x)
        std::fill_n(image.at(x, y), 3, factor * static_cast<float>(1 + frame.crop.x + x));
    }
    return image;
  };
}

using Names = std::vector<std::string>;
using Numbers = std::vector<int>;

TEST(Pictures, AreOneWithoutASuffix) {
  const auto pictures = numbered(scene_with({}));
  EXPECT_EQ(suffixes(pictures), Names{""});
  EXPECT_EQ(parts(pictures[0]), Numbers{1});
}

TEST(Pictures, OfTwoEyesAreTwoFiles) {
  const auto pictures = numbered(scene_with({"stereo.layout=files"}));
  EXPECT_EQ(suffixes(pictures), (Names{"_left", "_right"}));
  EXPECT_EQ(parts(pictures[0]), Numbers{1});
  EXPECT_EQ(parts(pictures[1]), Numbers{2});
}

TEST(Pictures, OfTwoEyesLieBesideEachOther) {
  const auto pictures = numbered(scene_with({"stereo.layout=side_by_side"}));
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(pictures[0].image.width, 2 * width);
  EXPECT_EQ(pictures[0].image.height, height);
  EXPECT_EQ(parts(pictures[0]), (Numbers{1, 2}));
}

TEST(Pictures, OfTheLeftEyeLieOnTop) {
  const auto pictures = numbered(scene_with({"stereo.layout=top_bottom"}));
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(pictures[0].image.height, 2 * height);
  EXPECT_EQ(parts(pictures[0]), (Numbers{1, 2}));
}

TEST(Pictures, OfTwoEyesMayBeSqueezedIntoTheSizeOfOne) {
  const auto beside = numbered(scene_with({"stereo.layout=side_by_side_half"}));
  ASSERT_EQ(beside.size(), 1U);
  const Image& image = beside.front().image;
  EXPECT_EQ(image.width, width);
  EXPECT_EQ(image.height, height);
  EXPECT_EQ(image.at(width / 2 - 1, 3)[0], 1);
  EXPECT_EQ(image.at(width / 2, 3)[0], 2);
  const auto above = numbered(scene_with({"stereo.layout=top_bottom_half"}));
  EXPECT_EQ(above.front().image.at(3, height / 2 - 1)[0], 1);
  EXPECT_EQ(above.front().image.at(3, height / 2)[0], 2);
}

TEST(Pictures, OfSqueezedEyesHaveTheMeanOfTwoPixelsInEach) {
  const Scene scene = scene_with({"stereo.layout=side_by_side_half"});
  std::vector<std::string> notes;
  const Image image =
      draw_pictures(scene, frame_of(scene), SnapshotInfo(), rising_light(), notes).front().image;
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 1.5F);
  EXPECT_FLOAT_EQ(image.at(1, 0)[0], 3.5F);
  EXPECT_FLOAT_EQ(image.at(2, 0)[0], 3);
}

TEST(Pictures, OfAnOddWidthCannotBeSqueezed) {
  EXPECT_THROW(scene_with({"stereo.layout=side_by_side_half", "image.size=[5,4]"}), UsageError);
  EXPECT_NO_THROW(scene_with({"stereo.layout=top_bottom_half", "image.size=[5,4]"}));
}

TEST(Pictures, OfTwoEyesMayBeOneForRedAndCyanGlasses) {
  for (const char* layout : {"anaglyph", "anaglyph_half_color", "anaglyph_gray"}) {
    const Scene scene = scene_with({std::string("stereo.layout=") + layout});
    int drawn = 0;
    const auto draw = [&drawn](const Frame& frame) {
      Image image(frame.crop.width, frame.crop.height);
      std::fill(image.pixels.begin(), image.pixels.end(), drawn++ == 0 ? 0.0F : 0.75F);
      return image;
    };
    std::vector<std::string> notes;
    const auto pictures = draw_pictures(scene, frame_of(scene), SnapshotInfo(), draw, notes);
    ASSERT_EQ(suffixes(pictures), Names{""});
    EXPECT_EQ(pictures[0].image.width, width);
    EXPECT_EQ(drawn, 2);
    EXPECT_LT(pictures[0].image.at(3, 3)[0], 0.1F);  // of the left eye
    EXPECT_GT(pictures[0].image.at(3, 3)[1], 0.6F);  // of the right
  }
}

TEST(Pictures, OfACubeMayBeAnAnaglyph) {
  const auto pictures = numbered(scene_with({"camera.projection=cube", "stereo.layout=anaglyph"}));
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(pictures[0].image.width, 3 * width);
  EXPECT_EQ(pictures[0].image.height, 2 * height);
}

TEST(Pictures, KnowWhichPixelsTheyShow) {
  const Scene scene = scene_with({"stereo.layout=side_by_side"});
  Frame frame = frame_of(scene);
  frame.crop = {1, 2, 3, 2};
  std::vector<std::string> notes;
  const auto pictures = draw_pictures(scene, frame, SnapshotInfo(), rising_light(), notes);
  EXPECT_EQ(pictures[0].places.left, 1);
  EXPECT_EQ(pictures[0].places.top, 2);
  EXPECT_EQ(pictures[0].places.width, 3);
  EXPECT_EQ(pictures[0].places.height, 2);
}

TEST(Pictures, OfTheSecondEyeAreSeenFromTheRight) {
  std::vector<Frame> frames;
  numbered(scene_with({"stereo.angle=3"}), &frames);
  ASSERT_EQ(frames.size(), 2u);
  const double step = 3 * 3.14159265358979323846 / 180;
  EXPECT_EQ(frames[0].camera.position.a[0], 0);
  // The sky is +y and the view +z: right is -x.
  EXPECT_NEAR(frames[1].camera.position.a[0], -step, 1e-12);
}

// Each eye sees the inset with its own eyes: what the inset looks at has no disparity in it.
TEST(Pictures, OfTwoEyesHaveInsetsOfTwoEyes) {
  for (const char* projection : {"perspective", "equirectangular"}) {
    const bool is_wide = std::string(projection) == "equirectangular";
    std::vector<Frame> frames;
    Scene scene = scene_with({"stereo.angle=2", "finish.inset.show=true",
                              "finish.inset.position=[0,0,-7]", "finish.inset.look_at=[0,0,-2]",
                              "finish.inset.border=0", "finish.inset.size=[0.5,0.5]"});
    scene.camera->projection = is_wide ? Projection::equirectangular : Projection::perspective;
    Frame whole;
    whole.width = 80;
    whole.height = 40;
    whole.crop = {0, 0, 80, 40};
    whole.projection = scene.camera->projection;
    whole.camera = make_camera_frame(*scene.camera, whole.width, whole.height);
    std::vector<std::string> notes;
    draw_pictures(
        scene, whole, SnapshotInfo(),
        [&frames](const Frame& frame) {
          frames.push_back(frame);
          return Image(frame.width, frame.height);
        },
        notes);
    ASSERT_EQ(frames.size(), 4U);  // each eye's picture and its inset
    const CameraFrame &left = frames[1].camera, &right = frames[3].camera;
    EXPECT_EQ(frames[1].projection, Projection::perspective);
    EXPECT_EQ(left.position.a[2], -7);
    const double step = 2 * 3.14159265358979323846 / 180 * 5;
    EXPECT_NEAR(left.position.a[0] - right.position.a[0], step, 1e-12);
    // x of the inset's look-at point in both.
    EXPECT_NEAR(left.center_x, right.center_x - right.focal_pixels * step / 5, 1e-9);
  }
}

TEST(Pictures, OfACubeAreOneSheet) {
  std::vector<Frame> frames;
  const auto pictures = numbered(scene_with({"camera.projection=cube"}), &frames);
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(pictures[0].image.width, 3 * width);
  EXPECT_EQ(pictures[0].image.height, 2 * height);
  EXPECT_EQ(parts(pictures[0]), (Numbers{1, 2, 3, 4, 5, 6}));
  // right, left, up; down, front, back
  EXPECT_EQ(frames[4].camera.forward.a[2], 1);
  EXPECT_EQ(frames[5].camera.forward.a[2], -1);
  EXPECT_EQ(frames[2].camera.forward.a[1], 1);
}

TEST(Pictures, OfACubeMayBeSixFiles) {
  const auto pictures = numbered(scene_with({"camera.projection=cube", "camera.cube=files"}));
  EXPECT_EQ(suffixes(pictures), (Names{"_right", "_left", "_up", "_down", "_front", "_back"}));
}

TEST(Pictures, OfTwoEyesMayBeTwoSheets) {
  const auto pictures =
      numbered(scene_with({"camera.projection=cube", "stereo.layout=top_bottom"}));
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(parts(pictures[0]), (Numbers{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
}

TEST(Pictures, HaveTheSizesThatAreToldBefore) {
  for (const char* layout : {"files", "side_by_side", "top_bottom"}) {
    const Scene scene = scene_with({std::string("stereo.layout=") + layout});
    const auto sizes = picture_sizes(scene, width, height);
    const auto pictures = numbered(scene);
    ASSERT_EQ(sizes.size(), pictures.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      EXPECT_EQ(sizes[i].suffix, pictures[i].suffix);
      EXPECT_EQ(sizes[i].width, pictures[i].image.width);
      EXPECT_EQ(sizes[i].height, pictures[i].image.height);
    }
  }
}

TEST(Pictures, OfTwoEyesShareTheExposureThatTheyDecide) {
  const Scene scene = scene_with({"stereo.layout=files", "finish.white=\"auto\""});
  std::vector<std::string> notes;
  const auto pictures =
      draw_pictures(scene, frame_of(scene), SnapshotInfo(), rising_light(), notes);
  for (int x = 0; x < width; ++x)
    EXPECT_FLOAT_EQ(pictures[1].image.at(x, 0)[0], 2 * pictures[0].image.at(x, 0)[0]);
  EXPECT_GT(pictures[1].image.at(width - 1, 0)[0], 0.4F);
  EXPECT_LE(pictures[1].image.at(width - 1, 0)[0], 1);
}

TEST(Pictures, HaveTheWholePicturesExposureInACrop) {
  const Scene scene =
      scene_with({"finish.tone=\"filmic\"", "finish.exposure=\"auto\"", "finish.white=\"auto\""});
  std::vector<std::string> notes;
  Frame frame = frame_of(scene);
  const auto whole = draw_pictures(scene, frame, SnapshotInfo(), rising_light(), notes);
  frame.crop = {1, 2, 2, 1};
  const auto part = draw_pictures(scene, frame, SnapshotInfo(), rising_light(), notes);
  ASSERT_EQ(part[0].image.width, 2);
  ASSERT_EQ(part[0].image.height, 1);
  for (int x = 0; x < 2; ++x)
    EXPECT_EQ(part[0].image.at(x, 0)[1], whole[0].image.at(1 + x, 2)[1]);
}

TEST(Pictures, HaveTheirSuffixBeforeTheEnding) {
  EXPECT_EQ(picture_path("folder/a.b.png", "_left"), "folder/a.b_left.png");
  EXPECT_EQ(picture_path("picture.exr", ""), "picture.exr");
}

// What the message names and what to do must both be there.
void expect_refused(const std::vector<std::string>& settings, const std::string& key,
                    const std::string& expected) {
  try {
    scene_with(settings);
    ADD_FAILURE() << "accepted " << settings.front();
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(key), std::string::npos) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Pictures, ThatNoCameraCanTakeAreRefusedBeforeAnythingIsRead) {
  expect_refused({"camera.look_at=[0,0,-1]"}, "camera.look_at", "another point");
  expect_refused({"camera.sky=[0,0,2]"}, "camera.sky", "parallel to the view");
  expect_refused({"camera.field_of_view=180"}, "camera.field_of_view", "less than 180");
  expect_refused({"camera.field_of_view=0"}, "camera.field_of_view", "> 0");
  expect_refused({"camera.projection=cube", "camera.field_of_view=60"}, "camera.field_of_view",
                 "90");
  expect_refused({"camera.projection=cube", "image.size=[4,3]"}, "image.size", "as high as wide");
  expect_refused({"camera.projection=equirectangular"}, "image.size", "twice as wide as high");
  expect_refused({"camera.projection=fisheye", "camera.near=-1"}, "camera.near", ">= 0");
  expect_refused({"camera.projection=orthographic", "stereo.angle=2"}, "stereo.mode", "toe_in");
  expect_refused({"camera.projection=fisheye", "stereo.mode=toe_in"}, "stereo.mode", "parallel");
  expect_refused({"stereo.angle=0"}, "stereo.angle", "> 0");
  expect_refused({"finish.scale_bar.show=true", "camera.projection=fisheye"},
                 "finish.scale_bar.show", "perspective");
}

DrawnPictures all_light(const Scene& scene, const Frame& frame, PictureLight light) {
  std::vector<std::string> notes;
  OtherScenes others;
  return draw_pictures(scene, frame, SnapshotInfo(), rising_light(), notes, others, light);
}

TEST(LightAsDrawn, IsThatOfExposureZeroBitForBit) {
  const std::vector<std::string> finished = {"finish.exposure=3", "finish.tone=filmic",
                                             "finish.white=5", "finish.bloom=0.2",
                                             "finish.saturation=2"};
  const Scene plain = scene_with({}), scene = scene_with(finished);
  const Picture both = all_light(scene, frame_of(scene), PictureLight::both).pictures[0];
  const Picture drawn = all_light(scene, frame_of(scene), PictureLight::drawn).pictures[0];
  const Picture exposed = all_light(plain, frame_of(plain), PictureLight::shown).pictures[0];
  EXPECT_EQ(both.light.pixels, exposed.image.pixels);
  EXPECT_EQ(drawn.light.pixels, exposed.image.pixels);
  EXPECT_NE(both.image.pixels, exposed.image.pixels);
  EXPECT_TRUE(drawn.image.pixels.empty());
  EXPECT_TRUE(exposed.light.pixels.empty());
}

TEST(LightAsDrawn, IsExposedByWhatItTells) {
  const Scene scene = scene_with({"finish.exposure=auto"});
  const DrawnPictures drawn = all_light(scene, frame_of(scene), PictureLight::drawn);
  EXPECT_TRUE(drawn.finish.exposure);
  EXPECT_EQ(drawn.pictures[0].light.at(3, 0)[0], 4);
}

TEST(LightAsDrawn, FadesAsThePictureDoes) {
  const Scene scene = scene_with({"finish.fade=1", "finish.fade_color=[1,0,0]"});
  const Picture both = all_light(scene, frame_of(scene), PictureLight::both).pictures[0];
  EXPECT_EQ(both.light.pixels, both.image.pixels);
}

TEST(LightAsDrawn, IsNotKeptOfAnaglyphs) {
  const Scene scene = scene_with({"stereo.layout=anaglyph"});
  const Picture both = all_light(scene, frame_of(scene), PictureLight::drawn).pictures[0];
  EXPECT_TRUE(both.light.pixels.empty());
  EXPECT_FALSE(both.image.pixels.empty());
}

// What shines beside a crop glows in it.
TEST(Pictures, GlowInACropAsInTheWhole) {
  const Scene scene = scene_with({"finish.bloom=0.5"});
  Frame frame = frame_of(scene);
  const Image whole = all_light(scene, frame, PictureLight::shown).pictures[0].image;
  frame.crop = {1, 1, 2, 2};
  const Image part = all_light(scene, frame, PictureLight::shown).pictures[0].image;
  ASSERT_EQ(part.width, 2);
  for (int x = 0; x < 2; ++x)
    EXPECT_EQ(part.at(x, 0)[0], whole.at(1 + x, 1)[0]);
}

}  // namespace
}  // namespace splotchcl
