// One way to draw a frame: what comes back of it, mostly with the oracle, which needs no device.
#include "splotchcl/frame_drawer.h"

#include "splotchcl/array_snapshot.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

constexpr const char* scene_text = R"(
snapshot = "arrays"
[image]
size = [16, 12]
[camera]
position = [0, 0, -5]
look_at = [0, 0, 0]
[[component]]
types = ["halo"]
size = { fixed = 0.5 }
palette = "white"
weight = "constant"
)";

class FrameDrawing : public ::testing::Test {
 protected:
  FrameDrawing() { arrays_.set_field(1, "position", position_.data(), 2, 3); }

  static Scene scene(const std::vector<std::string>& settings = {}) {
    return parse_scene(scene_text, "scene", settings);
  }
  DrawnFrame draw(const std::vector<std::string>& settings = {}) {
    arrays_.changed();
    return drawer_.draw(scene(settings), arrays_);
  }
  void spoil_one() { position_[4] = std::numeric_limits<float>::quiet_NaN(); }

  std::vector<float> position_ = {0, 0, 0, 1, 0.5F, 0.3F};
  ArraySnapshot arrays_;
  FrameDrawer drawer_{FrameDrawerOptions{"", true, {}}};
};

// What a color errs by is no part of its light where it comes close to black.
TEST_F(FrameDrawing, SaysWhereNothingBoundsWhatColorsDo) {
  std::vector<float> field = {0.2F, 0.7F};
  arrays_.set_field(1, "warmth", field.data(), 2, 1);
  arrays_.changed();
  FrameDrawerOptions options{"", false, {}};
  options.certify = true;
  FrameDrawer certifies(options);
  const auto notes_with = [&](const std::string& palette) {
    return certifies
        .draw(scene({"component.0.color.field=warmth", "component.0.color.min=0",
                     "component.0.color.max=1", "component.0.palette=" + palette}),
              arrays_)
        .all_notes();
  };
  EXPECT_THAT(notes_with("gray"), IsEmpty());
  EXPECT_THAT(notes_with("gray_r"),
              ElementsAre(HasSubstr("no bound can be given for roundings of this frame's colors")));
}

TEST_F(FrameDrawing, GivesThePictureAndWhatItTook) {
  const DrawnFrame drawn = draw();
  ASSERT_EQ(drawn.pictures.size(), 1U);
  EXPECT_EQ(drawn.pictures[0].image.width, 16);
  EXPECT_GT(drawn.pictures[0].image.at(8, 6)[0], 0.1F);
  EXPECT_EQ(drawn.stats.device, "reference");
  EXPECT_EQ(drawn.stats.particles, 2U);
  EXPECT_EQ(drawn.stats.drawn_particles, 2U);
  EXPECT_THAT(drawn.all_notes(), IsEmpty());
}

TEST_F(FrameDrawing, TellsOfBadParticlesInOneLine) {
  spoil_one();
  const DrawnFrame drawn = draw();
  EXPECT_EQ(drawn.stats.bad_particles, 1U);
  EXPECT_THAT(drawn.all_notes(), ElementsAre(HasSubstr("1 of 2 particles are left out")));
}

TEST_F(FrameDrawing, CountsParticlesOnceForTwoEyes) {
  spoil_one();
  const DrawnFrame drawn = draw({"stereo.angle=3"});
  EXPECT_EQ(drawn.pictures.size(), 2U);
  EXPECT_EQ(drawn.stats.particles, 2U);
  EXPECT_EQ(drawn.stats.bad_particles, 1U);
}

TEST_F(FrameDrawing, TellsWhatLoadingTells) {
  EXPECT_THAT(draw({"camera.look_at=[0,0,-9]"}).notes,
              ElementsAre(HasSubstr("sees none of its particles")));
}

TEST_F(FrameDrawing, TellsHowFarTheReferenceIs) {
  double last = -1;
  FrameDrawer drawer(FrameDrawerOptions{"", true, [&](const std::string& what, double fraction) {
                                          EXPECT_THAT(what, HasSubstr("reference"));
                                          EXPECT_GE(fraction, last);
                                          last = fraction;
                                        }});
  drawer.draw(scene(), arrays_);
  EXPECT_GT(last, 0.5);
}

TEST_F(FrameDrawing, StoresPicturesAsTheSceneSays) {
  const ImageFileOptions usual = image_file_options(scene({"image.gamma=2"}));
  EXPECT_EQ(usual.gamma, 2);
  EXPECT_FALSE(usual.truncates);
  EXPECT_TRUE(usual.dithers);
  EXPECT_FALSE(usual.bits);
  EXPECT_EQ(image_file_options(scene({"image.bits=16"})).bits, 16);
  EXPECT_FALSE(image_file_options(scene({"image.dither=false"})).dithers);
  EXPECT_EQ(usual.metadata.count("splotchcl:version"), 1U);
  const Scene original = scene({"image.convention=original"});
  const ImageFileOptions options = image_file_options(original, {{"splotchcl:frame", "7"}});
  EXPECT_TRUE(options.truncates);
  EXPECT_FALSE(options.dithers);
  EXPECT_EQ(options.metadata.at("splotchcl:frame"), "7");
}

TEST_F(FrameDrawing, WritesEachPictureToItsFile) {
  const test::TemporaryFolder folder;
  const Scene pair = scene({"stereo.angle=3"});
  write_pictures(folder / "a.png", drawer_.draw(pair, arrays_).pictures, image_file_options(pair));
  EXPECT_TRUE(std::filesystem::exists(folder / "a_left.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a_right.png"));
  EXPECT_EQ(folder.count_files(), 2U);
}

class FloatFiles : public FrameDrawing {
 protected:
  // Of a scene whose exposure is not 0.
  Image written(const std::string& name, PictureLight light) {
    FrameDrawerOptions options{"", true, {}};
    options.light = light;
    const Scene exposed = scene({"finish.exposure=2"});
    const DrawnFrame drawn = FrameDrawer(options).draw(exposed, arrays_);
    write_pictures(folder_ / name, drawn.pictures, image_file_options(exposed));
    return read_image(folder_ / name);
  }
  test::TemporaryFolder folder_;
};

TEST_F(FloatFiles, HoldLightWithoutExposure) {
  const Image drawn = draw().pictures[0].image;
  for (const char* name : {"a.exr", "a.tif"})
    EXPECT_EQ(written(name, light_of_file(name)).pixels, drawn.pixels) << name;
}

TEST_F(FloatFiles, HoldWhatADisplayShowsIfThatIsDrawn) {
  const Image shown = draw({"finish.exposure=2"}).pictures[0].image;
  EXPECT_EQ(written("a.exr", PictureLight::shown).pixels, shown.pixels);
}

TEST_F(FloatFiles, SayWhichLightTheyHold) {
  written("a.exr", PictureLight::drawn);
  const auto metadata = read_image_info(folder_ / "a.exr").metadata;
  EXPECT_THAT(metadata.at("splotchcl:light"), HasSubstr("scene-linear"));
  EXPECT_EQ(metadata.at("splotchcl:exposure"), "2");
  for (const char* name : {"a.tif", "a.hdr"}) {
    written(name, PictureLight::both);
    EXPECT_THAT(test::read_text(folder_ / name), HasSubstr("splotchcl:light: scene-linear"));
    EXPECT_THAT(test::read_text(folder_ / name), HasSubstr("splotchcl:exposure: 2"));
  }
}

TEST_F(FloatFiles, AreThoseThatAreNotWholeNumbers) {
  EXPECT_EQ(light_of_file("a.png"), PictureLight::shown);
  EXPECT_EQ(light_of_file("a.exr"), PictureLight::drawn);
  EXPECT_EQ(light_of_file("a.hdr"), PictureLight::drawn);
  EXPECT_EQ(light_of_file("a.tif"), PictureLight::both);
}

// By a device.
class LaterOpening : public FrameDrawing {
 protected:
  DrawnFrame draw_with(FrameDrawer& drawer) { return drawer.draw(scene(), arrays_); }

  static FrameDrawerOptions later(const std::string& device = "") {
    FrameDrawerOptions options{device, false, {}};
    options.opens_later = true;
    return options;
  }
};

TEST_F(LaterOpening, DrawsWhatADeviceDrawsThatIsOpen) {
  FrameDrawer waits, goes_on(later());
  EXPECT_EQ(draw_with(goes_on).pictures[0].image.pixels, draw_with(waits).pictures[0].image.pixels);
  EXPECT_NO_THROW(goes_on.check_device());
}

TEST_F(LaterOpening, TellsEachTimeOfADeviceThatIsNotThere) {
  FrameDrawer drawer(later("no such device"));
  const auto tells = ThrowsMessage<UsageError>(HasSubstr("'no such device'"));
  EXPECT_THAT([&] { draw_with(drawer); }, tells);
  EXPECT_THAT([&] { draw_with(drawer); }, tells);
  EXPECT_THAT([&] { drawer.check_device(); }, tells);
}

}  // namespace
}  // namespace splotchcl
