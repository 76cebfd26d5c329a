// Who waits for the reference is told how far it is, and may end it.
#include <gtest/gtest.h>

#include <mutex>
#include <stdexcept>
#include <vector>

#include "frames.h"
#include "splotchcl/reference.h"

namespace splotchcl::test {
namespace {

Frame some_frame() {
  Cloud cloud;
  cloud.sigma = 5;
  Palette palette;
  palette.emission = {Rgb{1.0f, 0.5f, 0.25f}};
  return frame_of(64, 200, {component_of({cloud}, palette)});
}

TEST(ReferenceProgress, GrowsToTheWholeFrame) {
  std::vector<double> told;
  std::mutex mutex;
  reference::render(some_frame(), [&](double fraction) {
    const std::lock_guard<std::mutex> lock(mutex);
    told.push_back(fraction);
  });
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
}

// Each thread asks once more at most, so that a picture of many rows ends long before its end.
TEST(ReferenceProgress, EndsAllThreadsByWhatItThrows) {
  int calls = 0;
  std::mutex mutex;
  const auto stop = [&](double) {
    const std::lock_guard<std::mutex> lock(mutex);
    ++calls;
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(reference::render(some_frame(), stop), std::runtime_error);
  EXPECT_GE(calls, 1);
}

TEST(ReferenceProgress, DoesNotChangeThePicture) {
  const Frame frame = some_frame();
  EXPECT_EQ(reference::render(frame, [](double) {}).pixels, reference::render(frame).pixels);
}

}  // namespace
}  // namespace splotchcl::test
