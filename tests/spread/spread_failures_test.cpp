// What goes wrong on one rank, or on all: each call ends on all of them, and one says why.
#include <mutex>

#include "ranks/forwarding_ranks.h"
#include "ranks/spread_particles.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/spread_snapshot.h"
#include "spread/simulation.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

const std::string small_head = "snapshot = \"memory\"\n[image]\nsize = [32, 32]\n";
const std::string camera = "[camera]\nposition = [0, -4, 1]\nlook_at = [0, 0, 0]\n";
const std::string component = "[[component]]\nname = \"gas\"\ntypes = \"gas\"\n";

// The messages of the ranks on which this throws an Error; on all others another one has failed.
std::vector<std::string> failures(int size, const std::function<void(Communicator&)>& work) {
  std::vector<std::string> messages;
  std::mutex mutex;
  ThreadRanks::run(size, [&](Communicator& ranks) {
    try {
      work(ranks);
      ADD_FAILURE() << "rank " << ranks.rank() << " has not failed";
    } catch (const Error& error) {
      const std::lock_guard<std::mutex> lock(mutex);
      messages.push_back(error.what());
    } catch (const FailedElsewhere&) {
    }
  });
  return messages;
}

// Loads a scene of gas that has no field "smoothing_length" unless it is set.
std::vector<std::string> failures_to_load(const std::function<std::string(int rank)>& scene) {
  Arrays arrays = gas_and_stars(100, 0);
  arrays[gas].scalars.erase("smoothing_length");
  arrays[gas].scalars.erase("density");
  return failures(3, [&](Communicator& ranks) {
    const RankOfSimulation own(arrays, uneven(3), ranks);
    std::vector<std::string> notes;
    load_frame(parse_scene(scene(ranks.rank()), "scene"), own.all, notes);
  });
}

TEST(SpreadFailures, AreToldOnce) {
  EXPECT_THAT(failures_to_load([](int) {
                return small_head + camera + component + "color = { field = \"entropy\" }\n";
              }),
              ElementsAre(HasSubstr("entropy")));
}

TEST(SpreadFailures, AreThoseOfScenesThatDiffer) {
  EXPECT_THAT(failures_to_load([](int rank) {
                return small_head + camera + component + (rank == 2 ? "brightness = 2\n" : "");
              }),
              ElementsAre(HasSubstr("another scene on rank 2")));
}

// While the others wait for its particles.
TEST(SpreadFailures, OfOneRankEndTheOthersWhereTheyWait) {
  const Arrays arrays = gas_and_stars(100, 0);
  EXPECT_THAT(failures(3,
                       [&](Communicator& ranks) {
                         const RankOfSimulation own(arrays, uneven(3), ranks);
                         own.all.spread()->agree_on([&] {
                           const Column mass = own.all.read(gas, "mass");
                           if (ranks.rank() == 1) throw DataError("its disk is full");
                           mass.source()->make(0, 100, std::vector<float>(100).data());
                         });
                       }),
              ElementsAre("process 1 on host1: its disk is full"));
}

TEST(SpreadFailures, LeaveTheNextPictureAsItIs) {
  const Arrays arrays = gas_and_stars(100, 0);
  ThreadRanks::run(2, [&](Communicator& ranks) {
    const RankOfSimulation own(arrays, uneven(2), ranks);
    std::vector<std::string> notes;
    const Scene wrong =
        parse_scene(small_head + camera + component + "color = { field = \"entropy\" }\n", "scene");
    EXPECT_ANY_THROW(load_frame(wrong, own.all, notes));
    const Frame frame =
        load_frame(parse_scene(small_head + camera + component, "scene"), own.all, notes);
    EXPECT_EQ(frame.components.front().particles.position[299],
              arrays.at(gas).vectors.at("position")[299]);
  });
}

TEST(SpreadFailures, AreDevicesThatOneRankHasNot) {
  EXPECT_THAT(failures(2,
                       [](Communicator& ranks) {
                         FrameDrawerOptions options;
                         options.ranks = borrowed(ranks);
                         if (ranks.rank() == 1) options.device = "no such device";
                         FrameDrawer drawer(options);
                       }),
              ElementsAre(HasSubstr("process 1 on host1")));
}

// What one rank is given fails while all draw; nobody expects to be told.
class FailsToExchange : public ForwardingRanks {
 public:
  using ForwardingRanks::ForwardingRanks;

  std::vector<Bytes> exchange(std::vector<Bytes> parts) override {
    if (rank() == 1) throw DeviceError("its memory is full");
    return ForwardingRanks::exchange(std::move(parts));
  }
  [[noreturn]] void abort(int code) override {
    aborted_with = code;
    ForwardingRanks::abort(code);
  }

  int aborted_with = 0;
};

TEST(SpreadFailures, WhileAllDrawEndAllProcesses) {
  const Arrays arrays = gas_and_stars(100, 0);
  std::vector<int> codes(2);
  ::testing::internal::CaptureStderr();
  EXPECT_ANY_THROW(ThreadRanks::run(2, [&](Communicator& ranks) {
    FailsToExchange failing(ranks);
    const Arrays part = part_of_rank(arrays, uneven(2), ranks.rank());
    ArraySnapshot own;
    set_fields(part, own);
    FrameDrawerOptions options;
    options.ranks = borrowed(failing);
    FrameDrawer drawer(options);
    const SpreadSnapshot all(own, options.ranks);
    try {
      drawer.draw(parse_scene(small_head + camera + component, "scene"), all);
    } catch (...) {
      codes[static_cast<std::size_t>(ranks.rank())] = failing.aborted_with;
      throw;
    }
  }));
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              HasSubstr("splotchcl: process 1 on host1: its memory is full\n"));
  EXPECT_EQ(codes[1], 1);
}

TEST(SpreadFailures, AreRenderersOfOneProcess) {
  const Arrays arrays = gas_and_stars(100, 0);
  EXPECT_THAT(failures(2,
                       [&](Communicator& ranks) {
                         const RankOfSimulation own(arrays, uneven(2), ranks);
                         FrameDrawer().draw(parse_scene(small_head + camera + component, "scene"),
                                            own.all);
                       }),
              ElementsAre(HasSubstr("spread over 2 processes and a renderer of 1")));
}

}  // namespace
}  // namespace splotchcl::test
