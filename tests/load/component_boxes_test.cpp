// Boxes from an index beside a snapshot hold the particles of a component as the scene places them.
#include "load/component_boxes.h"

#include <chrono>

#include "index/snapshot_index.h"
#include "load/particles.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class ComponentBoxes : public ::testing::Test {
 protected:
  void SetUp() override {
    write_universe(folder_ / "u", 30000);
    snapshot_ = open_snapshot(folder_ / "u");
    SnapshotIndex::make(*snapshot_, {}).write(snapshot_->info());
  }

  Particles load(const Component& component, bool is_wrapped = false) {
    Scene scene = scene_of({component});
    scene.periodic.wrap = is_wrapped;
    Camera camera;
    camera.position = {{10000, -60000, 20000}};
    camera.look_at = {{10000, 25000, 20000}};
    camera.sky = {{0, 0, 1}};
    scene.camera = camera;
    notes_.clear();
    return load_frame(scene, *snapshot_, notes_).components.front().particles;
  }

  static void expect_all_within(const Particles& particles) {
    ASSERT_TRUE(particles.boxes);
    for (std::size_t i = 0; i < particles.count; ++i) {
      const ParticleBox box = particles.boxes->around(i, i + 1);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float x = particles.position[3 * i + axis];
        // Corners are rounded when they are placed, as positions are.
        const float room = 0.1f;
        ASSERT_GE(x, box.lower[axis] - room) << i;
        ASSERT_LE(x, box.upper[axis] + room) << i;
      }
      ASSERT_LE(particles.smoothing_length[i], box.largest_smoothing_length) << i;
    }
  }

  splotchcl::test::TemporaryFolder folder_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::vector<std::string> notes_;
};

Component gas_and_stars() {
  Component component;
  component.name = "all";
  component.types = {0, 4};
  return component;
}

TEST_F(ComponentBoxes, HoldParticlesAsTheFileHasThem) {
  expect_all_within(load(gas()));
}

TEST_F(ComponentBoxes, HoldThoseOfSeveralTypes) {
  expect_all_within(load(gas_and_stars()));
}

TEST_F(ComponentBoxes, HoldThoseWrappedAroundTheCamera) {
  expect_all_within(load(gas_and_stars(), true));
}

TEST_F(ComponentBoxes, HoldPlacedOnes) {
  Component component = gas();
  component.center = {{25000, 25000, 25000}};
  component.placement.axis = {{1, 2, 3}};
  component.placement.angle_degrees = 40;
  component.placement.scale = 1.5;
  component.placement.origin = Vec3{{1000, 2000, 3000}};
  expect_all_within(load(component));
}

TEST_F(ComponentBoxes, TellAFixedSize) {
  Component component = gas();
  component.size_fixed = 12;
  const Particles particles = load(component);
  expect_all_within(particles);
  EXPECT_EQ(particles.boxes->around(0, 1).largest_smoothing_length, 12);
}

TEST_F(ComponentBoxes, AreNotThereForSelectedParticlesAndOtherSizes) {
  Component selected = gas();
  selected.select.where = {"internal_energy < 1000"};
  EXPECT_FALSE(load(selected).boxes);
  Component sized = gas();
  sized.size_field = "density";
  EXPECT_FALSE(load(sized).boxes);
}

TEST_F(ComponentBoxes, OfAChangedFileAreNotUsedAndTold) {
  const auto file = folder_ / "u";
  std::filesystem::last_write_time(
      file, std::filesystem::last_write_time(file) + std::chrono::seconds(2));
  snapshot_ = open_snapshot(file);
  EXPECT_FALSE(load(gas()).boxes);
  EXPECT_THAT(notes_, Contains(HasSubstr("splotchcl index makes it anew")));
}

}  // namespace
}  // namespace splotchcl::test
