// Real snapshots, drawn without a scene.
#include "cli/program.h"
#include "real_snapshots.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
