#include "tree/merged_drawing.h"

#include "device/pictures.h"
#include "scene/particle_columns.h"
#include "splotchcl/reference.h"
#include "testing.h"
#include "tree/tree_cut.h"
#include "tree/tree_preview.h"
#include "tree/tree_scenes.h"

namespace splotchcl::test {
namespace {

class MergedDrawings : public PictureTest {
 protected:
  static std::optional<MergedDrawing> draw_from_tree(const Frame& frame) {
    return draw_merged(frame, [](const Frame& part) { return draw(part); });
  }
  // Over max(1, light) and the tolerance.
  static double error_of(const Image& picture, const Frame& frame) {
    const ReferenceImage exact = reference::render(frame);
    double worst = 0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
      if (i % 4 == 3) continue;
      const double error = std::abs(static_cast<double>(picture.pixels[i]) - exact.pixels[i]);
      worst = std::max(worst, error / std::max(1.0, std::abs(exact.pixels[i])));
    }
    return worst / frame.tolerance;
  }
};

// Planted and seen from somewhere, with light over three decades.
Frame random_frame(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Matter matter = clumps(20000 + static_cast<std::size_t>(uniform(random) * 60000), seed,
                               seed % 6 == 0 ? 3 : 0.3);
  Frame frame = frame_of(matter, 40, 30);
  Camera camera;
  camera.look_at = {{uniform(random), uniform(random), uniform(random)}};
  const double angle = 2 * pi * uniform(random), distance = 0.8 + 2 * uniform(random);
  camera.position = {{camera.look_at.a[0] + distance * std::cos(angle),
                      camera.look_at.a[1] + distance * std::sin(angle),
                      camera.look_at.a[2] + uniform(random) - 0.5}};
  if (seed % 5 == 0) camera.projection = Projection::orthographic;
  if (seed % 7 == 0) camera.projection = Projection::fisheye;
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  frame.projection = camera.projection;
  frame.kernel.footprint_pixels = 0.25 + 0.5 * uniform(random);
  frame.tolerance = seed % 2 == 0 ? 1e-2 : 1e-3;
  if (seed % 4 == 3) frame.fade.near_length = 0.9 * distance;
  if (seed % 8 == 3) {
    frame.far_limit = 1.3 * distance;
    frame.fade.far_length = 0.2 * distance;
  }
  DrawnComponent& gas = frame.components.front();
  gas.brightness = std::pow(10, 3 * uniform(random) - 1.5);
  const Absorption::Kind kinds[] = {Absorption::Kind::none, Absorption::Kind::as_emission,
                                    Absorption::Kind::factor};
  gas.absorption.kind = kinds[seed % 3];
  if (gas.absorption.kind == Absorption::Kind::factor) gas.absorption.factor = gas.brightness;
  const unsigned least = seed % 4 == 0 ? 8 : 4;
  const bool has_colors = seed / 4 % 2 == 0;
  plant(frame, has_colors ? tree_of(matter, frame, least) : tree_of(matter, least));
  return frame;
}

TEST_F(MergedDrawings, KeepTheToleranceInRandomFrames) {
  std::size_t served = 0;
  for (const std::uint64_t seed : seeds(1, 120)) {
    const Frame frame = random_frame(seed);
    const auto drawing = draw_from_tree(frame);
    if (!drawing) continue;
    ++served;
    EXPECT_LE(error_of(drawing->image, frame), 1)
        << "seed " << seed << ", found " << drawing->found;
  }
  EXPECT_GT(served, seeds(1, 120).size() / 2) << "most should be served";
}

TEST_F(MergedDrawings, KeepTheToleranceWhereMatterOnlyAbsorbs) {
  for (const std::uint64_t seed : {2, 4, 8}) {
    Frame frame = random_frame(seed);
    frame.background = {1, 1, 1};
    DrawnComponent& gas = frame.components.front();
    gas.absorption = {Absorption::Kind::factor, 0.3 * gas.brightness};
    gas.brightness = 0;
    const auto drawing = draw_from_tree(frame);
    ASSERT_TRUE(drawing.has_value()) << seed;
    EXPECT_GT(drawing->nodes, 0U) << seed;
    EXPECT_LE(error_of(drawing->image, frame), 1) << seed << ", found " << drawing->found;
  }
}

// Particles of a lattice along the view, whose nodes err alike: what the estimate does not know and
// the blocks that are drawn again show.
TEST_F(MergedDrawings, KeepTheToleranceForALatticeAlongTheView) {
  Matter matter;
  constexpr int side = 40;
  for (int i = 0; i < side * side * side; ++i) {
    matter.add((i % side + 0.5) / side, (i / side % side + 0.5) / side,
               (i / side / side + 0.5) / side, 0.4 / side, 1, 1);
  }
  Frame frame = frame_of(matter, 30, 30);
  Camera camera;
  camera.position = {{0.5, -3, 0.5}};
  camera.look_at = {{0.5, 0.5, 0.5}};
  camera.sky = {{0, 0, 1}};
  camera.projection = Projection::orthographic;
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  frame.projection = camera.projection;
  plant(frame, tree_of(matter));
  const auto drawing = draw_from_tree(frame);
  if (drawing) {
    EXPECT_LE(error_of(drawing->image, frame), 1);
  }
}

// Nodes across the camera's plane are opened: their members behind it are not drawn.
TEST_F(MergedDrawings, KeepTheToleranceForACameraOfParallelViewsAmidTheParticles) {
  std::mt19937_64 random(23);
  std::normal_distribution<double> normal;
  Matter matter = clumps(40000, 23);
  for (int i = 0; i < 40000; ++i) {
    matter.add(0.55 + 0.02 * normal(random), 0.5 + 0.02 * normal(random),
               0.45 + 0.02 * normal(random), 0.004, 1, 1);
  }
  int served = 0;
  for (const double y : {0.49, 0.5, 0.51}) {
    Frame frame = frame_of(matter, 40, 30);
    Camera camera;
    camera.position = {{0.5, y, 0.5}};
    camera.look_at = {{0.6, 1, 0.4}};
    camera.sky = {{0, 0, 1}};
    camera.projection = Projection::orthographic;
    frame.camera = make_camera_frame(camera, frame.width, frame.height);
    frame.projection = camera.projection;
    frame.kernel.footprint_pixels = 1;
    frame.components.front().brightness = 0.1;
    plant(frame, tree_of(matter, frame));
    const auto drawing = draw_from_tree(frame);
    if (!drawing) continue;
    ++served;
    EXPECT_LE(error_of(drawing->image, frame), 1) << "y = " << y;
  }
  EXPECT_GT(served, 1);
}

// Hot in the middle, so that nodes around it carry heat outwards, all of them alike.
TEST_F(MergedDrawings, KeepTheToleranceAroundPeaksOfLightAndColor) {
  int served = 0;
  for (const double size : {0.01, 0.03, 0.1}) {
    std::mt19937_64 random(31);
    std::normal_distribution<double> normal;
    Matter matter;
    for (int i = 0; i < 60000; ++i) {
      const double d[3] = {normal(random), normal(random), normal(random)};
      const double away = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      const double shrunk = size * away * away;
      matter.add(0.5 + shrunk * d[0], 0.5 + shrunk * d[1], 0.5 + shrunk * d[2],
                 0.1 * size * (0.1 + away * away), 1, std::exp(2 - 2 * away));
    }
    for (const double tolerance : {1e-2, 1e-3}) {
      Frame frame = frame_of(matter, 40, 30);
      frame.tolerance = tolerance;
      plant(frame, tolerance < 5e-3 ? tree_of(matter, frame) : tree_of(matter));
      const auto drawing = draw_from_tree(frame);
      if (!drawing) continue;
      ++served;
      EXPECT_LE(error_of(drawing->image, frame), 1)
          << "size " << size << ", tolerance " << tolerance << ", found " << drawing->found;
    }
  }
  EXPECT_GT(served, 0);
}

TEST_F(MergedDrawings, TakeFewerSplatsThanThereAreParticles) {
  const Matter matter = clumps(200000, 21);
  Frame frame = frame_of(matter, 40, 30);
  plant(frame, tree_of(matter));
  const auto drawing = draw_from_tree(frame);
  ASSERT_TRUE(drawing);
  EXPECT_LT(drawing->nodes + drawing->particles, matter.count() / 4);
  EXPECT_LE(error_of(drawing->image, frame), 1);
}

TEST_F(MergedDrawings, TakeFewerSplatsWhereNodesHaveTheFramesColors) {
  const Matter matter = clumps(200000, 22, 1);
  Frame frame = frame_of(matter, 40, 30);
  const auto splats = [&] {
    const TreeCut cut = cut_tree(frame, {frame.tolerance, {}});
    return cut.nodes + cut.particles;
  };
  plant(frame, tree_of(matter, frame));
  const std::uint64_t with_colors = splats();
  frame.components.front().color.maximum *= 1.001;
  const std::uint64_t with_others = splats();
  EXPECT_LT(with_colors, with_others * 3 / 4);
}

TEST_F(MergedDrawings, DrawPeriodicImagesNearestToACenter) {
  const Matter matter = clumps(50000, 22);
  Frame frame = frame_of(matter, 40, 30);
  const Vec3 center = {{0.9, 0.4, 0.6}};
  Matter wrapped = matter;
  for (std::size_t i = 0; i < wrapped.position.size(); ++i) {
    const double d = static_cast<double>(matter.position[i]) - center.a[i % 3];
    wrapped.position[i] = static_cast<float>(d - std::round(d));
  }
  frame.components.front().particles.position = Column::owning(wrapped.position);
  frame.components.front().particles.origin = center;
  auto tree = std::make_shared<TreeOfComponent>();
  tree->parts = {{tree_of(matter), 0, 0, -1}};
  tree->period = {{1, 1, 1}};
  tree->center = center;
  frame.components.front().particles.tree = tree;
  const auto drawing = draw_from_tree(frame);
  ASSERT_TRUE(drawing);
  EXPECT_GT(drawing->nodes, 100u);
  EXPECT_LE(error_of(drawing->image, frame), 1);
}

// A random part of the particles, brighter by as much as is left out.
Frame random_part(Frame frame, std::size_t count) {
  DrawnComponent& component = frame.components.front();
  const std::size_t all = component.particles.count;
  Places places(all);
  std::iota(places.begin(), places.end(), 0);
  std::shuffle(places.begin(), places.end(), std::mt19937_64(1));
  places.resize(count);
  component.particles = picked_particles(component.particles, places);
  component.reference_column *= static_cast<double>(count) / static_cast<double>(all);
  return frame;
}

double root_mean_square(const Image& picture, const Image& exact) {
  double sum = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    const double error =
        static_cast<double>(picture.pixels[i]) - static_cast<double>(exact.pixels[i]);
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(exact.pixels.size()));
}

TEST_F(MergedDrawings, ErrLessThanAThirdOfWhatRandomPartsDoInPreviews) {
  const Matter matter = clumps(200000, 26);
  Frame frame = frame_of(matter, 80, 60);
  plant(frame, tree_of(matter));
  constexpr std::uint64_t splats = 20000;
  TreePreview preview;
  const std::optional<Frame> nodes = preview.of(frame, splats);
  ASSERT_TRUE(nodes);
  EXPECT_LE(particle_count(*nodes), splats);
  EXPECT_GE(particle_count(*nodes), splats / 3);
  const Image exact = draw(frame);
  EXPECT_LT(root_mean_square(draw(*nodes), exact),
            root_mean_square(draw(random_part(frame, splats)), exact) / 3);
}

// Over max(1, light), of the pixels of two pictures.
std::vector<double> differences(const Image& one, const Image& other) {
  std::vector<double> all;
  for (std::size_t i = 0; i < one.pixels.size(); ++i) {
    const double a = static_cast<double>(one.pixels[i]), b = static_cast<double>(other.pixels[i]);
    if (i % 4 != 3) all.push_back((b - a) / std::max(1.0, std::abs(a)));
  }
  return all;
}

// What nodes change from frame to frame beyond what particles do: where a cut changes nothing pops.
TEST_F(MergedDrawings, ChangeAlongAFlightAsParticlesDoWithinTheTolerance) {
  const Matter matter = clumps(100000, 27);
  const auto tree = tree_of(matter);
  Image last_nodes, last_particles;
  for (int number = 0; number < 12; ++number) {
    Frame frame = frame_of(matter, 40, 30);
    Camera camera;
    camera.position = {{0.5 + 0.01 * number, -1.6 + 0.02 * number, 0.7}};
    camera.look_at = {{0.5, 0.5, 0.5}};
    camera.field_of_view_degrees = 40;
    frame.camera = make_camera_frame(camera, frame.width, frame.height);
    plant(frame, tree);
    const Image particles = draw(frame);
    const auto nodes = draw_from_tree(frame);
    ASSERT_TRUE(nodes) << number;
    if (number > 0) {
      const auto of_nodes = differences(last_nodes, nodes->image);
      const auto of_particles = differences(last_particles, particles);
      for (std::size_t i = 0; i < of_nodes.size(); ++i)
        ASSERT_NEAR(of_nodes[i], of_particles[i], frame.tolerance) << "frame " << number;
    }
    last_nodes = nodes->image;
    last_particles = particles;
  }
}

TEST_F(MergedDrawings, AreNotBegunWhereTheyHaveToPayAndWouldNot) {
  const Matter matter = clumps(3000, 22);
  Frame frame = frame_of(matter, 40, 30);
  frame.tolerance = 1e-3;
  plant(frame, tree_of(matter));
  int drawings = 0;
  const auto count = [&drawings](const Frame& part) {
    ++drawings;
    return draw(part);
  };
  EXPECT_FALSE(draw_merged(frame, count, true));
  EXPECT_EQ(drawings, 0);
}

TEST(TreeCut, OpensAllToParticlesWhereNothingMayErr) {
  const Matter matter = clumps(3000, 23);
  Frame frame = frame_of(matter, 40, 30);
  frame.projection = Projection::fisheye;  // which shows all
  Camera camera;
  camera.position = {{0.5, -1.6, 0.7}};
  camera.look_at = {{0.5, 0.5, 0.5}};
  camera.projection = Projection::fisheye;
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  plant(frame, tree_of(matter));
  const TreeCut cut = cut_tree(frame, {0, {}, 2});
  EXPECT_EQ(cut.nodes, 0u);
  EXPECT_EQ(cut.particles, matter.count());
}

TEST(TreeCut, IsTheSameOnAnyNumberOfThreads) {
  const Matter matter = clumps(30000, 24);
  Frame frame = frame_of(matter, 40, 30);
  plant(frame, tree_of(matter));
  const TreeCut one = cut_tree(frame, {1e-3, {}, 2}), other = cut_tree(frame, {1e-3, {}, 2});
  ASSERT_EQ(one.nodes, other.nodes);
  for (std::size_t i = 0; i < one.nodes; ++i) {
    ASSERT_EQ(one.frame.components[0].particles.smoothing_length[i],
              other.frame.components[0].particles.smoothing_length[i]);
  }
}

// Else the squares that are verified would all lie at the picture's edges.
TEST(TreeCut, CountsNothingBesideTheCropAmongWhatErrsAlikeWithin) {
  const Matter matter = clumps(60000, 26);
  Frame whole = frame_of(matter, 96, 96);
  whole.tolerance = 1e-2;
  plant(whole, tree_of(matter));
  Frame part = whole;
  part.crop = {32, 32, 32, 32};
  const BlockErrors of_whole = cut_tree(whole, {1e-2, {}, 2}).alike;
  const BlockErrors of_part = cut_tree(part, {1e-2, {}, 2}).alike;
  for (const int y : {0, 16}) {
    for (const int x : {0, 16})
      EXPECT_LE(of_part.at(x, y), 1.5f * of_whole.at(x + 32, y + 32)) << x << ", " << y;
  }
}

TEST(TreeCut, ServesNoCutKernelNoFootprintNoLensAndNoGrayAbsorption) {
  const Matter matter = clumps(100, 25);
  Frame frame = frame_of(matter, 40, 30);
  EXPECT_FALSE(has_served_component(frame)) << "without a tree";
  plant(frame, tree_of(matter));
  EXPECT_TRUE(has_served_component(frame));
  Frame cut = frame, square = frame, gray = frame, blurred = frame;
  blurred.lens = {0.1, 1};
  cut.kernel.cut = 2;
  square.kernel.footprint_pixels = 0;
  gray.components.front().absorption = {Absorption::Kind::gray, 1};
  EXPECT_FALSE(has_served_component(cut));
  EXPECT_FALSE(has_served_component(square));
  EXPECT_FALSE(has_served_component(gray));
  EXPECT_FALSE(has_served_component(blurred));
}

}  // namespace
}  // namespace splotchcl::test
