#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "old_header_name.h"
#include "splotchcl/array_snapshot.h"
#include "splotchcl/picture.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/splotchcl_c.h"

namespace splotchcl::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* scene_text = R"(
[image]
size = [32, 24]
[camera]
position = [0, 0, -5]
look_at = [0, 0, 0]
[[component]]
types = ["halo"]
size = { fixed = 0.5 }
palette = "white"
weight = "constant"
)";

struct SceneFree {
  void operator()(splotchcl_scene* scene) const { splotchcl_scene_free(scene); }
};
struct ParticlesFree {
  void operator()(splotchcl_particles* particles) const { splotchcl_particles_free(particles); }
};
struct RendererFree {
  void operator()(splotchcl_renderer* renderer) const { splotchcl_renderer_free(renderer); }
};

class CInterface : public ::testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
    scene_.reset(splotchcl_scene_from_text(scene_text, &error_));
    ASSERT_NE(scene_, nullptr) << error_.message;
    renderer_.reset(splotchcl_renderer_new(nullptr, &error_));
    ASSERT_NE(renderer_, nullptr) << error_.message;
    ASSERT_EQ(splotchcl_particles_set_floats(particles_.get(), 1, "position", position_.data(), 2,
                                             3, &error_),
              0);
  }
  int draw() {
    float* const images[] = {image_.data()};
    return splotchcl_draw(renderer_.get(), scene_.get(), particles_.get(), images, 1, &error_);
  }

  std::vector<float> position_ = {0, 0, 0, 1, 0.5F, 0.3F};
  std::vector<float> image_ = std::vector<float>(4 * 32 * 24, -1.0F);
  splotchcl_error error_ = {};
  std::unique_ptr<splotchcl_scene, SceneFree> scene_;
  std::unique_ptr<splotchcl_renderer, RendererFree> renderer_;
  std::unique_ptr<splotchcl_particles, ParticlesFree> particles_{splotchcl_particles_new()};
};

TEST_F(CInterface, DrawsWhatTheCppInterfaceDraws) {
  ASSERT_EQ(draw(), 0) << error_.message;
  ArraySnapshot arrays;
  arrays.set_field(1, "position", position_.data(), 2, 3);
  const Scene scene = parse_scene(scene_text, "scene", {"snapshot=\"x\""});
  std::vector<std::string> notes;
  Renderer renderer;
  const auto pictures = draw_pictures(
      scene, arrays, [&](const Frame& frame) { return renderer.render(frame); }, notes);
  EXPECT_EQ(image_, pictures.at(0).image.pixels);
  EXPECT_GT(*std::max_element(image_.begin(), image_.end()), 0.1F);
}

TEST_F(CInterface, NotesTellOfBadParticles) {
  position_[4] = std::numeric_limits<float>::quiet_NaN();
  ASSERT_EQ(draw(), 0) << error_.message;
  EXPECT_THAT(splotchcl_renderer_notes(renderer_.get()),
              HasSubstr("1 of 2 particles are left out"));
  position_[4] = 0;
  ASSERT_EQ(draw(), 0) << error_.message;
  EXPECT_STREQ(splotchcl_renderer_notes(renderer_.get()), "");
}

TEST_F(CInterface, SceneCanBeChanged) {
  ASSERT_EQ(splotchcl_scene_set(scene_.get(), "image.size=[16,8]", &error_), 0);
  int width = 0, height = 0;
  ASSERT_EQ(splotchcl_scene_picture_size(scene_.get(), 0, &width, &height, &error_), 0);
  EXPECT_EQ(width, 16);
  EXPECT_EQ(height, 8);
  EXPECT_EQ(splotchcl_scene_picture_count(scene_.get()), 1u);
}

TEST_F(CInterface, DecidedScenesKeepTheirExposure) {
  ASSERT_EQ(splotchcl_scene_decide(scene_.get(), particles_.get(), &error_), 0) << error_.message;
  ASSERT_EQ(draw(), 0);
  const std::vector<float> first = image_;
  // A quarter of the light: without the decision the picture would be exposed anew.
  ASSERT_EQ(splotchcl_scene_set(scene_.get(), "component.0.brightness=0.25", &error_), 0);
  ASSERT_EQ(draw(), 0);
  EXPECT_LT(*std::max_element(image_.begin(), image_.end()),
            *std::max_element(first.begin(), first.end()));
}

TEST_F(CInterface, ErrorsAreCodesAndOneLine) {
  EXPECT_EQ(splotchcl_scene_from_text("colour = 1", &error_), nullptr);
  EXPECT_EQ(error_.code, 2);
  EXPECT_THAT(error_.message, HasSubstr("colour"));
  EXPECT_EQ(std::strchr(error_.message, '\n'), nullptr);
  EXPECT_EQ(splotchcl_scene_from_file("missing.toml", &error_), nullptr);
  EXPECT_NE(error_.code, 0);
  EXPECT_EQ(splotchcl_renderer_new("no such device", &error_), nullptr);
  EXPECT_NE(error_.code, 0);
  EXPECT_EQ(splotchcl_scene_set(scene_.get(), "image.size=[0,0]", nullptr), 2);
  EXPECT_EQ(splotchcl_scene_set(nullptr, "image.width=1", &error_), 2);
  EXPECT_THAT(error_.message, HasSubstr("null pointer"));
}

TEST_F(CInterface, ImagesThatDoNotFitTheSceneAreRefused) {
  float* const images[] = {image_.data(), image_.data()};
  EXPECT_EQ(splotchcl_draw(renderer_.get(), scene_.get(), particles_.get(), images, 2, &error_), 2);
  EXPECT_THAT(error_.message, HasSubstr("2 images"));
  float* const nothing[] = {nullptr};
  EXPECT_EQ(splotchcl_draw(renderer_.get(), scene_.get(), particles_.get(), nothing, 1, &error_),
            2);
  EXPECT_EQ(image_[0], -1.0F);
}

TEST_F(CInterface, ATypeWithoutParticlesIsNamed) {
  splotchcl_particles_clear(particles_.get(), 1);
  EXPECT_NE(draw(), 0);
  EXPECT_THAT(error_.message, HasSubstr("no particles of type 1"));
}

TEST(CInterfaceName, TheOldHeaderStillServesPrograms) {
  EXPECT_TRUE(draws_with_the_old_header_name(scene_text));
}

TEST(CInterfaceNull, FreeFunctionsTakeNull) {
  splotchcl_scene_free(nullptr);
  splotchcl_particles_free(nullptr);
  splotchcl_renderer_free(nullptr);
  EXPECT_STREQ(splotchcl_renderer_notes(nullptr), "");
  EXPECT_STRNE(splotchcl_version(), "");
}

}  // namespace
}  // namespace splotchcl::testing
