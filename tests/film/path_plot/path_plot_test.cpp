#include "film/path_plot/path_plot.h"

#include <boost/qvm/vec_operations.hpp>

#include "film/path_plot/plot_panel.h"
#include "testing.h"

namespace splotchcl {
namespace {

void add_ball(std::vector<Vec3>& particles, const Vec3& center, int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1);
  for (int i = 0; i < count; ++i)
    particles.push_back(center + Vec3{{normal(random), normal(random), normal(random)}});
}

TEST(DensestCells, AreWhereParticlesCrowdTheFullestFirst) {
  std::vector<Vec3> particles;
  add_ball(particles, {{0, 0, 0}}, 1000);
  add_ball(particles, {{100, 0, 0}}, 3000);
  add_ball(particles, {{0, 100, 50}}, 2000);
  const std::vector<DenseCell> cells = densest_cells(particles, 3);
  ASSERT_EQ(cells.size(), 3U);
  const Vec3 expected[] = {{{100, 0, 0}}, {{0, 100, 50}}, {{0, 0, 0}}};
  for (int i = 0; i < 3; ++i) {
    const DenseCell& cell = cells[static_cast<std::size_t>(i)];
    EXPECT_LT(boost::qvm::mag(cell.center - expected[i]), 0.1 * cell.size);
  }
}

TEST(DensestCells, AreNotPeaksOfAFewParticles) {
  std::vector<Vec3> particles;
  add_ball(particles, {{0, 0, 0}}, 3000);
  add_ball(particles, {{100, 0, 0}}, 3000);
  add_ball(particles, {{50, 30, 0}}, 10);
  add_ball(particles, {{50, -30, 10}}, 15);
  EXPECT_EQ(densest_cells(particles, 8).size(), 2U);
}

TEST(DensestCells, OfNoParticlesAreNone) {
  EXPECT_TRUE(densest_cells({}, 5).empty());
}

TEST(DensestCells, OfParticlesInOnePlaceAreOne) {
  EXPECT_EQ(densest_cells(std::vector<Vec3>(10, Vec3{{1, 2, 3}}), 5).size(), 1U);
}

TEST(PlotPanel, ShowsTwoAxesWithTheVerticalUpwards) {
  Image image(100, 100);
  const PlotPanel panel(image, {10, 20, 60, 60}, 0, 2, {{5, 6, 7}}, 3);
  const PlotPoint center = panel.place({{5, -100, 7}});
  EXPECT_EQ(center.x, 40);
  EXPECT_EQ(center.y, 50);
  const PlotPoint point = panel.place({{7, 0, 11}});
  EXPECT_EQ(point.x, 46);
  EXPECT_EQ(point.y, 38);
}

TEST(PlotPanel, DrawsLinesWithTheirWidthAndNothingOutside) {
  Image image(40, 40);
  PlotPanel panel(image, {10, 10, 20, 20}, 0, 1, {{0, 0, 0}}, 1);
  panel.line({-50, 20.25}, {50, 20.25}, 2.5, {1, 1, 1});
  double column = 0;
  for (int y = 0; y < 40; ++y) {
    column += static_cast<double>(image.at(20, y)[0]);
    EXPECT_EQ(image.at(9, y)[0], 0);
    EXPECT_EQ(image.at(30, y)[0], 0);
  }
  EXPECT_NEAR(column, 2.5, 0.3);  // a ramp of a pixel at either edge
}

// A camera at a corner of the particles' square, seen from both sides.
TEST(PathPlot, ShowsTheCameraInBothProjections) {
  PathPlot plot;
  Camera camera;
  camera.position = {{0, 10, -10}};
  camera.look_at = {{0, 0, 0}};
  camera.sky = {{1, 0, 0}};
  plot.cameras = {make_camera_frame(camera, 10, 10)};
  plot.look_at = {camera.look_at};
  plot.sky = {camera.sky};
  plot.half_angles = {0.3};
  plot.particles = {{{-10, -10, -10}}, {{10, 10, 10}}};
  const Image image = draw_path_plot(plot);
  // Half of the plot belongs to each projection. In x-y the camera is in the upper half, in
  // x-z in the lower one; its blue dot is the bluest thing there.
  const auto is_blue = [&](int x, int y) {
    const float* const pixel = image.at(x, y);
    return pixel[2] > 0.95F && pixel[0] < 0.3F && pixel[1] < 0.5F;
  };
  int above = 0, below = 0;
  for (int y = 0; y < 820; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!is_blue(x, y)) continue;
      const bool is_left = x < image.width / 2;
      (y < 424 ? above : below) += 1;
      EXPECT_EQ(is_left, y < 424) << x << ' ' << y;
    }
  }
  EXPECT_GT(above, 20);
  EXPECT_GT(below, 20);
}

int count_pixels(const Image& image, float red, float green, float blue) {
  int count = 0;
  for (int y = 0; y < 820; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* const pixel = image.at(x, y);
      const bool is_it = std::abs(pixel[0] - red) < 0.05F && std::abs(pixel[1] - green) < 0.05F &&
                         std::abs(pixel[2] - blue) < 0.05F;
      count += is_it ? 1 : 0;
    }
  }
  return count;
}

// Right is orange, the second eye and what it sees pink.
TEST(PathPlot, ShowsRightVectorsAndTheSecondEyesView) {
  PathPlot plot;
  Camera camera;
  camera.position = {{0, 0, 10}};
  camera.look_at = {{0, 0, 0}};
  camera.sky = {{0, 1, 0}};
  plot.cameras = {make_camera_frame(camera, 10, 10)};
  plot.look_at = {camera.look_at};
  plot.sky = {camera.sky};
  plot.half_angles = {0.3};
  plot.particles = {{{-10, -10, -10}}, {{10, 10, 10}}};
  const Image one = draw_path_plot(plot);
  EXPECT_GT(count_pixels(one, 1, 0.6F, 0.25F), 40);
  EXPECT_EQ(count_pixels(one, 0.95F, 0.4F, 0.95F), 0);
  plot.second_eyes = {{{{3, 0, 10}}, {{-0.6, 0, -0.8}}, {{0, 0, -1}}}};
  EXPECT_GT(count_pixels(draw_path_plot(plot), 0.95F, 0.4F, 0.95F), 10);
}

}  // namespace
}  // namespace splotchcl
