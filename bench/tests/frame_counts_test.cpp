// What is counted in the lists of a frame is what the renderer drew.
#include "frame_counts.h"

#include "synthetic.h"
#include "testing.h"

namespace splotchcl::bench {
namespace {

class CountsOfFrames : public testing::TestWithParam<LightPlan> {};

// Of frames whose first plan is kept: those that are drawn again have other lists.
TEST_P(CountsOfFrames, HaveTheEntriesThatWereDrawn) {
  CloudSetup setup;
  setup.count = 2000;
  setup.width = 300;
  setup.height = 200;
  Frame frame = cloud_frame(setup.width, setup.height, {make_clouds(setup)});
  set_light(frame, GetParam());
  Renderer renderer;
  renderer.render(frame);
  ASSERT_EQ(renderer.stats().check.errors_of_promise.size(), 1u);
  const FrameCounts counts = frame_counts(frame, renderer.stats(), "");
  EXPECT_EQ(counts.entries(), static_cast<double>(renderer.stats().tile_entries));
  EXPECT_EQ(counts.layered.entries > 0, GetParam() == LightPlan::ordered);
}

INSTANTIATE_TEST_SUITE_P(Plans, CountsOfFrames,
                         testing::Values(LightPlan::proportional, LightPlan::ordered),
                         [](const auto& info) { return std::string(name(info.param)); });

TEST(RowParts, ADiscInsideOfATileHasOneForEachOfItsNarrowRows) {
  EXPECT_EQ(row_parts_of({0.5f, 0.5f, 1.5f}, 32, 32), 3);
}

TEST(RowParts, AWideRowHasOneForEachEightPixels) {
  // Two rows, of 17 and of 19 pixels.
  EXPECT_EQ(row_parts_of({0.5f, 0.5f, 9.0f}, 64, 2), 3 + 3);
}

TEST(RowParts, ADiscThatCoversTheTileHasAllOfThem) {
  EXPECT_EQ(row_parts_of({3, -2, 100}, 64, 32), 32 * 8);
}

TEST(RowParts, ADiscThatIsCutByTheTileHasThoseInsideAlone) {
  EXPECT_EQ(row_parts_of({-16, 0.5f, 1.0f}, 32, 32), 1);
}

TEST(RowParts, ADiscBesideTheTileAndASplatThatIsOnlyListedHaveNone) {
  EXPECT_EQ(row_parts_of({40, 0, 5}, 32, 32), 0);
  EXPECT_EQ(row_parts_of({0, 0, -5}, 32, 32), 0);
}

TEST(Patches, AWideDiscHasNoneInTheCornersOfItsSquare) {
  // Six rows of the two middle columns, four of the outer ones.
  EXPECT_EQ(patches_of({0, 0, 20}, 64, 64, {16, 8}), 2 * 6 + 2 * 4);
}

TEST(Patches, ADiscThatCoversTheTileHasAllOfThem) {
  EXPECT_EQ(patches_of({3, -2, 100}, 64, 32, {8, 4}), 64);
}

TEST(Patches, ADiscOfSevenPixelsInTheTileHasNone) {
  EXPECT_EQ(patches_of({0.5f, 0.5f, 3.4f}, 64, 32, {16, 8}), 0);
  EXPECT_EQ(patches_of({0, 0, 9}, 64, 32, {16, 8}), 2 * 4);
}

TEST(Patches, ADiscBesideTheTileAndASplatThatIsOnlyListedHaveNone) {
  EXPECT_EQ(patches_of({80, 0, 30}, 64, 32, {16, 8}), 0);
  EXPECT_EQ(patches_of({0, 0, -20}, 64, 32, {16, 8}), 0);
}

}  // namespace
}  // namespace splotchcl::bench
