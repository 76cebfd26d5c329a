#include "device/counted_column.h"
#include "splotchcl/camera.h"
#include "testing.h"
#include "view/answers.h"
#include "view/view_drawer.h"

namespace splotchcl::view {
namespace {

// A part of the particles that has the light of all.

Frame frame_of(std::size_t count) {
  std::vector<float> positions, sizes, masses;
  for (std::size_t i = 0; i < count; ++i) {
    for (const float offset : {0.0f, 0.25f, 0.5f})
      positions.push_back(static_cast<float>(i) + offset);
    sizes.push_back(static_cast<float>(i + 1));
    masses.push_back(1);
  }
  Frame frame;
  DrawnComponent component;
  component.particles.count = count;
  component.particles.position = Column::owning(std::move(positions));
  component.particles.smoothing_length = Column::owning(std::move(sizes));
  component.particles.weight = Column::owning(std::move(masses));
  component.particles.color = Column::uniform(5);
  component.reference_column = 8;
  frame.components.push_back(component);
  return frame;
}

TEST(FrameSample, IsTheFrameWhereAllParticlesAreWanted) {
  FrameSampler sampler;
  const Frame frame = frame_of(100);
  EXPECT_EQ(sampler.sample(frame, 0).components[0].particles.count, 100u);
  EXPECT_EQ(sampler.sample(frame, 100).components[0].particles.count, 100u);
}

TEST(FrameSample, HasTheLightOfAll) {
  FrameSampler sampler;
  const DrawnComponent sample = sampler.sample(frame_of(1000), 250).components[0];
  EXPECT_EQ(sample.particles.count, 250u);
  EXPECT_DOUBLE_EQ(sample.reference_column, 2);
  EXPECT_DOUBLE_EQ(sample.particles_per_drawn, 4);
}

TEST(FrameSample, TakesWholeParticlesOfAllTheFrame) {
  FrameSampler sampler;
  const Particles sample = sampler.sample(frame_of(1000), 100).components[0].particles;
  std::set<std::size_t> tenths;
  for (std::size_t i = 0; i < sample.count; ++i) {
    const float number = sample.position[3 * i];
    EXPECT_EQ(sample.position[3 * i + 2], number + 0.5f);
    EXPECT_EQ(sample.smoothing_length[i], number + 1);
    tenths.insert(static_cast<std::size_t>(number) / 10);
  }
  EXPECT_EQ(tenths.size(), 100u);  // one of each run of ten
  EXPECT_EQ(sample.color.uniform_value(), 5);
}

TEST(FrameSample, IsGatheredOnceForTheSameColumns) {
  FrameSampler sampler;
  const Frame frame = frame_of(1000);
  const float* const first = sampler.sample(frame, 100).components[0].particles.position.data();
  EXPECT_EQ(sampler.sample(frame, 100).components[0].particles.position.data(), first);
  Frame other = frame;
  other.components[0].particles.color = Column::uniform(6);
  EXPECT_EQ(sampler.sample(other, 100).components[0].particles.color.uniform_value(), 6);
}

TEST(FrameSample, MakesOfColumnsThatAreStreamedItsOwnValuesOnlyIfTheseLieFarApart) {
  FrameSampler sampler;
  Frame frame = frame_of(100000);
  Particles& particles = frame.components[0].particles;
  const auto sizes = std::make_shared<const test::CountedColumn>(particles.smoothing_length);
  particles.smoothing_length = Column::made_by(sizes);
  sampler.sample(frame, 100);
  EXPECT_EQ(sampler.sample(frame, 100).components[0].particles.smoothing_length.size(), 100u);
  EXPECT_EQ(sizes->made(), 100u);
}

TEST(FrameSample, ForgetsWhatNoFrameHasUsedForSomeTime) {
  FrameSampler sampler;
  std::weak_ptr<const test::CountedColumn> sizes;
  {
    Frame frame = frame_of(1000);
    Particles& particles = frame.components[0].particles;
    const auto made = std::make_shared<const test::CountedColumn>(particles.smoothing_length);
    particles.smoothing_length = Column::made_by(made);
    sizes = made;
    sampler.sample(frame, 100);
  }
  EXPECT_FALSE(sizes.expired());
  const Frame another = frame_of(500);
  for (int i = 0; i < 20; ++i)
    sampler.sample(another, 50);
  EXPECT_TRUE(sizes.expired());
}

TEST(FrameSample, LeavesNoComponentOut) {
  FrameSampler sampler;
  Frame frame = frame_of(10000);
  frame.components.push_back(frame_of(3).components[0]);
  EXPECT_EQ(sampler.sample(frame, 100).components[1].particles.count, 1u);
}

// How values are distributed.

TEST(FieldHistogram, CountsValuesInEqualBins) {
  const auto histogram = field_histogram(Column::owning({0, 1, 2, 3, 4, 4, 4}), Scaling::linear, 4);
  EXPECT_EQ(histogram.minimum, 0);
  EXPECT_EQ(histogram.maximum, 4);
  EXPECT_THAT(histogram.counts, ElementsAre(1, 1, 1, 4));
}

TEST(FieldHistogram, HasBinsThatAreEqualAfterScaling) {
  const auto histogram = field_histogram(Column::owning({1, 5, 50, 500, 1000}), Scaling::log, 3);
  EXPECT_NEAR(histogram.maximum, 1000, 1e-9);
  EXPECT_THAT(histogram.counts, ElementsAre(2, 1, 2));
}

TEST(FieldHistogram, LeavesOutWhatHasNoScaledValue) {
  const auto histogram = field_histogram(Column::owning({-1, 0, 10, 100}), Scaling::log, 2);
  EXPECT_THAT(histogram.counts, ElementsAre(1, 1));
  EXPECT_THAT(field_histogram(Column::owning({-1, 0}), Scaling::log, 2).counts, IsEmpty());
}

TEST(FieldHistogram, HasOneBinOfValuesThatAreAllEqual) {
  EXPECT_THAT(field_histogram(Column::owning({7, 7}), Scaling::linear, 3).counts,
              ElementsAre(2, 0, 0));
}

// What lies under the pointer.

// Looks along z from 10 before the origin; a picture of 100 x 100 pixels.
Frame frame_with(const std::vector<float>& positions, const std::vector<float>& masses) {
  Frame frame;
  frame.width = frame.height = 100;
  Camera camera;
  camera.position = {{0, 0, -10}};
  camera.look_at = {{0, 0, 0}};
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  DrawnComponent component;
  component.particles.count = masses.size();
  component.particles.position = Column::owning(positions);
  component.particles.smoothing_length = Column::uniform(0.1f);
  component.particles.weight = Column::owning(masses);
  frame.components.push_back(component);
  return frame;
}

TEST(Pick, FindsTheParticleUnderThePointer) {
  const auto found = pick_particle(frame_with({0, 0, 0, 3, 0, 0}, {1, 1}), 50, 50);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->a[0], 0);
}

TEST(Pick, FindsNothingInTheDark) {
  EXPECT_FALSE(pick_particle(frame_with({0, 0, 0}, {1}), 10, 10));
}

TEST(Pick, TakesTheMiddleOfTheLightByDepth) {
  const Frame frame = frame_with({0, 0, 8, 0, 0, 0, 0, 0, 4}, {1, 1, 1});
  EXPECT_EQ(pick_particle(frame, 50, 50)->a[2], 4);
}

TEST(Pick, TakesWhatIsBright) {
  const Frame frame = frame_with({0, 0, 8, 0, 0, 0, 0, 0, 4}, {1, 100, 1});
  EXPECT_EQ(pick_particle(frame, 50, 50)->a[2], 0);
}

TEST(Probe, FindsTheMeanOfTheFieldByMassAlongTheLineOfSight) {
  Frame frame = frame_with({0, 0, 8, 0, 0, 0, 3, 0, 0}, {1, 3, 100});
  frame.components[0].particles.color = Column::owning(std::vector<float>{10, 20, 1000});
  const Probe found = probe(frame, 50, 50);
  EXPECT_EQ(*found.distance, 10);
  EXPECT_NEAR(*found.components.at(0).mean, (10 * 1 + 20 * 3) / 4.0, 1e-6);
}

TEST(Probe, FindsTheColumnOfMassThroughACloud) {
  const Frame frame = frame_with({0, 0, 0}, {5});
  const double sigma = frame.kernel.width * 0.1f;
  EXPECT_NEAR(probe(frame, 50, 50).components.at(0).column, 5 / (M_PI * sigma * sigma), 1e-6);
  EXPECT_EQ(probe(frame, 10, 10).components.at(0).column, 0);
  EXPECT_FALSE(probe(frame, 10, 10).components.at(0).mean);
}

TEST(Probe, TellsSomePlacesOfEachComponent) {
  Frame frame = frame_with({1, 2, 3, 4, 5, 6}, {1, 1});
  frame.components.push_back(frame.components.front());
  EXPECT_THAT(some_places(frame, 2), ElementsAre(1, 2, 3, 1, 2, 3));
}

TEST(Pick, LeavesOutWhatIsBehindTheCamera) {
  EXPECT_FALSE(pick_particle(frame_with({0, 0, -20}, {1}), 50, 50));
}

TEST(ErrorsForAPage, DoNotQuoteFiles) {
  EXPECT_EQ(
      text_for_page(DataError("a/palette.txt:1: found \"password=hunter2\", expected a number")),
      "a/palette.txt:1: found (not shown), expected a number");
  EXPECT_EQ(text_for_page(DataError("t.txt: found 'it's a secret', expected x; the user's file")),
            "t.txt: found (not shown), expected x; the user's file");
  EXPECT_EQ(text_for_page(DataError("t.txt: found \"no end")), "t.txt: found (not shown)");
}

TEST(ErrorsForAPage, RepeatWhatThePageHasSent) {
  EXPECT_EQ(text_for_page(UsageError("palette: found 'secret', expected another")),
            "palette: found 'secret', expected another");
}

}  // namespace
}  // namespace splotchcl::view
