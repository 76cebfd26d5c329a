// Pictures of awkward sizes, and parts of very large ones.
#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"

namespace splotchcl::test {
namespace {

Frame clouds_over(int width, int height, LightPlan plan) {
  CloudSetup setup;
  setup.width = width;
  setup.height = height;
  setup.count = 400;
  setup.column_low = 0.1;
  return lit(frame_of(width, height, {random_clouds(setup)}), plan);
}

// A crop of a perspective picture of 16384 x 16384, with clouds around the crop only.
Frame part_of_a_large_picture(int x, int y, LightPlan plan) {
  constexpr int side = 16384;
  const Rectangle crop = {x, y, 96, 64};
  Camera camera;
  camera.field_of_view_degrees = 50;
  Frame frame = seen_by(camera, side, side, {});
  Random random(53);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 400; ++i) {
    const double pixel_x = crop.x + random.uniform(-0.1, 1.1) * crop.width;
    const double pixel_y = crop.y + random.uniform(-0.1, 1.1) * crop.height;
    const double z = random.uniform(1, 10);
    const double length = z / frame.camera.focal_pixels;  // of one pixel
    // The camera looks along z with the sky along y: right is -x.
    const double right = (pixel_x - frame.camera.center_x) * length;
    const double down = (pixel_y - frame.camera.center_y) * length;
    const Vec3 at =
        frame.camera.right * right + frame.camera.down * down + frame.camera.forward * z;
    clouds.push_back({at.a[0], at.a[1], at.a[2], length * random.logarithmic(0.3, 20),
                      random.logarithmic(0.1, 1)});
  }
  frame.components = {in_random_colors(component_of(clouds, two_colors()))};
  frame.crop = crop;
  return lit(frame, plan);
}

}  // namespace

std::vector<HardCase> picture_cases() {
  std::vector<HardCase> cases;
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 4097}, {4097, 1}, {101, 103}, {61, 7}}) {
    cases.push_back({"Picture" + std::to_string(width) + "x" + std::to_string(height),
                     "rows of eight and tiles reach over every edge",
                     [width = width, height = height](LightPlan plan) {
                       return clouds_over(width, height, plan);
                     }});
  }
  for (const auto& [x, y] : {std::pair{0, 0}, {16384 - 96, 16384 - 64}, {8150, 8160}, {0, 9001}}) {
    cases.push_back(
        {"Part" + std::to_string(x) + "x" + std::to_string(y) + "Of16384x16384",
         "pixel coordinates of 16384 have steps of 0.001 in single precision",
         [x = x, y = y](LightPlan plan) { return part_of_a_large_picture(x, y, plan); }});
  }
  return cases;
}

}  // namespace splotchcl::test
