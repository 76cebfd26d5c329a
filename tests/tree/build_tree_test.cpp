#include "tree/build_tree.h"

#include "scene/particle_columns.h"
#include "scene/scalar_map.h"
#include "testing.h"
#include "tree/node_bytes.h"
#include "tree/sampled_field.h"
#include "tree/tree_scenes.h"

namespace splotchcl::test {
namespace {

// All particles below a node, each as often as it is there.
void collect(const TreeOfType& tree, std::size_t level, std::uint64_t node,
             std::vector<std::uint32_t>& places) {
  const TreeLevel& nodes = tree.levels[level];
  const std::uint64_t first = nodes.first_loose_particle(node);
  for (std::uint64_t i = first; i < first + nodes.loose[node]; ++i)
    places.push_back(tree.order[i]);
  std::uint64_t child = nodes.first_child(node);
  for (unsigned octant = 0; octant < 8; ++octant) {
    if ((nodes.children[node] >> octant & 1U) != 0) collect(tree, level + 1, child++, places);
  }
}

// Of members' colors, found from the particles.
struct ColorSums {
  double flux = 0;
  std::array<double, 3> color{}, square{}, place{};
  std::array<std::array<double, 3>, 3> product{};  // of channel and axis

  void add(const Matter& matter, std::size_t i, const DrawnComponent& drawn) {
    const auto mass = static_cast<double>(matter.mass[i]);
    const auto rgb = sample_knots(drawn.palette.emission,
                                  normalized(static_cast<double>(matter.color[i]), drawn.color));
    flux += mass;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto at = static_cast<double>(matter.position[3 * i + a]);
      color[a] += mass * rgb[a];
      square[a] += mass * rgb[a] * rgb[a];
      place[a] += mass * at;
      for (std::size_t c = 0; c < 3; ++c)
        product[c][a] += mass * rgb[c] * at;
    }
  }
  std::array<double, 3> mean() const { return {color[0] / flux, color[1] / flux, color[2] / flux}; }
  double deviation() const {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max(largest, square[c] / flux - mean()[c] * mean()[c]);
    return std::sqrt(largest);
  }
  double dipole() const {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double squares = 0;
      for (std::size_t a = 0; a < 3; ++a)
        squares += std::pow(product[c][a] / flux - mean()[c] * place[a] / flux, 2);
      largest = std::max(largest, squares);
    }
    return std::sqrt(largest);
  }
};

template <class T>
bool are_same(const T* a, const T* b, std::uint64_t count) {
  return std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof(T)) == 0;
}

void expect_same(const TreeOfType& a, const TreeOfType& b) {
  ASSERT_EQ(a.levels.size(), b.levels.size());
  for (std::size_t l = 0; l < a.levels.size(); ++l) {
    ASSERT_EQ(a.levels[l].count, b.levels[l].count);
    EXPECT_TRUE(are_same(a.levels[l].nodes, b.levels[l].nodes, a.levels[l].count));
    EXPECT_TRUE(
        are_same(a.levels[l].fields, b.levels[l].fields, a.levels[l].count * a.fields.size()));
    EXPECT_EQ(a.levels[l].colors != nullptr, b.levels[l].colors != nullptr);
    EXPECT_TRUE(a.levels[l].colors == nullptr ||
                are_same(a.levels[l].colors, b.levels[l].colors, a.levels[l].count));
    EXPECT_TRUE(are_same(a.levels[l].children, b.levels[l].children, a.levels[l].count));
    EXPECT_TRUE(are_same(a.levels[l].loose, b.levels[l].loose, a.levels[l].count));
  }
  ASSERT_EQ(a.order_count, b.order_count);
  EXPECT_TRUE(are_same(a.order, b.order, a.order_count));
}

// Of their mean, dark members included, and of how far they lie on one side.
TEST(BuildTree, KnowsTheMeanColorOfAllMembers) {
  Matter matter = clumps(3000, 6, 2);
  std::mt19937_64 random(6);
  for (float& mass : matter.mass)
    mass = static_cast<float>(random() % 4);
  const Frame frame = frame_of(matter, 8, 8);
  const auto tree = tree_of(matter, frame);
  const DrawnComponent& drawn = frame.components.front();
  for (std::size_t level = 0; level < tree->levels.size(); ++level) {
    const TreeLevel& nodes = tree->levels[level];
    for (std::uint64_t node = 0; node < nodes.count; ++node) {
      std::vector<std::uint32_t> places;
      collect(*tree, level, node, places);
      ColorSums sums;
      for (const std::uint32_t place : places)
        sums.add(matter, place, drawn);
      if (!(sums.flux > 0)) continue;
      const MeanColor& color = nodes.colors[node];
      const auto mean = sums.mean();
      const double largest = *std::max_element(mean.begin(), mean.end());
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(static_cast<double>(color.mean()[c]), mean[c], 1e-4 * largest);
      const double cell = tree->side * std::exp2(-nodes.nodes[node].cell_level(level));
      EXPECT_NEAR(rough_of_bits(color.deviation), sums.deviation(), 0.05 * sums.deviation() + 1e-5);
      EXPECT_NEAR(cell * rough_of_bits(color.dipole), sums.dipole(),
                  0.05 * sums.dipole() + 1e-5 * cell);
    }
  }
}

TEST(MeanColor, HoldsColorsOfAnySize) {
  for (const double brightest : {1e-30, 1e-3, 1.0, 1e6}) {
    const MeanColor color = MeanColor::of({brightest, 0.3 * brightest, 0}, 0, 0);
    EXPECT_NEAR(static_cast<double>(color.mean()[0]), brightest, 2e-5 * brightest);
    EXPECT_NEAR(static_cast<double>(color.mean()[1]), 0.3 * brightest, 2e-5 * brightest);
    EXPECT_EQ(color.mean()[2], 0);
  }
  EXPECT_EQ(MeanColor::of({0, 0, 0}, 0, 0).mean(), (std::array<float, 3>{}));
}

TEST(BuildTree, HoldsEachParticleOnce) {
  const Matter matter = clumps(20000, 3);
  for (const unsigned least : {2u, 4u, 9u}) {
    const auto tree = tree_of(matter, least);
    ASSERT_EQ(tree->levels.front().count, 1u);
    std::vector<std::uint32_t> places;
    collect(*tree, 0, 0, places);
    ASSERT_EQ(places.size(), matter.count());
    EXPECT_EQ(std::set<std::uint32_t>(places.begin(), places.end()).size(), matter.count());
  }
}

TEST(BuildTree, KeepsTheFluxOnEveryLevel) {
  const Matter matter = clumps(20000, 4);
  const auto tree = tree_of(matter);
  const double all = std::accumulate(matter.mass.begin(), matter.mass.end(), 0.0);
  EXPECT_NEAR(static_cast<double>(tree->levels.front().nodes->flux), all, 1e-6 * all);
  for (std::size_t level = 0; level + 1 < tree->levels.size(); ++level) {
    for (std::uint64_t node = 0; node < tree->levels[level].count; ++node) {
      std::vector<std::uint32_t> places;
      collect(*tree, level, node, places);
      double flux = 0;
      for (const std::uint32_t place : places)
        flux += static_cast<double>(matter.mass[place]);
      ASSERT_NEAR(static_cast<double>(tree->levels[level].nodes[node].flux), flux, 1e-6 * flux);
    }
  }
}

TEST(BuildTree, HasTheSameBitsHoweverManyParticlesAreHeld) {
  const Matter matter = clumps(30000, 5);
  TreeSource source = source_of(matter);
  source.colors = ColorRule{0, -1, {Scaling::log, -2, 2}, {}, {"", {{0, 0, 1}, {1, 0, 0}}, {}}};
  expect_same(build_tree(source, {4, 1000}), build_tree(source, {4, 0}));
}

// Three stretches of particles along x, of which most of what is held at once needs one.
TEST(BuildTree, HasTheSameBitsWhereSomeStretchesAreNotRead) {
  constexpr std::size_t count = 2 * streamed_particles + 5000;
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> uniform(0, 1);
  Matter matter;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = (static_cast<double>(i) + uniform(random)) / static_cast<double>(count);
    matter.add(x, uniform(random), uniform(random), 0.02, 1, 1 + x);
  }
  matter.position[0] = 0.999F;  // one that lies in no order
  const TreeSource source = source_of(matter);
  expect_same(build_tree(source, {8, 60000}), build_tree(source, {8, 0}));
}

// A mean over nodes of what a steep palette makes of eight members is that of all members, within
// four of its standard errors.
TEST(BuildTree, SamplesMembersWithoutBias) {
  const Matter matter = clumps(40000, 6, 1);
  const auto tree = tree_of(matter, 16);
  const TreeLevel& level = tree->levels[3];
  double difference = 0, squares = 0, sampled_sum = 0;
  for (std::uint64_t node = 0; node < level.count; ++node) {
    std::vector<std::uint32_t> places;
    collect(*tree, 3, node, places);
    double exact = 0, sampled = 0;
    for (const std::uint32_t place : places)
      exact += matter.color[place] > 3 ? 1 : 0;
    exact /= static_cast<double>(places.size());
    const SampledField& field = level.fields[node];
    for (std::size_t k = 0; k < sampled_members; ++k)
      sampled += value_of_ordered(field.ordered(k)) > 3 ? 1.0 / 8 : 0;
    difference += sampled - exact;
    squares += (sampled - exact) * (sampled - exact);
    sampled_sum += sampled;
  }
  EXPECT_GT(sampled_sum, 10);
  EXPECT_LE(std::abs(difference), 4 * std::sqrt(squares));
}

TEST(BuildTree, KnowsBetweenWhichValuesAllMembersLie) {
  const Matter matter = clumps(20000, 7, 1);
  const auto tree = tree_of(matter, 16);
  for (std::size_t l = 0; l < tree->levels.size(); ++l) {
    const TreeLevel& level = tree->levels[l];
    for (std::uint64_t node = 0; node < level.count; ++node) {
      std::vector<std::uint32_t> places;
      collect(*tree, l, node, places);
      const SampledField& field = level.fields[node];
      for (const std::uint32_t place : places) {
        const std::uint32_t value = ordered_value(matter.color[place]);
        ASSERT_GE(value, field.least_ordered()) << l << " " << node;
        ASSERT_LE(value, field.largest_ordered()) << l << " " << node;
      }
    }
  }
}

std::vector<double> values_of(const Matter& matter, const std::vector<std::uint32_t>& places) {
  std::vector<double> values;
  for (const std::uint32_t place : places)
    values.push_back(std::log(static_cast<double>(matter.color[place])));
  std::sort(values.begin(), values.end());
  return values;
}
std::vector<double> sampled_values(const TreeOfType& tree, std::size_t level, std::uint64_t node) {
  std::vector<double> values;
  for (std::size_t k = 0; k < sampled_members; ++k) {
    const float value = value_of_ordered(tree.levels[level].fields[node].ordered(k));
    values.push_back(std::log(static_cast<double>(value)));
  }
  return values;
}

TEST(BuildTree, KeepsTheValuesOfUpToEightMembersOfEqualFlux) {
  const Matter matter = clumps(5000, 9, 1);
  const auto tree = tree_of(matter);
  int few = 0;
  for (std::size_t level = 0; level < tree->levels.size(); ++level) {
    for (std::uint64_t node = 0; node < tree->levels[level].count; ++node) {
      std::vector<std::uint32_t> places;
      collect(*tree, level, node, places);
      const std::size_t members = places.size() <= sampled_members ? places.size() : 0;
      ASSERT_EQ(tree->levels[level].nodes[node].all_sampled(), members);
      if (members == 0) continue;
      ++few;
      const std::vector<double> exact = values_of(matter, places);
      const std::vector<double> sampled = sampled_values(*tree, level, node);
      for (std::size_t k = 0; k < members; ++k)
        ASSERT_NEAR(sampled[k], exact[k], (exact.back() - exact.front() + 1e-5) / 100);
    }
  }
  EXPECT_GT(few, 100);
}

TEST(BuildTree, SamplesMembersOfUnlikeFluxByTheirShares) {
  Matter matter;
  for (int i = 0; i < 4; ++i)
    matter.add(0.1 * i, 0.2, 0.3, 0.1, i == 0 ? 5 : 1, i == 0 ? 2 : 1);
  const auto tree = tree_of(matter);
  EXPECT_EQ(tree->levels.front().nodes->members, 0);
  double sum = 0;
  for (std::size_t k = 0; k < sampled_members; ++k)
    sum += static_cast<double>(value_of_ordered(tree->levels.front().fields->ordered(k)));
  EXPECT_NEAR(sum, 5 * 2 + 3 * 1, 1e-4);
}

// Of places in each eighth that know nothing of each other the mean errs by the eighths' own
// variances.
TEST(BuildTree, SamplesMembersNearerToTheirMeanThanAtRandom) {
  const Matter matter = clumps(100000, 10, 1);
  const auto tree = tree_of(matter);
  const std::size_t level = 4;
  double squares = 0, at_random = 0;
  for (std::uint64_t node = 0; node < tree->levels[level].count; ++node) {
    std::vector<std::uint32_t> places;
    collect(*tree, level, node, places);
    if (places.size() < 8 * sampled_members) continue;
    const std::vector<double> exact = values_of(matter, places);
    const std::vector<double> sampled = sampled_values(*tree, level, node);
    const double mean =
        std::accumulate(exact.begin(), exact.end(), 0.0) / static_cast<double>(exact.size());
    const double of_sampled = std::accumulate(sampled.begin(), sampled.end(), 0.0) / 8;
    squares += (of_sampled - mean) * (of_sampled - mean);
    for (std::size_t k = 0; k < sampled_members; ++k) {
      const std::size_t first = k * exact.size() / 8, last = (k + 1) * exact.size() / 8;
      const double count = static_cast<double>(last - first);
      double sum = 0, sum_of_squares = 0;
      for (std::size_t i = first; i < last; ++i) {
        sum += exact[i];
        sum_of_squares += exact[i] * exact[i];
      }
      at_random += (sum_of_squares / count - sum * sum / count / count) / 64;
    }
  }
  EXPECT_GT(at_random, 0);
  EXPECT_LT(squares, at_random);
}

// Calls look(level, node, its cell along each axis) for a node and all below it.
template <class Look>
void walk(const TreeOfType& tree, std::size_t level, std::uint64_t node,
          const std::array<std::uint32_t, 3>& cell, const Look& look) {
  look(level, node, cell);
  std::uint64_t child = tree.levels[level].first_child(node);
  for (unsigned octant = 0; octant < 8; ++octant) {
    if ((tree.levels[level].children[node] >> octant & 1U) == 0) continue;
    std::array<std::uint32_t, 3> below{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      below[axis] = 2 * cell[axis] + (octant >> axis & 1U);
    walk(tree, level + 1, child++, below, look);
  }
}

TEST(BuildTree, HasNodesAtTheCentersOfTheirParticlesAndMergesTheRestOfEachNode) {
  const Matter matter = clumps(100000, 12);
  const auto tree = tree_of(matter);
  int rests = 0;
  walk(*tree, 0, 0, {}, [&](std::size_t level, std::uint64_t node, const auto& cell) {
    const TreeLevel& of_level = tree->levels[level];
    const TreeNode& stored = of_level.nodes[node];
    std::vector<std::uint32_t> places;
    collect(*tree, level, node, places);
    const int cell_level = stored.cell_level(level);
    const double side = std::ldexp(tree->side, -cell_level);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double center = 0;
      for (const std::uint32_t place : places)
        center += static_cast<double>(matter.position[3 * place + axis]);
      center /= static_cast<double>(places.size());
      const double at = (cell[axis] >> (stored.is_rest() ? 1 : 0)) +
                        (static_cast<double>(stored.place[axis]) + 0.5) * 0x1p-16;
      ASSERT_NEAR(tree->origin.a[axis] + side * at, center, 1e-4 * side + 1e-6);
    }
    rests += stored.is_rest() ? 1 : 0;
    if (level > 5 && of_level.children[node] != 0) {
      ASSERT_LT(of_level.loose[node], 4);
    }
  });
  EXPECT_GT(rests, 100);
}

TEST(BuildTree, LeavesBadParticlesOutAndCountsThem) {
  Matter matter = clumps(1000, 7);
  matter.position[3] = std::numeric_limits<float>::quiet_NaN();
  matter.h[5] = -1;
  matter.mass[9] = -2;
  const auto tree = tree_of(matter);
  EXPECT_EQ(tree->bad, 3u);
  std::vector<std::uint32_t> places;
  collect(*tree, 0, 0, places);
  EXPECT_EQ(places.size(), 997u);
}

TEST(BuildTree, TakesFewParticlesAndNone) {
  Matter one;
  one.add(5, 5, 5, 1, 2, 3);
  const auto tree = tree_of(one);
  ASSERT_EQ(tree->levels.size(), 1u);
  EXPECT_EQ(tree->levels.front().nodes->flux, 2);
  EXPECT_EQ(tree->order_count, 1u);
  EXPECT_TRUE(tree_of(Matter())->levels.empty());
}

TEST(BuildTree, RefusesMoreThan255ParticlesInOnePlace) {
  Matter matter = clumps(100, 8);
  for (int i = 0; i < 256; ++i)
    matter.add(0.5, 0.5, 0.5, 0.01, 1, 1);
  EXPECT_THROW(tree_of(matter), UsageError);
}

TEST(SampledField, HoldsEqualValuesExactly) {
  for (const float value : {-1e30f, -2.5f, 0.0f, 1e-20f, 10237.0f}) {
    const std::vector<float> equal(sampled_members, value);
    EXPECT_EQ(value_of_ordered(SampledField::of(equal.data(), value, value).ordered(3)), value);
  }
}

TEST(SampledField, HoldsOthersToAPartOfTheirSpread) {
  const std::vector<float> values = {1000, 1000.5f, 1001, 1002, 1003, 1004, 1004.5f, 1005};
  const SampledField field = SampledField::of(values.data(), values.front(), values.back());
  for (std::size_t k = 0; k < sampled_members; ++k)
    EXPECT_NEAR(value_of_ordered(field.ordered(k)), values[k], 5.1 / 510);
}

TEST(SampledField, HoldsHowFarOtherMembersReach) {
  const std::vector<float> values = {2, 2, 2.5F, 3, 3, 3, 3, 4};
  const auto distance = [](float from, float to) {
    return static_cast<double>(ordered_value(to)) - static_cast<double>(ordered_value(from));
  };
  for (const float least : {2.0F, 1.999F, 0.0F, -1e30F}) {
    for (const float largest : {4.0F, 4.001F, 1e30F}) {
      const SampledField field = SampledField::of(values.data(), least, largest);
      const double below = distance(least, 2), above = distance(4, largest);
      const double found_below = distance(value_of_ordered(field.least_ordered()), 2);
      const double found_above = distance(4, value_of_ordered(field.largest_ordered()));
      EXPECT_GE(found_below, below);
      EXPECT_LE(found_below, 1.1 * below);
      EXPECT_GE(found_above, above);
      // The span to the largest of the samples is rounded up to a 2048th.
      EXPECT_LE(found_above, 1.1 * above + distance(2, 4) / 1024);
    }
  }
}

TEST(SampledField, KeepsTheOrderOfValuesOfAnySize) {
  const std::vector<float> rising = {-1e30f, -2.5f, -1e-20f, 0, 1e-20f, 1, 3e4f, 1e30f};
  const SampledField field = SampledField::of(rising.data(), rising.front(), rising.back());
  for (std::size_t k = 1; k < sampled_members; ++k)
    EXPECT_LE(field.ordered(k - 1), field.ordered(k));
}

}  // namespace
}  // namespace splotchcl::test
