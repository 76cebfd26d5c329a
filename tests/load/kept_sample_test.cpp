// What follows from a sample of a snapshot's particles is found in the sample that a tree keeps.
#include "load/component_tree.h"
#include "load/particles.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class KeptSample : public ::testing::Test {
 protected:
  void SetUp() override {
    write_universe(folder_ / "u", 3000);
    const auto snapshot = open();
    std::vector<std::string> notes;
    source_ = tree_source(*snapshot, gas_type, {"internal_energy"}, notes, {});
    sample_.origin = source_.origin;
    sample_.particles = {
        source_.position, source_.smoothing_length, source_.weights, {source_.fields[0].values}};
    sample_.other_names = {"density"};
    sample_.others = {snapshot->read(gas_type, "density")};
  }

  std::shared_ptr<const Snapshot> open() const { return open_snapshot(folder_ / "u"); }

  // Of a tree that keeps the sample.
  std::shared_ptr<const Snapshot> with_tree() const {
    auto tree = std::make_shared<TreeOfType>(build_tree(source_, {}));
    tree->sample = sample_;
    const auto snapshot = open();
    give_trees(*snapshot, {tree});
    return snapshot;
  }

  static Scene scene() {
    Component component = gas();
    component.types = {gas_type};
    component.color = {"internal_energy", Scaling::log, {}, {}};
    return scene_of({component});
  }
  static DecidedScene decided(const Snapshot& snapshot, const Scene& scene) {
    std::vector<std::string> notes;
    return decide(scene, snapshot, notes);
  }

  static Column times(const Column& column, float factor) {
    std::vector<float> values;
    for (std::size_t i = 0; i < column.size(); ++i)
      values.push_back(factor * column[i]);
    return Column::owning(std::move(values));
  }

  static constexpr int gas_type = 0;
  TemporaryFolder folder_;
  TreeSource source_;
  ParticleSample sample_;  // of every particle
};

TEST_F(KeptSample, DecidesWhatAllParticlesDo) {
  Scene open_scene = scene();
  open_scene.camera.reset();
  const DecidedScene all = decided(*open(), open_scene), kept = decided(*with_tree(), open_scene);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(kept.scene.camera->position.a[axis], all.scene.camera->position.a[axis]);
  EXPECT_EQ(kept.components[0].reference_column, all.components[0].reference_column);
  EXPECT_EQ(kept.components[0].color.minimum, all.components[0].color.minimum);
  EXPECT_EQ(kept.components[0].color.maximum, all.components[0].color.maximum);
}

TEST_F(KeptSample, TellsRanges) {
  const double all = decided(*open(), scene()).components[0].color.maximum;
  sample_.particles.fields[0] = times(sample_.particles.fields[0], 10);
  EXPECT_NEAR(decided(*with_tree(), scene()).components[0].color.maximum, all + 1, 1e-6);
}

TEST_F(KeptSample, DoesNotTellTheLargestOfAllValues) {
  Scene to_the_ends = scene();
  to_the_ends.components[0].color.percentiles = {0.0, 100.0};
  const double all = decided(*open(), to_the_ends).components[0].color.maximum;
  sample_.particles.fields[0] = times(sample_.particles.fields[0], 10);
  EXPECT_EQ(decided(*with_tree(), to_the_ends).components[0].color.maximum, all);
}

TEST_F(KeptSample, TellsTheReferenceColumn) {
  const double all = decided(*open(), scene()).components[0].reference_column;
  sample_.particles.weight = times(sample_.particles.weight, 3);
  EXPECT_NEAR(decided(*with_tree(), scene()).components[0].reference_column / all, 3, 1e-6);
}

TEST_F(KeptSample, TellsWhatASuggestedSceneShows) {
  const Component all = suggest_scene(*open()).components[0];
  ASSERT_EQ(all.color.field, "internal_energy");
  sample_.particles.fields[0] = Column::owning(std::vector<float>(source_.count, 1));
  const Component kept = suggest_scene(*with_tree()).components[0];
  EXPECT_EQ(kept.color.field, "density");
  EXPECT_GT(*kept.color.maximum, *kept.color.minimum);
}

TEST_F(KeptSample, TellsWhereTheCameraStands) {
  Scene open_scene = scene();
  open_scene.camera.reset();
  const Vec3 all = decided(*open(), open_scene).scene.camera->look_at;
  sample_.particles.position = times(sample_.particles.position, 0.5F);
  EXPECT_LT(decided(*with_tree(), open_scene).scene.camera->look_at.a[0], 0.75 * all.a[0]);
}

TEST_F(KeptSample, OfAnotherStrideIsNotUsed) {
  const double all = decided(*open(), scene()).components[0].color.maximum;
  sample_.particles.fields[0] = times(sample_.particles.fields[0], 10);
  sample_.stride = 2;
  EXPECT_EQ(decided(*with_tree(), scene()).components[0].color.maximum, all);
}

TEST_F(KeptSample, OfFewParticlesIsNotKept) {
  EXPECT_FALSE(sample_to_keep(*open(), source_));
}

}  // namespace
}  // namespace splotchcl::test
