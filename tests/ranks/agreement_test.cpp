#include <atomic>
#include <mutex>

#include "ranks/exchange.h"
#include "ranks/thread_ranks.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// What the ranks that tell anything tell, one after the other.
std::string told_by(int ranks, const std::function<void(int rank)>& work) {
  std::mutex mutex;
  std::string told;
  ThreadRanks::run(ranks, [&](Communicator& all) {
    try {
      agree(&all, [&] { work(all.rank()); });
    } catch (const Error& error) {
      const std::lock_guard<std::mutex> lock(mutex);
      told += error.what();
    } catch (const FailedElsewhere& elsewhere) {
      const std::lock_guard<std::mutex> lock(mutex);
      EXPECT_FALSE(elsewhere.is_usage());
    }
  });
  return told;
}

TEST(Agreement, IsReachedWhereNobodyFails) {
  std::atomic<int> went_on{0};
  ThreadRanks::run(3, [&](Communicator& all) {
    agree(&all, [] {});
    ++went_on;
  });
  EXPECT_EQ(went_on, 3);
}

TEST(Agreement, TellsTheFailureOfOneRankOnce) {
  const std::string told = told_by(4, [](int rank) {
    if (rank >= 2) throw DataError("rank " + std::to_string(rank) + " has no file");
  });
  EXPECT_EQ(told, "process 2 on host2: rank 2 has no file");
}

TEST(Agreement, TellsWhatFailsEverywhereAsOneProcessWould) {
  EXPECT_EQ(told_by(3, [](int) { throw DataError("there is no file"); }), "there is no file");
}

TEST(Agreement, EndsTheWorkOfOthersWhereTheyWait) {
  std::atomic<int> went_on{0};
  ThreadRanks::run(3, [&](Communicator& all) {
    EXPECT_ANY_THROW(agree(&all, [&] {
      if (all.rank() == 1) throw DataError("there is no file");
      wait_for_all(all);
      ++went_on;
    }));
  });
  EXPECT_EQ(went_on, 0);
}

TEST(Agreement, TellsOnceWhatHasBeenAgreedUponInside) {
  std::mutex mutex;
  std::string told;
  ThreadRanks::run(3, [&](Communicator& all) {
    try {
      agree(&all, [&] {
        agree(&all, [&] {
          if (all.rank() == 1) throw DataError("there is no file");
        });
      });
      ADD_FAILURE();
    } catch (const DataError& error) {
      const std::lock_guard<std::mutex> lock(mutex);
      told += error.what();
    } catch (const FailedElsewhere&) {
    }
  });
  EXPECT_EQ(told, "process 1 on host1: there is no file");
}

// One rank has failed before, while the others agree upon something else.
TEST(Agreement, IsEndedByARankThatDoesNotReachIt) {
  std::mutex mutex;
  std::string told;
  ThreadRanks::run(3, [&](Communicator& all) {
    try {
      agree(&all, [&] {
        if (all.rank() == 0) throw DataError("there is no folder");
        agree(&all, [&] { wait_for_all(all); });
      });
      ADD_FAILURE();
    } catch (const DataError& error) {
      const std::lock_guard<std::mutex> lock(mutex);
      told += error.what();
    } catch (const FailedElsewhere&) {
    }
  });
  EXPECT_EQ(told, "process 0 on host0: there is no folder");
}

TEST(Agreement, KeepsWrongCallsApart) {
  ThreadRanks::run(2, [](Communicator& all) {
    try {
      agree(&all, [&] {
        if (all.rank() == 1) throw UsageError("wrong");
      });
      ADD_FAILURE();
    } catch (const UsageError& error) {
      EXPECT_EQ(all.rank(), 1);
    } catch (const FailedElsewhere& elsewhere) {
      EXPECT_EQ(all.rank(), 0);
      EXPECT_TRUE(elsewhere.is_usage());
    }
  });
}

TEST(Agreement, NamesTheRankThatDiffers) {
  std::string told;
  ThreadRanks::run(3, [&](Communicator& all) {
    try {
      require_same(all, "device", all.rank() == 1 ? "B" : "A", "choose one");
      ADD_FAILURE();
    } catch (const DeviceError& error) {
      told = error.what();
    } catch (const FailedElsewhere&) {
    }
  });
  EXPECT_EQ(told,
            "process 1 on host1: found device B, expected that of process 0 on host0, A, since "
            "pictures of the two differ; choose one");
}

TEST(Values, AreKnownToAllRanks) {
  ThreadRanks::run(3, [](Communicator& all) {
    const auto own = static_cast<std::uint64_t>(10 * all.rank() + 5);
    EXPECT_EQ(gather_values(all, own), (std::vector<std::uint64_t>{5, 15, 25}));
    EXPECT_EQ(smallest_of(all, own), 5u);
    std::vector<float> values(static_cast<std::size_t>(all.rank()), 1.0f);
    if (all.rank() == 0) values = {1, 2, 3};
    broadcast_values(all, values);
    EXPECT_EQ(values, (std::vector<float>{1, 2, 3}));
  });
}

}  // namespace
}  // namespace splotchcl::test
