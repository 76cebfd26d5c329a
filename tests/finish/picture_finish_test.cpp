// Pictures as they leave the finishing step, pixel by pixel.
#include "finish/finish_pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

const ScalarMap zero_to_one = {Scaling::linear, 0, 1};

std::string refusal(const std::function<void()>& action) {
  return refusal_by<UsageError>([&] { action(); });
}

// The smallest rectangle that holds all pixels for which `is_inside` says so.
Rectangle bounds(const Image& image, const std::function<bool(const float*)>& is_inside) {
  Rectangle box{image.width, image.height, 0, 0};
  int right = 0, bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!is_inside(image.at(x, y))) continue;
      box.x = std::min(box.x, x);
      box.y = std::min(box.y, y);
      right = std::max(right, x + 1);
      bottom = std::max(bottom, y + 1);
    }
  }
  box.width = std::max(0, right - box.x);
  box.height = std::max(0, bottom - box.y);
  return box;
}

bool is_bright(const float* pixel) {
  return pixel[0] > 0.5F;
}

TEST(PictureFinish, ChangesNoBitWhereNothingIsAskedFor) {
  const FinishScene scene;
  const std::array<float, 3> light = {0.1F, 7, 0.3F};
  EXPECT_EQ(scene.finish(light).pixels, plain_image(400, 300, light).pixels);
}

TEST(PictureFinish, NeedsNoFontWithoutText) {
  FinishScene scene;
  scene.scene.finish.font = "NoSuchFontAnywhere";
  scene.scene.finish.exposure = 1;
  EXPECT_EQ(scene.finish({0.25F, 0.25F, 0.25F}).at(0, 0)[0], 0.5F);
}

TEST(PictureFinish, PutsTextIntoTheCornerThatIsSaid) {
  FinishScene scene;
  scene.scene.finish.title = {"HELM", Anchor::bottom_right, 0.1};
  const Rectangle text = bounds(scene.finish(), is_bright);
  const int margin = 10;  // 0.032 of 300 pixels, rounded
  // Beside an M the font leaves a tenth of its size.
  EXPECT_NEAR(text.x + text.width, 400 - margin, 5);
  EXPECT_NEAR(text.y + text.height, 300 - margin, 1);
  EXPECT_NEAR(text.height, 0.73 * 30, 2);
  EXPECT_GT(text.width, 60);
}

TEST(PictureFinish, ReplacesPlaceholders) {
  FinishScene with, plain;
  with.scene.finish.title.text = "z = {redshift:.1f}";
  plain.scene.finish.title.text = "z = 3.0";
  EXPECT_EQ(with.finish().pixels, plain.finish().pixels);
}

TEST(PictureFinish, GivesTextItsColorAfterGamma) {
  FinishScene scene;
  scene.scene.image.gamma = 2.2;
  scene.scene.finish.text_color = {1, 0.5, 0};
  scene.scene.finish.title = {"█", Anchor::top_left, 0.2};
  const Image image = scene.finish();
  const float* pixel = image.at(25, 25);
  EXPECT_NEAR(pixel[0], 1, 1e-6);
  EXPECT_NEAR(std::pow(static_cast<double>(pixel[1]), 1 / 2.2), 0.5, 1e-6);
  EXPECT_NEAR(pixel[2], 0, 1e-6);
}

TEST(PictureFinish, DoesNotExposeText) {
  FinishScene scene;
  scene.scene.finish.exposure = 3;
  scene.scene.finish.title = {"█", Anchor::top_left, 0.2};
  EXPECT_EQ(scene.finish().at(25, 25)[0], 1.0F);
}

TEST(ScaleBar, IsAsLongAsItsLengthAppears) {
  FinishScene scene;
  scene.scene.finish.scale_bar = {true, Anchor::bottom_left, 73, ""};
  const Image image = scene.finish();
  // The bar's row: the lowest in which anything bright is longer than a cap.
  int longest = 0;
  for (int y = 0; y < image.height; ++y) {
    int count = 0;
    for (int x = 0; x < image.width; ++x)
      count += is_bright(image.at(x, y)) ? 1 : 0;
    longest = std::max(longest, count);
  }
  EXPECT_EQ(longest, 73 * 2);
}

TEST(ScaleBar, ChoosesARoundLength) {
  FinishScene chosen, given;
  chosen.scene.finish.scale_bar.show = true;
  // A fifth of 400 pixels is 40 kpc, and 20 is the round number below.
  given.scene.finish.scale_bar = {true, Anchor::bottom_left, 20, "kpc"};
  EXPECT_EQ(chosen.finish().pixels, given.finish().pixels);
}

TEST(ScaleBar, LongerThanThePictureIsRefused) {
  FinishScene scene;
  scene.scene.finish.scale_bar = {true, Anchor::bottom_left, 250, ""};
  EXPECT_THAT(refusal([&] { scene.finish(); }), HasSubstr("finish.scale_bar: takes 500 x"));
}

Palette red_to_blue() {
  Palette palette;
  palette.emission = {Rgb{1, 0, 0.25F}, Rgb{0, 0, 0.25F}};
  return palette;
}

// The bar's own pixels: nothing else has this blue.
bool is_of_palette(const float* pixel) {
  return pixel[2] == 0.25F && pixel[1] == 0;
}

TEST(ColorBar, ShowsThePalettesLightFromLowToHigh) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.scene.finish.color_bar.show = true;
  scene.scene.image.gamma = 2.2;
  const Image image = scene.finish();
  const Rectangle bar = bounds(image, is_of_palette);
  EXPECT_EQ(bar.height, 180);  // 0.6 of the picture's height
  for (int i = 0; i < bar.height; ++i) {
    const float* pixel = image.at(bar.x + bar.width / 2, bar.y + bar.height - 1 - i);
    ASSERT_NEAR(pixel[0], 1 - (i + 0.5) / bar.height, 1e-6) << i;
  }
}

TEST(ColorBar, HasItsTicksAtTheirColors) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), {Scaling::log, 2.5, 4.5});
  scene.scene.finish.color_bar.show = true;
  scene.scene.finish.text_size = 0.05;
  const Image image = scene.finish();
  const Rectangle bar = bounds(image, is_of_palette);
  // Right of the bar and its frame, long ticks stand at 10^3 and 10^4.
  std::vector<int> rows;
  for (int y = bar.y; y < bar.y + bar.height; ++y) {
    if (is_bright(image.at(bar.x + bar.width + 4, y))) rows.push_back(y);
  }
  ASSERT_EQ(rows.size(), 2U);
  // At a tick's edge, the palette has the colour of the value.
  EXPECT_NEAR(image.at(bar.x + 2, rows[0])[0], 1 - 0.75, 1.0 / bar.height);
  EXPECT_NEAR(image.at(bar.x + 2, rows[1])[0], 1 - 0.25, 1.0 / bar.height);
}

// Opaque matter shows emission over absorption: the palette itself only where it absorbs all colors
// alike and as much as it is bright.
TEST(ColorBar, IsThePicturesOnlyWhereOpaqueMatterHasItsPalettesColors) {
  DrawnComponent component;
  component.palette = red_to_blue();
  component.palette.absorption = {Rgb{1, 1, 1}};
  component.brightness = 3;
  component.absorption = {Absorption::Kind::factor, 3};
  EXPECT_TRUE(keeps_palette(component, {}));
  FinishSettings brighter;
  brighter.exposure = 1;
  EXPECT_FALSE(keeps_palette(component, brighter));
  component.absorption.factor = 2;
  EXPECT_FALSE(keeps_palette(component, {}));
  component.absorption = {Absorption::Kind::as_emission, 0};
  EXPECT_FALSE(keeps_palette(component, {}));
}

TEST(ColorBar, SaysWhatItShowsWhereLightAddsUp) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.scene.finish.color_bar.show = true;
  EXPECT_THAT(tell_color_bars(scene.scene, scene.frame),
              ElementsAre(HasSubstr("single particles of component gas")));
  const auto bars = color_bars_of(scene.scene, scene.frame, {}, true);
  EXPECT_THAT(bars.front().title, HasSubstr(" of particles"));
  scene.scene.finish.color_bar.show = false;
  EXPECT_TRUE(tell_color_bars(scene.scene, scene.frame).empty());
}

TEST(ColorBar, LiesAtTheTopAndBottom) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.scene.finish.color_bar = {true, Anchor::bottom, 0.5, {}, {}};
  const Rectangle bar = bounds(scene.finish(), is_of_palette);
  EXPECT_EQ(bar.width, 200);
  EXPECT_LT(bar.height, 20);
}

// Such as that of a formula in a small picture: it ends in dots.
TEST(ColorBar, HasRoomForLongLabels) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.scene.finish.color_bar = {true, Anchor::right, 0.6, {}, {std::string(300, 'm') + " [kpc]"}};
  EXPECT_EQ(bounds(scene.finish(), is_of_palette).height, 180);
}

TEST(ColorBar, OfEveryColoredComponentShareTheLength) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.add_component("stars", red_to_blue(), zero_to_one);
  scene.scene.finish.color_bar = {true, Anchor::right, 0.6, {}, {"gas", "stars"}};
  const Image image = scene.finish();
  const Rectangle both = bounds(image, is_of_palette);
  EXPECT_NEAR(both.height, 180, 2);
  int rows = 0;
  for (int y = both.y; y < both.y + both.height; ++y)
    rows += is_of_palette(image.at(both.x + 2, y)) ? 1 : 0;
  EXPECT_LT(rows, 175);
  EXPECT_GT(rows, 120);
}

TEST(ColorBar, OfAComponentThatDoesNotExistIsRefused) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.scene.finish.color_bar = {true, Anchor::right, 0.6, {"gass"}, {}};
  const std::string message = refusal([&] { check_finish(scene.scene, scene.snapshot); });
  EXPECT_THAT(message, HasSubstr("finish.color_bar.components"));
  EXPECT_THAT(message, HasSubstr("did you mean gas"));
}

TEST(ColorBar, WithoutAColoredComponentIsRefused) {
  FinishScene scene;
  scene.scene.finish.color_bar.show = true;
  EXPECT_THAT(refusal([&] { check_finish(scene.scene, scene.snapshot); }),
              HasSubstr("finish.color_bar.show"));
}

TEST(ColorBar, WithAnotherNumberOfLabelsIsRefused) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.scene.finish.color_bar = {true, Anchor::right, 0.6, {}, {"one", "two"}};
  EXPECT_THAT(refusal([&] { check_finish(scene.scene, scene.snapshot); }),
              HasSubstr("found 2 labels, expected one for each of 1 bars"));
}

TEST(Inset, ShowsTheSecondViewInItsRectangle) {
  FinishScene scene;
  scene.scene.finish.inset.show = true;
  scene.scene.finish.inset.size = {0.25, 0.3};
  scene.scene.finish.inset.at = Anchor::top_right;
  scene.scene.finish.inset.border = 0.01;
  Frame seen;
  const Image image = scene.finish({0.1F, 0.1F, 0.1F}, [&seen](const Frame& frame) {
    seen = frame;
    return plain_image(frame.width, frame.height, {0, 0.5F, 0});
  });
  EXPECT_EQ(seen.width, 100);
  EXPECT_EQ(seen.height, 90);
  const Rectangle inset = bounds(image, [](const float* p) { return p[1] == 0.5F && p[0] == 0; });
  EXPECT_EQ(inset.width, 100);
  EXPECT_EQ(inset.height, 90);
  const Rectangle with_border = bounds(image, [](const float* p) { return p[1] != 0.1F; });
  EXPECT_EQ(with_border.width, 100 + 2 * 3);
  EXPECT_EQ(with_border.x + with_border.width, 400 - 10);
  EXPECT_EQ(with_border.y, 10);
}

TEST(Inset, HasThePicturesCameraWhereItSaysNothingElse) {
  FinishScene scene;
  Camera camera;
  camera.position = {{1, 2, 3}};
  camera.look_at = {{4, 6, 3}};
  camera.sky = {{0, 0, 1}};
  camera.projection = Projection::orthographic;
  scene.frame.camera = make_camera_frame(camera, 400, 300);
  scene.scene.finish.inset.show = true;
  scene.scene.finish.inset.size = {0.5, 0.5};
  Frame seen;
  const DrawFrame draw = [&seen](const Frame& frame) {
    seen = frame;
    return plain_image(frame.width, frame.height);
  };
  scene.finish({0, 0, 0}, draw);
  EXPECT_NEAR(seen.camera.pixels_per_length, 0.5 * scene.frame.camera.pixels_per_length, 1e-9);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(seen.camera.position.a[i], scene.frame.camera.position.a[i], 1e-12);
    EXPECT_NEAR(seen.camera.forward.a[i], scene.frame.camera.forward.a[i], 1e-12);
    EXPECT_NEAR(seen.camera.down.a[i], scene.frame.camera.down.a[i], 1e-12);
  }
  scene.scene.finish.inset.position = Vec3{{1, 2, 30}};
  scene.scene.finish.inset.field_of_view_degrees = 20;
  scene.finish({0, 0, 0}, draw);
  EXPECT_EQ(seen.camera.position.a[2], 30);
  EXPECT_NEAR(seen.camera.focal_pixels, 100 / std::tan(10 * pi / 180), 1e-9);
}

// Rows that grow along the sky do so in the inset, too, and left stays left.
TEST(Inset, HasThePicturesConvention) {
  FinishScene scene;
  Camera camera;
  camera.position = {{1, 2, 3}};
  camera.look_at = {{4, 6, 3}};
  camera.sky = {{0, 0, 1}};
  camera.projection = Projection::orthographic;
  scene.frame.camera = in_original_convention(make_camera_frame(camera, 400, 300));
  scene.scene.image.convention = PixelConvention::original;
  scene.scene.finish.inset.show = true;
  Frame seen;
  scene.finish({0, 0, 0}, [&seen](const Frame& frame) {
    seen = frame;
    return plain_image(frame.width, frame.height);
  });
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(seen.camera.right.a[i], scene.frame.camera.right.a[i], 1e-12);
    EXPECT_NEAR(seen.camera.down.a[i], scene.frame.camera.down.a[i], 1e-12);
  }
  EXPECT_EQ(seen.camera.center_x, 0.5 * seen.width + 0.5);
}

TEST(Inset, ShowsTheComponentsThatAreNamed) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.add_component("stars", red_to_blue(), zero_to_one);
  scene.scene.finish.inset.show = true;
  scene.scene.finish.inset.components = {"stars"};
  Frame seen;
  scene.finish({0, 0, 0}, [&seen](const Frame& frame) {
    seen = frame;
    return plain_image(frame.width, frame.height);
  });
  ASSERT_EQ(seen.components.size(), 1U);
  EXPECT_EQ(seen.components[0].name, "stars");
  scene.scene.finish.inset.components = {"star"};
  EXPECT_THAT(refusal([&] { check_finish(scene.scene, scene.snapshot); }),
              HasSubstr("did you mean stars"));
}

TEST(Inset, ThatDoesNotFitIsRefusedBeforeAnythingIsDrawn) {
  FinishScene scene;
  scene.scene.finish.inset.show = true;
  scene.scene.finish.inset.size = {1, 0.2};
  EXPECT_THAT(refusal([&] { PictureFinish(scene.scene, scene.frame, scene.snapshot); }),
              HasSubstr("finish.inset: takes"));
}

TEST(Inset, WithACameraThatIsNoneIsRefused) {
  FinishScene scene;
  scene.scene.finish.inset.show = true;
  scene.scene.finish.inset.position = Vec3{{0, 0, 5}};
  scene.scene.finish.inset.look_at = Vec3{{0, 0, 5}};
  EXPECT_THAT(refusal([&] { PictureFinish(scene.scene, scene.frame, scene.snapshot); }),
              HasSubstr("finish.inset: camera.look_at"));
}

// A part of the picture is what it is in the whole one.
TEST(PictureFinish, OfACropIsThatOfThePicture) {
  FinishScene scene;
  scene.add_component("gas", red_to_blue(), zero_to_one);
  scene.scene.finish.title.text = "Title";
  scene.scene.finish.scale_bar.show = true;
  scene.scene.finish.color_bar.show = true;
  scene.scene.finish.inset.show = true;
  scene.scene.finish.inset.at = Anchor::bottom;
  const DrawFrame draw = [](const Frame& frame) {
    return plain_image(frame.width, frame.height, {0, 0.5F, 0});
  };
  const Image whole = scene.finish({0.2F, 0.2F, 0.2F}, draw);
  scene.frame.crop = {5, 9, 371, 280};
  const Image part = scene.finish({0.2F, 0.2F, 0.2F}, draw);
  for (int y = 0; y < 280; ++y) {
    for (int x = 0; x < 371; ++x) {
      for (int c = 0; c < 4; ++c)
        ASSERT_EQ(part.at(x, y)[c], whole.at(x + 5, y + 9)[c]) << x << ", " << y;
    }
  }
}

TEST(CheckFinish, RefusesFontsAndPlaceholdersBeforeAnythingIsRead) {
  FinishScene scene;
  scene.scene.finish.label.text = "{nonsense}";
  EXPECT_THAT(refusal([&] { check_finish(scene.scene, scene.snapshot); }),
              HasSubstr("finish.label.text"));
  scene.scene.finish.label.text = "fine";
  scene.scene.finish.font = "NoSuchFontAnywhere";
  EXPECT_THAT(refusal([&] { check_finish(scene.scene, scene.snapshot); }),
              HasSubstr("finish.font"));
}

}  // namespace
}  // namespace splotchcl::test
