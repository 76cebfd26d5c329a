// Ranks that all have a snapshot look at its particles together: each reads its share, and all
// decide what one process would.
#include <atomic>
#include <mutex>

#include "load/passes.h"
#include "ranks/exchange.h"
#include "ranks/forwarding_ranks.h"
#include "scene/particle_columns.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"
#include "spread/simulation.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Counts the values that are read of its columns, which are too large to be held.
class CountedSnapshot : public Snapshot {
 public:
  explicit CountedSnapshot(const Arrays& arrays) { set_fields(arrays, all_); }

  const SnapshotInfo& info() const override { return all_.info(); }
  Column read(int type, const std::string& field) const override {
    const Column held = all_.read(type, field);
    return make_column(held.size(), true,
                       [this, held, field](std::size_t begin, std::size_t end, float* values) {
                         if (field == fails_) throw DataError("its disk is broken");
                         read_ += end - begin;
                         std::copy_n(held.data() + begin, end - begin, values);
                       });
  }

  void set_box(double side) { all_.set_box_size(side); }
  void fail_to_read(const std::string& field) { fails_ = field; }
  std::size_t values_read() const { return read_; }

 private:
  ArraySnapshot all_;
  std::string fails_;
  mutable std::atomic<std::size_t> read_{0};
};

constexpr std::size_t gas_count = 30000, star_count = 6000;

const Arrays& many() {
  static const Arrays arrays = gas_and_stars(gas_count, star_count);
  return arrays;
}

const std::string gas_text =
    "[[component]]\nname = \"gas\"\ntypes = \"gas\"\npalette = \"temperature\"\n";

using MakeScene = std::function<Scene(const Snapshot&)>;

Scene suggested(const Snapshot& snapshot) {
  return suggest_scene(snapshot);
}

MakeScene given(const std::string& text) {
  return [text](const Snapshot&) { return parse_scene(text, "scene"); };
}

using Bits = std::vector<std::uint32_t>;

std::vector<Bits> columns_of(const Frame& frame) {
  std::vector<Bits> all;
  for (const DrawnComponent& component : frame.components) {
    for (const Column* const column : component.particles.columns()) {
      Bits& bits = all.emplace_back(column->size());
      for (std::size_t i = 0; i < column->size(); ++i) {
        const float value = (*column)[i];
        std::memcpy(&bits[i], &value, sizeof value);
      }
    }
  }
  return all;
}

// What one of several ranks has found.
struct Found {
  std::string scene;          // with all that is decided
  double values_read = 0;     // for that
  std::vector<Bits> columns;  // to be drawn
  std::vector<std::string> notes;
};

std::vector<Found> find_by(int size, const Arrays& arrays, const MakeScene& make) {
  std::vector<Found> all(static_cast<std::size_t>(size));
  ThreadRanks::run(size, [&](Communicator& ranks) {
    CountedSnapshot snapshot(arrays);
    snapshot.set_box(4);
    share_passes(snapshot, borrowed(ranks));
    Found& found = all[static_cast<std::size_t>(ranks.rank())];
    Scene scene;
    agree(&ranks, [&] { scene = make(snapshot); });
    found.scene = format_scene(fixed_scene(decide(scene, snapshot, found.notes)));
    found.values_read = static_cast<double>(snapshot.values_read());
    found.columns = columns_of(load_frame(scene, snapshot, found.notes));
  });
  return all;
}

void expect_found_by_one(const Arrays& arrays, const MakeScene& make) {
  const Found one = find_by(1, arrays, make).front();
  for (int ranks = 2; ranks <= 3; ++ranks) {
    for (const Found& found : find_by(ranks, arrays, make)) {
      EXPECT_EQ(found.scene, one.scene) << ranks << " ranks";
      EXPECT_EQ(found.notes, one.notes) << ranks << " ranks";
      EXPECT_TRUE(found.columns == one.columns) << ranks << " ranks";
    }
  }
}

// And each of the ranks has read its part of what one process reads, or at most so many times that:
// what follows from other fields one process keeps, and ranks make it whenever they want it.
void expect_shares(const Arrays& arrays, const MakeScene& make, double at_most = 1) {
  expect_found_by_one(arrays, make);
  const double all = find_by(1, arrays, make).front().values_read;
  for (int ranks = 2; ranks <= 3; ++ranks) {
    for (const Found& found : find_by(ranks, arrays, make)) {
      EXPECT_LT(found.values_read, (at_most + 0.01) * all / ranks) << ranks << " ranks";
      EXPECT_GT(found.values_read, 0.1 * all / ranks) << ranks << " ranks";
    }
  }
}

TEST(SharedPasses, AreThoseOfASnapshotAlone) {
  expect_shares(many(), suggested);
}

TEST(SharedPasses, FindTheEndsOfFields) {
  expect_shares(many(), given(scene_head + gas_text +
                              "color = { field = \"density\", percentiles = [0, 100] }\n"
                              "intensity = { field = \"mass\", percentiles = [0, 60] }\n"));
}

TEST(SharedPasses, FindTheEndsOfFieldsThatFollowFromOthers) {
  for (const std::string field : {"speed", "radius", "velocity_y"}) {
    expect_shares(many(), given(scene_head + gas_text + "color = { field = \"" + field +
                                "\", percentiles = [0, 100] }\n"));
  }
}

TEST(SharedPasses, JoinTypesOneAfterTheOther) {
  expect_shares(many(),
                given(scene_head + "[[component]]\nname = \"all\"\ntypes = [\"gas\", \"stars\"]\n"
                                   "palette = \"white\"\ncolor = { field = \"mass\" }\n"));
}

TEST(SharedPasses, TurnAndWrapParticles) {
  const std::string camera = "[camera]\nposition = [0.5, -4, 1]\nlook_at = [0.5, 0, 0]\n";
  expect_shares(many(), given(scene_head + camera + gas_text +
                              "rotation = { axis = [1, 2, 3], angle = 40 }\n"));
  expect_shares(many(), given(scene_head + camera + "[periodic]\nwrap = true\n" + gas_text));
}

TEST(SharedPasses, FindLengthsFromDensities) {
  Arrays arrays = many();
  arrays.at(gas).scalars.erase("smoothing_length");
  expect_shares(arrays, given(scene_head + gas_text), 1.3);
}

TEST(SharedPasses, SelectOfAllParticles) {
  expect_shares(many(), given(scene_head + gas_text + "color = { field = \"density\" }\n" +
                              "select = { where = \"mass > 1.2\", sphere = { center = [0.1, 0, 0], "
                              "radius = 0.8 } }\nexclude = { where = \"density > 90\" }\n"));
  expect_shares(many(), given(scene_head + gas_text + "select = { where = \"mass > 100\" }\n"));
}

// All ranks hold the positions among which each searches for its part.
TEST(SharedPasses, FindLengthsFromNeighbors) {
  Arrays arrays = gas_and_stars(5000, 1000);
  for (const int type : {gas, stars}) {
    arrays.at(type).scalars.erase("smoothing_length");
    arrays.at(type).scalars.erase("density");
  }
  arrays.at(gas).vectors.at("position")[300] = std::nanf("");
  expect_found_by_one(arrays, suggested);
}

// Counts what this rank broadcasts.
class CountedRanks final : public ForwardingRanks {
 public:
  using ForwardingRanks::ForwardingRanks;

  void broadcast(void* data, std::size_t bytes, int root) override {
    if (root == rank()) bytes_ += bytes;
    ForwardingRanks::broadcast(data, bytes, root);
  }
  std::size_t bytes_broadcast() const { return bytes_; }

 private:
  std::size_t bytes_ = 0;
};

TEST(SharedPasses, TellTheLengthsThatEachHasFound) {
  Arrays arrays = many();
  arrays.at(gas).scalars.erase("smoothing_length");
  arrays.at(gas).scalars.erase("density");
  ThreadRanks::run(3, [&](Communicator& all) {
    CountedRanks ranks(all);
    const CountedSnapshot snapshot(arrays);
    share_passes(snapshot, borrowed(ranks));
    std::vector<std::string> notes;
    load_frame(parse_scene(scene_head + "[camera]\nposition = [0, -4, 1]\nlook_at = [0, 0, 0]\n" +
                               gas_text + "reference_column = 1\n",
                           "scene"),
               snapshot, notes);
    const auto share = static_cast<double>(gas_count * sizeof(float)) / 3;
    EXPECT_NEAR(static_cast<double>(ranks.bytes_broadcast()), share, 0.25 * share);
  });
}

TEST(SharedPasses, LeaveNothingOpenToRanksWithoutParticles) {
  expect_found_by_one(gas_and_stars(2, 1), suggested);
}

// One line, whatever the others are at.
TEST(SharedPasses, EndOnAllRanksWhereOneCannotRead) {
  for (const std::string field : {"position", "internal_energy", "mass"}) {
    std::vector<std::string> told;
    std::mutex mutex;
    ThreadRanks::run(3, [&](Communicator& ranks) {
      CountedSnapshot snapshot(many());
      share_passes(snapshot, borrowed(ranks));
      if (ranks.rank() == 1) snapshot.fail_to_read(field);
      std::vector<std::string> notes;
      try {
        agree(&ranks, [&] { load_frame(suggest_scene(snapshot), snapshot, notes); });
        ADD_FAILURE() << "rank " << ranks.rank() << " has not failed";
      } catch (const Error& error) {
        const std::lock_guard<std::mutex> lock(mutex);
        told.push_back(error.what());
      } catch (const FailedElsewhere&) {
      }
    });
    EXPECT_THAT(told, ElementsAre("process 1 on host1: its disk is broken")) << field;
  }
}

// What all ranks of a simulation broadcast to decide the scene.
std::size_t bytes_to_decide(const std::string& scene) {
  std::atomic<std::size_t> bytes{0};
  ThreadRanks::run(3, [&](Communicator& all) {
    CountedRanks ranks(all);
    const RankOfSimulation own(many(), uneven(3), ranks);
    std::vector<std::string> notes;
    decide(parse_scene(scene, "scene"), own.all, notes);
    bytes += ranks.bytes_broadcast();
  });
  return bytes;
}

TEST(SpreadPasses, SendTheEndsOfFieldsAndNotTheFields) {
  const auto scene = [](const std::string& percentiles) {
    return scene_head + "[camera]\nposition = [0, -4, 1]\nlook_at = [0, 0, 0]\n" + gas_text +
           "reference_column = 1\ncolor = { field = \"density\", percentiles = " + percentiles +
           " }\n";
  };
  EXPECT_LT(bytes_to_decide(scene("[0, 100]")), bytes_to_decide(scene("[1, 99]")) + 1000);
}

TEST(SpreadPasses, TellOfPositionsThatAreRounded) {
  Arrays arrays = gas_and_stars(300, 0);
  for (const std::size_t particle : {7, 250})
    arrays.at(gas).vectors.at("position")[3 * particle] = 5e6F;
  const auto notes_of = [](const Snapshot& snapshot) {
    std::vector<std::string> notes;
    load_frame(parse_scene(scene_head + gas_text, "scene"), snapshot, notes);
    return notes;
  };
  ArraySnapshot alone;
  alone.set_position_origin({{1e7, 0, 0}});
  set_fields(arrays, alone);
  const std::vector<std::string> expected = notes_of(alone);
  ASSERT_THAT(expected, ElementsAre(HasSubstr("2 of 300 particles lie so far")));
  ThreadRanks::run(3, [&](Communicator& ranks) {
    const Arrays part = part_of_rank(arrays, uneven(3), ranks.rank());
    ArraySnapshot own;
    own.set_position_origin({{1e7, 0, 0}});
    set_fields(part, own);
    EXPECT_EQ(notes_of(SpreadSnapshot(own, borrowed(ranks))), expected);
  });
}

}  // namespace
}  // namespace splotchcl::test
