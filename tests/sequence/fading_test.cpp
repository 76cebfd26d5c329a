// Particles that only one of two snapshots has, or that cannot be told apart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sequence/moving_snapshot.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// 1 vanishes, 2 stays, 3 appears.
std::shared_ptr<const SequenceMember> before() {
  return MovingSnapshot(0)
      .ids(0, {1, 2})
      .positions(0, {5, 5, 5, 0, 0, 0})
      .field(0, "mass", {10, 20})
      .field(0, "smoothing_length", {1, 1})
      .make();
}
std::shared_ptr<const SequenceMember> after() {
  return MovingSnapshot(1)
      .ids(0, {3, 2})
      .positions(0, {9, 9, 9, 4, 0, 0})
      .field(0, "mass", {30, 20})
      .field(0, "smoothing_length", {1, 1})
      .make();
}

TEST(Strangers, FadeWhereTheyAre) {
  const InterpolatedSnapshot snapshot = between(before(), after(), 0.25);
  EXPECT_EQ(snapshot.info().types[0].count, 3U);
  EXPECT_THAT(snapshot.read_ids(0), ElementsAre(1, 2, 3));
  EXPECT_THAT(values(snapshot, "position"), ElementsAre(5, 5, 5, 1, 0, 0, 9, 9, 9));
  EXPECT_THAT(values(snapshot, "mass"), ElementsAre(10, 20, 30));
  EXPECT_THAT(values(snapshot, fade_field), ElementsAre(0.75F, 1, 0.25F));
}

Component gas(WeightModel weight) {
  Component component;
  component.weight = weight;
  component.reference_column = 1;
  return component;
}

std::vector<float> weights_drawn(WeightModel model) {
  Scene scene;
  scene.components = {gas(model)};
  scene.camera = Camera{};
  scene.camera->position = {{0, 0, -10}};
  scene.camera->look_at = {{0, 0, 0}};
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene, between(before(), after(), 0.25), notes);
  const Column weight = frame.components[0].particles.weight;
  return {weight.data(), weight.data() + weight.size()};
}

TEST(Strangers, FadeInEveryWeight) {
  EXPECT_THAT(weights_drawn(WeightModel::mass), ElementsAre(7.5F, 20, 7.5F));
  EXPECT_THAT(weights_drawn(WeightModel::constant), ElementsAre(0.75F, 1, 0.25F));
}

TEST(Strangers, OfATypeThatOneSnapshotLacksFade) {
  auto first = MovingSnapshot(0).ids(0, {1, 2}).positions(0, {0, 0, 0, 1, 1, 1}).make();
  auto second = MovingSnapshot(1)
                    .ids(0, {1})
                    .ids(4, {2})
                    .positions(0, {0, 0, 0})
                    .positions(4, {1, 1, 1})
                    .make();
  const InterpolatedSnapshot snapshot = between(first, second, 0.25);
  EXPECT_THAT(values(snapshot, fade_field, 0), ElementsAre(1, 0.75F));
  EXPECT_THAT(values(snapshot, fade_field, 4), ElementsAre(0.25F));
  EXPECT_THAT(values(snapshot, "position", 4), ElementsAre(1, 1, 1));
}

TEST(Strangers, MoveOnAlongTheirVelocityWithHermite) {
  auto first = MovingSnapshot(0)
                   .ids(0, {1, 2})
                   .positions(0, {0, 0, 0, 10, 0, 0})
                   .velocities(0, {4, 0, 0, 1, 0, 0})
                   .make();
  auto second = MovingSnapshot(2)
                    .ids(0, {2, 3})
                    .positions(0, {12, 0, 0, 20, 0, 0})
                    .velocities(0, {1, 0, 0, 0, 8, 0})
                    .make();
  EXPECT_THAT(values(between(first, second, 0.25, Interpolation::hermite), "position"),
              ElementsAre(2, 0, 0, FloatEq(10.5), 0, 0, 20, -12, 0));
}

TEST(Strangers, AloneAreRefused) {
  const auto first = MovingSnapshot(0).ids(0, {1}).positions(0, {0, 0, 0}).make();
  const auto second = MovingSnapshot(1).ids(0, {2}).positions(0, {0, 0, 0}).make();
  try {
    between(first, second, 0.5);
    FAIL();
  } catch (const DataError& error) {
    EXPECT_THAT(error.what(), HasSubstr("snapshots of the same run"));
  }
}

TEST(SharedIds, FadeAndAreNamed) {
  auto first = MovingSnapshot(0).ids(0, {4, 4, 5}).positions(0, {0, 0, 0, 1, 0, 0, 2, 0, 0}).make();
  auto second = MovingSnapshot(1).ids(0, {4, 5}).positions(0, {8, 0, 0, 4, 0, 0}).make();
  const InterpolatedSnapshot snapshot = between(first, second, 0.5);
  EXPECT_THAT(values(snapshot, "position"), ElementsAre(0, 0, 0, 1, 0, 0, 3, 0, 0, 8, 0, 0));
  EXPECT_THAT(values(snapshot, fade_field), ElementsAre(0.5F, 0.5F, 1, 0.5F));
  EXPECT_THAT(snapshot.info().notes, Contains(HasSubstr("share their id")));
}

TEST(Acquaintances, HaveNothingThatFades) {
  const auto make = [] { return MovingSnapshot(0).ids(0, {1}).positions(0, {0, 0, 0}).make(); };
  const InterpolatedSnapshot snapshot = between(make(), make(), 0.5);
  EXPECT_EQ(find_field(snapshot.info().types[0], fade_field), nullptr);
  EXPECT_THAT(snapshot.info().notes, IsEmpty());
}

}  // namespace
}  // namespace splotchcl
