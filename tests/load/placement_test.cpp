// Particles of a snapshot of their own, put into a scene.
#include "load/placement.h"

#include "device/pictures.h"
#include "load/particles.h"
#include "splotchcl/generate.h"
#include "splotchcl/plan.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

void expect_near(const Vec3& a, const Vec3& b, double error) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(a.a[axis], b.a[axis], error) << axis;
}

// Where particle i is drawn.
Vec3 place_of(const Particles& particles, std::size_t i) {
  Vec3 place = particles.origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
    place.a[axis] += static_cast<double>(particles.position[3 * i + axis]);
  return place;
}

TEST(Rotation, IsRightHanded) {
  const Vec3 x = {{1, 0, 0}}, y = {{0, 1, 0}}, z = {{0, 0, 1}};
  expect_near(rotated(x, z, 90), y, 1e-15);
  expect_near(rotated(y, x, 90), z, 1e-15);
  expect_near(rotated(x, {{0, 0, -1e200}}, 90), {{0, -1, 0}}, 1e-15);
  expect_near(rotated(x, {{1, 1, 1}}, 120), y, 1e-15);
  expect_near(rotated(y, z, 360e6), y, 1e-15);
}

TEST(Placement, MovesTheOriginAndCopiesNothing) {
  const NumberedSnapshot snapshot = gas_row();
  Component component = gas();
  component.center = {{2, 0, 0}};
  component.placement.origin = Vec3{{1e9, 5, 0}};
  const Particles particles = load(component, snapshot).particles;
  EXPECT_EQ(particles.position.data(), snapshot.read(0, "position").data());
  expect_near(place_of(particles, 2), {{1e9, 5, 0}}, 0);
  expect_near(place_of(particles, 3), {{1e9 + 1, 5, 0}}, 0);
}

TEST(Placement, TurnsAndScalesAboutTheCenter) {
  Component component = gas();
  component.center = {{2, 0, 0}};
  component.placement.origin = Vec3{{10, 20, 30}};
  component.placement.axis = {{0, 0, 2}};
  component.placement.angle_degrees = 90;
  component.placement.scale = 0.5;
  component.size_factor = 3;
  const DrawnComponent drawn = load(component, gas_row());
  expect_near(place_of(drawn.particles, 2), {{10, 20, 30}}, 0);
  expect_near(place_of(drawn.particles, 4), {{10, 21, 30}}, 1e-6);
  EXPECT_EQ(drawn.size_factor, 1.5);
  EXPECT_EQ(drawn.particles.weight[4], 5) << "masses stay";
}

TEST(Placement, WithoutAnOriginLeavesTheCenterWhereItIs) {
  Component component = gas();
  component.center = {{2, 0, 0}};
  component.placement.scale = 10;
  const Particles particles = load(component, gas_row()).particles;
  expect_near(place_of(particles, 2), {{2, 0, 0}}, 0);
  expect_near(place_of(particles, 3), {{12, 0, 0}}, 1e-6);
}

TEST(Placement, DoesNotScaleAFixedSize) {
  Component component = gas();
  component.size_fixed = 0.25;
  component.placement.scale = 10;
  EXPECT_EQ(load(component, gas_row()).size_factor, 1);
}

TEST(Placement, SelectsWhereTheSnapshotHasTheParticles) {
  Component component = gas();
  component.placement.origin = Vec3{{1000, 0, 0}};
  component.select.where = {"position_x < 1.5"};
  EXPECT_EQ(load(component, gas_row()).particles.count, 2u);
}

TEST(Placement, IsMadeOnceForAllFramesWhereverItMoves) {
  const NumberedSnapshot snapshot = gas_row();
  Component component = gas();
  component.placement.angle_degrees = 30;
  const Column first = load(component, snapshot).particles.position;
  component.placement.origin = Vec3{{3, 2, 1}};
  EXPECT_EQ(load(component, snapshot).particles.position.data(), first.data());
  component.placement.angle_degrees = 31;
  EXPECT_NE(load(component, snapshot).particles.position.data(), first.data());
}

TEST(Placement, RefusesRotationsAndScalesThatAreNone) {
  Component component = gas();
  component.placement.angle_degrees = std::nan("");
  EXPECT_THAT(refusal(component, gas_row()), HasSubstr("component gas: rotation is by nan"));
  component.placement = {};
  component.placement.axis = {{0, 0, 0}};
  EXPECT_THAT(refusal(component, gas_row()), HasSubstr("an axis that is not 0"));
  component.placement = {};
  component.placement.scale = -1;
  EXPECT_THAT(refusal(component, gas_row()), HasSubstr("scale is -1"));
}

TEST(Placement, NeedsACameraWhenNothingIsWhereTheSnapshotHasIt) {
  Component component = gas();
  component.placement.origin = Vec3{{0, 0, 0}};
  Scene scene = scene_of({component});
  scene.camera.reset();
  EXPECT_THROW(load(scene, gas_row()), UsageError);
}

class OwnSnapshot : public ::testing::Test {
 protected:
  std::string generated(std::uint64_t seed) {
    const auto path = folder_ / ("halo" + std::to_string(seed) + ".gadget");
    GenerateSettings settings;
    settings.particles = 2000;
    settings.seed = seed;
    write_gadget2(path, generate_halo(settings));
    return path.string();
  }
  const splotchcl::test::TemporaryFolder folder_;
};

TEST_F(OwnSnapshot, GivesTheComponentItsParticles) {
  const auto other = open_snapshot(generated(1));
  Component planted = gas();
  planted.name = "planted";
  planted.snapshot = other->info().files.front().string();
  const Frame frame = load(scene_of({gas(), planted}), gas_row());
  EXPECT_EQ(frame.components[0].particles.count, 6u);
  EXPECT_EQ(frame.components[1].particles.count, other->info().find_type(0)->count);
}

TEST_F(OwnSnapshot, IsOpenedOnceForAllFramesAndComponents) {
  Component planted = gas();
  planted.snapshot = generated(1);
  Component again = planted;
  planted.name = "a";
  again.name = "b";
  const NumberedSnapshot snapshot = gas_row();
  const Frame frame = load(scene_of({planted, again}), snapshot);
  const Column position = frame.components[0].particles.position;
  EXPECT_EQ(frame.components[1].particles.position.data(), position.data());
  std::filesystem::remove(planted.snapshot);
  EXPECT_EQ(load(scene_of({planted}), snapshot).components[0].particles.position.data(),
            position.data());
}

TEST_F(OwnSnapshot, IsReadAsTheScenesIs) {
  Component planted = gas();
  planted.snapshot = generated(1);
  const std::size_t all = load(scene_of({planted}), gas_row()).components[0].particles.count;
  Scene scene = scene_of({planted});
  scene.read.every = 10;
  const Frame frame = load(scene, gas_row());
  EXPECT_EQ(frame.components[0].particles.count, (all + 9) / 10);
  EXPECT_NEAR(frame.components[0].particles_per_drawn, 10, 0.1);
}

TEST_F(OwnSnapshot, MayBeATableWhoseColumnsAreNamedOrNone) {
  Component table = gas(), planted = gas();
  table.name = "table";
  table.snapshot = (folder_ / "table.txt").string();
  std::ofstream(table.snapshot) << "6 5 5 5\n7 0 0 0\n8 1 1 1\n";
  planted.snapshot = generated(1);
  Scene scene = scene_of({table, planted});
  for (Component& component : scene.components)
    component.size_fixed = 1;
  scene.read.columns = {"mass", "x", "y", "z"};
  scene.read.skip_lines = 1;
  const Frame frame = load(scene, gas_row());
  EXPECT_EQ(frame.components[0].particles.weight[1], 8);
  EXPECT_GT(frame.components[1].particles.count, 2u);
}

TEST_F(OwnSnapshot, ThatIsMissingIsRefusedBeforeAnythingIsRead) {
  Component planted = gas();
  planted.snapshot = (folder_ / "lost.gadget").string();
  const NumberedSnapshot snapshot = gas_row();
  EXPECT_THAT(refusal(planted, snapshot), HasSubstr("lost.gadget"));
  EXPECT_TRUE(snapshot.fields_read().empty());
}

// A galaxy of a millionth of the box, seen from far outside to inside its disk: what the
// device draws at a particle's place must be where double precision has it.
class Planted : public PictureTest {
 protected:
  static constexpr double box = 50000;
  static constexpr double size = 1e-6 * box;
  // Nowhere near a number that single precision knows.
  const Vec3 origin_ = {{31234.56789, 17171.717171, 40404.040404}};

  Frame frame_from(const Vec3& camera, double field_of_view) const {
    Frame frame;
    frame.width = 400;
    frame.height = 300;
    frame.crop = {0, 0, 400, 300};
    Camera from;
    from.position = camera;
    from.look_at = Vec3(origin_ + Vec3{{0.1 * size, 0.2 * size, 0}});
    from.sky = {{0.1, 0.2, 1}};
    from.field_of_view_degrees = field_of_view;
    frame.camera = make_camera_frame(from, frame.width, frame.height);
    frame.near_limit = 0;
    return frame;
  }
};

// The centre of the light, in pixels.
std::pair<double, double> light_center(const Image& image) {
  double x = 0, y = 0, sum = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double light = static_cast<double>(
          image.pixels[4 * static_cast<std::size_t>(row * image.width + column)]);
      x += light * (column + 0.5);
      y += light * (row + 0.5);
      sum += light;
    }
  }
  return {x / sum, y / sum};
}

TEST_F(Planted, APointStaysWithinATwentiethOfAPixelOfTheOracle) {
  NumberedSnapshot galaxy;
  // In kiloparsecs of its own, of which the scene's unit holds many.
  galaxy.add(0, "position", {3, 5, 0.25f}, 3);
  galaxy.add(0, "smoothing_length", {0.01f});
  galaxy.add(0, "mass", {1});
  Component component = gas();
  component.placement.origin = origin_;
  component.placement.axis = {{0.3, -1, 0.2}};
  component.placement.angle_degrees = 63;
  component.placement.scale = size / 30;  // 30 across
  component.reference_column = 1;
  component.size_fixed = 1;
  Scene scene = scene_of({component});
  double largest = 0;
  // From four boxes away to inside the disk, always with the galaxy in the picture; near
  // and far away the point is magnified by as much as it takes to see the error.
  for (int step = 0; step <= 24; ++step) {
    const double distance = 4 * box * std::pow(0.2 * size / (4 * box), step / 24.0);
    const double turn = 0.5 * step;
    const Vec3 camera = Vec3(origin_ + distance * Vec3{{std::cos(turn), std::sin(turn), 0.3}});
    Frame frame = frame_from(camera, 40);
    DrawnComponent drawn = load(scene, galaxy).components[0];
    const Vec3 place = place_of(drawn.particles, 0);
    const double z = boost::qvm::dot(Vec3(place - camera), frame.camera.forward);
    if (z <= 0) continue;
    // A cloud of 4 pixels, well lit, wherever it is.
    drawn.particles.smoothing_length = Column::uniform(1);
    drawn.size_factor = 4 / frame.kernel.width * z / frame.camera.focal_pixels;
    drawn.weight = WeightModel::constant;
    drawn.reference_column = 1 / drawn.size_factor;
    drawn.absorption.kind = Absorption::Kind::none;
    drawn.palette = one_color(1, 1, 1);
    frame.components = {drawn};
    const std::vector<reference::Splat> splats = reference::project(frame);
    ASSERT_EQ(splats.size(), 1u);
    if (splats[0].x < 20 || splats[0].x > 380 || splats[0].y < 20 || splats[0].y > 280) continue;
    const auto [x, y] = light_center(draw(frame));
    largest = std::max({largest, std::abs(x - splats[0].x), std::abs(y - splats[0].y)});
    EXPECT_LT(std::hypot(x - splats[0].x, y - splats[0].y), 0.05) << "from " << distance;
  }
  RecordProperty("pixels", std::to_string(largest));
  EXPECT_GT(largest, 0) << "some camera must have seen it";
}

}  // namespace
}  // namespace splotchcl::test
