// A crop has the bits of the whole picture, in every projection, where both are drawn with the same
// plan.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "device/pictures.h"
#include "long_tests.h"
#include "projections/wide_frames.h"

namespace splotchcl::test {
namespace {

const std::vector<Projection> projections = {Projection::perspective, Projection::orthographic,
                                             Projection::fisheye, Projection::equirectangular,
                                             Projection::cube};
const std::vector<Projection> some_projections = {Projection::equirectangular, Projection::cube};

// Clouds all around the camera, some in front of others.
Frame clouds_around(Projection projection, bool ordered, double tolerance) {
  Random random(71);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 300; ++i) {
    const Vec3 direction = {{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
    clouds.push_back(cloud_towards(direction, random.uniform(0.5, 2), random.logarithmic(2e-3, 0.5),
                                   random.logarithmic(0.01, 3)));
  }
  WideCamera camera;
  camera.projection = projection;
  camera.width = 98;
  camera.height = projection == Projection::cube ? 98 : 49;
  Frame frame = wide_frame(camera, {component_of(clouds, two_colors())});
  frame.components.front().absorption = {ordered ? Absorption::Kind::gray : Absorption::Kind::none,
                                         0.2};
  frame.tolerance = tolerance;
  return frame;
}

Image part_of(const Image& whole, const Rectangle& crop) {
  Image part(crop.width, crop.height);
  for (int y = 0; y < crop.height; ++y)
    std::copy_n(whole.at(crop.x, crop.y + y), 4 * crop.width, part.at(0, y));
  return part;
}

template <class Draw>
void expect_equal_bits(const std::vector<Projection>& of, Draw draw, double tolerance) {
  for (const Projection projection : of) {
    for (const bool ordered : {false, true}) {
      Frame frame = clouds_around(projection, ordered, tolerance);
      const Image whole = draw(frame);
      ASSERT_GT(*std::max_element(whole.pixels.begin(), whole.pixels.end()), 0.1f);
      for (const Rectangle& crop : {Rectangle{0, 0, 50, 40}, Rectangle{37, 13, 61, 36},
                                    Rectangle{97, 48, 1, 1}, Rectangle{0, 23, 98, 1}}) {
        frame.crop = crop;
        EXPECT_EQ(draw(frame).pixels, part_of(whole, crop).pixels)
            << "projection " << static_cast<int>(projection) << ", crop at " << crop.x << ", "
            << crop.y << (ordered ? ", ordered" : "");
      }
    }
  }
}

class WideAngleCrops : public PictureTest {};

TEST_F(WideAngleCrops, HaveTheBitsOfThePicture) {
  DeviceContext device(choose_device(""));
  for (const CompositeShape shape : {CompositeShape::rows, CompositeShape::groups}) {
    const auto draw = [&](const Frame& frame) { return draw_once(device, frame, shape); };
    // Kernels made for GPUs take a processor's compiler seconds each.
    const bool has_all = shape == CompositeShape::rows || long_tests();
    expect_equal_bits(has_all ? projections : some_projections, draw, 1e-3);
  }
}

TEST_F(WideAngleCrops, HaveTheBitsOfThePictureAtToleranceZero) {
  expect_equal_bits(
      projections, [](const Frame& frame) { return renderer().render(frame); }, 0);
}

TEST_F(WideAngleCrops, HaveThemInPairsOfFloats) {
  Renderer pairs({"", CompositeShape::rows, false});
  expect_equal_bits(
      projections, [&](const Frame& frame) { return pairs.render(frame); }, 0);
}

}  // namespace
}  // namespace splotchcl::test
