#include "old_header_name.h"
#include "splotchcl/array_snapshot.h"
#include "splotchcl/picture.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/splotchcl_c.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

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
    const std::size_t capacities[] = {image_.size()};
    return splotchcl_draw(renderer_.get(), scene_.get(), particles_.get(), images, capacities, 1,
                          &error_);
  }
  // Refused as a wrong call, with one line.
  void expect_refused(int code, const std::string& why) const {
    EXPECT_EQ(code, 2) << why;
    EXPECT_EQ(error_.code, 2) << why;
    EXPECT_THAT(error_.message, HasSubstr(why));
    EXPECT_EQ(std::strchr(error_.message, '\n'), nullptr);
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
  const std::size_t capacities[] = {image_.size(), image_.size()};
  expect_refused(splotchcl_draw(renderer_.get(), scene_.get(), particles_.get(), images, capacities,
                                2, &error_),
                 "2 images");
  float* const nothing[] = {nullptr};
  expect_refused(splotchcl_draw(renderer_.get(), scene_.get(), particles_.get(), nothing,
                                capacities, 1, &error_),
                 "null pointer");
  EXPECT_EQ(image_[0], -1.0F);
}

TEST_F(CInterface, MemoryTooSmallForAPictureIsRefused) {
  image_.resize(image_.size() - 1);
  expect_refused(draw(), "room for 3071 floats, expected 3072");
  EXPECT_EQ(image_[0], -1.0F);
  float* const images[] = {image_.data()};
  expect_refused(
      splotchcl_draw(renderer_.get(), scene_.get(), particles_.get(), images, nullptr, 1, &error_),
      "capacities");
}

TEST_F(CInterface, CountsThatOverflowAreRefused) {
  const std::vector<double> doubles(6);
  const std::uint64_t too_many[] = {UINT64_MAX, UINT64_MAX / 3 + 1, UINT64_MAX / 12 + 1,
                                    std::uint64_t{1} << 62};
  for (const std::uint64_t count : too_many) {
    splotchcl_particles* const p = particles_.get();
    expect_refused(
        splotchcl_particles_set_floats(p, 2, "position", position_.data(), count, 3, &error_),
        "do not fit into memory");
    expect_refused(
        splotchcl_particles_set_doubles(p, 2, "position", doubles.data(), count, 3, &error_),
        "do not fit into memory");
  }
  EXPECT_EQ(draw(), 0) << error_.message;
}

TEST_F(CInterface, IntegersBeyondFloatsAreTakenForConditions) {
  const std::vector<std::int64_t> ids = {(std::int64_t{1} << 60) + 1, std::int64_t{1} << 60};
  splotchcl_particles* const p = particles_.get();
  ASSERT_EQ(splotchcl_particles_set_integers(p, 1, "tracer", ids.data(), 2, &error_), 0);
  ASSERT_EQ(
      splotchcl_scene_set(scene_.get(),
                          R"(component.0.select.where=["tracer == 1152921504606846976"])", &error_),
      0);
  ASSERT_EQ(draw(), 0) << error_.message;
  const std::vector<float> of_two = image_;
  ASSERT_EQ(splotchcl_particles_clear(p, 1, &error_), 0);
  ASSERT_EQ(splotchcl_particles_set_floats(p, 1, "position", &position_[3], 1, 3, &error_), 0);
  ASSERT_EQ(splotchcl_particles_set_integers(p, 1, "tracer", &ids[1], 1, &error_), 0);
  ASSERT_EQ(draw(), 0) << error_.message;
  EXPECT_EQ(of_two, image_);
}

TEST_F(CInterface, TypesThatAreNoneAreRefused) {
  splotchcl_particles* const p = particles_.get();
  for (const int type : {-1, 32, 1 << 30}) {
    expect_refused(splotchcl_particles_set_floats(p, type, "mass", position_.data(), 2, 1, &error_),
                   "type");
    expect_refused(splotchcl_particles_set_mass(p, type, 1, &error_), "type");
    expect_refused(splotchcl_particles_clear(p, type, &error_), "type");
  }
}

TEST_F(CInterface, ArraysThatAreNotAlignedAreRefused) {
  const auto* const bytes = reinterpret_cast<const char*>(position_.data());
  expect_refused(
      splotchcl_particles_set_floats(particles_.get(), 1, "mass",
                                     reinterpret_cast<const float*>(bytes + 1), 2, 1, &error_),
      "multiple of 4 bytes");
}

TEST_F(CInterface, NumbersThatAreNoneAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, infinity, -infinity, -1.0}) {
    expect_refused(splotchcl_particles_set_mass(particles_.get(), 1, wrong, &error_), "mass");
    expect_refused(splotchcl_particles_set_box_size(particles_.get(), wrong, &error_), "box");
    expect_refused(splotchcl_write_image("never.png", image_.data(), 8, 8, wrong, &error_),
                   "gamma");
  }
  expect_refused(splotchcl_write_image("never.png", image_.data(), 8, 8, 0, &error_), "gamma");
  expect_refused(splotchcl_write_image("never.png", image_.data(), 1 << 30, 1 << 30, 1, &error_),
                 "65536");
  EXPECT_EQ(splotchcl_particles_set_box_size(particles_.get(), 0, &error_), 0);
}

TEST(CInterfaceNull, IsAWrongCallForEveryFunction) {
  splotchcl_error error;
  int width = 0;
  EXPECT_EQ(splotchcl_scene_from_text(nullptr, &error), nullptr);
  EXPECT_EQ(error.code, 2);
  EXPECT_EQ(splotchcl_scene_from_file(nullptr, &error), nullptr);
  EXPECT_EQ(error.code, 2);
  EXPECT_EQ(splotchcl_scene_set(nullptr, nullptr, nullptr), 2);
  EXPECT_EQ(splotchcl_scene_picture_count(nullptr), 0U);
  EXPECT_EQ(splotchcl_scene_picture_size(nullptr, 0, &width, nullptr, nullptr), 2);
  EXPECT_EQ(splotchcl_scene_decide(nullptr, nullptr, nullptr), 2);
  EXPECT_EQ(splotchcl_particles_set_floats(nullptr, 0, nullptr, nullptr, 0, 0, nullptr), 2);
  EXPECT_EQ(splotchcl_particles_set_doubles(nullptr, 0, nullptr, nullptr, 0, 0, nullptr), 2);
  EXPECT_EQ(splotchcl_particles_set_mass(nullptr, 0, 0, nullptr), 2);
  EXPECT_EQ(splotchcl_particles_clear(nullptr, 0, nullptr), 2);
  EXPECT_EQ(splotchcl_particles_set_box_size(nullptr, 0, nullptr), 2);
  EXPECT_EQ(splotchcl_draw(nullptr, nullptr, nullptr, nullptr, nullptr, 0, nullptr), 2);
  EXPECT_EQ(splotchcl_write_image(nullptr, nullptr, 0, 0, 0, nullptr), 2);
}

TEST_F(CInterface, ATypeWithoutParticlesIsNamed) {
  splotchcl_particles_clear(particles_.get(), 1, &error_);
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

TEST(CRanks, AreOfMpisThatAreKnown) {
  const int communicator = 0;
  splotchcl_error error;
  EXPECT_EQ(splotchcl_ranks_new("another MPI", &communicator, &error), nullptr);
  EXPECT_EQ(error.code, 2);
  EXPECT_THAT(error.message, HasSubstr("found another MPI, expected openmpi or mpich"));
  for (const char* const mpi : {static_cast<const char*>(nullptr), "openmpi"}) {
    EXPECT_EQ(splotchcl_ranks_new(mpi, nullptr, &error), nullptr);
    EXPECT_EQ(error.code, 2);
    EXPECT_THAT(error.message, HasSubstr("null pointer"));
  }
}

TEST(CRanks, AreNeeded) {
  splotchcl_error error;
  EXPECT_EQ(splotchcl_renderer_new_for_ranks(nullptr, nullptr, &error), nullptr);
  EXPECT_EQ(error.code, 2);
  EXPECT_EQ(splotchcl_scene_decide_for_ranks(nullptr, nullptr, nullptr, &error), 2);
  EXPECT_THAT(error.message, HasSubstr("the object of ranks is a null pointer"));
  splotchcl_ranks_free(nullptr);
}

}  // namespace
}  // namespace splotchcl::test
