#include "view/tree_maker.h"

#include <chrono>
#include <thread>

#include "load/component_tree.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "testing.h"
#include "tree/tree_preview.h"
#include "tree/tree_scenes.h"

namespace splotchcl::view {
namespace {

constexpr std::uint64_t particles = 20000;

std::shared_ptr<test::MemorySnapshot> snapshot_of(const test::Matter& matter) {
  auto snapshot = std::make_shared<test::MemorySnapshot>();
  snapshot->add(0, "position", matter.position, 3);
  snapshot->add(0, "smoothing_length", matter.h);
  snapshot->add(0, "mass", matter.mass);
  snapshot->add(0, "temperature", matter.color);
  return snapshot;
}

Scene scene_of_gas() {
  Scene scene;
  Camera camera;
  camera.position = {{0.5, -1.6, 0.7}};
  camera.look_at = {{0.5, 0.5, 0.5}};
  scene.camera = camera;
  Component gas;
  gas.color.field = "temperature";
  gas.color.scaling = Scaling::log;
  scene.components = {gas};
  return scene;
}

// Waits for it as long as a slow machine may take.
const Trees* trees_of(const TreeMaker& maker) {
  for (int tenths = 0; tenths < 600 && maker.trees() == nullptr; ++tenths)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return maker.trees();
}

Frame load(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  return load_frame(scene, snapshot, notes);
}

TEST(TreeMaker, MakesATreeThatPreviewsAreDrawnFrom) {
  const auto snapshot = snapshot_of(test::clumps(particles, 1));
  const Scene scene = scene_of_gas();
  EXPECT_EQ(load(scene, *snapshot).components.front().particles.tree, nullptr);
  const TreeMaker maker(scene, snapshot, particles);
  const Trees* const trees = trees_of(maker);
  ASSERT_NE(trees, nullptr);
  give_trees(*snapshot, *trees);
  const Frame frame = load(scene, *snapshot);
  ASSERT_NE(frame.components.front().particles.tree, nullptr);
  const std::optional<Frame> nodes = TreePreview().of(frame, particles / 4);
  ASSERT_TRUE(nodes);
  EXPECT_LE(particle_count(*nodes), particles / 4);
}

TEST(TreeMaker, LeavesFewParticlesAsTheyAre) {
  const auto snapshot = snapshot_of(test::clumps(particles, 1));
  const TreeMaker maker(scene_of_gas(), snapshot, particles + 1);
  EXPECT_FALSE(maker.is_at_work());
  EXPECT_EQ(maker.trees(), nullptr);
}

TEST(TreeMaker, MakesNoneWhereATreeIsGiven) {
  const auto snapshot = snapshot_of(test::clumps(particles, 1));
  give_trees(*snapshot, {test::tree_of(test::clumps(particles, 1))});
  EXPECT_FALSE(TreeMaker(scene_of_gas(), snapshot, 1).is_at_work());
}

TEST(TreeMaker, MakesNoneOfManyParticlesInOnePlace) {
  test::Matter matter;
  for (int i = 0; i < 300; ++i)
    matter.add(0.5, 0.5, 0.5, 0.1, 1, 1);
  const auto snapshot = snapshot_of(matter);
  const TreeMaker maker(scene_of_gas(), snapshot, 1);
  while (maker.is_at_work())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(maker.trees(), nullptr);
}

TEST(TreeMaker, GivesUpWithTheView) {
  const auto snapshot = snapshot_of(test::clumps(10 * particles, 1));
  const TreeMaker maker(scene_of_gas(), snapshot, 1);
  EXPECT_TRUE(maker.is_at_work() || maker.trees() != nullptr);
}

}  // namespace
}  // namespace splotchcl::view
