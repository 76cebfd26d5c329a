// Where clouds around the camera lie in an order that ranks have in slices.
#include "device/stages/cloud_layers.h"
#include "device/walk/key_slices.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
