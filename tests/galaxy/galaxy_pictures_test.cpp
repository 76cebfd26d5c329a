#include <OpenImageIO/imageio.h>

#include "galaxy/galaxy_frame.h"
#include "galaxy/galaxy_picture.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Pictures as files: of every kind, and those that hold no galaxy.

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
  return refusal_by<DataError>([&] { read_galaxy(path, small_settings()); });
}

using GalaxyPictures = FolderTest;

TEST_F(GalaxyPictures, EightAndSixteenBitsAndFloatsHoldTheSameGalaxy) {
  const Image image = DiskPicture().draw();
  store(folder_ / "8.png", image, 3, OIIO::TypeDesc::UINT8);
  store(folder_ / "16.png", image, 3, OIIO::TypeDesc::UINT16);
  store(folder_ / "float.exr", image, 3, OIIO::TypeDesc::FLOAT);
  const double exact = light(make_galaxy(image, small_settings()));
  // Eight bits round light of 0.02 by up to 0.0008, most of its noise.
  EXPECT_NEAR(light(read_galaxy(folder_ / "8.png", small_settings())) / exact, 1, 0.03);
  EXPECT_NEAR(light(read_galaxy(folder_ / "16.png", small_settings())) / exact, 1, 0.002);
  EXPECT_NEAR(light(read_galaxy(folder_ / "float.exr", small_settings())) / exact, 1, 0.002);
}

TEST_F(GalaxyPictures, GreyPicturesMakeGreyGalaxies) {
  store(folder_ / "grey.png", DiskPicture().draw(), 1, OIIO::TypeDesc::UINT8);
  const Galaxy galaxy = read_galaxy(folder_ / "grey.png", small_settings());
  ASSERT_GT(galaxy.gas.count(), 1000u);
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i) {
    ASSERT_EQ(galaxy.gas.color[3 * i], galaxy.gas.color[3 * i + 1]);
    ASSERT_EQ(galaxy.gas.color[3 * i], galaxy.gas.color[3 * i + 2]);
  }
}

TEST_F(GalaxyPictures, TransparentPixelsHaveNoLight) {
  Image image = DiskPicture().draw();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      image.at(x, y)[3] = x < 80 ? 1.0F : 0.0F;
  }
  store(folder_ / "half.png", image, 4, OIIO::TypeDesc::UINT8);
  GalaxySettings settings = small_settings();
  settings.center = {80, 80};
  const Galaxy galaxy = read_galaxy(folder_ / "half.png", settings);
  ASSERT_GT(galaxy.gas.count(), 1000u);
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i)
    ASSERT_LT(galaxy.gas.position[3 * i], 0.2F);
}

// Averaged in light: a checkerboard of 0 and 1 is 0.5, not what its values' mean shows.
TEST_F(GalaxyPictures, LargePicturesAreAveragedAsLight) {
  Image board(20000, 40);
  for (int y = 0; y < board.height; ++y) {
    for (int x = 0; x < board.width; ++x)
      std::fill_n(board.at(x, y), 3, (x + y) % 2 == 0 ? 1.0F : 0.0F);
  }
  store(folder_ / "board.tif", board, 3, OIIO::TypeDesc::UINT8);
  LinearImageOptions options;
  options.longest_side = galaxy_picture_limit;
  const Image reduced = read_linear_image(folder_ / "board.tif", options);
  EXPECT_EQ(reduced.width, 1000);
  EXPECT_EQ(reduced.height, 2);
  for (std::size_t i = 0; i < reduced.pixels.size(); ++i)
    ASSERT_NEAR(reduced.pixels[i], i % 4 == 3 ? 1 : 0.5, 1e-6);
}

TEST_F(GalaxyPictures, APictureOfTwentyThousandPixelsMakesAGalaxy) {
  DiskPicture picture;
  picture.width = 20000;
  picture.height = 600;
  picture.center_x = 6000;
  picture.center_y = 300;
  picture.scale = 100;
  store(folder_ / "wide.tif", picture.draw(), 1, OIIO::TypeDesc::UINT8);
  GalaxySettings settings = small_settings();
  settings.size_kpc = 2000;
  const Galaxy galaxy = read_galaxy(folder_ / "wide.tif", settings);
  EXPECT_DOUBLE_EQ(galaxy.pixel_size_kpc, 2);
  // In pixels of the file, of which 20 are averaged to one.
  EXPECT_NEAR(galaxy.center[0], 6000, 20);
  EXPECT_NEAR(galaxy.center[1], 300, 20);
}

TEST_F(GalaxyPictures, OnePixelIsRefused) {
  Image image(1, 1);
  std::fill(image.pixels.begin(), image.pixels.end(), 1.0F);
  store(folder_ / "one.png", image, 3, OIIO::TypeDesc::UINT8);
  EXPECT_THAT(refusal(folder_ / "one.png"), HasSubstr("one.png: the picture has 1x1 pixels"));
}

TEST_F(GalaxyPictures, BlackPicturesAreRefused) {
  store(folder_ / "black.png", Image(64, 64), 3, OIIO::TypeDesc::UINT8);
  EXPECT_THAT(refusal(folder_ / "black.png"), HasSubstr("no light above its sky"));
}

TEST_F(GalaxyPictures, EvenPicturesAreRefused) {
  Image image(64, 64);
  std::fill(image.pixels.begin(), image.pixels.end(), 0.5F);
  store(folder_ / "even.png", image, 3, OIIO::TypeDesc::UINT8);
  EXPECT_THAT(refusal(folder_ / "even.png"), HasSubstr("no light above its sky"));
}

TEST_F(GalaxyPictures, ValuesThatAreNoLightAreRefused) {
  Image image = DiskPicture().draw();
  image.at(3, 4)[1] = NAN;
  store(folder_ / "nan.exr", image, 3, OIIO::TypeDesc::FLOAT);
  EXPECT_THAT(refusal(folder_ / "nan.exr"), HasSubstr("at pixel 3,4"));
}

TEST_F(GalaxyPictures, OtherFilesAreRefused) {
  std::ofstream(folder_ / "text.png") << "not a picture";
  EXPECT_THAT(refusal(folder_ / "text.png"), HasSubstr("cannot be read as a picture"));
  EXPECT_THAT(refusal(folder_ / "missing.png"), HasSubstr("missing.png"));
}

// The galaxy from other sides than that of its picture, and from close by.

double brightness(const Image& image, int x, int y) {
  const float* const pixel = image.at(x, y);
  return static_cast<double>(pixel[0] + pixel[1] + pixel[2]) / 3;
}

// How rough a picture is where it should be smooth: the root mean square of a pixel's light
// relative to the mean of the square around it, away from the borders.
double roughness(const Image& image, int reach) {
  double sum = 0;
  int count = 0;
  for (int y = reach; y < image.height - reach; ++y) {
    for (int x = reach; x < image.width - reach; ++x) {
      double around = 0;
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx)
          around += brightness(image, x + dx, y + dy);
      }
      around /= (2 * reach + 1) * (2 * reach + 1);
      sum += std::pow(brightness(image, x, y) / around - 1, 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

Galaxy spiral(double dust = 1) {
  GalaxySettings settings = small_settings();
  settings.clusters = 0;  // points of light
  settings.dust = dust;
  return make_galaxy(SpiralPicture().draw(), settings);
}

// From far away in this direction, with the disk's axis upwards, 16 kpc across.
Frame seen_from(const Galaxy& galaxy, const Vec3& direction) {
  Camera camera;
  camera.projection = Projection::orthographic;
  camera.position = direction * 100.0;
  camera.look_at = {{0, 0, 0}};
  camera.sky = {{0, 0, 1}};
  camera.field_of_view_degrees = 2 * std::atan(16 / 200.0) * 180 / M_PI;
  return galaxy_frame(galaxy, camera, 320, 160);
}

// Mean light of a row's middle half.
double row_brightness(const Image& image, int y) {
  double sum = 0;
  for (int x = image.width / 4; x < 3 * image.width / 4; ++x)
    sum += brightness(image, x, y);
  return sum / (image.width / 2);
}

// 0.122 where points were at random, with lengths to neighbour 24.
TEST(GalaxyViews, CloseUpIsSmoothWhereThePictureIs) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const DiskPicture picture = {320, 320, 160, 160, 40};
  GalaxySettings settings;
  settings.size_kpc = 16;
  settings.clusters = 0;  // points of light
  Camera camera;
  camera.position = {{3, -2.5, 1.5}};
  camera.look_at = {{3, -1, 0}};
  camera.sky = {{0, 0, 1}};
  camera.field_of_view_degrees = 40;
  const auto found = [&] {
    const Galaxy galaxy = make_galaxy(picture.draw(), settings);
    return roughness(Renderer().render(galaxy_frame(galaxy, camera, 240, 135)), 12);
  };
  const double usual = found();
  EXPECT_LT(usual, 0.122 / 3);
  settings.detail = 4;
  EXPECT_LT(found(), 0.75 * usual);
}

TEST(GalaxyViews, ALaneDarkensTheMiddleOfAnEdge) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const Image edge = Renderer().render(seen_from(spiral(), {{0, -1, 0}}));
  const double pixel = 16.0 / 320;  // kpc
  const double middle = row_brightness(edge, 80);
  const int aside = static_cast<int>(0.2 / pixel);
  EXPECT_LT(middle, 0.4 * row_brightness(edge, 80 - aside));
  EXPECT_LT(middle, 0.4 * row_brightness(edge, 80 + aside));
  const Image bare = Renderer().render(seen_from(spiral(0), {{0, -1, 0}}));
  EXPECT_GT(row_brightness(bare, 80), row_brightness(bare, 80 + aside));
}

// The bulge of a tilted galaxy, a ball of stars, is darker below its middle, where the disk that
// lies in front has dust; without dust it is the same above and below.
TEST(GalaxyViews, TheNearSideOfATiltedDiskLiesInShadow) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const auto near_over_far = [](const Galaxy& galaxy) {
    const double tilt = 15 * M_PI / 180;
    Frame frame = seen_from(galaxy, {{0, -std::cos(tilt), std::sin(tilt)}});
    // Of the light, the bulge's alone.
    frame.components = {frame.components[2], frame.components[4]};
    const Image image = Renderer().render(frame);
    double near = 0, far = 0;
    for (int row = 3; row < 11; ++row) {
      near += row_brightness(image, 80 + row);
      far += row_brightness(image, 79 - row);
    }
    return near / far;
  };
  EXPECT_LT(near_over_far(spiral()), 0.8);
  EXPECT_NEAR(near_over_far(spiral(0)), 1, 0.05);
}

}  // namespace
}  // namespace splotchcl::test
