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

// Where the order counts, one channel after the other.
std::vector<double> drawn_as_splats(const Frame& frame) {
  const std::vector<LightSplat> splats = light_splats(frame);
  if (!is_ordered(frame)) return reference::render(as_on_page(frame, splats)).pixels;
  std::vector<double> pixels;
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const auto drawn = reference::render(as_on_page(frame, splats, channel % 3)).pixels;
    pixels.resize(drawn.size());
    for (std::size_t i = channel; i < drawn.size(); i += 4)
      pixels[i] = drawn[i];
  }
  return pixels;
}

double worst_error(const Frame& frame) {
  const ReferenceImage of_particles = reference::render(frame);
  const std::vector<double> of_splats = drawn_as_splats(frame);
  double worst = 0;
  for (std::size_t i = 0; i < of_particles.pixels.size(); ++i) {
    // Of all channels together, which no single one of them knows.
    if (is_ordered(frame) && i % 4 == 3) continue;
    const double error = std::abs(of_splats[i] - of_particles.pixels[i]);
    worst = std::max(worst, error / std::max(1.0, std::abs(of_particles.pixels[i])));
  }
  return worst;
}

bool has_gray_matter(const Frame& frame) {
  return std::any_of(frame.components.begin(), frame.components.end(), [](const DrawnComponent& c) {
    return c.absorption.kind == Absorption::Kind::gray;
  });
}

TEST(LightSplats, AreWhatTheReferenceDrawsOfTheParticles) {
  std::size_t ordered = 0, others = 0;
  for (const Frame& frame : frames_of_pages(400)) {
    // Its light depends on how wide a pixel makes it.
    if (has_gray_matter(frame)) continue;
    ++(is_ordered(frame) ? ordered : others);
    // Places, widths and light are rounded to single precision: a place by 2^-24 of its distance
    // from the point looked at, which is up to some ten widths of a picture of 70 pixels.
    EXPECT_LT(worst_error(frame), 1e-4);
  }
  EXPECT_GE(ordered, 30U);
  EXPECT_GE(others, 30U);
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
  frame.sort = {};
  frame.components.resize(1);
  DrawnComponent& component = frame.components.front();
  component.absorption = {Absorption::Kind::none, 0};
  EXPECT_NO_THROW(check_splat_file(frame));
  component.absorption = {Absorption::Kind::gray, 1};
  EXPECT_NO_THROW(check_page(frame));
  EXPECT_THROW(check_splat_file(frame), UsageError);
  frame.sort.descending = true;
  EXPECT_THROW(check_page(frame), UsageError);
  component.absorption = {Absorption::Kind::none, 0};
  EXPECT_NO_THROW(check_page(frame));
  frame.projection = Projection::fisheye;
  EXPECT_THROW(check_page(frame), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
