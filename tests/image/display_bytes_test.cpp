// The 8 bits of a picture are those that its file would have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using splotchcl::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Image pixels(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size() / 4), 1);
  image.pixels = values;
  return image;
}

TEST(DisplayBytes, LeaveOutAlphaAndClamp) {
  const Image image = pixels({0, 1, 2, 0.5f, -1, 1, 0, 1});
  EXPECT_THAT(display_bytes("picture", image), ElementsAre(0, 255, 255, 0, 255, 0));
}

TEST(DisplayBytes, AreThoseOfTheFile) {
  const TemporaryFolder folder;
  std::vector<float> values;
  for (int i = 0; i < 4 * 64; ++i)
    values.push_back(static_cast<float>(i) / 255);
  ImageFileOptions options;
  options.gamma = 2.2;
  write_image(folder / "a.png", pixels(values), options);
  const Image read = read_image(folder / "a.png");
  const std::vector<std::uint8_t> bytes = display_bytes("picture", pixels(values), options);
  ASSERT_EQ(bytes.size(), 3U * 64);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    EXPECT_EQ(bytes[i], std::lround(255 * read.pixels[i / 3 * 4 + i % 3])) << i;
}

TEST(DisplayBytes, RefuseWhatIsNotANumber) {
  const Image image = pixels({0, std::numeric_limits<float>::quiet_NaN(), 0, 1});
  EXPECT_THAT([&] { display_bytes("the picture", image); },
              ThrowsMessage<DataError>(HasSubstr("the picture")));
}

}  // namespace
}  // namespace splotchcl
