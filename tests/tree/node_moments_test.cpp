#include "tree/node_moments.h"

#include "testing.h"
#include "tree/node_bytes.h"

namespace splotchcl::test {
namespace {

struct Point {
  double flux, h;
  Vec3 place;
};

std::vector<Point> random_points(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({0.2 + uniform(random),
                      0.1 + uniform(random),
                      {{uniform(random), 2 * uniform(random), std::pow(uniform(random), 3)}}});
  }
  return points;
}

NodeMoments merged(const std::vector<NodeMoments>& parts) {
  std::vector<const NodeMoments*> pointers;
  for (const NodeMoments& part : parts)
    pointers.push_back(&part);
  return NodeMoments::merged(pointers);
}

std::vector<NodeMoments> of_particles(const std::vector<Point>& points) {
  std::vector<NodeMoments> particles;
  for (const Point& p : points)
    particles.push_back(NodeMoments::of_particle(p.flux, p.place, p.h));
  return particles;
}

// The mean over points, weighted by flux, of what f makes of a point's place from the centroid.
template <class F>
double mean(const std::vector<Point>& points, const Vec3& centroid, const F& f) {
  double sum = 0, flux = 0;
  for (const Point& p : points) {
    const double d[3] = {p.place.a[0] - centroid.a[0], p.place.a[1] - centroid.a[1],
                         p.place.a[2] - centroid.a[2]};
    sum += p.flux * f(d, p.h);
    flux += p.flux;
  }
  return sum / flux;
}

double length2(const double* d) {
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

TEST(NodeMoments, AreThoseOfAllMembersHoweverTheyWereMerged) {
  const std::vector<Point> points = random_points(12, 1);
  const std::vector<NodeMoments> all = of_particles(points);
  const NodeMoments once = merged(all);
  const NodeMoments twice =
      merged({merged({all.begin(), all.begin() + 5}), merged({all.begin() + 5, all.begin() + 8}),
              merged({all.begin() + 8, all.end()})});
  for (const NodeMoments& node : {once, twice}) {
    const Vec3& c = node.centroid;
    EXPECT_NEAR(mean(points, c, [](const double* d, double) { return d[1]; }), 0, 1e-14);
    EXPECT_NEAR(node.second[1], mean(points, c, [](auto* d, double) { return d[0] * d[1]; }),
                1e-14);
    EXPECT_NEAR(node.third[2], mean(points, c, [](auto* d, double) { return d[0] * d[0] * d[2]; }),
                1e-14);
    EXPECT_NEAR(node.third[4], mean(points, c, [](auto* d, double) { return d[0] * d[1] * d[2]; }),
                1e-14);
    EXPECT_NEAR(node.fourth,
                mean(points, c, [](auto* d, double) { return length2(d) * length2(d); }), 1e-13);
    EXPECT_NEAR(node.h2, mean(points, c, [](auto*, double h) { return h * h; }), 1e-14);
    EXPECT_NEAR(node.h4, mean(points, c, [](auto*, double h) { return h * h * h * h; }), 1e-14);
    EXPECT_NEAR(node.h2_offset[2], mean(points, c, [](auto* d, double h) { return h * h * d[2]; }),
                1e-14);
    EXPECT_NEAR(node.h2_spread,
                mean(points, c, [](auto* d, double h) { return h * h * length2(d); }), 1e-14);
    for (const Point& p : points) {
      const double d[3] = {p.place.a[0] - c.a[0], p.place.a[1] - c.a[1], p.place.a[2] - c.a[2]};
      EXPECT_LE(std::sqrt(length2(d)), node.reach * (1 + 1e-12));
      EXPECT_LE(p.h, node.widest);
    }
  }
}

TEST(NodeShape, IsZeroForEqualMembersInOnePlace) {
  const NodeMoments node = merged({NodeMoments::of_particle(1, {{1, 2, 3}}, 0.5),
                                   NodeMoments::of_particle(2, {{1, 2, 3}}, 0.5)});
  const NodeShape shape = shape_of(node, 0.3);
  EXPECT_NEAR(shape.uneven, 0, 1e-15);
  EXPECT_NEAR(shape.third, 0, 1e-15);
  EXPECT_NEAR(shape.fourth, 0, 1e-15);
}

// Two points at x = -1 and 1: <x^2> = 1, a round node's 1/3 along each axis; no third moment; the
// fourth <x^4> - 3 <x^2>^2 = -2.
TEST(NodeShape, IsThatOfAPair) {
  const NodeMoments node = merged({NodeMoments::of_particle(1, {{-1, 0, 0}}, 1e-9),
                                   NodeMoments::of_particle(1, {{1, 0, 0}}, 1e-9)});
  const NodeShape shape = shape_of(node, 0.3);
  EXPECT_NEAR(shape.uneven, std::sqrt(4.0 / 9 + 1.0 / 9 + 1.0 / 9), 1e-12);
  EXPECT_NEAR(shape.third, 0, 1e-12);
  EXPECT_NEAR(shape.fourth, 2, 1e-12);
}

TEST(NodeMoments, KnowHowNarrowMostOfTheirPeaksAre) {
  const auto merged_widths = [](std::vector<double> widths) {
    std::vector<NodeMoments> parts;
    for (const double h : widths)
      parts.push_back(NodeMoments::of_particle(1, Vec3{{h, 0, 0}}, h));
    std::vector<const NodeMoments*> pointers;
    for (const NodeMoments& part : parts)
      pointers.push_back(&part);
    return NodeMoments::merged(pointers).narrowness();
  };
  EXPECT_NEAR(merged_widths({0.1, 0.1, 0.1}), 1, 1e-12);
  EXPECT_NEAR(merged_widths({0.1, 0.2}), 1 / std::sqrt(62.5 * 0.025), 1e-12);
}

TEST(NarrowBits, AreRoundedDown) {
  for (double narrowness = 0.05; narrowness <= 1; narrowness += 0.001) {
    const double stored = narrownesses[narrow_bits(narrowness)];
    EXPECT_LE(stored, std::max(narrowness, narrowness >= 0.97 ? 1.0 : 0.0));
    EXPECT_GE(stored, 0.25 * narrowness);
  }
}

}  // namespace
}  // namespace splotchcl::test
