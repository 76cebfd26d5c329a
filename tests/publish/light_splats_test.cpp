#include "publish/light_splats.h"

#include "frames/random_frames.h"
#include "publish/web_page.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// What can be on a page of a made-up scene; none for scenes that cannot.
std::vector<Frame> frames_of_pages(std::uint64_t seeds) {
  std::vector<Frame> frames;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Frame frame = SceneMaker(seed).make();
    try {
      check_page(frame);
    } catch (const UsageError&) {
      continue;
    }
    frames.push_back(as_on_page(frame));
  }
  return frames;
}

TEST(LightSplats, AreWhatTheReferenceDrawsOfTheParticles) {
  const std::vector<Frame> frames = frames_of_pages(200);
  ASSERT_GE(frames.size(), 30U);
  for (const Frame& frame : frames) {
    const ReferenceImage of_particles = reference::render(frame);
    const ReferenceImage of_splats = reference::render(as_on_page(frame, light_splats(frame)));
    double worst = 0;
    for (std::size_t i = 0; i < of_particles.pixels.size(); ++i) {
      const double error = std::abs(of_splats.pixels[i] - of_particles.pixels[i]);
      worst = std::max(worst, error / std::max(1.0, std::abs(of_particles.pixels[i])));
    }
    // Places, widths and light are rounded to single precision: a place by 2^-24 of its distance
    // from the point looked at, which is up to some ten widths of a picture of 70 pixels.
    EXPECT_LT(worst, 1e-4);
  }
}

TEST(LightSplats, LeaveOutBadParticlesAndDarkOnes) {
  Frame frame = SceneMaker(1).make();
  frame.components.resize(1);
  const std::vector<Cloud> clouds = {{}, {}, {}};
  DrawnComponent& component = frame.components.front();
  component = component_of(clouds, {"white", {{1, 1, 1}}, {}});
  component.particles.weight = Column::owning({1, 0, -1});
  EXPECT_EQ(light_splats(frame).size(), 1U);
}

TEST(Pages, RefuseWhatTheyCannotShow) {
  Frame frame = SceneMaker(1).make();
  frame.components.resize(1);
  DrawnComponent& component = frame.components.front();
  component.absorption = {Absorption::Kind::none, 0};
  EXPECT_NO_THROW(check_page(frame));
  component.absorption = {Absorption::Kind::gray, 1};
  EXPECT_THROW(check_page(frame), UsageError);
  component.absorption = {Absorption::Kind::none, 0};
  frame.projection = Projection::fisheye;
  EXPECT_THROW(check_page(frame), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
