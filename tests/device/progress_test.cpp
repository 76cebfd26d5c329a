// Who waits for a picture is told how far it is, and may end it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

using ::testing::ElementsAre;

// Where nothing absorbs, the device takes one component after the other.
Frame frame_of_components(int count) {
  std::vector<DrawnComponent> components;
  for (int i = 0; i < count; ++i) {
    components.push_back(random_clouds({60, 40, 30}));
    components.back().absorption = {Absorption::Kind::none, 0};
  }
  return frame_of(40, 30, components);
}

TEST(Progress, GrowsFromPartToPart) {
  std::vector<double> told;
  RendererOptions options;
  options.progress = [&told](double fraction) { told.push_back(fraction); };
  Renderer(options).render(frame_of_components(4));
  // The frame may be drawn again.
  ASSERT_GE(told.size(), 4U);
  told.resize(4);
  EXPECT_THAT(told, ElementsAre(0, 0.25, 0.5, 0.75));
}

TEST(Progress, IsNotToldOfOnePart) {
  int calls = 0;
  RendererOptions options;
  options.progress = [&calls](double) { ++calls; };
  Renderer(options).render(frame_of_components(1));
  EXPECT_EQ(calls, 0);
}

TEST(Progress, EndsADrawingByWhatItThrows) {
  bool is_enough = true;
  RendererOptions options;
  options.progress = [&is_enough](double fraction) {
    if (is_enough && fraction > 0.3) throw std::runtime_error("enough");
  };
  Renderer renderer(options);
  const Frame frame = frame_of_components(4);
  EXPECT_THROW(renderer.render(frame), std::runtime_error);
  is_enough = false;
  EXPECT_EQ(renderer.render(frame).pixels, Renderer().render(frame).pixels);
}

}  // namespace
}  // namespace splotchcl::test
