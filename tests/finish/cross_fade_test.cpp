#include "finish/effects.h"
#include "finish/finish_picture.h"
#include "finish/finish_pictures.h"
#include "pictures/other_scenes.h"
#include "splotchcl/generate.h"
#include "splotchcl/picture.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class CrossFadeTest : public ::testing::Test {
 protected:
  CrossFadeTest() {
    write("own.toml",
          "snapshot = 'own'\n[image]\nsize = [40, 30]\n"
          "[camera]\nposition = [0, 0, -9]\nlook_at = [0, 0, 0]\n[[component]]\n");
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  Scene own(double amount, const std::string& other = "other.toml") const {
    return read_scene_file(path("own.toml"),
                           {"finish.cross_fade.scene=" + path(other),
                            "finish.cross_fade.amount=" + std::to_string(amount)});
  }
  std::string refusal(const Scene& scene) const {
    return refusal_by<UsageError>([&] { check_finish(scene, {}); });
  }

 private:
  splotchcl::test::TemporaryFolder folder_{"cross_fade"};
};

TEST_F(CrossFadeTest, DrawsTheOtherSceneInThisOnesSize) {
  write("other.toml", "snapshot = 'b'\n[image]\nsize = [9, 9]\n[[component]]\n");
  const auto other = cross_fade_scene(own(0.5));
  ASSERT_TRUE(other.has_value());
  EXPECT_EQ(other->image.width, 40);
  EXPECT_EQ(other->image.height, 30);
  EXPECT_EQ(other->snapshot, path("b"));
}

TEST_F(CrossFadeTest, TakesThisScenesCameraWhereTheOtherHasNone) {
  write("other.toml", "snapshot = 'b'\n[[component]]\n");
  EXPECT_EQ(cross_fade_scene(own(0.5))->camera->position.a[2], -9);
  write("other.toml", "snapshot = 'b'\n[camera]\nposition = [0, 0, 7]\nlook_at = [0, 0, 0]\n");
  EXPECT_EQ(cross_fade_scene(own(0.5))->camera->position.a[2], 7);
}

TEST_F(CrossFadeTest, TakesThisScenesMomentWhereTheRunIsTheSame) {
  const std::string time = "[time]\nsnapshots = 'run_%03d'\nindex = ";
  Scene scene = own(0.5);
  scene.time.pattern = path("run_%03d");
  scene.time.index = 4.25;
  write("other.toml", time + "1\n[[component]]\n");
  EXPECT_EQ(cross_fade_scene(scene)->time.index, 4.25);
  scene.time.pattern = path("another_run_%03d");
  EXPECT_EQ(cross_fade_scene(scene)->time.index, 1);
}

TEST_F(CrossFadeTest, NeedsNoOtherSceneWhereNothingOfItIsSeen) {
  write("other.toml", "snapshot = 'b'\n[[component]]\n");
  EXPECT_FALSE(cross_fade_scene(own(0)).has_value());
}

TEST_F(CrossFadeTest, ToASceneThatIsMissingOrFadesItselfIsRefused) {
  EXPECT_THAT(refusal(own(0.5, "missing.toml")), HasSubstr("missing.toml"));
  EXPECT_THAT(refusal(own(0, "missing.toml")), HasSubstr("missing.toml"));
  write("other.toml", "snapshot = 'b'\n[finish]\ncross_fade.scene = 'own.toml'\n[[component]]\n");
  EXPECT_THAT(refusal(own(0.5)), HasSubstr("fades to another scene itself"));
}

// Both scenes are drawn as an even light, their background's.
class CrossFadeOfPictures : public CrossFadeTest {
 protected:
  CrossFadeOfPictures() {
    GenerateSettings settings;
    settings.particles = 1000;
    write_gadget2(path("own"), generate_halo(settings));
    write("other.toml", "snapshot = 'own'\n[image]\nbackground = [0, 2, 1]\n[[component]]\n");
  }
  Image draw(double amount, const std::string& more = "finish.exposure=0") {
    const Scene scene = apply_settings(own(amount), {more});
    std::vector<std::string> notes;
    const std::vector<Picture> pictures = draw_pictures(
        scene, *open_snapshot(scene.snapshot),
        [this](const Frame& frame) {
          ++drawn;
          std::array<float, 3> light;
          for (std::size_t c = 0; c < 3; ++c)
            light[c] = static_cast<float>(frame.background[c]);
          return plain_image(frame.width, frame.height, light);
        },
        notes);
    EXPECT_EQ(pictures.size(), 1U);
    return pictures.front().image;
  }
  int drawn = 0;
};

TEST_F(CrossFadeOfPictures, MixesTheirLight) {
  const Image image = draw(0.25);
  EXPECT_EQ(drawn, 2);
  EXPECT_EQ(image.width, 40);
  EXPECT_FLOAT_EQ(image.at(39, 29)[1], 0.5F);
}

TEST_F(CrossFadeOfPictures, DrawsOnlyTheSceneThatIsSeen) {
  EXPECT_EQ(draw(0).at(0, 0)[1], 0.0F);
  EXPECT_EQ(drawn, 1);
  EXPECT_EQ(draw(1).at(0, 0)[1], 2.0F);
  EXPECT_EQ(drawn, 2);
}

// What the frames of a film fade to is read once, and decided by the first.
TEST_F(CrossFadeOfPictures, ReadsTheOtherSceneOnce) {
  write("other.toml", "snapshot = 'other'\n[[component]]\ncolor.field = 'U'\n");
  GenerateSettings settings;
  settings.particles = 1000;
  write_gadget2(path("other"), generate_halo(settings));
  const Scene scene = own(1);
  OtherScenes others;
  others.decide(scene);
  std::filesystem::remove(path("other"));
  const auto reference_seen_from = [&](double z) {
    Scene moved = scene;
    moved.camera->position.a[2] = z;
    double reference = 0;
    std::vector<std::string> notes;
    draw_pictures(
        moved, empty_frame(40, 30), SnapshotInfo(),
        [&reference](const Frame& frame) {
          reference = frame.components.at(0).reference_column;
          return plain_image(frame.width, frame.height);
        },
        notes, others);
    return reference;
  };
  EXPECT_EQ(reference_seen_from(-9), reference_seen_from(-90));
}

TEST_F(CrossFadeOfPictures, FadesToAColorAfterwards) {
  EXPECT_FLOAT_EQ(draw(0.5, "finish.fade=0.5").at(3, 3)[1], 0.5F);
}

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
