#include "galaxy/galaxy_frame.h"
#include "galaxy/galaxy_picture.h"
#include "galaxy/light_map.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Face-on, without perspective, a pixel for each of the picture's.
Frame face_on_frame(const Galaxy& galaxy, const DiskPicture& picture,
                    const GalaxySettings& settings) {
  Camera camera;
  camera.projection = Projection::orthographic;
  camera.position = {{0, 0, 100}};
  camera.look_at = {{0, 0, 0}};
  camera.field_of_view_degrees = 2 * std::atan(settings.size_kpc / 200) * 180 / M_PI;
  return galaxy_frame(galaxy, camera, picture.width, picture.height);
}

// Mean light by radius in rings of `width` pixels.
std::vector<double> radial_profile(const Image& image, double width, double sky) {
  std::vector<double> sums, counts;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double radius = std::hypot(x + 0.5 - image.width / 2.0, y + 0.5 - image.height / 2.0);
      const auto ring = static_cast<std::size_t>(radius / width);
      if (ring >= sums.size()) {
        sums.resize(ring + 1);
        counts.resize(ring + 1);
      }
      const float* const pixel = image.at(x, y);
      sums[ring] += static_cast<double>(pixel[0] + pixel[1] + pixel[2]) / 3 - sky;
      counts[ring] += 1;
    }
  }
  for (std::size_t ring = 0; ring < sums.size(); ++ring)
    sums[ring] /= counts[ring];
  return sums;
}

// Measure: mean light above the sky in rings of 6 pixels, from the centre to four scale
// lengths, where an exponential disk has given off 90 % of its light.
TEST(GalaxyLight, FaceOnRenderHasThePicturesRadialProfile) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const DiskPicture picture;
  GalaxySettings settings = small_settings();
  settings.cluster_light = 0;  // a few bright points of their own
  const Image image = picture.draw();
  const Galaxy galaxy = make_galaxy(image, settings);
  const Image drawn = Renderer().render(face_on_frame(galaxy, picture, settings));
  const std::vector<double> expected = radial_profile(image, 6, sky_level);
  const std::vector<double> found = radial_profile(drawn, 6, 0);
  for (std::size_t ring = 0; ring < 8; ++ring) {
    // Clouds of 1.6 pixels and lengths of about as much blur an exponential of 12 pixels by
    // (1.6^2 + 1.6^2) / 12^2, 4 %; stars are few in outer rings: 3 % more.
    EXPECT_NEAR(found[ring] / expected[ring], 1, ring == 0 ? 0.1 : 0.07) << "ring " << ring;
  }
}

TEST(GalaxyLight, ParticlesGiveOffThePicturesLightWhereNoDustHidesAny) {
  const DiskPicture picture;
  GalaxySettings settings = small_settings();
  settings.dust = 0;
  const Galaxy galaxy = make_galaxy(picture.draw(), settings);
  double light = 0;
  for (const GalaxyParticles* kind : {&galaxy.gas, &galaxy.disk, &galaxy.bulge, &galaxy.clusters}) {
    for (std::size_t i = 0; i < kind->count(); ++i) {
      light += static_cast<double>(kind->mass[i]) *
               static_cast<double>(kind->color[3 * i] + kind->color[3 * i + 1] +
                                   kind->color[3 * i + 2]) /
               3;
    }
  }
  // The integral of peak exp(-r / scale), without what lies below the threshold: at twice the
  // noise it is 6 scale lengths out, where 98 % lie within.
  const double expected = 2 * M_PI * picture.peak * (2.6 / 3) * std::pow(picture.scale * 0.1, 2);
  EXPECT_NEAR(light / expected, 1, 0.05);
}

// Pixels red or blue at random: their colours say which pixel a particle comes from.
Image red_and_blue_pixels(const DiskPicture& picture) {
  Random random(9);
  Image image = picture.draw();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      float* const pixel = image.at(x, y);
      (random.uniform() < 0.5 ? pixel[0] : pixel[2]) = static_cast<float>(sky_level);
    }
  }
  return image;
}

TEST(GalaxyLight, NoColumnOfPixelsHasOneColorAlongZ) {
  const DiskPicture picture;
  GalaxySettings settings = small_settings();
  settings.removes_stars = false;
  settings.cloud_points = 12;
  const Galaxy galaxy = make_galaxy(red_and_blue_pixels(picture), settings);
  struct Column {
    int count = 0;
    double red = 0;
  };
  std::map<std::pair<int, int>, Column> columns;
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i) {
    const auto pixel = [&](std::size_t axis) {
      return static_cast<int>(
          std::floor(static_cast<double>(galaxy.gas.position[3 * i + axis]) / 0.1));
    };
    if (std::hypot(pixel(0), pixel(1)) > 40) continue;
    Column& column = columns[{pixel(0), pixel(1)}];
    const double red = static_cast<double>(galaxy.gas.color[3 * i]);
    const double blue = static_cast<double>(galaxy.gas.color[3 * i + 2]);
    ++column.count;
    column.red += red / (red + blue);
  }
  // The variance of a column's share of red: (1 - red) red for pure colours. 0.25 if every
  // column were an even mixture; its 12 particles have the colours of about 8 pixels, so chance
  // alone makes some columns of one colour.
  double variance = 0;
  int many = 0, of_one_color = 0;
  for (const auto& [place, column] : columns) {
    if (column.count < 8) continue;
    const double red = column.red / column.count;
    ++many;
    variance += red * (1 - red);
    of_one_color += red < 0.02 || red > 0.98 ? 1 : 0;
  }
  ASSERT_GT(many, 50);
  EXPECT_GT(variance / many, 0.12);
  EXPECT_LT(of_one_color, 0.1 * many);
}

TEST(GalaxyLight, StarsOfTheMilkyWayAreTakenOut) {
  const DiskPicture picture;
  Image image = picture.draw();
  for (const auto& [x, y] : {std::pair(30, 40), std::pair(120, 50), std::pair(100, 130)}) {
    for (int i = 0; i < 3; ++i)
      image.at(x, y)[i] = 1;
  }
  const Galaxy galaxy = make_galaxy(image, small_settings());
  EXPECT_GE(galaxy.pixels_of_stars, 3u * 9);
  EXPECT_LT(galaxy.pixels_of_stars, 5u * 9);
  // Their light, 1 a channel, would be the brightest outside the disk's own 0.8.
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i)
    ASSERT_LT(galaxy.gas.color[3 * i + 2], 0.7F);
}

TEST(GalaxyLight, CloudsThatShineInHydrogensLineAreNoStars) {
  Image image = DiskPicture().draw();
  image.at(110, 60)[0] = 0.9F;
  image.at(110, 60)[2] = 0.5F;
  EXPECT_EQ(make_galaxy(image, small_settings()).pixels_of_stars, 0u);
}

// In the column through the middle of an even disk, which reaches beyond a picture so high.
double deepest_dust(int height, const GalaxySettings& settings) {
  constexpr int width = 300;
  constexpr double disk = 90;
  Image picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double r = std::hypot(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0);
      const double light = 0.02 + 0.5 / (1 + std::exp((r - disk) / 4));
      std::fill_n(picture.at(x, y), 3, static_cast<float>(light));
    }
  }
  const LightMap map(picture, settings, 1);
  double deepest = 0;
  for (int y = 0; y < height; ++y)
    deepest = std::max(deepest, map.dust().depth(width / 2, y));
  return deepest;
}

TEST(GalaxyDust, IsNotWhereTheBorderFadesTheLight) {
  EXPECT_LT(deepest_dust(130, GalaxySettings()), 0.45);
}

TEST(GalaxyDust, IsNotWhereTheDiskIsCutOff) {
  GalaxySettings settings;
  settings.radius_pixels = 60;
  EXPECT_LT(deepest_dust(300, settings), 0.45);
}

}  // namespace
}  // namespace splotchcl::test
