// The least that stages have to move and to compute.
#include "floors.h"

#include "testing.h"

namespace splotchcl::bench {
namespace {

// A byte a second everywhere, so that seconds are bytes.
MachineRates slow_machine() {
  MachineRates rates;
  rates.memory_bandwidth = rates.chunk_bandwidth = 1;
  return rates;
}

FrameCounts sums() {
  FrameCounts counts;
  counts.particles = 100;
  counts.particle_bytes = 24;
  counts.splats = 10;
  counts.splat_bytes = 28;
  counts.summed = {20, 50};
  counts.entry_bytes = 28;
  counts.key_bytes = 6;
  counts.pixels = 1000;
  counts.planes = 3;
  counts.chunks = 1;
  return counts;
}

FrameCounts ordered() {
  FrameCounts counts = sums();
  counts.is_ordered = true;
  counts.splat_bytes = 32;
  counts.entry_bytes = 40;
  counts.planes = 6;
  counts.layered = {20, 50};
  counts.summed = {};
  return counts;
}

StageFloor floor_of(const std::string& stage, const FrameCounts& counts,
                    const MachineRates& rates = slow_machine()) {
  for (const StageFloor& floor : floors_of(counts, rates))
    if (floor.stage == stage) return floor;
  ADD_FAILURE() << "no stage " << stage;
  return {};
}

std::vector<std::string> stages_of(const FrameCounts& counts) {
  std::vector<std::string> stages;
  for (const StageFloor& floor : floors_of(counts, slow_machine()))
    stages.push_back(floor.stage);
  return stages;
}

TEST(Floors, OnlyOrderedFramesSort) {
  EXPECT_EQ(stages_of(sums()),
            (std::vector<std::string>{"project", "bin", "certify", "composite", "resolve"}));
  EXPECT_EQ(stages_of(ordered()), (std::vector<std::string>{"project", "sort", "bin", "certify",
                                                            "composite", "resolve"}));
}

TEST(Floors, FramesOfToleranceZeroCollectNothingForTheCheck) {
  FrameCounts counts = sums();
  counts.is_collected = false;
  EXPECT_EQ(stages_of(counts),
            (std::vector<std::string>{"project", "bin", "composite", "resolve"}));
}

TEST(Floors, AParticleOutOfViewIsReadForItsPositionAlone) {
  EXPECT_EQ(floor_of("project", sums()).frame_bytes, 100 * 12 + 10 * 12);
}

TEST(Floors, ASplatOfSumsIsWrittenWithItsTilesWhereItsLineIsReadFirst) {
  EXPECT_EQ(floor_of("project", sums()).chunk_bytes, 2 * 10 * (28 + 4));
}

TEST(Floors, ASplatInOrderIsWrittenWithItsKeyAndPlace) {
  const StageFloor floor = floor_of("project", ordered());
  EXPECT_EQ(floor.frame_bytes, 100 * 12 + 10 * 12 + 2 * 10 * (32 + 6 + 4));
  EXPECT_EQ(floor.chunk_bytes, 0);
}

TEST(Floors, APairPassesFourTimesThroughTheSort) {
  // Its key, and key and place; then key and place written.
  EXPECT_EQ(floor_of("sort", ordered()).frame_bytes, 10 * 4 * (4 + 8 + 2 * 8));
}

TEST(Floors, AnEntryIsWrittenByBinAndReadByTheTwoStagesAfterIt) {
  EXPECT_EQ(floor_of("bin", sums()).chunk_bytes, 2 * 20 * 28 + 10 * (28 + 4));
  EXPECT_EQ(floor_of("certify", sums()).chunk_bytes, 20 * 28);
  EXPECT_EQ(floor_of("composite", sums()).chunk_bytes, 20 * 28);
}

TEST(Floors, SplatsInOrderAreGatheredFromTheWholeFrame) {
  const StageFloor floor = floor_of("bin", ordered());
  EXPECT_EQ(floor.frame_bytes, 10 * (4 + 32));
  EXPECT_EQ(floor.chunk_bytes, 2 * 20 * 40);
}

TEST(Floors, EverySlabReadsAndWritesThePlanesOnceMore) {
  FrameCounts counts = ordered();
  const double without = floor_of("resolve", counts).frame_bytes;
  counts.slabs = 5;
  EXPECT_EQ(floor_of("resolve", counts).frame_bytes - without, 5 * 2 * 1000 * 6 * 4);
}

TEST(Floors, ArraysOfAChunkMoveAtTheirOwnBandwidth) {
  MachineRates rates = slow_machine();
  rates.memory_bandwidth = 100;
  rates.chunk_bandwidth = 10;
  const StageFloor floor = floor_of("bin", ordered(), rates);
  EXPECT_DOUBLE_EQ(floor.byte_seconds, floor.frame_bytes / 100 + floor.chunk_bytes / 10);
}

TEST(Floors, APixelTakesThreeMultiplyAddsInSumsAndNineInLayers) {
  FrameCounts counts = ordered();
  counts.summed = {3, 7};
  MachineRates rates = slow_machine();
  rates.multiply_adds = 2;
  EXPECT_EQ(multiply_adds_of(counts), 8 * (9 * 50 + 3 * 7));
  EXPECT_EQ(floor_of("composite", counts, rates).operation_seconds, 4 * (9 * 50 + 3 * 7));
}

TEST(Floors, TheLeastIsTheLongerOfBytesAndOperations) {
  StageFloor floor;
  floor.byte_seconds = 2;
  floor.operation_seconds = 1;
  EXPECT_EQ(floor.seconds(), 2);
  floor.operation_seconds = 3;
  EXPECT_EQ(floor.seconds(), 3);
}

TEST(Floors, AChunkHasItsShareOfTheEntries) {
  FrameCounts counts = sums();
  counts.chunks = 4;
  EXPECT_EQ(chunk_bytes(counts), 20 * 28 / 4);
}

}  // namespace
}  // namespace splotchcl::bench
