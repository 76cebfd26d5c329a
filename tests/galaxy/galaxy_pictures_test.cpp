// Pictures as files: of every kind, and those that hold no galaxy.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "galaxy/galaxy_picture.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

// Stores the first `channels` of the picture's with gamma 2.2 (whole numbers) or as they are.
void store(const std::filesystem::path& path, const Image& image, int channels,
           OIIO::TypeDesc type) {
  std::vector<float> values;
  for (std::size_t pixel = 0; pixel < image.pixels.size() / 4; ++pixel) {
    for (int i = 0; i < channels; ++i) {
      const bool is_alpha = (channels == 4 && i == 3) || (channels == 2 && i == 1);
      const float value = image.pixels[4 * pixel + (is_alpha ? 3 : static_cast<std::size_t>(i))];
      const bool as_is = is_alpha || type == OIIO::TypeDesc::FLOAT;
      values.push_back(as_is ? value : std::pow(std::max(0.0F, value), 1 / 2.2F));
    }
  }
  OIIO::ImageSpec spec(image.width, image.height, channels, type);
  if (channels == 4 || channels == 2) spec.attribute("oiio:UnassociatedAlpha", 1);
  auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output && output->open(path.string(), spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  ASSERT_TRUE(output->close());
}

double light(const Galaxy& galaxy) {
  double sum = 0;
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i)
    sum += static_cast<double>(galaxy.gas.mass[i]) * static_cast<double>(galaxy.gas.color[3 * i]);
  return sum;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_galaxy(path, small_settings());
  } catch (const DataError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GalaxyPictures, EightAndSixteenBitsAndFloatsHoldTheSameGalaxy) {
  const TemporaryFolder folder;
  const Image image = DiskPicture().draw();
  store(folder / "8.png", image, 3, OIIO::TypeDesc::UINT8);
  store(folder / "16.png", image, 3, OIIO::TypeDesc::UINT16);
  store(folder / "float.exr", image, 3, OIIO::TypeDesc::FLOAT);
  const double exact = light(make_galaxy(image, small_settings()));
  // Eight bits round light of 0.02 by up to 0.0008, most of its noise.
  EXPECT_NEAR(light(read_galaxy(folder / "8.png", small_settings())) / exact, 1, 0.03);
  EXPECT_NEAR(light(read_galaxy(folder / "16.png", small_settings())) / exact, 1, 0.002);
  EXPECT_NEAR(light(read_galaxy(folder / "float.exr", small_settings())) / exact, 1, 0.002);
}

TEST(GalaxyPictures, GreyPicturesMakeGreyGalaxies) {
  const TemporaryFolder folder;
  store(folder / "grey.png", DiskPicture().draw(), 1, OIIO::TypeDesc::UINT8);
  const Galaxy galaxy = read_galaxy(folder / "grey.png", small_settings());
  ASSERT_GT(galaxy.gas.count(), 1000u);
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i) {
    ASSERT_EQ(galaxy.gas.color[3 * i], galaxy.gas.color[3 * i + 1]);
    ASSERT_EQ(galaxy.gas.color[3 * i], galaxy.gas.color[3 * i + 2]);
  }
}

TEST(GalaxyPictures, TransparentPixelsHaveNoLight) {
  const TemporaryFolder folder;
  Image image = DiskPicture().draw();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      image.at(x, y)[3] = x < 80 ? 1.0F : 0.0F;
  }
  store(folder / "half.png", image, 4, OIIO::TypeDesc::UINT8);
  GalaxySettings settings = small_settings();
  settings.center = {80, 80};
  const Galaxy galaxy = read_galaxy(folder / "half.png", settings);
  ASSERT_GT(galaxy.gas.count(), 1000u);
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i)
    ASSERT_LT(galaxy.gas.position[3 * i], 0.2F);
}

// Averaged in light: a checkerboard of 0 and 1 is 0.5, not what its values' mean shows.
TEST(GalaxyPictures, LargePicturesAreAveragedAsLight) {
  const TemporaryFolder folder;
  Image board(20000, 40);
  for (int y = 0; y < board.height; ++y) {
    for (int x = 0; x < board.width; ++x)
      std::fill_n(board.at(x, y), 3, (x + y) % 2 == 0 ? 1.0F : 0.0F);
  }
  store(folder / "board.tif", board, 3, OIIO::TypeDesc::UINT8);
  LinearImageOptions options;
  options.longest_side = galaxy_picture_limit;
  const Image reduced = read_linear_image(folder / "board.tif", options);
  EXPECT_EQ(reduced.width, 1000);
  EXPECT_EQ(reduced.height, 2);
  for (std::size_t i = 0; i < reduced.pixels.size(); ++i)
    ASSERT_NEAR(reduced.pixels[i], i % 4 == 3 ? 1 : 0.5, 1e-6);
}

TEST(GalaxyPictures, APictureOfTwentyThousandPixelsMakesAGalaxy) {
  const TemporaryFolder folder;
  DiskPicture picture;
  picture.width = 20000;
  picture.height = 1000;
  picture.center_x = 6000;
  picture.center_y = 500;
  picture.scale = 100;
  store(folder / "wide.tif", picture.draw(), 1, OIIO::TypeDesc::UINT8);
  GalaxySettings settings = small_settings();
  settings.size_kpc = 2000;
  const Galaxy galaxy = read_galaxy(folder / "wide.tif", settings);
  EXPECT_DOUBLE_EQ(galaxy.pixel_size_kpc, 2);
  // In pixels of the file, of which 20 are averaged to one.
  EXPECT_NEAR(galaxy.center[0], 6000, 20);
  EXPECT_NEAR(galaxy.center[1], 500, 20);
}

TEST(GalaxyPictures, OnePixelIsRefused) {
  const TemporaryFolder folder;
  Image image(1, 1);
  std::fill(image.pixels.begin(), image.pixels.end(), 1.0F);
  store(folder / "one.png", image, 3, OIIO::TypeDesc::UINT8);
  EXPECT_THAT(refusal(folder / "one.png"), HasSubstr("one.png: the picture has 1x1 pixels"));
}

TEST(GalaxyPictures, BlackPicturesAreRefused) {
  const TemporaryFolder folder;
  store(folder / "black.png", Image(64, 64), 3, OIIO::TypeDesc::UINT8);
  EXPECT_THAT(refusal(folder / "black.png"), HasSubstr("no light above its sky"));
}

TEST(GalaxyPictures, EvenPicturesAreRefused) {
  const TemporaryFolder folder;
  Image image(64, 64);
  std::fill(image.pixels.begin(), image.pixels.end(), 0.5F);
  store(folder / "even.png", image, 3, OIIO::TypeDesc::UINT8);
  EXPECT_THAT(refusal(folder / "even.png"), HasSubstr("no light above its sky"));
}

TEST(GalaxyPictures, ValuesThatAreNoLightAreRefused) {
  const TemporaryFolder folder;
  Image image = DiskPicture().draw();
  image.at(3, 4)[1] = NAN;
  store(folder / "nan.exr", image, 3, OIIO::TypeDesc::FLOAT);
  EXPECT_THAT(refusal(folder / "nan.exr"), HasSubstr("at pixel 3,4"));
}

TEST(GalaxyPictures, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "text.png") << "not a picture";
  EXPECT_THAT(refusal(folder / "text.png"), HasSubstr("cannot be read as a picture"));
  EXPECT_THAT(refusal(folder / "missing.png"), HasSubstr("missing.png"));
}

}  // namespace
}  // namespace splotchcl::test
