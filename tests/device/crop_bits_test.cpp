// A crop has the bits of the whole picture where both are drawn with the same plan, whatever of it
// is drawn.
#include "device/cases.h"
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr double tolerances[] = {1e-2, 1e-3, 1e-4, 0};

class CropBits : public PictureTest, public testing::WithParamInterface<CompositeShape> {
 protected:
  // Faint and bright clouds of all widths, some of them at one place.
  static Frame frame_for(LightPlan plan, int count) {
    CloudSetup setup;
    setup.width = 160;
    setup.height = 96;
    setup.count = count;
    setup.column_high = 5;
    DrawnComponent clouds = random_clouds(setup);
    const DrawnComponent crowd =
        component_of(std::vector<Cloud>(40, Cloud{20.3, -7.1, 50, 4.6, 10}), two_colors());
    Frame frame = frame_of(setup.width, setup.height, {clouds, crowd});
    for (DrawnComponent& component : frame.components)
      component.absorption = absorption_for(plan);
    return frame;
  }
};

TEST_P(CropBits, AreThoseOfTheWholePicture) {
  DeviceContext device(choose_device(""));
  for (const LightPlan plan : all_plans) {
    for (const double tolerance : tolerances) {
      Frame frame = frame_for(plan, tolerance > 0 ? 200 : 20);
      frame.tolerance = tolerance;
      const Image whole = draw_once(device, frame, GetParam());
      ASSERT_GT(sum_of_light(whole), 100);
      for (const Rectangle& crop :
           {Rectangle{0, 0, 50, 40}, Rectangle{64, 32, 32, 32}, Rectangle{37, 23, 101, 67},
            Rectangle{159, 95, 1, 1}, Rectangle{0, 70, 160, 1}}) {
        frame.crop = crop;
        EXPECT_EQ(rows_that_differ(draw_once(device, frame, GetParam()), whole, crop), 0)
            << name(plan) << ", tolerance " << tolerance << ", crop at " << crop.x << ", "
            << crop.y;
      }
    }
  }
}

// Clouds around the camera are entries of the lists of all tiles that they may touch.
TEST_P(CropBits, AreThoseOfThePictureThroughClouds) {
  DeviceContext device(choose_device(""));
  Camera camera;
  camera.look_at = {{0, 0, 1}};
  camera.sky = {{0, -1, 0}};
  Frame frame = frame_for(LightPlan::ordered, 200);
  frame.projection = camera.projection;
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  frame.through_clouds = true;
  frame.components.push_back(component_of(
      {{0, 0, 0.5, 1, 0.2}, {0.3, -0.1, 5, 0.8, 0.3}, {0, 0.1, -1, 1, 0.4}}, two_colors()));
  frame.components.back().absorption = {Absorption::Kind::gray, 0.1};
  const Image whole = draw_once(device, frame, GetParam());
  ASSERT_GT(sum_of_light(whole), 100);
  for (const Rectangle& crop : {Rectangle{64, 32, 32, 32}, Rectangle{37, 23, 101, 67}}) {
    frame.crop = crop;
    EXPECT_EQ(rows_that_differ(draw_once(device, frame, GetParam()), whole, crop), 0) << crop.x;
  }
}

// What one splat asks for is asked for in the whole picture.
TEST_P(CropBits, AreThoseOfThePictureAlsoWhereAStarBesideTheCropIsTooSharp) {
  Frame frame = frame_for(LightPlan::emission, 20);
  frame.tolerance = 3e-5;
  draw(frame, GetParam());
  ASSERT_FALSE(renderer(GetParam()).stats().drawn_most_exactly);
  frame.components.push_back(component_of({Cloud{70.2, 30.1, 50, 0.02, 1e15}}, two_colors()));
  frame.components.back().absorption = {Absorption::Kind::none, 0};
  const Image whole = draw(frame, GetParam());
  EXPECT_TRUE(renderer(GetParam()).stats().drawn_most_exactly);
  frame.crop = {0, 0, 40, 90};
  EXPECT_EQ(rows_that_differ(draw(frame, GetParam()), whole, frame.crop), 0);
  EXPECT_TRUE(renderer(GetParam()).stats().drawn_most_exactly);
}

// Of so many splats the lists of tiles are cut, and a crop's tiles also list what lies beside them.
TEST_P(CropBits, AreThoseOfThePictureWhereTilesHaveManyThousandSplats) {
  DeviceContext device(choose_device(""));
  CloudSetup setup;
  setup.width = 160;
  setup.height = 96;
  setup.count = 150000;
  setup.sigma_low = 0.3;
  setup.sigma_high = 6;
  setup.column_high = 0.1;
  Frame frame = frame_of(setup.width, setup.height, {random_clouds(setup)});
  for (const LightPlan plan : all_plans) {
    frame.components.front().absorption = absorption_for(plan);
    frame.crop = {0, 0, setup.width, setup.height};
    const Image whole = draw_once(device, frame, GetParam());
    ASSERT_GT(sum_of_light(whole), 100);
    for (const Rectangle& crop : {Rectangle{0, 0, 50, 40}, Rectangle{64, 32, 32, 32},
                                  Rectangle{37, 23, 101, 67}, Rectangle{100, 60, 60, 36}}) {
      frame.crop = crop;
      EXPECT_EQ(rows_that_differ(draw_once(device, frame, GetParam()), whole, crop), 0)
          << name(plan) << ", crop at " << crop.x << ", " << crop.y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, CropBits,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const testing::TestParamInfo<CompositeShape>& info) {
                           return info.param == CompositeShape::rows ? "rows" : "groups";
                         });

}  // namespace
}  // namespace splotchcl::test
