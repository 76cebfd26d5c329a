// Slices by keys, and the clouds of each.
#include "device/stages/clouds_in_lists.h"
#include "device/walk/key_slices.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Where clouds around the camera lie in an order that ranks have in slices.

using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

Ranges ranges_of(const std::vector<std::uint64_t>& keys, const std::vector<KeySlice>& slices) {
  Ranges ranges;
  for (const CloudRange& range : clouds_of_slices(keys, slices))
    ranges.emplace_back(range.first, range.end);
  return ranges;
}

KeySlice slice(SplatPlace begin, SplatPlace end, std::uint64_t first, std::uint64_t splats) {
  return {begin, end, first, splats};
}

TEST(CloudsOfSlices, LieWhereTheirKeysDo) {
  const std::vector<KeySlice> slices = {slice({10, 0}, {20, 0}, 0, 5),
                                        slice({20, 0}, {end_of_keys, 0}, 5, 5)};
  EXPECT_EQ(ranges_of({3, 10, 19, 20, 99}, slices), (Ranges{{0, 3}, {3, 5}}));
}

// Splats of key 20 are in both slices: the cloud lies behind all of them.
TEST(CloudsOfSlices, LieBehindSplatsOfTheSameKey) {
  const std::vector<KeySlice> slices = {slice({10, 0}, {20, 4}, 0, 5),
                                        slice({20, 4}, {end_of_keys, 0}, 5, 5)};
  EXPECT_EQ(ranges_of({19, 20, 21}, slices), (Ranges{{0, 1}, {1, 3}}));
}

TEST(CloudsOfSlices, AreTheFirstOnesWithoutSplats) {
  const SplatPlace end = {end_of_keys, 0};
  EXPECT_EQ(ranges_of({1, 2}, {slice(end, end, 0, 0), slice(end, end, 0, 0)}),
            (Ranges{{0, 2}, {2, 2}}));
}

TEST(CloudsOfSlices, MayBeCountedLikeSplats) {
  const KeySlice counted = with_clouds(slice({20, 0}, {30, 0}, 5, 7), {2, 6});
  EXPECT_EQ(counted.first, 7u);
  EXPECT_EQ(counted.splats, 11u);
}

CloudLayers layers_of(const std::vector<std::uint64_t>& keys) {
  std::vector<CloudAround> clouds;
  for (const std::uint64_t key : keys)
    clouds.emplace_back().key = key;
  return CloudLayers(std::move(clouds));
}

// The first slice has splats of keys 10 and 12, the second of 20 and 22.
CloudLayers placed_by_slices(const std::vector<std::uint64_t>& keys, std::size_t of_first) {
  CloudLayers layers = layers_of(keys);
  layers.append_places(layers.places_among({12, 10}, 0, 0, of_first));
  layers.append_places(layers.places_among({20, 22}, 2, of_first, keys.size()));
  return layers;
}

TEST(LayersOfSlices, HaveThePlacesOfOneProcess) {
  const std::vector<std::uint64_t> keys = {5, 10, 11, 15, 16, 20, 30};
  CloudLayers alone = layers_of(keys);
  alone.append_places(alone.places_among({12, 10, 20, 22}, 0, 0, keys.size()));
  CloudLayers sliced = placed_by_slices(keys, 4);
  while (const std::optional<CloudLayer> layer = alone.take_before(end_of_keys)) {
    const std::optional<CloudLayer> same = sliced.take_before(end_of_keys);
    ASSERT_TRUE(same);
    EXPECT_EQ(same->first, layer->first);
    EXPECT_EQ(same->end, layer->end);
    EXPECT_EQ(same->splats_before, layer->splats_before);
  }
  EXPECT_FALSE(sliced.take_before(end_of_keys));
}

TEST(LayersOfSlices, AreLeftToThoseWhoHaveTheSplatsBehindThem) {
  CloudLayers layers = placed_by_slices({5, 15, 16, 21}, 2);
  layers.skip_before(2);
  const std::optional<CloudLayer> between = layers.take_before(3);
  ASSERT_TRUE(between);
  EXPECT_EQ(between->first, 1u);
  EXPECT_EQ(between->end, 3u);
  EXPECT_FALSE(layers.take_before(3));
}

// Splats of known keys and chunks, and how they are counted.
struct Splats {
  std::vector<SplatPlace> places;

  CountedKeys count(const KeyWindow& window, int shift) const {
    CountedKeys counted{window, shift, std::vector<std::uint64_t>(1 << bits_of_key_bin)};
    for (const SplatPlace& place : places) {
      if (place.key >= window.first && place.key < window.end)
        ++counted.bins[place.key >> shift & ((1 << bits_of_key_bin) - 1)];
    }
    return counted;
  }
  std::vector<std::uint64_t> count_chunks(const KeyWindow& window) const {
    std::vector<std::uint64_t> chunks(10);
    for (const SplatPlace& place : places) {
      if (place.key >= window.first && place.key < window.end) ++chunks[place.chunk];
    }
    return chunks;
  }
  std::vector<KeySlice> cut(std::size_t ranks, std::uint64_t capacity) const {
    return cut_in_slices(
        count({}, 32), ranks, capacity,
        [this](const KeyWindow& window, int shift) { return count(window, shift); },
        [this](const KeyWindow& window) { return count_chunks(window); });
  }
};

Splats splats_of_keys(std::size_t count, std::uint64_t first, std::uint64_t step) {
  Splats splats;
  for (std::size_t i = 0; i < count; ++i)
    splats.places.push_back({first + step * i, i % 10});
  return splats;
}

void expect_all_in_their_slices(const Splats& splats, const std::vector<KeySlice>& slices) {
  std::vector<std::uint64_t> found(slices.size());
  for (const SplatPlace& place : splats.places) {
    const std::size_t slice = slice_of(place, slices.data(), slices.size());
    ASSERT_LT(slice, slices.size());
    ++found[slice];
  }
  std::uint64_t first = 0;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    EXPECT_EQ(slices[s].splats, found[s]) << s;
    EXPECT_EQ(slices[s].first, first);
    first += found[s];
  }
}

TEST(KeySlices, ShareOutSplatsEvenly) {
  const Splats splats = splats_of_keys(1000, 1, (std::uint64_t{1} << 48) / 1001);
  for (const std::size_t ranks : {1u, 2u, 3u, 7u}) {
    const std::vector<KeySlice> slices = splats.cut(ranks, 1u << 20);
    ASSERT_EQ(slices.size(), ranks);
    expect_all_in_their_slices(splats, slices);
    for (const KeySlice& slice : slices)
      EXPECT_NEAR(static_cast<double>(slice.splats), 1000.0 / static_cast<double>(ranks), 1.5);
  }
}

TEST(KeySlices, LookCloserWhereKeysLieTogether) {
  const Splats splats = splats_of_keys(1000, std::uint64_t{5} << 40, 3);
  const std::vector<KeySlice> slices = splats.cut(4, 1u << 20);
  expect_all_in_their_slices(splats, slices);
  for (const KeySlice& slice : slices)
    EXPECT_NEAR(static_cast<double>(slice.splats), 250, 2);
}

TEST(KeySlices, CutOneKeyByChunks) {
  Splats splats;
  for (std::size_t i = 0; i < 1000; ++i)
    splats.places.push_back({77, i / 100});
  const std::vector<KeySlice> slices = splats.cut(4, 1u << 20);
  expect_all_in_their_slices(splats, slices);
  for (const KeySlice& slice : slices)
    EXPECT_NEAR(static_cast<double>(slice.splats), 250, 100);
}

TEST(KeySlices, ComeInRoundsWhereRanksHaveNoRoom) {
  const Splats splats = splats_of_keys(1000, 1, (std::uint64_t{1} << 48) / 1001);
  const std::vector<KeySlice> slices = splats.cut(3, 60);
  EXPECT_EQ(slices.size() % 3, 0u);
  EXPECT_GE(slices.size(), 17u);
  expect_all_in_their_slices(splats, slices);
  for (const KeySlice& slice : slices)
    EXPECT_LE(slice.splats, 60u);
}

TEST(KeySlices, MayBeEmpty) {
  const Splats one = splats_of_keys(1, 12345, 1);
  const std::vector<KeySlice> slices = one.cut(3, 100);
  ASSERT_EQ(slices.size(), 3u);
  expect_all_in_their_slices(one, slices);
  for (const KeySlice& slice : Splats().cut(3, 100))
    EXPECT_EQ(slice.splats, 0u);
}

TEST(KeySlices, LeaveOutWhatLiesInOthers) {
  const Splats splats = splats_of_keys(100, 1, (std::uint64_t{1} << 48) / 101);
  const std::vector<KeySlice> slices = splats.cut(4, 1000);
  const std::uint64_t before = slices[1].begin.key - 1, behind = slices[2].end.key;
  EXPECT_EQ(slice_of({before, 0}, &slices[1], 2), 2u);
  EXPECT_EQ(slice_of({behind, 0}, &slices[1], 2), 2u);
  EXPECT_EQ(window_of(&slices[1], 2).first, slices[1].begin.key);
  EXPECT_EQ(window_of(&slices[1], 2).end, behind);
}

// One process that has not room for all splats draws slice by slice.
TEST(KeySlices, OfOneProcessFillItsRoom) {
  Splats splats;
  for (std::uint64_t i = 0; i < 5000; ++i)
    splats.places.push_back({i * 0x9e3779b97f4a7c15u >> 16, i % 10});
  for (const std::uint64_t capacity : {5000u, 2500u, 700u, 100u}) {
    const std::vector<KeySlice> slices = splats.cut(1, capacity);
    expect_all_in_their_slices(splats, slices);
    for (const KeySlice& slice : slices)
      EXPECT_LE(slice.splats, capacity);
    EXPECT_LE(slices.size(), 2 * splats.places.size() / capacity + 1);
  }
}

TEST(KeySlices, HoldTheSmallestAndTheLargestKey) {
  const Splats both = {{{0, 0}, {end_of_keys - 1, 9}}};
  for (const std::uint64_t capacity : {1u, 2u})
    expect_all_in_their_slices(both, both.cut(1, capacity));
}

// What each chunk of particles has of a slice: all splats of it, and none of another one.
TEST(KeySlices, KnowTheKeysOfEachChunk) {
  Splats splats;
  for (std::size_t i = 0; i < 1000; ++i)
    splats.places.push_back({76 + i % 3, i / 100});
  const std::vector<KeySlice> slices = splats.cut(1, 150);
  expect_all_in_their_slices(splats, slices);
  EXPECT_GT(slices.size(), 3u) << "so that one key lies in several";
  for (const SplatPlace& place : splats.places) {
    for (std::size_t s = 0; s < slices.size(); ++s) {
      const KeyWindow window = window_of_chunk(slices[s], place.chunk);
      const bool is_within = place.key >= window.first && place.key < window.end;
      EXPECT_EQ(is_within, s == slice_of(place, slices.data(), slices.size()));
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
