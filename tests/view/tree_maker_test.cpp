// What the live view does beside its pages: trees, and frames in turn.
#include "view/tree_maker.h"

#include <chrono>
#include <thread>

#include "load/component_tree.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "testing.h"
#include "tree/tree_preview.h"
#include "tree/tree_scenes.h"
#include "view/frame_scheduler.h"

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

using Stage = FrameScheduler::Stage;
using std::chrono::milliseconds;

// What is drawn next for a page.

const FrameScheduler::Time start;

TEST(FrameScheduler, HasNothingToDrawWithoutInput) {
  const FrameScheduler scheduler;
  EXPECT_FALSE(scheduler.next(start));
  EXPECT_FALSE(scheduler.wake_time());
}

TEST(FrameScheduler, TheNewestInputWins) {
  FrameScheduler scheduler;
  for (int i = 0; i < 200; ++i)
    scheduler.take_input(true, start);
  const auto task = scheduler.next(start);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->input, 200u);
  scheduler.sent(*task);
  EXPECT_FALSE(scheduler.next(start));  // none of the others
}

TEST(FrameScheduler, APreviewComesAtOnceAndTheExactPictureAtRest) {
  FrameScheduler scheduler;
  scheduler.take_input(false, start);
  const auto preview = scheduler.next(start);
  ASSERT_TRUE(preview);
  EXPECT_EQ(preview->stage, Stage::preview);
  scheduler.acknowledge(scheduler.sent(*preview));
  EXPECT_FALSE(scheduler.next(start));
  ASSERT_EQ(scheduler.wake_time(), start + FrameScheduler::rest);
  const auto exact = scheduler.next(start + FrameScheduler::rest);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->stage, Stage::exact);
  scheduler.acknowledge(scheduler.sent(*exact));
  EXPECT_FALSE(scheduler.next(start + milliseconds(10000)));
  EXPECT_FALSE(scheduler.wake_time());
}

TEST(FrameScheduler, WhileSomethingMovesRestIsLonger) {
  FrameScheduler scheduler;
  scheduler.take_input(true, start);
  scheduler.acknowledge(scheduler.sent(*scheduler.next(start)));
  EXPECT_FALSE(scheduler.next(start + FrameScheduler::rest));
  EXPECT_TRUE(scheduler.next(start + FrameScheduler::rest_while_moving));
}

TEST(FrameScheduler, TwoFramesAtMostAreOnTheirWay) {
  FrameScheduler scheduler;
  std::uint64_t first = 0;
  for (int i = 0; i < 2; ++i) {
    scheduler.take_input(true, start);
    const std::uint64_t frame = scheduler.sent(*scheduler.next(start));
    if (i == 0) first = frame;
  }
  const std::uint64_t newest = scheduler.take_input(true, start);
  EXPECT_FALSE(scheduler.next(start));
  EXPECT_FALSE(scheduler.wake_time());
  scheduler.acknowledge(99);  // never sent
  EXPECT_FALSE(scheduler.next(start));
  scheduler.acknowledge(first);
  ASSERT_TRUE(scheduler.next(start));
  EXPECT_EQ(scheduler.next(start)->input, newest);
}

TEST(FrameScheduler, NewInputMakesAnExactPictureUseless) {
  FrameScheduler scheduler;
  const FrameScheduler::Task exact{Stage::exact, scheduler.take_input(false, start)};
  EXPECT_FALSE(scheduler.is_outdated(exact));
  scheduler.take_input(true, start);
  EXPECT_TRUE(scheduler.is_outdated(exact));
}

TEST(FrameScheduler, WhatFailedIsNotTriedAgain) {
  FrameScheduler scheduler;
  const std::uint64_t input = scheduler.take_input(false, start);
  scheduler.failed({Stage::preview, input});
  scheduler.failed({Stage::exact, input});
  EXPECT_FALSE(scheduler.next(start + milliseconds(10000)));
  scheduler.take_input(false, start);
  EXPECT_TRUE(scheduler.next(start));
}

// How much of the data previews show.

constexpr double target = 1.0 / 30;

TEST(PreviewQuality, EndsWithAllParticlesAtFullSize) {
  for (const std::uint64_t particles : {1ull, 32768ull, 32769ull, 16777216ull}) {
    const PreviewLevel finest = preview_levels(particles).back();
    EXPECT_EQ(finest.particles, 0u) << particles;
    EXPECT_EQ(finest.divisor, 1) << particles;
  }
}

TEST(PreviewQuality, BeginsCoarse) {
  const PreviewQuality quality(16777216, target);
  EXPECT_EQ(quality.level().particles, 32768u);
  EXPECT_EQ(quality.level().divisor, 4);
}

TEST(PreviewQuality, GetsFinerWhilePreviewsAreQuick) {
  PreviewQuality quality(16777216, target);
  for (int i = 0; i < 100; ++i)
    quality.drawn(0.1 * target);
  EXPECT_EQ(quality.level().particles, 0u);
  EXPECT_EQ(quality.level().divisor, 1);
}

TEST(PreviewQuality, GetsCoarserWhenOneIsTooSlow) {
  PreviewQuality quality(1000000, target);
  quality.drawn(0.1 * target);
  EXPECT_EQ(quality.level().divisor, 2);
  quality.drawn(2 * target);
  EXPECT_EQ(quality.level().divisor, 4);
}

TEST(PreviewQuality, DoesNotGoBackAndForth) {
  PreviewQuality quality(1000000, target);
  quality.drawn(0.1 * target);
  quality.drawn(2 * target);
  for (int i = 0; i < 30; ++i)
    quality.drawn(0.1 * target);
  EXPECT_EQ(quality.level().divisor, 4);
}

TEST(PreviewQuality, StaysWhereTheNextLevelWouldBeTooSlow) {
  PreviewQuality quality(1000000, target);
  for (int i = 0; i < 100; ++i)
    quality.drawn(0.6 * target);
  EXPECT_EQ(quality.level().divisor, 4);
}

}  // namespace
}  // namespace splotchcl::view
