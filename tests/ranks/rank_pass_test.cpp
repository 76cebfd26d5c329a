// What ranks find in a pass that they make together is known to all, in the order of the particles.
#include "ranks/rank_pass.h"

#include "ranks/thread_ranks.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

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
