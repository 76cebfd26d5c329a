// Keys and the order they give.
#include <gtest/gtest.h>

#include <limits>

#include "reference/frames.h"
#include "splotchcl/reference.h"

namespace splotchcl {
namespace {

using test::Cloud;
using test::component_of;
using test::frame_of;
using test::one_color;

std::vector<std::uint64_t> sorted(const std::vector<std::uint64_t>& keys, const SortOrder& order) {
  std::vector<reference::Splat> splats(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    splats[i].key = keys[i];
    splats[i].particle = i;
  }
  reference::sort(splats, order);
  std::vector<std::uint64_t> particles;
  for (const auto& splat : splats)
    particles.push_back(splat.particle);
  return particles;
}

SortOrder by_field(bool descending) {
  SortOrder order;
  order.by = SortOrder::By::field;
  order.field = "density";
  order.descending = descending;
  return order;
}

TEST(Sort, PutsTheSmallestKeyInFront) {
  EXPECT_EQ(sorted({3, 1, 2}, {}), (std::vector<std::uint64_t>{1, 2, 0}));
  EXPECT_EQ(sorted({3, 1, 2}, by_field(false)), (std::vector<std::uint64_t>{1, 2, 0}));
}

TEST(Sort, PutsTheLargestKeyInFrontWhenDescending) {
  EXPECT_EQ(sorted({3, 1, 2}, by_field(true)), (std::vector<std::uint64_t>{0, 2, 1}));
}

TEST(Sort, KeepsEqualKeysInFileOrder) {
  EXPECT_EQ(sorted({1, 0, 1, 0, 1}, {}), (std::vector<std::uint64_t>{1, 3, 0, 2, 4}));
  EXPECT_EQ(sorted({1, 0, 1, 0, 1}, by_field(true)), (std::vector<std::uint64_t>{0, 2, 4, 1, 3}));
}

TEST(Key, OfAFieldHasTheOrderOfItsValues) {
  constexpr float smallest = std::numeric_limits<float>::denorm_min();
  constexpr float largest = std::numeric_limits<float>::max();
  const std::vector<float> values = {-largest, -3,       -1, -smallest, -0.0f,
                                     0.0f,     smallest, 1,  largest};
  Frame frame =
      frame_of(8, 8, {component_of(std::vector<Cloud>(values.size()), one_color(1, 1, 1))});
  frame.sort = by_field(false);
  frame.components[0].particles.sort_field = Column::owning(values);
  const auto splats = reference::project(frame);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] == 0 && values[i - 1] == 0) {
      EXPECT_EQ(splats[i - 1].key, splats[i].key) << "-0 is 0";
    } else {
      EXPECT_LT(splats[i - 1].key, splats[i].key) << values[i];
    }
  }
}

TEST(Render, SortsByAFieldInsteadOfDepthWhenTheSceneSaysSo) {
  // The far cloud has the smaller field: it covers the near one.
  DrawnComponent opaque =
      component_of({Cloud{0.5, 0.5, 1, 9, 50}, Cloud{0.5, 0.5, 2, 9, 50}}, one_color(1, 1, 1));
  opaque.palette.emission = {Rgb{1, 0, 0}, Rgb{0, 1, 0}};
  opaque.palette.absorption = {Rgb{1, 1, 1}, Rgb{1, 1, 1}};
  opaque.particles.color = Column::owning({0, 1});
  opaque.particles.sort_field = Column::owning({2, 1});
  Frame frame = frame_of(16, 16, {opaque});
  frame.sort = by_field(false);
  const ReferenceImage image = reference::render(frame);
  const double* middle = &image.pixels[4 * (8 * 16 + 8)];
  EXPECT_LT(middle[0], 1e-6);
  EXPECT_GT(middle[1], 0.01);
}

}  // namespace
}  // namespace splotchcl
