// How often frames are drawn until they keep their promise.
#include <gtest/gtest.h>

#include <vector>

#include "device/pictures.h"
#include "splotchcl/reference.h"

namespace splotchcl::test {
namespace {

class Drawings : public PictureTest {
 protected:
  static std::size_t drawings_of(const Frame& frame) {
    draw(frame);
    return renderer().stats().check.errors_of_promise.size();
  }

  static Frame faint_discs_in_one_place(double tolerance) {
    const std::vector<Cloud> discs(400, Cloud{3.3, -7.1, 50, 9, 0.002});
    Frame frame = frame_of(100, 70, {component_of(discs, two_colors())});
    frame.kernel.cut = 1.8;
    frame.kernel.sampling = Sampling::center;
    frame.tolerance = tolerance;
    return frame;
  }

  static CloudSetup faint_clouds(int width, int height, double column_low, double column_high) {
    CloudSetup faint;
    faint.width = width;
    faint.height = height;
    faint.count = 2000;
    faint.sigma_high = 3;
    faint.column_low = column_low;
    faint.column_high = column_high;
    return faint;
  }

  // Around pixel 50, 50.
  static Frame crowd_among_faint_clouds(Absorption absorption) {
    const CloudSetup faint = faint_clouds(400, 300, 0.001, 0.02);
    const std::vector<Cloud> crowd(20000, Cloud{-150, -100, 50, 3, 0.5});
    Frame frame = frame_of(faint.width, faint.height,
                           {random_clouds(faint), component_of(crowd, one_color(1, 1, 1))});
    for (DrawnComponent& component : frame.components)
      component.absorption = absorption;
    return frame;
  }

  // In the first and in the last corner, of clouds with these columns.
  static Frame two_crowds(double first, double last) {
    const CloudSetup faint = faint_clouds(600, 450, 1e-5, 2e-4);
    const std::vector<Cloud> before(300, Cloud{-225, -175, 50, 4.5, first});
    const std::vector<Cloud> behind(300, Cloud{225, 175, 50, 4.5, last});
    return frame_of(faint.width, faint.height,
                    {random_clouds(faint), component_of(before, one_color(1, 1, 1)),
                     component_of(behind, one_color(1, 1, 1))});
  }

  // Wide clouds in the middle, whose ends add up around them.
  static Frame cluster_in_the_dark(double tolerance) {
    CloudSetup setup;
    setup.width = 100;
    setup.height = 70;
    setup.count = 4000;
    setup.sigma_low = 8;
    setup.sigma_high = 12;
    setup.column_low = 0.01;
    setup.column_high = 0.3;
    Frame frame = frame_of(400, 300, {random_clouds(setup)});
    frame.components[0].absorption = {Absorption::Kind::gray, 0.2};
    frame.tolerance = tolerance;
    return frame;
  }

  // How many of the pixels from the first column on differ, and of those before it.
  static std::pair<int, int> differences(const Image& a, const Image& b, int first) {
    int beyond = 0, before = 0;
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x)
        (x < first ? before : beyond) += !std::equal(a.at(x, y), a.at(x, y) + 4, b.at(x, y));
    }
    return {beyond, before};
  }
};

// The edges of discs that lie upon one another have no coarse grid that is good enough.
TEST_F(Drawings, OfCutKernelsNeedNoSecondOne) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4})
    EXPECT_EQ(drawings_of(faint_discs_in_one_place(tolerance)), 1U) << tolerance;
}

TEST_F(Drawings, InOrderAreOneWhereAllEndsAreKnownBefore) {
  for (const double tolerance : {1e-3, 1e-5}) {
    const Frame frame = cluster_in_the_dark(tolerance);
    EXPECT_EQ(drawings_of(frame), 1U) << tolerance;
    renderer().render(frame, make_plan(frame));
    EXPECT_GT(renderer().stats().check.errors_of_promise.size(), 1U)
        << "a plan that does not know them, " << tolerance;
  }
}

// Splats above white stay on the picture's own grid up to a larger width than others, or on finer
// ones: that is where they are expected to lie upon one another.
TEST_F(Drawings, OfBrightCrowdsAreOneWhereTheirGridIsKnownBefore) {
  EXPECT_EQ(drawings_of(two_crowds(2, 2)), 1U);
}

// Whichever part is drawn last.
TEST_F(Drawings, OfPartsTellOfTheWorstOfAllBlocks) {
  for (const bool is_first_brighter : {false, true}) {
    const Frame frame = is_first_brighter ? two_crowds(20, 2) : two_crowds(2, 20);
    renderer().render(frame, make_plan(frame));
    const FrameCheck& check = renderer().stats().check;
    EXPECT_NEAR(check.worst.sum(), check.errors_of_promise.back(),
                1e-5 * check.errors_of_promise.back());
  }
}

TEST_F(Drawings, AfterTheFirstAreOfThePartsThatBrokeThePromise) {
  DeviceContext device(choose_device(""));
  for (const Absorption& absorption : {Absorption{}, Absorption{Absorption::Kind::gray, 0.2}}) {
    const Frame frame = crowd_among_faint_clouds(absorption);
    const Image image = renderer().render(frame, make_plan(frame));
    const std::vector<double>& errors = renderer().stats().check.errors_of_promise;
    ASSERT_GT(errors.size(), 1U);
    EXPECT_GT(errors.front(), 1);
    EXPECT_LE(errors.back(), 1);
    const Image first = draw_once(device, frame, CompositeShape::rows);
    const auto [far_away, around_the_crowd] = differences(image, first, 200);
    EXPECT_EQ(far_away, 0);
    EXPECT_GT(around_the_crowd, 0);
    EXPECT_LE(largest_difference(image, reference::render(frame).to_float()), frame.tolerance);
  }
}

}  // namespace
}  // namespace splotchcl::test
