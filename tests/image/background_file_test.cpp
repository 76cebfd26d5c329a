#include "finish/finish_pictures.h"
#include "image/image_library.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class BackgroundFile : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  splotchcl::test::TemporaryFolder folder_{"background"};
};

TEST_F(BackgroundFile, OfFloatsIsLinearLight) {
  write_image(path("a.exr"), plain_image(6, 4, {0.25F, 3, 0}));
  const auto image = load_background_image(path("a.exr"), 6, 4, 2.2);
  EXPECT_EQ(image->at(5, 3)[0], 0.25F);
  EXPECT_EQ(image->at(5, 3)[1], 3.0F);
}

// Then it is written with the same values that were read.
TEST_F(BackgroundFile, OfEightBitsLooksAsItDoes) {
  write_image(path("a.png"), plain_image(6, 4, {0.25F, 0.5F, 1}));
  const auto image = load_background_image(path("a.png"), 6, 4, 2.2);
  write_image(path("b.png"), *image, {2.2, false, {}});
  EXPECT_EQ(read_image(path("b.png")).pixels, read_image(path("a.png")).pixels);
}

TEST_F(BackgroundFile, OfAnotherShapeFillsThePicture) {
  // The middle square is green, what lies beside it red.
  Image wide = plain_image(90, 30, {1, 0, 0});
  for (int y = 0; y < 30; ++y) {
    for (int x = 30; x < 60; ++x) {
      wide.at(x, y)[0] = 0;
      wide.at(x, y)[1] = 1;
    }
  }
  write_image(path("a.exr"), wide);
  const auto image = load_background_image(path("a.exr"), 70, 70, 1);
  ASSERT_EQ(image->width, 70);
  ASSERT_EQ(image->height, 70);
  for (const int i : {0, 35, 69}) {
    EXPECT_NEAR(image->at(i, 69 - i)[0], 0, 1e-5);
    EXPECT_NEAR(image->at(i, 69 - i)[1], 1, 1e-5);
  }
}

TEST_F(BackgroundFile, ThatIsMissingOrNegativeIsRefused) {
  EXPECT_THROW(load_background_image(path("missing.png"), 6, 4, 1), DataError);
  write_image(path("a.exr"), plain_image(6, 4, {0.25F, -3, 0}));
  EXPECT_THAT([&] { load_background_image(path("a.exr"), 6, 4, 1); },
              ThrowsMessage<DataError>(HasSubstr("a.exr: found the light -3")));
}

}  // namespace
}  // namespace splotchcl::test
