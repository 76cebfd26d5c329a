// How often frames are drawn until they keep their promise.
#include <gtest/gtest.h>

#include <vector>

#include "device/pictures.h"

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
};

// The edges of discs that lie upon one another have no coarse grid that is good enough.
TEST_F(Drawings, OfCutKernelsNeedNoSecondOne) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4})
    EXPECT_EQ(drawings_of(faint_discs_in_one_place(tolerance)), 1U) << tolerance;
}

}  // namespace
}  // namespace splotchcl::test
