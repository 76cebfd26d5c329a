// Frames filled by hand that no renderer can draw, which scenes refuse before.
#include <gtest/gtest.h>

#include "device/pictures.h"
#include "splotchcl/error.h"

namespace splotchcl::test {
namespace {

class RefusedFrames : public PictureTest {
 protected:
  Frame frame_ = frame_of(20, 10, {component_of({Cloud{}}, one_color(1, 1, 1))});
};

TEST_F(RefusedFrames, HaveACropBesideThePicture) {
  frame_.crop = {15, 0, 6, 10};
  EXPECT_THROW(draw(frame_), UsageError);
}

TEST_F(RefusedFrames, HaveSidesThatKernelsCannotCount) {
  frame_.width = 65537;
  EXPECT_THROW(draw(frame_), UsageError);
}

TEST_F(RefusedFrames, HaveMorePixelsThanKernelsCanCount) {
  frame_.width = frame_.height = 65536;
  frame_.crop = {0, 0, 65536, 65536};
  EXPECT_THROW(draw(frame_), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
