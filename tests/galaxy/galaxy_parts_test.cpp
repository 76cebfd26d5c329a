#include "galaxy/dust_map.h"
#include "galaxy/galaxy_frame.h"
#include "galaxy/galaxy_picture.h"
#include "snapshot/field_names.h"
#include "splotchcl/rotation_curve.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

std::vector<float> values(const Column& column) {
  return {column.data(), column.data() + column.size()};
}

TEST(GalaxyFile, OurReaderReadsWhatIsWritten) {
  const TemporaryFolder folder;
  const Galaxy galaxy = make_galaxy(DiskPicture().draw(), small_settings());
  write_galaxy(folder / "galaxy.hdf5", galaxy);
  const auto snapshot = open_snapshot(folder / "galaxy.hdf5");
  EXPECT_TRUE(snapshot->info().notes.empty());
  for (const auto& [type, particles] :
       {std::pair(0, &galaxy.gas), std::pair(2, &galaxy.disk), std::pair(3, &galaxy.bulge),
        std::pair(4, &galaxy.clusters)}) {
    const ParticleTypeInfo* const info = snapshot->info().find_type(type);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(info->count, particles->count());
    EXPECT_EQ(values(snapshot->read(type, "position")), particles->position);
    EXPECT_EQ(values(snapshot->read(type, "velocity")), particles->velocity);
    EXPECT_EQ(values(snapshot->read(type, "mass")), particles->mass);
    EXPECT_EQ(values(snapshot->read(type, "smoothing_length")), particles->smoothing_length);
    EXPECT_EQ(values(snapshot->read(type, "Color")), particles->color);
    EXPECT_EQ(values(snapshot->read(type, "OrbitAxis")), particles->orbit_axis);
    EXPECT_EQ(values(snapshot->read(type, "OrbitRadius")), particles->orbit_radius);
  }
  EXPECT_EQ(values(snapshot->read(5, "position")), galaxy.dust.position);
  EXPECT_EQ(values(snapshot->read(5, "Opacity")), galaxy.dust.color);
  EXPECT_EQ(snapshot->read_ids(0).front(), 1u);
  EXPECT_EQ(snapshot->read_ids(2).front(), galaxy.gas.count() + 1);
}

TEST(GalaxyFile, LengthsAndVelocitiesNameTheirUnits) {
  const TemporaryFolder folder;
  write_galaxy(folder / "galaxy.hdf5", make_galaxy(DiskPicture().draw(), small_settings()));
  const auto snapshot = open_snapshot(folder / "galaxy.hdf5");
  const auto unit = [&](const char* field) {
    return find_field(*snapshot->info().find_type(0), field)->unit;
  };
  EXPECT_EQ(unit("position"), "kpc");
  EXPECT_EQ(unit("smoothing_length"), "kpc");
  EXPECT_EQ(unit("OrbitRadius"), "kpc");
  EXPECT_EQ(unit("velocity"), "km/s");
  EXPECT_EQ(unit("mass"), "");
}

TEST(GalaxyFile, NothingIsLeftWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  const Galaxy galaxy = make_galaxy(DiskPicture().draw(), small_settings());
  EXPECT_THROW(write_galaxy(folder / "missing" / "galaxy.hdf5", galaxy), DataError);
  EXPECT_THROW(write_galaxy(folder.path(), galaxy), DataError);
  EXPECT_EQ(folder.count_files(), 0u);
}

std::string refusal_of_curve(const std::string& text) {
  return refusal_by<DataError>([&] { parse_rotation_curve(text, "curve.txt"); });
}

TEST(RotationCurve, DefaultIsLinearInsideAndFlatOutside) {
  const RotationCurve curve = RotationCurve::flat(200, 1);
  EXPECT_NEAR(curve.speed(1e-3), 0.2, 1e-6);
  EXPECT_NEAR(curve.speed(100), 200, 0.02);
  EXPECT_NEAR(curve.angular_speed(0), 200 / myr_per_kpc_s_km, 1e-12);
}

TEST(RotationCurve, TableIsLinearBetweenItsPoints) {
  const RotationCurve curve = parse_rotation_curve("# kpc km/s\n1 100\n3, 200\n", "curve.txt");
  EXPECT_DOUBLE_EQ(curve.speed(0.5), 50);
  EXPECT_DOUBLE_EQ(curve.speed(2), 150);
  EXPECT_DOUBLE_EQ(curve.speed(30), 200);
  EXPECT_DOUBLE_EQ(curve.angular_speed(0), 100 / myr_per_kpc_s_km);
  EXPECT_DOUBLE_EQ(curve.angular_speed(2), 75 / myr_per_kpc_s_km);
}

TEST(RotationCurve, OneRowIsRefused) {
  EXPECT_THAT(refusal_of_curve("1 100\n"), HasSubstr("curve.txt: found 1 line with"));
  EXPECT_THAT(refusal_of_curve("# nothing\n"), HasSubstr("found 0 lines"));
}

TEST(RotationCurve, UnsortedRadiiAreRefused) {
  EXPECT_THAT(refusal_of_curve("1 100\n3 200\n2 150\n"),
              HasSubstr("curve.txt:3: radius 2 follows 3"));
  EXPECT_THAT(refusal_of_curve("1 100\n1 200\n"), HasSubstr("curve.txt:2: radius 1 follows 1"));
}

TEST(RotationCurve, NegativeNumbersAreRefused) {
  EXPECT_THAT(refusal_of_curve("1 100\n2 -5\n"), HasSubstr("curve.txt:2: the speed is -5"));
  EXPECT_THAT(refusal_of_curve("-1 100\n2 5\n"), HasSubstr("curve.txt:1: the radius is -1"));
}

TEST(RotationCurve, OtherTextIsRefused) {
  EXPECT_THAT(refusal_of_curve("1\n2 3\n"),
              HasSubstr("curve.txt:1: found '1', expected two numbers"));
  EXPECT_THAT(refusal_of_curve("1 2 3\n"), HasSubstr("expected two numbers"));
  EXPECT_THAT(refusal_of_curve("1 two\n"), HasSubstr("expected two numbers"));
  EXPECT_THAT(refusal_of_curve("0 100\n1 100\n"), HasSubstr("speed 100 at radius 0"));
  EXPECT_THROW(RotationCurve::flat(-1, 1), UsageError);
  EXPECT_THROW(RotationCurve::flat(100, 0), UsageError);
}

// What the dust of a galaxy absorbs, and where it lies.

GalaxySettings spiral_settings() {
  GalaxySettings settings = small_settings();
  settings.removes_stars = false;
  settings.center = {120, 120};
  return settings;
}

TEST(Dust, ASheetHidesHalfOfTheLightAtMost) {
  const Veil sheet(0, 1);
  EXPECT_DOUBLE_EQ(sheet.transmission(0), 1);
  for (const double depth : {0.5, 2.0, 10.0, 40.0})
    EXPECT_NEAR(sheet.transmission(depth), (1 + std::exp(-depth)) / 2, 1e-4);
}

// Mixed evenly with the stars: the mean of exp(-t) for t from 0 to the depth.
TEST(Dust, DustAmongTheStarsHidesMore) {
  const Veil mixed(1, 1);
  for (const double depth : {0.5, 2.0, 10.0})
    EXPECT_NEAR(mixed.transmission(depth) / (-std::expm1(-depth) / depth), 1, 0.005);
}

TEST(Dust, DepthIsTheInverseOfTransmission) {
  const Veil veil(0.05, 0.12);
  for (const double depth : {0.0, 0.3, 1.234, 2.4})
    EXPECT_NEAR(veil.depth(veil.transmission(depth), 3), depth, 1e-6);
  EXPECT_EQ(veil.depth(0.1, 2.5), 2.5);
}

TEST(Dust, LiesWhereThePictureHasDarkLanes) {
  const SpiralPicture picture;
  const Galaxy galaxy = make_galaxy(picture.draw(), spiral_settings());
  double in_lanes = 0, elsewhere = 0;
  int lanes = 0, others = 0;
  for (std::size_t i = 0; i < galaxy.dust.count(); ++i) {
    const int x = static_cast<int>(
        std::floor(static_cast<double>(galaxy.dust.position[3 * i]) / (16.0 / 240) + 120));
    const int y = static_cast<int>(
        std::floor(120 - static_cast<double>(galaxy.dust.position[3 * i + 1]) / (16.0 / 240)));
    const double radius = std::hypot(x - 120, y - 120);
    if (radius < 25 || radius > 75) continue;
    // Dust particles stand for equal areas.
    (picture.is_lane(x, y) ? in_lanes : elsewhere) += static_cast<double>(galaxy.dust.mass[i]);
    ++(picture.is_lane(x, y) ? lanes : others);
  }
  ASSERT_GT(lanes, 1000);
  EXPECT_GT(in_lanes / lanes, 1.7 * elsewhere / others);
}

// In front of white light, seen face-on.
TEST(Dust, ReddensWhatItDims) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const Galaxy galaxy = make_galaxy(SpiralPicture().draw(), spiral_settings());
  Camera camera;
  camera.position = {{0, 0, 40}};
  camera.look_at = {{0, 0, 0}};
  camera.field_of_view_degrees = 20;
  Frame frame = galaxy_frame(galaxy, camera, 100, 100);
  frame.components = {drawn_dust(galaxy.dust)};
  frame.background = {{1, 1, 1}};
  const Image veiled = Renderer().render(frame);
  int dark = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const float* const pixel = veiled.at(x, y);
      const double red = -std::log(pixel[0]), green = -std::log(pixel[1]),
                   blue = -std::log(pixel[2]);
      if (green < 0.5) continue;
      ++dark;
      // The tolerance is 0.001 of light that is 0.05 at least.
      ASSERT_NEAR(red / green, 0.57, 0.03);
      ASSERT_NEAR(blue / green, 1.33, 0.03);
    }
  }
  EXPECT_GT(dark, 200);
}

TEST(Dust, NoneIsMadeWhereNoneIsWanted) {
  GalaxySettings settings = small_settings();
  settings.dust = 0;
  EXPECT_EQ(make_galaxy(SpiralPicture().draw(), settings).dust.count(), 0u);
}

}  // namespace
}  // namespace splotchcl::test
