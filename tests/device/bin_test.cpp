// The lists per tile hold every splat that matters to a pixel of the tile, in order.
#include "device/stages.h"
#include "testing.h"

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
    Lists read = {stages.entries(lists), {}, stages.lengths()};
    std::uint32_t start = 0;
    for (const std::uint32_t length : read.lengths) {
      read.starts.push_back(start);
      start += length;
    }
    return read;
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

  // So many that some end within a rounding of a tile's edge.
  static Frame many_clouds() {
    CloudSetup setup;
    setup.width = 160;
    setup.height = 96;
    setup.count = 20000;
    setup.sigma_low = 0.3;
    setup.sigma_high = 6;
    setup.column_high = 0.1;
    DrawnComponent component = random_clouds(setup);
    component.absorption = absorption_for(GetParam().light);
    return with_identities(frame_of(setup.width, setup.height, {component}));
  }

  // The numbers of a crop's tiles, and of the same tiles in the whole picture.
  static std::vector<std::pair<std::size_t, std::size_t>> tiles_of_both(const Stages& crop,
                                                                        const Stages& whole) {
    std::vector<std::pair<std::size_t, std::size_t>> tiles;
    const int width = static_cast<int>(crop.context().variant.tile_width);
    const int height = static_cast<int>(crop.context().variant.tile_height);
    for (std::size_t g = 0; g < crop.layout().grids.size(); ++g) {
      const shared::Grid &part = crop.layout().grids[g], &all = whole.layout().grids[g];
      for (int i = 0; i < part.tiles_x * part.tiles_y; ++i) {
        const int column = part.first_x / width + i % part.tiles_x;
        const int row = part.first_y / height + i / part.tiles_x;
        tiles.emplace_back(part.first_tile + static_cast<std::uint32_t>(i),
                           all.first_tile + static_cast<std::uint32_t>(row * all.tiles_x + column));
      }
    }
    return tiles;
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

// Lists are cut by their length: a crop's would be cut elsewhere if what lies beside it came first.
TEST_P(Bin, ListsOfACropBeginWithThoseOfThePicture) {
  const Frame whole = many_clouds();
  Stages in_picture(device(), whole, GetParam().rows);
  const Lists of_picture = read_lists(in_picture, in_picture.bin());
  for (const Rectangle& crop : {Rectangle{0, 0, 50, 40}, Rectangle{70, 40, 20, 9}}) {
    Frame part = whole;
    part.crop = crop;
    Stages in_crop(device(), part, GetParam().rows);
    const Lists of_crop = read_lists(in_crop, in_crop.bin());
    std::size_t behind = 0;
    for (const auto& [tile, in_whole] : tiles_of_both(in_crop, in_picture)) {
      ASSERT_GE(of_crop.lengths[tile], of_picture.lengths[in_whole]);
      behind += of_crop.lengths[tile] - of_picture.lengths[in_whole];
      for (std::size_t i = 0; i < of_picture.lengths[in_whole]; ++i) {
        ASSERT_EQ(of_crop.entries[of_crop.starts[tile] + i].particle,
                  of_picture.entries[of_picture.starts[in_whole] + i].particle);
      }
    }
    EXPECT_GT(behind, 10u) << "some must lie beside the crop";
  }
}

TEST_P(Bin, CountsTheEntriesOfAllLists) {
  Stages stages(device(), clouds(), GetParam().rows);
  const TileLists lists = stages.bin();
  const std::vector<std::uint32_t>& lengths = stages.lengths();
  ASSERT_EQ(lengths.size(), stages.layout().tile_count);
  EXPECT_EQ(lists.entry_count, std::accumulate(lengths.begin(), lengths.end(), std::uint64_t{0}));
  EXPECT_GT(lists.entry_count, 500u) << "the scene must fill some lists";
}

// Segments cut every list into pieces in order; only lists of several pieces have partial
// layers, each its own.
TEST_P(Bin, SegmentsCoverEveryListInOrder) {
  device().traits.choose_shape(GetParam().rows);
  device().traits.segment_length = 16;
  Stages stages(device(), clouds(), GetParam().rows);
  const TileLists lists = stages.bin();
  const Lists read = read_lists(stages, lists);
  const auto segments = stages.read(lists.segments, lists.segment_count);
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
  Stages stages(device(), clouds(), GetParam().rows);
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
Drawn on_grid(const reference::Splat& splat, std::uint32_t g, const Stages& stages) {
  const shared::Grid& grid = stages.layout().grids[g];
  const FramePlan& plan = stages.plan();
  const double pixel = std::ldexp(1.0, plan.pyramid.grids[g].level);
  Drawn drawn{};
  drawn.by_mean = splat.sigma < static_cast<double>(plan.splats.mean_sigma);
  drawn.sigma = std::sqrt(splat.sigma * splat.sigma / (pixel * pixel) - plan.pyramid.blur_of(g));
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

// docs/dev/accuracy.md: where a splat ends, it adds less than 1/24 of the truncation's share.
// A centre is known to 1e-5 pixels here (orthographic, 150 pixels: 5 roundings of 150), by
// which contributions err by 2 k / sigma of it: 1.3e-3 for k = 3 and sigma = 0.05.
TEST_P(Bin, ListsHoldEverySplatThatMattersToAPixel) {
  Stages stages(device(), clouds(), GetParam().rows);
  const double smallest = stages.plan().shares.truncation / 24 * 1.01;
  const Lists lists = read_lists(stages, stages.bin());
  const PictureLayout& layout = stages.layout();

  // The grid that the device chose for each particle; off the picture it may have none.
  std::map<std::uint64_t, std::uint32_t> level;
  for (std::uint32_t g = 0; g < layout.grids.size(); ++g) {
    const shared::Grid& grid = layout.grids[g];
    const std::uint32_t tiles = static_cast<std::uint32_t>(grid.tiles_x * grid.tiles_y);
    for (std::uint32_t tile = grid.first_tile; tile < grid.first_tile + tiles; ++tile) {
      for (std::uint32_t i = 0; i < lists.lengths[tile]; ++i) {
        const auto known = level.emplace(lists.entries[lists.starts[tile] + i].particle, g);
        ASSERT_EQ(known.first->second, g) << "a splat on two grids";
      }
    }
  }

  int pixels_checked = 0;
  const int tile_width = static_cast<int>(stages.context().variant.tile_width);
  const int tile_height = static_cast<int>(stages.context().variant.tile_height);
  for (const reference::Splat& splat : reference::project(stages.frame())) {
    const auto found = level.find(splat.particle);
    const std::uint32_t g = found == level.end() ? 0 : found->second;
    const shared::Grid& grid = layout.grids[g];
    const Drawn drawn = on_grid(splat, g, stages);
    // Of a guard band all but its outermost pixels is looked at, and in memory.
    const int end_x = std::min(grid.width, grid.first_x + grid.tiles_x * tile_width);
    const int end_y = std::min(grid.height, grid.first_y + grid.tiles_y * tile_height);
    for (int y = grid.first_y; y < end_y; ++y) {
      for (int x = grid.first_x; x < end_x; ++x) {
        if (contribution(drawn, x, y) <= smallest) continue;
        ++pixels_checked;
        const int tx = (x - grid.first_x) / tile_width, ty = (y - grid.first_y) / tile_height;
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
        ASSERT_LE(std::abs(x - grid.first_x + 0.5 - tx * tile_width - entry->x), entry->radius);
        ASSERT_LE(std::abs(y - grid.first_y + 0.5 - ty * tile_height - entry->y), entry->radius);
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

// Lists that do not fit together are made band by band.
TEST(TileBands, AreOneWhereAllFits) {
  const std::vector<TileBand> bands = cut_in_bands({3, 0, 4}, 7);
  ASSERT_EQ(bands.size(), 1u);
  EXPECT_EQ(bands.front().first, 0u);
  EXPECT_EQ(bands.front().end, 3u);
}

TEST(TileBands, EndBeforeTheTileThatIsTooMuch) {
  const std::vector<TileBand> bands = cut_in_bands({3, 4, 1, 5, 1}, 7);
  ASSERT_EQ(bands.size(), 2u);
  EXPECT_EQ(bands[0].end, 2u);
  EXPECT_EQ(bands[1].first, 2u);
  EXPECT_EQ(bands[1].end, 5u);
}

TEST(TileBands, CountEntriesBeyond32Bits) {
  const std::vector<std::uint32_t> lengths(6, 0xfffffff0u);
  EXPECT_EQ(cut_in_bands(lengths, std::uint64_t{1} << 40).size(), 1u);
  EXPECT_EQ(cut_in_bands(lengths, std::uint64_t{1} << 33).size(), 3u);
}

class DrawnInBands : public StageTest {};

TEST_F(DrawnInBands, IsTheSamePictureBitForBit) {
  for (const bool ordered : {false, true}) {
    CloudSetup setup;
    setup.count = 3000;
    setup.width = 300;
    setup.height = 200;
    setup.sigma_low = 5;
    DrawnComponent component = random_clouds(setup);
    if (ordered) component.absorption = {Absorption::Kind::gray, 1};
    const Frame frame = frame_of(setup.width, setup.height, {component});
    const FramePlan plan = make_plan(frame);
    ParticleStore particles(device());
    const DeviceTraits traits = device().traits;
    // One tile may have all splats of a chunk, so that a band holds as many at least.
    device().traits.chunk_blocks = 1;
    if (traits.rows) device().traits.project_block = 1024;
    device().traits.sorted_chunk = 1024;
    const Image whole = Pipeline(device(), particles, frame, plan).draw();
    device().traits.list_capacity = 1;
    Pipeline in_bands(device(), particles, frame, plan);
    const Image banded = in_bands.draw();
    EXPECT_GT(in_bands.counts().tile_entries, 3 * 1024u) << "the lists must not fit";
    device().traits = traits;
    EXPECT_EQ(whole.pixels, banded.pixels);
  }
}

}  // namespace
}  // namespace splotchcl::test
