#include "galaxy/galaxy_picture.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Of values along one axis.
double deviation(const GalaxyParticles& particles, std::size_t axis) {
  double sum = 0;
  for (std::size_t i = 0; i < particles.count(); ++i)
    sum += std::pow(static_cast<double>(particles.position[3 * i + axis]), 2);
  return std::sqrt(sum / static_cast<double>(particles.count()));
}

TEST(GalaxyShape, CenterOfLightIsFoundBesideACompanion) {
  DiskPicture picture;
  picture.center_x = 60.5;
  picture.center_y = 90.5;
  Image image = picture.draw();
  const DiskPicture companion = {160, 160, 140, 30, 5, 1.0};
  const Image other = companion.draw();
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] += other.pixels[i] - static_cast<float>(sky_level);
  const Galaxy galaxy = make_galaxy(image, small_settings());
  EXPECT_NEAR(galaxy.center[0], 60.5, 1);
  EXPECT_NEAR(galaxy.center[1], 90.5, 1);
}

TEST(GalaxyShape, RadiusKeepsACompanionOut) {
  GalaxySettings settings = small_settings();
  settings.radius_pixels = 40;
  const Galaxy galaxy = make_galaxy(DiskPicture().draw(), settings);
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i) {
    const double radius = std::hypot(static_cast<double>(galaxy.gas.position[3 * i]),
                                     static_cast<double>(galaxy.gas.position[3 * i + 1]));
    ASSERT_LT(radius, 4.0 + 0.3);  // and the radius of a cloud
  }
}

// However far it is said to reach: beyond the corners there is nothing, and no time is spent there.
TEST(GalaxyShape, RadiusBeyondThePictureIsThatOfItsCorners) {
  const Image image = DiskPicture().draw();
  const Galaxy whole = make_galaxy(image, small_settings());
  for (const double radius : {1000.0, 2147483647.0, 1e300}) {
    GalaxySettings settings = small_settings();
    settings.radius_pixels = radius;
    const Galaxy galaxy = make_galaxy(image, settings);
    EXPECT_EQ(galaxy.gas.position, whole.gas.position) << radius;
    EXPECT_EQ(galaxy.gas.mass, whole.gas.mass) << radius;
  }
}

TEST(GalaxyShape, AnInclinedDiskBecomesRound) {
  DiskPicture picture;
  picture.axis_ratio = 0.5;
  GalaxySettings settings = small_settings();
  settings.inclination_degrees = 60;
  settings.position_angle_degrees = 0;  // the longest diameter is upright
  settings.radius_pixels = 60;
  const Galaxy round = make_galaxy(picture.draw(), settings);
  EXPECT_NEAR(deviation(round.gas, 0) / deviation(round.gas, 1), 1, 0.03);
  settings.inclination_degrees = 0;
  const Galaxy flat = make_galaxy(picture.draw(), settings);
  EXPECT_LT(deviation(flat.gas, 0) / deviation(flat.gas, 1), 0.85);
}

TEST(GalaxyShape, RightAndUpAreThoseOfThePicture) {
  Image image = DiskPicture().draw();
  for (int y = 20; y < 26; ++y) {
    for (int x = 120; x < 126; ++x)
      image.at(x, y)[2] = 3;  // to the upper right
  }
  GalaxySettings settings = small_settings();
  settings.center = {80, 80};
  settings.removes_stars = false;
  const Galaxy galaxy = make_galaxy(image, settings);
  const std::vector<float>& color = galaxy.gas.color;
  std::size_t bluest = 0;
  for (std::size_t i = 0; i < galaxy.gas.count(); ++i) {
    if (color[3 * i + 2] > color[3 * bluest + 2]) bluest = i;
  }
  EXPECT_NEAR(galaxy.gas.position[3 * bluest], 4.3, 0.5);
  EXPECT_NEAR(galaxy.gas.position[3 * bluest + 1], 5.7, 0.5);
}

TEST(GalaxyShape, DiskIsThinAndBulgeIsRound) {
  GalaxySettings settings = small_settings();
  settings.radius_pixels = 70;
  settings.flare = 0;
  const Galaxy galaxy = make_galaxy(DiskPicture().draw(), settings);
  EXPECT_NEAR(deviation(galaxy.gas, 2), settings.gas_height_kpc, 0.005);
  EXPECT_NEAR(deviation(galaxy.dust, 2), settings.dust_height_kpc, 0.002);
  EXPECT_LT(deviation(galaxy.dust, 2), deviation(galaxy.disk, 2) / 3);
  EXPECT_NEAR(deviation(galaxy.disk, 2), settings.disk_height_kpc, 0.01);
  EXPECT_GT(deviation(galaxy.disk, 0), 5 * deviation(galaxy.disk, 2));
  EXPECT_NEAR(deviation(galaxy.bulge, 2) / deviation(galaxy.bulge, 0), settings.bulge_flattening,
              0.08);
}

TEST(GalaxyShape, DiskFlares) {
  GalaxySettings flat = small_settings();
  flat.radius_pixels = 70;
  flat.flare = 0;
  GalaxySettings flaring = flat;
  flaring.flare = 1.5;
  const Galaxy even = make_galaxy(DiskPicture().draw(), flat);
  const Galaxy flared = make_galaxy(DiskPicture().draw(), flaring);
  constexpr double radius = 7;  // kpc
  const auto check = [](const GalaxyParticles& thin, const GalaxyParticles& thick) {
    ASSERT_EQ(thin.count(), thick.count());
    for (std::size_t i = 0; i < thin.count(); ++i) {
      const double r = std::hypot(thin.position[3 * i], thin.position[3 * i + 1]);
      const double factor = std::exp(1.5 * (r / radius - 0.5));
      ASSERT_NEAR(thick.position[3 * i + 2], factor * thin.position[3 * i + 2], 1e-5)
          << "at radius " << r;
    }
  };
  check(even.gas, flared.gas);
  check(even.dust, flared.dust);
  check(even.disk, flared.disk);
}

TEST(GalaxyShape, NumbersOfClusterStarsAreRandom) {
  GalaxySettings settings = small_settings();
  const std::size_t count = make_galaxy(DiskPicture().draw(), settings).clusters.count();
  settings.seed = 2;
  EXPECT_NE(make_galaxy(DiskPicture().draw(), settings).clusters.count(), count);
  settings.clusters = 0;
  EXPECT_EQ(make_galaxy(DiskPicture().draw(), settings).clusters.count(), 0u);
}

TEST(GalaxyShape, TheSameSeedMakesTheSameGalaxy) {
  GalaxySettings settings = small_settings();
  const Image image = DiskPicture().draw();
  const Galaxy first = make_galaxy(image, settings), again = make_galaxy(image, settings);
  EXPECT_EQ(first.gas.position, again.gas.position);
  EXPECT_EQ(first.disk.color, again.disk.color);
  EXPECT_EQ(first.bulge.velocity, again.bulge.velocity);
  EXPECT_EQ(first.clusters.smoothing_length, again.clusters.smoothing_length);
  settings.seed = 2;
  EXPECT_NE(make_galaxy(image, settings).gas.position, first.gas.position);
}

TEST(GalaxyShape, OrbitsAreCirclesAtTheSpeedOfTheCurve) {
  const GalaxySettings settings = small_settings();
  const Galaxy galaxy = make_galaxy(DiskPicture().draw(), settings);
  for (std::size_t i = 0; i < galaxy.bulge.count(); ++i) {
    double speed = 0, radial = 0, radius = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double v = static_cast<double>(galaxy.bulge.velocity[3 * i + axis]);
      const double x = static_cast<double>(galaxy.bulge.position[3 * i + axis]);
      speed += v * v;
      radial += v * x;
      radius += x * x;
    }
    speed = std::sqrt(speed);
    radius = std::sqrt(radius);
    ASSERT_NEAR(speed, settings.rotation.speed(radius), 1e-4 * 200);
    ASSERT_NEAR(radial / radius, 0, 1e-4 * 200);
  }
}

TEST(GalaxyShape, SettingsOutOfRangeAreRefused) {
  const Image image = DiskPicture().draw();
  const auto refuses = [&](auto&& change) {
    GalaxySettings settings = small_settings();
    change(settings);
    EXPECT_THROW(make_galaxy(image, settings), UsageError);
  };
  refuses([](GalaxySettings& s) { s.inclination_degrees = 85; });
  refuses([](GalaxySettings& s) { s.inclination_degrees = -1; });
  refuses([](GalaxySettings& s) { s.size_kpc = 0; });
  refuses([](GalaxySettings& s) { s.size_kpc = NAN; });
  refuses([](GalaxySettings& s) { s.radius_pixels = 0; });
  refuses([](GalaxySettings& s) { s.cloud_points = 0; });
  refuses([](GalaxySettings& s) { s.disk_light = 1.5; });
  refuses([](GalaxySettings& s) { s.center = {-10, 5}; });
}

}  // namespace
}  // namespace splotchcl::test
