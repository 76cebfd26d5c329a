// Scenes of examples/, as the program draws them.
#include "cli/program.h"
#include "splotchcl/camera.h"
#include "splotchcl/image_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;

// Maps are read as plots are: x to the right, y upwards. A dome is looked up at.
TEST(Examples, ThatLookAlongZHaveXToTheRightAndYUpwards) {
  int maps = 0;
  for (const auto& entry : fs::directory_iterator(test::source_folder() / "examples")) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = read_scene_file(entry.path());
    if (!scene.camera || scene.camera->projection == Projection::fisheye) continue;
    const CameraFrame frame =
        make_camera_frame(*scene.camera, scene.image.width, scene.image.height);
    if (std::abs(frame.forward.a[2]) < 0.99) continue;
    ++maps;
    EXPECT_GT(frame.right.a[0], 0.99) << entry.path();
    EXPECT_LT(frame.down.a[1], -0.99) << entry.path();
  }
  EXPECT_GE(maps, 5);
}

TEST(Examples, ShowALargeXOnTheRightAndALargeYAbove) {
  const TemporaryFolder folder;
  std::ofstream(folder / "t.csv") << "x,y,z,mass,density,hsml\n45000,40000,10000,1,1,3000\n"
                                     "45000,40000,10000,1,2,3000\n";
  const std::string scene = (test::source_folder() / "examples/density_map.toml").string();
  const ProgramResult result =
      splotchcl_in(folder, "render '" + scene + "' --reference -o a.exr --set image.size=[50,50] " +
                               "--set snapshot=" + (folder / "t.csv").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Image image = read_image(folder / "a.exr");
  const auto brightest = std::max_element(image.pixels.begin(), image.pixels.end(),
                                          [](float a, float b) { return a < b; });
  const auto pixel = static_cast<int>(brightest - image.pixels.begin()) / 4;
  EXPECT_NEAR(pixel % image.width, 45, 3);
  EXPECT_NEAR(pixel / image.width, 10, 3);
}

}  // namespace
}  // namespace splotchcl::test
