// Real snapshots, drawn without a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.h"
#include "real_snapshots.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

void expect_equal_pictures(const TemporaryFolder& folder, const std::string& first,
                           const std::string& second) {
  SCOPED_TRACE(first + " and " + second);
  const std::string size = " --set 'image.size=[300,200]'";
  for (const auto& [snapshot, name] : {std::pair{first, "a"}, {second, "b"}}) {
    const ProgramResult result =
        splotchcl_in(folder, "render \"$data\"/" + snapshot + " -o " + name + ".png" + size);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_EQ(read_text(folder / "a.png"), read_text(folder / "b.png"));
}

TEST(RealSnapshots, GiveTheSameFileInEveryFormat) {
  SKIP_WITHOUT_TEST_DATA();
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  expect_equal_pictures(folder, "lcdm/fmt1_snapshot_006", "lcdm/fmt2_snapshot_006");
  expect_equal_pictures(folder, "lcdm/fmt3_snapshot_006.hdf5", "lcdm/fmt2_snapshot_006");
}

TEST(RealSnapshots, GiveTheSameFileInEitherEndianness) {
  SKIP_WITHOUT_TEST_DATA();
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  expect_equal_pictures(folder, "gadget2_ics/gassphere_bigendian.dat",
                        "gadget2_ics/gassphere_littleendian.dat");
}

TEST(RealSnapshots, GiveTheSameFileFromAnyMemberOfASet) {
  SKIP_WITHOUT_TEST_DATA();
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  expect_equal_pictures(folder, "gassphere_multifile/fmt2_snapshot_002.0",
                        "gassphere_multifile/fmt2_snapshot_002.2");
  expect_equal_pictures(folder, "gassphere_multifile/fmt2_snapshot_002.0",
                        "gassphere_multifile/fmt2_snapshot_002");
}

TEST(RealSnapshots, AreWithinTheToleranceOfTheReference) {
  SKIP_WITHOUT_TEST_DATA();
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  // One for each plan.
  for (const std::string absorption :
       {"absorption=emission", "absorption=none", "gray_absorption=0.2"}) {
    SCOPED_TRACE(absorption);
    const std::string scene =
        "render \"$data\"/lcdm/fmt2_snapshot_006 --set 'image.size=[256,256]' "
        "--set finish.tone=linear --set finish.exposure=0 --set finish.white=1 "
        "--set component.gas." +
        absorption;
    ASSERT_EQ(splotchcl_in(folder, scene + " -o device.exr").exit_code, 0);
    ASSERT_EQ(splotchcl_in(folder, scene + " --reference -o reference.exr").exit_code, 0);
    const ProgramResult result =
        splotchcl_in(folder, "compare device.exr reference.exr --limit 1e-3");
    EXPECT_EQ(result.exit_code, 0) << result.out;
  }
}

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

class BrokenSnapshot : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, BrokenSnapshot,
                         ::testing::Values("broken/no_coordinates.hdf5",
                                           "broken/no_positions/snap_144.0.key", "README.md",
                                           "images/m51_heic0506a.jpg"));

TEST_P(BrokenSnapshot, IsRefusedInOneLineThatNamesIt) {
  SKIP_WITHOUT_TEST_DATA();
  const TemporaryFolder folder;
  for (const std::string command : {"info", "render"}) {
    const ProgramResult result = splotchcl_in(folder, command + " \"$data\"/" + GetParam());
    // A text that is given to render could have been meant as a scene.
    const bool is_text = std::string(GetParam()) == "README.md";
    EXPECT_EQ(result.exit_code, is_text && command == "render" ? 2 : 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr(std::filesystem::path(GetParam()).filename().string()));
    EXPECT_EQ(folder.count_files(), 0U);
  }
}

}  // namespace
}  // namespace splotchcl::test
