// The lists per tile hold every splat that matters to a pixel of the tile, in order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "device/stages.h"

namespace splotchcl::test {
namespace {

struct Setup {
  LightPlan light;
  bool rows;  // the tiles of which shape of compositing
};

// Every splat of a list, and where the lists of its tiles begin and end.
struct Lists {
  std::vector<ListedSplat> entries;
  std::vector<std::uint32_t> starts, lengths;
};

class Bin : public StageTest, public testing::WithParamInterface<Setup> {
 protected:
  static Lists read_lists(Stages& stages, const TileLists& lists) {
    const std::size_t tiles = stages.layout().tile_count;
    return {stages.entries(lists), stages.read<std::uint32_t>("tile starts", tiles),
            stages.read<std::uint32_t>("tile lengths", tiles)};
  }

  // Clouds of all sizes in and around the picture, equal depths among them.
  static Frame clouds() {
    CloudSetup setup;
    setup.count = 700;
    setup.width = 150;
    setup.height = 110;
    DrawnComponent component = random_clouds(setup);
    std::vector<float> positions(
        component.particles.position.data(),
        component.particles.position.data() + component.particles.position.size());
    for (std::size_t i = 2; i < positions.size(); i += 9)
      positions[i] = 50;
    component.particles.position = Column::owning(positions);
    if (GetParam().light == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
    if (GetParam().light == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 1};
    return with_identities(frame_of(setup.width, setup.height, {component}));
  }

  // Where each particle stands in the order of the lists.
  static std::map<std::uint64_t, std::size_t> places(const Frame& frame) {
    std::vector<reference::Splat> splats = reference::project(frame);
    if (GetParam().light == LightPlan::ordered) reference::sort(splats, frame.sort);
    std::map<std::uint64_t, std::size_t> places;
    for (std::size_t i = 0; i < splats.size(); ++i)
      places[splats[i].particle] = i;
    return places;
  }
};

TEST_P(Bin, StartsAndTotalsAddUp) {
  Stages stages(device(), clouds(), true, GetParam().rows);
  const TileLists lists = stages.bin();
  const Lists read = read_lists(stages, lists);
  std::uint64_t running = 0;
  for (std::size_t tile = 0; tile < read.lengths.size(); ++tile) {
    ASSERT_EQ(read.starts[tile], running) << "of tile " << tile;
    running += read.lengths[tile];
  }
  EXPECT_EQ(lists.entry_count, running);
  EXPECT_GT(running, 500u) << "the scene must fill some lists";
}

// Segments cut every list into pieces in order; only lists of several pieces have partial
// layers, each its own.
TEST_P(Bin, SegmentsCoverEveryListInOrder) {
  device().traits.segment_length = 16;
  Stages stages(device(), clouds(), true, GetParam().rows);
  const TileLists lists = stages.bin();
  const Lists read = read_lists(stages, lists);
  const auto segments = stages.read<kernel::Segment>(lists.segments, lists.segment_count);
  std::uint32_t next_partial = 0;
  std::size_t s = 0;
  for (std::uint32_t tile = 0; tile < read.lengths.size(); ++tile) {
    std::uint32_t place = read.starts[tile];
    const std::uint32_t end = place + read.lengths[tile];
    const bool is_cut = read.lengths[tile] > 16;
    while (place < end) {
      ASSERT_LT(s, segments.size());
      ASSERT_EQ(segments[s].tile, tile);
      ASSERT_EQ(segments[s].begin, place);
      ASSERT_GT(segments[s].end, place);
      ASSERT_LE(segments[s].end, std::min(end, place + 16));
      ASSERT_EQ(segments[s].partial, is_cut ? next_partial++ : NO_PARTIAL);
      place = segments[s++].end;
    }
  }
  EXPECT_EQ(s, segments.size());
  EXPECT_EQ(lists.partial_count, next_partial);
  EXPECT_GT(next_partial, 10u) << "some lists must be cut";
  device().traits = traits_of(device().device);
}

TEST_P(Bin, ListsAreInTheOraclesOrder) {
  Stages stages(device(), clouds(), true, GetParam().rows);
  const Lists lists = read_lists(stages, stages.bin());
  const std::map<std::uint64_t, std::size_t> place = places(stages.frame());
  for (std::size_t tile = 0; tile < lists.lengths.size(); ++tile) {
    for (std::size_t i = 1; i < lists.lengths[tile]; ++i) {
      const std::size_t here = lists.starts[tile] + i;
      ASSERT_LT(place.at(lists.entries[here - 1].particle), place.at(lists.entries[here].particle))
          << "in tile " << tile;
    }
  }
}

// A splat as one grid of the frame shows it, from the oracle's splat.
struct Drawn {
  double x, y, sigma, amplitude;
  bool by_mean;
};

// On grids that are blurred afterwards splats are drawn narrower.
Drawn on_grid(const reference::Splat& splat, std::uint32_t g, const FrameLayout& layout) {
  const kernel::Grid& grid = layout.grids[g];
  const double pixel = std::ldexp(1.0, level_of_grid(layout, g));
  Drawn drawn{};
  drawn.by_mean = splat.sigma < static_cast<double>(layout.mean_sigma);
  drawn.sigma = std::sqrt(splat.sigma * splat.sigma / (pixel * pixel) - blur_of_grid(layout, g));
  drawn.x = splat.x / pixel + grid.guard;
  drawn.y = splat.y / pixel + grid.guard;
  for (int c = 0; c < 3; ++c) {
    drawn.amplitude = std::max(
        {drawn.amplitude, splat.weight * splat.emission[c], splat.weight * splat.absorption[c]});
  }
  return drawn;
}

// What the splat adds to a pixel of the grid.
double contribution(const Drawn& splat, int x, int y) {
  reference::Splat on_pixels;
  on_pixels.x = splat.x;
  on_pixels.y = splat.y;
  on_pixels.sigma = splat.sigma;
  KernelSettings kernel;
  kernel.sampling = splat.by_mean ? Sampling::mean : Sampling::center;
  return splat.amplitude * reference::shape(on_pixels, x, y, kernel);
}

// docs/accuracy.md: where a splat ends, it adds less than 1/24 of the truncation's share.
// A centre is known to 1e-5 pixels here (orthographic, 150 pixels: 5 roundings of 150), by
// which contributions err by 2 k / sigma of it: 1.3e-3 for k = 3 and sigma = 0.05.
TEST_P(Bin, ListsHoldEverySplatThatMattersToAPixel) {
  Stages stages(device(), clouds(), true, GetParam().rows);
  const double smallest = stages.plan().truncation_share / 24 * 1.01;
  const Lists lists = read_lists(stages, stages.bin());
  const FrameLayout& layout = stages.layout();

  // The grid that the device chose for each particle; off the picture it may have none.
  std::map<std::uint64_t, std::uint32_t> level;
  for (std::uint32_t g = 0; g < layout.grids.size(); ++g) {
    const kernel::Grid& grid = layout.grids[g];
    const std::uint32_t tiles = static_cast<std::uint32_t>(grid.tiles_x * grid.tiles_y);
    for (std::uint32_t tile = grid.first_tile; tile < grid.first_tile + tiles; ++tile) {
      for (std::uint32_t i = 0; i < lists.lengths[tile]; ++i) {
        const auto known = level.emplace(lists.entries[lists.starts[tile] + i].particle, g);
        ASSERT_EQ(known.first->second, g) << "a splat on two grids";
      }
    }
  }

  int pixels_checked = 0;
  const int tile_width = static_cast<int>(layout.tile_width);
  const int tile_height = static_cast<int>(layout.tile_height);
  for (const reference::Splat& splat : reference::project(stages.frame())) {
    const auto found = level.find(splat.particle);
    const std::uint32_t g = found == level.end() ? 0 : found->second;
    const kernel::Grid& grid = layout.grids[g];
    const Drawn drawn = on_grid(splat, g, layout);
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        if (contribution(drawn, x, y) <= smallest) continue;
        ++pixels_checked;
        const int tx = x / tile_width, ty = y / tile_height;
        const std::uint32_t tile =
            grid.first_tile + static_cast<std::uint32_t>(ty * grid.tiles_x + tx);
        const auto begin = lists.entries.begin() + lists.starts[tile];
        const auto end = begin + lists.lengths[tile];
        const auto entry = std::find_if(
            begin, end, [&](const ListedSplat& e) { return e.particle == splat.particle; });
        ASSERT_NE(entry, end) << "particle " << splat.particle << " adds "
                              << contribution(drawn, x, y) << " to pixel " << x << ", " << y
                              << " of grid " << g;
        // And its disc reaches the pixel's centre.
        ASSERT_LE(std::abs(x + 0.5 - tx * tile_width - entry->x), entry->radius);
        ASSERT_LE(std::abs(y + 0.5 - ty * tile_height - entry->y), entry->radius);
      }
    }
  }
  EXPECT_GT(pixels_checked, 10000);
}

std::string setup_name(const testing::TestParamInfo<Setup>& info) {
  return std::string(name(info.param.light)) + (info.param.rows ? "_rows" : "_groups");
}

INSTANTIATE_TEST_SUITE_P(Plans, Bin,
                         testing::Values(Setup{LightPlan::emission, true},
                                         Setup{LightPlan::emission, false},
                                         Setup{LightPlan::proportional, true},
                                         Setup{LightPlan::ordered, true},
                                         Setup{LightPlan::ordered, false}),
                         setup_name);

// Sums of list lengths are counted in 64 bits: what does not fit is refused, never wrapped.
class BinTotals : public StageTest {};

TEST_F(BinTotals, AreCountedBeyond32Bits) {
  Frame frame = frame_of(64, 96, {component_of({{0, 0, 1, 2, 1}}, one_color(1, 1, 1))});
  frame.components.front().absorption = {Absorption::Kind::gray, 1};  // one grid of 2 x 3 tiles
  Stages stages(device(), frame);
  const std::uint32_t tiles = stages.layout().tile_count;
  ASSERT_GE(tiles, 6u);
  const std::vector<std::uint32_t> lengths(tiles, 0xfffffff0u);

  Buffers& buffers = device().buffers;
  constexpr std::uint32_t segment_capacity = 100;
  kernel::BinParameters parameters{};
  parameters.tile_count = tiles;
  parameters.grid_count = 1;
  parameters.segment_length = 8192;
  const compute::buffer totals = buffers.get("totals", sizeof(kernel::BinTotals));
  const compute::program program = device().programs.get(
      kernel_defines(frame, stages.plan(), stages.layout()), {"common.cl", "bin.cl"});
  Launch(device(), "bin", program.create_kernel("bin_scan_tiles"))
      .value(parameters)
      .arg(buffers.upload("grids", stages.layout().grids))
      .arg(buffers.upload("long lengths", lengths))
      .arg(buffers.get("tile starts", 4ull * tiles))
      .value(segment_capacity)
      .arg(buffers.get("segments", segment_capacity * sizeof(kernel::Segment)))
      .arg(totals)
      .run_items(1);
  const kernel::BinTotals read = stages.read<kernel::BinTotals>(totals, 1).front();
  const std::uint64_t entries =
      read.entries_low | (static_cast<std::uint64_t>(read.entries_high) << 32);
  EXPECT_EQ(entries, std::uint64_t{tiles} * 0xfffffff0u);
  EXPECT_LE(read.segment_count, segment_capacity);
}

// More list entries than one pass takes: nothing is scattered, and the caller is told.
TEST_F(BinTotals, BeyondTheBuffersAreRefused) {
  std::vector<Cloud> clouds(4000, Cloud{0, 0, 1, 1e6, 1e-3});
  Frame frame = frame_of(1024, 1024, {component_of(clouds, one_color(1, 1, 1))});
  frame.components.front().absorption = {Absorption::Kind::gray, 1};
  frame = with_identities(frame);
  Stages stages(device(), frame);
  const std::uint64_t expected = std::uint64_t{4000} * stages.layout().tile_count;
  ASSERT_GT(expected, std::uint64_t{3} << 20);
  TileLists lists;
  EXPECT_FALSE(stages.try_bin(lists));
  EXPECT_EQ(lists.entry_count, expected);
}

}  // namespace
}  // namespace splotchcl::test
