// Frames that several ranks draw together have the bits of one process, whatever their number.
#include <mutex>

#include "device/cloud_frames.h"
#include "device/opencl/device_context.h"
#include "device/pipeline.h"
#include "device/ranks/rank_share.h"
#include "device/stages.h"
#include "frames/random_frames.h"
#include "ranks/spread_particles.h"
#include "ranks/thread_ranks.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Of a device's own, as another process has it; made once for all tests.
DeviceContext& device_of_rank(int rank) {
  static std::vector<std::unique_ptr<DeviceContext>> devices;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  while (devices.size() <= static_cast<std::size_t>(rank))
    devices.push_back(std::make_unique<DeviceContext>(choose_device("")));
  return *devices[static_cast<std::size_t>(rank)];
}

struct Drawn {
  Image image;
  DrawCounts counts;
  CollectedSplats collected;
  std::vector<RankWork> work;
};

bool are_equal(const CollectedSplats& a, const CollectedSplats& b) {
  return a.longest_list == b.longest_list && a.of_slabs == b.of_slabs && a.around == b.around &&
         std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(),
                    [](const PeakCells& c, const PeakCells& d) {
                      return c.level == d.level && c.octave == d.octave &&
                             c.peaks.values == d.peaks.values &&
                             c.endings.values == d.endings.values;
                    });
}

// What particles each rank has.
enum class Holds { all, own };

// A rank's own values of a column: the first rank has none, the others have as many each.
Column spread_over(SpreadParticles& spread, const Column& column, std::size_t count,
                   std::size_t width) {
  if (!column.is_array()) return column;
  const auto rank = static_cast<std::size_t>(spread.ranks().rank());
  const auto others = static_cast<std::size_t>(spread.ranks().size() - 1);
  const std::size_t begin = rank == 0 ? 0 : count * (rank - 1) / others;
  const std::size_t end = count * rank / others;
  std::vector<float> own;
  for (std::size_t i = begin * width; i < end * width; ++i)
    own.push_back(column[i]);
  return spread.spread(Column::owning(std::move(own)), end - begin, width);
}

Frame spread_over(Communicator& ranks, const Frame& frame) {
  Frame spread = frame;
  spread.spread = std::make_shared<SpreadParticles>(
      std::shared_ptr<Communicator>(std::shared_ptr<Communicator>(), &ranks));
  for (DrawnComponent& component : spread.components) {
    Particles& particles = component.particles;
    for (Column* const column : {&particles.position, &particles.color_vector})
      *column = spread_over(*spread.spread, *column, particles.count, 3);
    for (Column* const column : {&particles.smoothing_length, &particles.weight, &particles.color,
                                 &particles.intensity, &particles.sort_field})
      *column = spread_over(*spread.spread, *column, particles.count, 1);
  }
  return spread;
}

class RankFrames : public testing::TestWithParam<bool> {
 protected:
  // Few splats of a chunk and few particles of a block, so that small scenes have many.
  void set_sizes(DeviceContext& device) const {
    device.traits.choose_shape(GetParam());
    device.traits.project_block = GetParam() ? 16 : GROUP_ITEMS;
    device.traits.chunk_blocks = GetParam() ? 4 : 1;
    device.traits.leaf_chunks = 1;
    device.traits.sorted_chunk = 32;
    device.memory.total = memory_;
  }

  // By so many ranks; 0: by one process, without any.
  Drawn draw(const Frame& frame, int ranks, int slabs = -1, Holds holds = Holds::all) {
    PlanOptions options;
    options.slabs = slabs;
    const FramePlan plan = make_plan(frame, options);
    Drawn drawn;
    drawn.work.resize(static_cast<std::size_t>(std::max(1, ranks)));
    const auto draw_with = [&](const Frame& own, DeviceContext& device, FrameRanks* with) {
      set_sizes(device);
      const FetchedParticles fetched(own, plan, device.traits);
      ParticleStore particles(device);
      particles.begin_frame();
      Pipeline pipeline(device, particles, own, plan, {}, with);
      Image image = pipeline.draw();
      device.queue.finish();
      if (with != nullptr) drawn.work[static_cast<std::size_t>(with->rank())] = with->work;
      if (with != nullptr && with->rank() > 0) return;
      drawn.image = std::move(image);
      drawn.counts = pipeline.counts();
      if (drawn.counts.too_sharp == 0) drawn.collected = pipeline.collected();
    };
    if (ranks == 0) {
      draw_with(frame, device_of_rank(0), nullptr);
    } else {
      ThreadRanks::run(ranks, [&](Communicator& all) {
        const Frame own = holds == Holds::own ? spread_over(all, frame) : frame;
        FrameRanks with = {all, {}};
        draw_with(own, device_of_rank(all.rank()), &with);
      });
    }
    return drawn;
  }

  void expect_same_bits(const Frame& frame, int ranks, int slabs = -1) {
    const Drawn one = draw(frame, 0, slabs);
    expect_same(draw(frame, ranks, slabs), one, ranks);
    expect_same(draw(frame, ranks, slabs, Holds::own), one, ranks);
  }

  static void expect_same(const Drawn& many, const Drawn& one, int ranks) {
    EXPECT_EQ(many.image.pixels, one.image.pixels) << ranks << " ranks";
    EXPECT_TRUE(are_equal(many.collected, one.collected)) << ranks << " ranks";
    EXPECT_EQ(many.counts.particles, one.counts.particles);
    EXPECT_EQ(many.counts.visible, one.counts.visible);
    EXPECT_EQ(many.counts.bad, one.counts.bad);
    EXPECT_EQ(many.counts.around, one.counts.around);
    EXPECT_EQ(many.counts.tile_entries, one.counts.tile_entries);
  }

  // The least memory that has room for so many splats at a time.
  void make_room_for(std::uint64_t splats, const Frame& frame) {
    DeviceContext& device = device_of_rank(0);
    set_sizes(device);
    const FramePlan plan = make_plan(frame);
    const StageContext context(device, frame, plan);
    std::uint64_t low = 0, high = std::uint64_t{1} << 40;
    while (high - low > 1) {
      device.memory.total = (low + high) / 2;
      (splat_capacity(context) >= splats ? high : low) = device.memory.total;
    }
    memory_ = high;
  }

 private:
  std::uint64_t memory_ = std::uint64_t{1} << 34;
};

INSTANTIATE_TEST_SUITE_P(Shapes, RankFrames, testing::Bool(),
                         [](const auto& info) { return info.param ? "rows" : "groups"; });

TEST_P(RankFrames, HaveTheBitsOfOneProcessInAllScenes) {
  // Each rank compiles kernels of its own.
  for (const std::uint64_t seed : seeds(1, 28))
    expect_same_bits(SceneMaker(seed).make(), 2);
}

TEST_P(RankFrames, HaveTheBitsOfOneProcessInSums) {
  for (const Absorption& absorption :
       {Absorption{Absorption::Kind::none, 0}, Absorption{Absorption::Kind::as_emission, 0}}) {
    for (const int ranks : {2, 3, 4})
      expect_same_bits(with_absorption(many_clouds(1000), absorption), ranks);
  }
}

TEST_P(RankFrames, HaveTheBitsOfOneProcessInOrder) {
  for (const int ranks : {2, 3, 4})
    expect_same_bits(many_clouds(1000), ranks);
}

TEST_P(RankFrames, ShareOutParticlesAndSplats) {
  const Frame frame = many_clouds(4000);
  const Drawn drawn = draw(frame, 4);
  std::uint64_t particles = 0, splats = 0;
  for (const RankWork& work : drawn.work) {
    particles += work.particles;
    splats += work.splats;
    EXPECT_NEAR(static_cast<double>(work.particles), 2000, 300);
    EXPECT_NEAR(static_cast<double>(work.splats), static_cast<double>(drawn.counts.visible) / 4,
                static_cast<double>(drawn.counts.visible) / 8);
    EXPECT_GT(work.sent_bytes, 0u);
  }
  EXPECT_EQ(particles, drawn.counts.particles);
  EXPECT_EQ(splats, drawn.counts.visible);
}

TEST_P(RankFrames, ShareOutSums) {
  const Drawn drawn = draw(without_absorption(many_clouds(4000)), 4);
  for (const RankWork& work : drawn.work)
    EXPECT_NEAR(static_cast<double>(work.particles), 2000, 300);
}

TEST_P(RankFrames, DrawInRoundsWhereMemoryAsksForIt) {
  const Frame frame = many_clouds(2000);
  const Drawn one = draw(frame, 0);
  for (const int ranks : {2, 3}) {
    make_room_for(300, frame);
    for (const Holds holds : {Holds::all, Holds::own}) {
      const Drawn many = draw(frame, ranks, -1, holds);
      EXPECT_EQ(many.image.pixels, one.image.pixels) << ranks;
      EXPECT_GE(many.counts.windows, 6u);
    }
  }
}

TEST_P(RankFrames, HaveTheBitsOfOneProcessWhateverIsDivided) {
  for (const DividedFrame& divided : divided_frames()) {
    SCOPED_TRACE(divided.name);
    for (const int ranks : divided.ranks)
      expect_same_bits(divided.frame, ranks, divided.slabs);
    const bool is_in_sums_too = divided.frame.tolerance == 0 || divided.least == 0;
    if (is_in_sums_too) expect_same_bits(without_absorption(divided.frame), divided.ranks.front());
  }
  Frame without_components = many_clouds(100);
  without_components.components.clear();
  expect_same_bits(without_components, 3);
}

TEST_P(RankFrames, HoldCloudsAroundTheCamera) {
  Frame frame = within_clouds();
  frame.tolerance = 1e-2;
  for (const int slabs : {0, 3}) {
    for (const bool descending : {false, true}) {
      frame.sort.descending = descending;
      expect_same_bits(frame, 3, slabs);
    }
  }
  expect_same_bits(without_absorption(frame), 3);
}

// The camera stands in some of many. Lists hold them, or they are laid between the splats.
Frame within_many_clouds(bool are_in_lists) {
  Frame frame = many_clouds(are_in_lists ? 2000 : 1000);
  if (are_in_lists) {
    frame.width = 240;
    frame.height = 100;
  } else {
    frame.kernel.cut = 2.5;
  }
  frame.through_clouds = true;
  return looked_at_from(std::move(frame), 20);
}

TEST_P(RankFrames, ShareOutSplatsAmongCloudsAroundTheCamera) {
  for (const bool are_in_lists : {false, true}) {
    const Drawn drawn = draw(within_many_clouds(are_in_lists), 3);
    ASSERT_GT(drawn.counts.around, 20u);
    ASSERT_EQ(drawn.counts.in_lists > 0, are_in_lists);
    const double share = static_cast<double>(drawn.counts.visible) / 3;
    ASSERT_GT(share, 60);
    for (const RankWork& work : drawn.work)
      EXPECT_NEAR(static_cast<double>(work.splats), share, 0.4 * share) << are_in_lists;
  }
}

TEST_P(RankFrames, DrawAmongCloudsAroundTheCameraInSlices) {
  for (const bool are_in_lists : {false, true}) {
    const Frame frame = within_many_clouds(are_in_lists);
    for (const int ranks : {2, 3, 4})
      expect_same_bits(frame, ranks, 0);
    expect_same_bits(frame, 3, 3);
  }
}

TEST_P(RankFrames, DrawAmongCloudsAroundTheCameraInRounds) {
  for (const bool are_in_lists : {false, true}) {
    const Frame frame = within_many_clouds(are_in_lists);
    const Drawn one = draw(frame, 0);
    for (const int ranks : {2, 3}) {
      make_room_for(40, frame);
      for (const Holds holds : {Holds::all, Holds::own}) {
        const Drawn many = draw(frame, ranks, -1, holds);
        expect_same(many, one, ranks);
        EXPECT_GE(many.counts.windows, 2 * static_cast<std::uint64_t>(ranks));
      }
    }
  }
}

TEST_P(RankFrames, KeepTheOrderOfSplatsAndCloudsAroundTheCameraOfOneKey) {
  for (const bool are_in_lists : {false, true}) {
    Frame frame = within_many_clouds(are_in_lists);
    frame.sort.by = SortOrder::By::field;
    for (const std::size_t period : {3, 200}) {
      give_few_fields(frame, period);
      expect_same_bits(frame, 3);
    }
  }
}

TEST_P(RankFrames, HoldCloudsAroundTheCameraMostExactly) {
  Frame frame = within_clouds();
  frame.tolerance = 0;
  expect_same_bits(frame, 2);
}

TEST_P(RankFrames, HoldFramesWithFewerSplatsThanRanks) {
  for (const int count : {1, 2, 3}) {
    Frame frame = many_clouds(count);
    expect_same_bits(frame, 4);
    expect_same_bits(without_absorption(frame), 4);
  }
}

}  // namespace
}  // namespace splotchcl::test
