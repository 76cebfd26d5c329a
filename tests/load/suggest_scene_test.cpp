// The scene that is drawn when only a snapshot is given.
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "splotchcl/picture.h"
#include "splotchcl/reference.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::MemorySnapshot;

std::vector<float> ball(int count, double center, double radius) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(center, radius);
  std::vector<float> position;
  for (int i = 0; i < 3 * count; ++i)
    position.push_back(static_cast<float>(normal(random)));
  return position;
}

std::vector<float> cube(int count, double side) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(0, side);
  std::vector<float> position;
  for (int i = 0; i < 3 * count; ++i)
    position.push_back(static_cast<float>(place(random)));
  return position;
}

MemorySnapshot particles_at(int type, const std::vector<float>& positions) {
  MemorySnapshot snapshot;
  snapshot.add(type, "position", positions, 3);
  return snapshot;
}

std::vector<float> powers_of_ten(int count, double last) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(static_cast<float>(std::pow(10, last * i / count)));
  }
  return values;
}

double distance(const Camera& camera) {
  return boost::qvm::mag(camera.look_at - camera.position);
}

Scene classic(const Snapshot& snapshot) {
  return suggest_scene(snapshot, Look::classic);
}

Component classic_component(const Snapshot& snapshot, const std::vector<int>& types) {
  return suggest_component(snapshot, types, Look::classic);
}

// Half the width of what the camera sees at its look-at point.
double half_width(const Camera& camera) {
  return distance(camera) * std::tan(field_of_view_degrees(camera) * 3.14159265358979 / 360);
}

TEST(SuggestScene, DrawsGasWithoutTheDarkMatterBesideIt) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  snapshot.add(1, "position", ball(100, 0, 1), 3);
  snapshot.add(4, "position", ball(100, 0, 1), 3);
  const Scene scene = classic(snapshot);
  ASSERT_EQ(scene.components.size(), 2u);
  EXPECT_EQ(scene.components[0].types, (std::vector<int>{0}));
  EXPECT_EQ(scene.components[1].types, (std::vector<int>{4}));
}

TEST(SuggestScene, BringsAllLightWithinReachOfTheDisplay) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  const Scene scene = classic(snapshot);
  EXPECT_EQ(scene.components[0].absorption.kind, Absorption::Kind::none);
  EXPECT_EQ(scene.finish.tone, ToneCurve::filmic);
  EXPECT_FALSE(scene.finish.exposure || scene.finish.white);
}

TEST(SuggestScene, DrawsEveryTypeWhereThereIsNoGas) {
  MemorySnapshot snapshot = particles_at(1, ball(100, 0, 1));
  snapshot.add(2, "position", ball(100, 0, 1), 3);
  const Scene scene = classic(snapshot);
  ASSERT_EQ(scene.components.size(), 2u);
  EXPECT_EQ(scene.components[0].name, "halo");
  EXPECT_EQ(scene.components[1].name, "disk");
  EXPECT_NE(scene.components[0].palette, scene.components[1].palette);
  EXPECT_LT(scene.components[0].brightness, scene.components[1].brightness);
}

TEST(SuggestScene, DrawsTheDiscAndBulgeOfAGalaxyThatHasGas) {
  MemorySnapshot snapshot;
  for (const int type : {0, 1, 2, 3, 4})
    snapshot.add(type, "position", ball(100, 0, 1), 3);
  std::vector<std::string> names;
  for (const Component& component : classic(snapshot).components)
    names.push_back(component.name);
  EXPECT_EQ(names, (std::vector<std::string>{"gas", "disk", "bulge", "stars"}));
}

TEST(SuggestScene, LeavesOutTheFarDarkMatterOfAUniverse) {
  MemorySnapshot snapshot;
  for (const int type : {0, 1, 2, 3})
    snapshot.add(type, "position", ball(100, 0, 1), 3);
  snapshot.set_cosmology(Cosmology());
  const Scene scene = classic(snapshot);
  ASSERT_EQ(scene.components.size(), 1u);
  EXPECT_EQ(tell_not_drawn(scene, snapshot), "not drawn: halo 100, disk 100, bulge 100");
}

TEST(SuggestScene, HasNothingToTellWhereAllIsDrawn) {
  MemorySnapshot snapshot = particles_at(1, ball(100, 0, 1));
  snapshot.add(2, "position", ball(100, 0, 1), 3);
  EXPECT_EQ(tell_not_drawn(classic(snapshot), snapshot), "");
}

TEST(SuggestScene, DrawsParticlesInColorsOfTheirOwnTogether) {
  MemorySnapshot snapshot;
  for (const int type : {0, 2, 4}) {
    snapshot.add(type, "position", ball(100, 0, 1), 3);
    if (type != 4) snapshot.add(type, "Color", std::vector<float>(300, 0.5f), 3);
  }
  const Scene scene = classic(snapshot);
  ASSERT_EQ(scene.components.size(), 2u);
  EXPECT_EQ(scene.components[0].types, (std::vector<int>{0, 2}));
  EXPECT_EQ(scene.components[0].color_vector, "Color");
  EXPECT_EQ(scene.components[0].color.field, "");
  EXPECT_EQ(scene.components[1].types, (std::vector<int>{4}));
}

TEST(SuggestScene, TakesNoColorsBelowZeroForLight) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  std::vector<float> colors(300, 0.5f);
  colors[7] = -1;
  snapshot.add(0, "Color", colors, 3);
  EXPECT_EQ(classic(snapshot).components[0].color_vector, "");
}

TEST(SuggestComponent, FitsTheTypesThatAreAskedFor) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  snapshot.add(0, "internal_energy", powers_of_ten(100, 4));
  snapshot.add(1, "position", ball(100, 0, 1), 3);
  EXPECT_EQ(classic_component(snapshot, {0}).color.field, "internal_energy");
  EXPECT_EQ(classic_component(snapshot, {1}).color.field, "density");
  EXPECT_EQ(classic_component(snapshot, {0, 1}).color.field, "density");
  EXPECT_EQ(classic_component(snapshot, {0, 1}).types, (std::vector<int>{0, 1}));
}

TEST(SuggestScene, ColorsGasByItsHeatIfThatVaries) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  snapshot.add(0, "density", powers_of_ten(100, 3));
  snapshot.add(0, "internal_energy", powers_of_ten(100, 4));
  const Component gas = classic(snapshot).components[0];
  EXPECT_EQ(gas.color.field, "internal_energy");
  EXPECT_EQ(gas.color.scaling, Scaling::log);
  EXPECT_NEAR(std::log10(*gas.color.maximum), 3.94, 0.02);
}

TEST(SuggestScene, ColorsGasByItsDensityIfTheHeatIsTheSameEverywhere) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  snapshot.add(0, "density", powers_of_ten(100, 3));
  snapshot.add(0, "internal_energy", std::vector<float>(100, 0.05f));
  EXPECT_EQ(classic(snapshot).components[0].color.field, "density");
}

TEST(SuggestScene, ColorsGasByItsDensityIfTheHeatHardlyVaries) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  snapshot.add(0, "density", powers_of_ten(100, 1));
  snapshot.add(0, "temperature", powers_of_ten(100, 0.1));
  EXPECT_EQ(classic(snapshot).components[0].color.field, "density");
}

TEST(SuggestScene, CutsARangeThatReachesDownToWhatIsAlmostZero) {
  MemorySnapshot snapshot = particles_at(0, ball(1000, 0, 1));
  std::vector<float> density = powers_of_ten(1000, 3);
  std::fill(density.begin(), density.begin() + 40, 9e-43f);  // 4 %
  snapshot.add(0, "density", density);
  const Component gas = classic(snapshot).components[0];
  EXPECT_NEAR(*gas.color.minimum, 1.3, 0.2);
  EXPECT_NEAR(*gas.color.maximum, 970, 30);
}

TEST(SuggestScene, NeverSpansMoreThanEightPowersOfTen) {
  MemorySnapshot snapshot = particles_at(0, ball(1000, 0, 1));
  std::vector<float> density = powers_of_ten(1000, 3);
  std::fill(density.begin(), density.begin() + 700, 9e-43f);
  snapshot.add(0, "density", density);
  const Component gas = classic(snapshot).components[0];
  EXPECT_NEAR(*gas.color.maximum / *gas.color.minimum, 1e8, 2e6);
}

TEST(SuggestScene, LetsWhatIsDenserStandOutInAnEvenBox) {
  MemorySnapshot snapshot = particles_at(1, cube(5000, 100));
  snapshot.set_box_size(100);
  const Component even = classic(snapshot).components[0];
  EXPECT_EQ(even.intensity.field, "density");
  ASSERT_TRUE(even.intensity.percentiles);
  EXPECT_GE((*even.intensity.percentiles)[0], 30);
  EXPECT_EQ(even.size_factor, 1);
}

TEST(SuggestScene, LeavesTheContrastOfAClusteredBoxAsItIs) {
  MemorySnapshot snapshot;
  std::vector<float> position = cube(2000, 100);
  for (const double center : {20.0, 40.0, 60.0, 80.0}) {
    const std::vector<float> halo = ball(2000, center, 1);
    position.insert(position.end(), halo.begin(), halo.end());
  }
  snapshot.add(1, "position", position, 3);
  snapshot.set_box_size(100);
  EXPECT_EQ(classic(snapshot).components[0].intensity.field, "");
}

TEST(SuggestScene, DrawsSmallerCloudsWhereAllOfAnEvenBoxHaveOneSize) {
  MemorySnapshot snapshot = particles_at(0, cube(5000, 100));
  snapshot.add(0, "smoothing_length", std::vector<float>(5000, 12));
  snapshot.set_box_size(100);
  EXPECT_LT(classic(snapshot).components[0].size_factor, 0.5);
}

TEST(SuggestScene, WeighsByMassOnlyWhereMassesAreKnown) {
  MemorySnapshot snapshot = particles_at(0, ball(100, 0, 1));
  EXPECT_EQ(classic(snapshot).components[0].weight, WeightModel::constant);
  snapshot.set_table_mass(0, 3);
  EXPECT_EQ(classic(snapshot).components[0].weight, WeightModel::mass);
}

TEST(SuggestCamera, LooksAtTheMiddleOfAPeriodicBox) {
  MemorySnapshot snapshot = particles_at(0, cube(5000, 100));
  snapshot.set_box_size(100);
  const Camera camera = *suggest_scene(snapshot).camera;
  for (const double x : camera.look_at.a)
    EXPECT_EQ(x, 50);
  EXPECT_NEAR(half_width(camera), 50, 10);
  EXPECT_GT(camera.position.a[2], 50);  // from above
}

TEST(SuggestCamera, TakesAFilledCubeForABoxWhereTheHeaderHasNone) {
  MemorySnapshot snapshot = particles_at(0, cube(5000, 100));
  const Camera camera = *suggest_scene(snapshot).camera;
  for (const double x : camera.look_at.a)
    EXPECT_NEAR(x, 50, 0.5);
  EXPECT_NEAR(half_width(camera), 50, 10);
}

TEST(SuggestCamera, FindsAnObjectInALargeBox) {
  MemorySnapshot snapshot = particles_at(0, ball(5000, 700, 2));
  snapshot.set_box_size(1000);
  const Camera camera = *suggest_scene(snapshot).camera;
  for (const double x : camera.look_at.a)
    EXPECT_NEAR(x, 700, 1);
  EXPECT_GT(half_width(camera), 2);
  EXPECT_LT(half_width(camera), 10);
}

TEST(SuggestCamera, SeesASlabFromItsSideAndFillsThePictureWithIt) {
  for (const std::size_t axis : {0U, 1U, 2U}) {
    MemorySnapshot snapshot;
    std::vector<float> position = cube(5000, 1);
    for (std::size_t i = axis; i < position.size(); i += 3)
      position[i] *= 10;
    snapshot.add(0, "position", position, 3);
    const Camera camera = *suggest_scene(snapshot).camera;
    EXPECT_NEAR(half_width(camera), 5.2, 0.3) << axis;
    const Vec3 view = camera.look_at - camera.position;
    EXPECT_NEAR(view.a[axis], 0, 0.01) << axis;
    EXPECT_EQ(camera.sky.a[axis], 0) << axis;
    EXPECT_NEAR(camera.look_at.a[axis], 5, 0.1) << axis;
  }
}

// Seven eighths of the particles lie in one half, as at the start of Sod's shock tube.
TEST(SuggestCamera, SeesATubeOfTwoDensitiesFromItsSideAndWhole) {
  MemorySnapshot snapshot;
  std::vector<float> position = cube(8000, 1);
  for (std::size_t i = 0; i < position.size(); i += 3)
    position[i + 2] = 5 * (position[i + 2] + (i % 8 == 0 ? 1.0F : 0.0F));
  snapshot.add(0, "position", position, 3);
  const Camera camera = *suggest_scene(snapshot).camera;
  const Vec3 view = camera.look_at - camera.position;
  EXPECT_NEAR(view.a[2], 0, 0.01);
  EXPECT_EQ(camera.sky.a[2], 0);
  EXPECT_NEAR(camera.look_at.a[2], 5, 0.01);
  EXPECT_GT(half_width(camera), 5);
}

ImageSettings picture_of(int width, int height) {
  ImageSettings image;
  image.width = width;
  image.height = height;
  return image;
}

// Half the height of what the camera sees in that picture at its look-at point.
double half_height(const Camera& camera, const ImageSettings& image) {
  return half_width(camera) * image.height / image.width;
}

TEST(SuggestCamera, ShowsTheWholeOfARoundObjectInAPictureOfAnyShape) {
  const MemorySnapshot snapshot = particles_at(0, ball(5000, 0, 2));
  const double half = half_width(*suggest_scene(snapshot).camera);
  const ImageSettings wide = picture_of(1600, 400), tall = picture_of(400, 1600);
  const Scene in_wide = suggest_scene(snapshot, Look::press, wide);
  EXPECT_NEAR(half_height(*in_wide.camera, wide), half, 0.1 * half);
  EXPECT_NEAR(half_width(*suggest_scene(snapshot, Look::press, tall).camera), half, 0.1 * half);
  EXPECT_EQ(in_wide.image.width, 1024);
}

TEST(SuggestCamera, FillsAPictureOfAnyShapeWithABox) {
  MemorySnapshot snapshot = particles_at(0, cube(5000, 100));
  snapshot.set_box_size(100);
  const double half = half_width(*suggest_scene(snapshot).camera);
  const ImageSettings wide = picture_of(1600, 400), tall = picture_of(400, 1600);
  EXPECT_EQ(half_width(*suggest_scene(snapshot, Look::press, wide).camera), half);
  EXPECT_NEAR(half_height(*suggest_scene(snapshot, Look::press, tall).camera, tall), half,
              0.01 * half);
}

TEST(SuggestCamera, FramesAPairOfSmallObjectsClosely) {
  MemorySnapshot snapshot;
  std::vector<float> position = ball(2000, 0, 1);
  for (std::size_t i = 0; i < position.size() / 2; i += 3)
    position[i] += 60;
  snapshot.add(2, "position", position, 3);
  const double half = half_width(*suggest_scene(snapshot).camera);
  EXPECT_GT(half, 26);  // as it appears from 30 degrees beside the line of sight
  EXPECT_LT(half, 38);
}

TEST(SuggestCamera, IsNotMovedByOutliersOrBadPositions) {
  MemorySnapshot snapshot;
  std::vector<float> position = ball(5000, 0, 2);
  for (int i = 0; i < 60; ++i)
    position[static_cast<std::size_t>(i)] = 1e6f;
  position[100] = std::nanf("");
  snapshot.add(0, "position", position, 3);
  const Camera camera = *suggest_scene(snapshot).camera;
  EXPECT_LT(half_width(camera), 10);
  for (const double x : camera.look_at.a)
    EXPECT_NEAR(x, 0, 1);
}

TEST(SuggestCamera, FramesTheDiskRatherThanItsHalo) {
  MemorySnapshot snapshot = particles_at(1, ball(1000, 0, 100));
  snapshot.add(2, "position", ball(1000, 0, 5), 3);
  EXPECT_LT(half_width(*suggest_scene(snapshot).camera), 20);
}

TEST(SuggestCamera, SeesASingleParticle) {
  MemorySnapshot snapshot = particles_at(0, {5, 5, 5});
  EXPECT_NO_THROW(make_camera_frame(*suggest_scene(snapshot).camera, 64, 64));
}

TEST(SuggestCamera, RefusesDataWithoutAFinitePosition) {
  MemorySnapshot snapshot = particles_at(0, {std::nanf(""), 0, 0});
  EXPECT_THROW(suggest_scene(snapshot), DataError);
}

// Of every pixel one value, in increasing order.
using OfPixel = std::function<float(const float*)>;
float brightest_channel(const float* pixel) {
  return std::max({pixel[0], pixel[1], pixel[2]});
}
float darkest_channel(const float* pixel) {
  return std::min({pixel[0], pixel[1], pixel[2]});
}

Image drawn(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  const auto draw = [](const Frame& frame) { return reference::render(frame).to_float(); };
  return draw_pictures(scene, snapshot, draw, notes).front().image;
}

std::vector<float> values_of(const Image& image, const OfPixel& value = brightest_channel) {
  std::vector<float> values;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4)
    values.push_back(value(&image.pixels[i]));
  std::sort(values.begin(), values.end());
  return values;
}

// Of values in increasing order.
double part_from(double least, const std::vector<float>& values) {
  const auto first = std::lower_bound(values.begin(), values.end(), static_cast<float>(least));
  return static_cast<double>(values.end() - first) / static_cast<double>(values.size());
}

// Of the light in it, how much is not gray: 0 to 1.
float mean_saturation(const Image& image) {
  const std::vector<float> values = values_of(image, [](const float* pixel) {
    const float most = brightest_channel(pixel);
    return most > 0.02F ? (most - darkest_channel(pixel)) / most : -1;
  });
  const auto first = std::lower_bound(values.begin(), values.end(), 0.0F);
  return std::accumulate(first, values.end(), 0.0F) / static_cast<float>(values.end() - first);
}

class SuggestedPicture : public testing::TestWithParam<const char*> {};

TEST_P(SuggestedPicture, IsLitColoredAndFilledAsMatterFillsIt) {
  const auto path = test::data_folder() / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const std::shared_ptr<const Snapshot> snapshot = open_snapshot(path);
  Scene scene = suggest_scene(*snapshot);
  scene.image.width = scene.image.height = 64;
  const Image picture = drawn(scene, *snapshot);
  // 8 bits hold nothing brighter than (1 - 0.5 / 255)^gamma.
  const double white = std::pow(1 - 0.5 / 255, scene.image.gamma);
  EXPECT_LE(part_from(white, values_of(picture, darkest_channel)), 0.005) << "hardly any white";
  EXPECT_GT(mean_saturation(picture), 0.2F) << "colored";
  // Matter fills what has two thousandths of the light of the brightest pixel.
  scene.finish = {};
  const std::vector<float> light = values_of(drawn(scene, *snapshot));
  const double filled = part_from(2e-3 * static_cast<double>(light.back()), light);
  const double lit = part_from(0.02, values_of(picture));
  EXPECT_GE(lit, std::min(0.25, filled)) << "a quarter, or as much as matter fills";
  EXPECT_GT(lit, 0.04) << "some of its frame";
}

INSTANTIATE_TEST_SUITE_P(
    RealData, SuggestedPicture,
    testing::Values("lcdm/fmt2_snapshot_002", "lcdm/fmt2_snapshot_004", "lcdm/fmt2_snapshot_005",
                    "lcdm/fmt2_snapshot_006", "gadget_minimal/snap_002.0",
                    "gassphere/fmt2_snapshot_000", "gassphere/fmt1_snapshot_004",
                    "gassphere/fmt3_snapshot_008.hdf5", "gassphere_id64/fmt3_snapshot_001.hdf5",
                    "gassphere_multifile/fmt2_snapshot_002.0",
                    "gadget2_ics/gassphere_bigendian.dat", "gadget2_ics/galaxy_littleendian.dat",
                    "gadget2_ics/lcdm_gas_littleendian.dat", "galaxy_collision/snapshot_000.hdf5",
                    "galaxy_collision/snapshot_005.hdf5", "galaxy_collision/snapshot_010.hdf5",
                    "tipsy/tiny.000640", "tipsy/shocktube.std", "tipsy/adiabtophat_glass_28721.bin",
                    "swift/swift_lcdm_0000.hdf5", "phantom/dustmixture_00000.h5"),
    [](const auto& info) {
      std::string name = info.param;
      for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      }
      return name;
    });

}  // namespace
}  // namespace splotchcl
