// The share of each rank, and passes over all of them.
#include "device/ranks/rank_share.h"

#include "device/walk/key_slices.h"
#include "device/walk/relay.h"
#include "ranks/spread_particles.h"
#include "ranks/thread_ranks.h"
#include "reference/frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

DeviceTraits small_sizes() {
  DeviceTraits traits;
  traits.project_block = 4;
  traits.chunk_blocks = 2;
  traits.leaf_chunks = 3;
  traits.sorted_chunk = 10;
  return traits;
}

TEST(RankShare, GivesEachLeafToOneRank) {
  for (const std::size_t leaves : {0u, 1u, 2u, 5u, 64u}) {
    for (const int ranks : {1, 2, 3, 8, 100}) {
      std::size_t next = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        const ChunkRange own = leaves_of_rank(leaves, rank, ranks);
        EXPECT_EQ(own.first, next);
        for (std::size_t leaf = own.first; leaf < own.end; ++leaf)
          EXPECT_EQ(owner_of_leaf(leaf, leaves, ranks), rank);
        next = own.end;
      }
      EXPECT_EQ(next, leaves);
      if (leaves > 0) {
        EXPECT_EQ(owner_of_leaf(0, leaves, ranks), 0);
      }
    }
  }
}

// No chunk lies across the border of two of one process, where columns in pieces may be cut.
TEST(RankShare, GivesEachParticleToOneRankInOrder) {
  DeviceTraits sizes = small_sizes();
  sizes.chunk_blocks = 4;
  Frame frame;
  for (const std::size_t count : {50u, 3u, 0u, 21u}) {
    frame.components.emplace_back();
    frame.components.back().particles.count = count;
  }
  for (const int ranks : {1, 2, 3, 5, 40}) {
    std::vector<std::uint64_t> next(frame.components.size());
    std::uint32_t component = 0;
    for (int rank = 0; rank < ranks; ++rank) {
      for (const ParticleChunk& chunk : particles_of_rank(frame, sizes, rank, ranks)) {
        EXPECT_GE(chunk.component, component);
        component = chunk.component;
        EXPECT_EQ(chunk.first, next[component]);
        EXPECT_EQ(chunk.first % 4, 0u);
        const std::uint64_t length =
            particles_per_chunk(frame.components[component].particles.count, sizes);
        EXPECT_EQ(chunk.first / length, (chunk.end - 1) / length);
        next[component] = chunk.end;
      }
    }
    EXPECT_EQ(next, (std::vector<std::uint64_t>{50, 3, 0, 21})) << ranks;
  }
}

TEST(ParticleChunks, AreOfOneLengthButTheLast) {
  DeviceTraits sizes = small_sizes();
  sizes.chunk_blocks = 4;
  for (std::size_t count = 0; count < 100; ++count) {
    Frame frame;
    frame.components.emplace_back();
    frame.components.back().particles.count = count;
    std::uint64_t next = 0;
    for (const ParticleChunk& chunk : particle_chunks(frame, sizes)) {
      EXPECT_EQ(chunk.first, next);
      EXPECT_TRUE(chunk.end == count || chunk.count() == particles_per_chunk(count, sizes));
      EXPECT_LE(chunk.count(), sizes.chunk_length());
      next = chunk.end;
    }
    EXPECT_EQ(next, count);
  }
}

TEST(SumLeaves, FollowFromTheNumberOfChunksAlone) {
  const std::vector<ChunkRange> leaves = sum_leaves(7, small_sizes());
  ASSERT_EQ(leaves.size(), 3u);
  EXPECT_EQ(leaves[1].first, 3u);
  EXPECT_EQ(leaves[2].end, 7u);
  EXPECT_EQ(sum_leaves(100000, small_sizes()).size(), 1021u);
  EXPECT_TRUE(sum_leaves(0, small_sizes()).empty());
}

TEST(SumLeaves, AreJoinedByATreeThatIsFullToTheLeft) {
  EXPECT_EQ(left_leaves(2), 1u);
  EXPECT_EQ(left_leaves(3), 2u);
  EXPECT_EQ(left_leaves(4), 2u);
  EXPECT_EQ(left_leaves(5), 4u);
  EXPECT_EQ(left_leaves(1000), 512u);
}

TEST(SumLeaves, AreHeldOncePerLevelOfTheTree) {
  EXPECT_EQ(most_held_leaves(0), 0u);
  EXPECT_EQ(most_held_leaves(1), 1u);
  EXPECT_EQ(most_held_leaves(2), 2u);
  EXPECT_EQ(most_held_leaves(3), 2u);  // the first two are added up by then
  EXPECT_EQ(most_held_leaves(4), 3u);
  EXPECT_EQ(most_held_leaves(1024), 11u);
}

TEST(SliceParts, CoverAllChunksOnce) {
  for (const std::vector<std::uint64_t>& sizes :
       {std::vector<std::uint64_t>{33, 40, 27}, {100, 0, 0}, {0, 0, 100}, {3, 4, 93}, {1, 2, 2}}) {
    std::uint64_t total = 0;
    for (const std::uint64_t size : sizes)
      total += size;
    const std::vector<SplatChunk> chunks = splat_chunks(total, 0, small_sizes());
    std::size_t next = 0;
    std::uint32_t passed_on = 0;
    KeySlice slice;
    for (const std::uint64_t size : sizes) {
      slice.splats = size;
      const SlicePart part = part_of(slice, chunks);
      EXPECT_EQ(part.carried, passed_on);
      EXPECT_EQ(part.own, size);
      EXPECT_EQ(part.first_chunk, next);
      EXPECT_EQ(part.first + part.carried, slice.first);
      next = part.end_chunk;
      passed_on = part.passed_on;
      slice.first += size;
    }
    EXPECT_EQ(next, chunks.size());
    EXPECT_EQ(passed_on, 0u);
  }
}

TEST(RelayBands, AreWholeRowsOfTiles) {
  PictureLayout layout;
  layout.grids.emplace_back();
  layout.grids.front().tiles_x = 5;
  layout.grids.front().tiles_y = 7;
  for (const int ranks : {2, 3, 100}) {
    std::uint32_t next = 0;
    for (const TileBand& band : relay_bands(layout, ranks)) {
      EXPECT_EQ(band.first, next);
      EXPECT_EQ(band.end % 5, 0u);
      EXPECT_GT(band.end, band.first);
      next = band.end;
    }
    EXPECT_EQ(next, 35u);
  }
  EXPECT_EQ(relay_bands(layout, 2).size(), 4u);
}

TEST(RelayBands, TakeTheirPartOfOthers) {
  const std::vector<TileBand> parts = parts_in({10, 20}, {{0, 5}, {5, 12}, {12, 18}, {18, 40}});
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].first, 10u);
  EXPECT_EQ(parts[0].end, 12u);
  EXPECT_EQ(parts[2].first, 18u);
  EXPECT_EQ(parts[2].end, 20u);
}

// What ranks find in a pass that they make together is known to all, in the order of the particles.

std::shared_ptr<Communicator> borrowed(Communicator& ranks) {
  return {std::shared_ptr<Communicator>(), &ranks};
}

// The numbers of the particles.
void list(const ParticleRun& run, std::vector<int>& found) {
  for (std::size_t i = run.begin; i < run.end; ++i)
    found.push_back(static_cast<int>(i));
}

std::vector<int> counted(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(RankPass, GoesOverAllParticlesInEqualRuns) {
  for (const int count : {0, 2, 10}) {
    for (int size = 1; size <= 4; ++size) {
      ThreadRanks::run(size, [&](Communicator& ranks) {
        const ParticlePass pass = shared_pass(borrowed(ranks), static_cast<std::size_t>(count));
        EXPECT_EQ(pass.collect<int>(list), counted(count));
        const std::vector<std::size_t> lengths =
            pass.collect<std::size_t>([](const ParticleRun& run, std::vector<std::size_t>& found) {
              found.push_back(run.end - run.begin);
            });
        ASSERT_EQ(lengths.size(), static_cast<std::size_t>(size));
        for (const std::size_t length : lengths)
          EXPECT_LE(length, static_cast<std::size_t>((count + size - 1) / size));
      });
    }
  }
}

TEST(RankPass, IsThatOfOneProcessWithoutRanks) {
  EXPECT_EQ(shared_pass(nullptr, 5).collect<int>(list), counted(5));
}

// Particles 0 to 5 of one type and 6 to 11 of another, of which each rank has two.
TEST(RankPass, JoinsTheRunsOfEachTypeBeforeTheNext) {
  ThreadRanks::run(3, [](Communicator& ranks) {
    const auto first = 2 * static_cast<std::size_t>(ranks.rank());
    const ParticlePass pass({{first, first + 2}, {6 + first, 8 + first}},
                            std::make_shared<const RankPass>(borrowed(ranks)));
    EXPECT_EQ(pass.collect<int>(list), counted(12));
    // Some find nothing.
    const auto find_some = [](const ParticleRun& run, std::vector<int>& found) {
      if (run.begin == 2 || run.begin == 10) list(run, found);
    };
    EXPECT_EQ(pass.collect<int>(find_some), (std::vector<int>{2, 3, 10, 11}));
  });
}

}  // namespace
}  // namespace splotchcl::test
