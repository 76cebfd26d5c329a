// Files that the program reads: everyday ones, snapshots of all formats, the examples.
#include "cli/program.h"
#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_writer.h"
#include "real_snapshots.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/camera.h"
#include "splotchcl/image_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// What people have on disk, in files of numbers; of texts sessions tell.

class EverydayFiles : public ::testing::Test {
 protected:
  ProgramResult run(const std::string& arguments) const { return splotchcl_in(folder_, arguments); }
  TemporaryFolder folder_;
};

// P-Gadget keeps other things there, in the first file of a set alone.
TEST_F(EverydayFiles, OfGadgetMayHaveHighWordsThatAreNoCounts) {
  auto members = split(small_snapshot(), 2);
  members[0].high_words = {0, 0, 228, 0, 0, 0};
  write_gadget_set(folder_ / "snap", members, 2);
  const ProgramResult result = run("info snap.0");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("gas: 37 particles"));
}

TEST_F(EverydayFiles, OfH5pyHaveNoHeader) {
  write_values(create_hdf5(folder_ / "t.hdf5"), "pos", {1, 2, 3, 4, 5, 6, 7, 8, 9}, 3);
  const ProgramResult result = run("info t.hdf5");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("3 particles"));
}

// What swiftsimio writes names no code, and has the kernel's scale for its radius.
TEST_F(EverydayFiles, OfSwiftsimioStartSimulations) {
  {
    const Hdf5Output file = create_hdf5(folder_ / "t.hdf5");
    make_group(file, "Header");
    make_group(file, "Units");
    write_attribute(file, "Header", "NumPart_ThisFile", {2, 0, 0, 0, 0, 0});
    write_attribute(file, "Units", "Unit length in cgs (U_L)", {3.08567758e24});
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "PartType0/SmoothingLength", {0.5, 0.5});
  }
  EXPECT_THAT(run("info t.hdf5").out,
              AllOf(HasSubstr("SWIFT initial conditions"), HasSubstr("0.912871")));
}

// Real snapshots, drawn without a scene.

// All files of a set give the same picture: the first of each.
std::vector<std::string> different_snapshots() {
  std::vector<std::string> names = real_snapshots();
  const auto is_further_member = [](const std::string& name) {
    const auto member = parse_member_name(name);
    return member && member->index > 0;
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_further_member), names.end());
  return names;
}

class RealSnapshot : public ::testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RealSnapshot);
INSTANTIATE_TEST_SUITE_P(Formats, RealSnapshot, ::testing::ValuesIn(different_snapshots()));

// Of the pixels' brightest channels.
float percentile(const Image& image, double part) {
  std::vector<float> values;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    values.push_back(std::max({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}));
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

TEST_P(RealSnapshot, GivesAPictureThatIsNeitherBlackNorSaturated) {
  SKIP_WITHOUT_TEST_DATA();
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(
      folder, "render \"$data\"/" + GetParam() + " -o picture.png --set 'image.size=[200,200]'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Image image = read_image(folder / "picture.png");
  EXPECT_GT(percentile(image, 0.99), 0.25F) << "the brightest hundredth is dark";
  EXPECT_LT(percentile(image, 0.5), 0.95F) << "half of the picture is saturated";
  EXPECT_GT(percentile(image, 0.99), percentile(image, 0.1) + 0.1F) << "there is no contrast";
}

// Scenes of examples/, as the program draws them.

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
