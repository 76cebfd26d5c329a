// Six faces of a cube against closed forms and each other.
#include "splotchcl/cube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "projections/wide_frames.h"
#include "splotchcl/error.h"

namespace splotchcl::test {
namespace {

constexpr int side = 40;

std::map<std::string, Frame> faces_of(const DrawnComponent& component) {
  const Frame front = wide_frame({Projection::cube, side, side}, {component});
  std::map<std::string, Frame> frames;
  for (const CubeFace& face : cube_faces(front.camera)) {
    frames[face.name] = front;
    frames[face.name].camera = face.camera;
  }
  return frames;
}

TEST(Cube, FacesLookInSixDirections) {
  const Vec3 directions[] = {{{0, 0, 1}},  {{1, 0, 0}},  {{0, 0, -1}},
                             {{-1, 0, 0}}, {{0, -1, 0}}, {{0, 1, 0}}};
  const char* names[] = {"front", "right", "back", "left", "up", "down"};
  for (int i = 0; i < 6; ++i) {
    const auto faces = faces_of(white_light({cloud_towards(directions[i], 2, 0.01)}));
    const reference::Splat splat = only_splat(faces.at(names[i]));
    EXPECT_NEAR(splat.x, 0.5 * side, 1e-4) << names[i];
    EXPECT_NEAR(splat.y, 0.5 * side, 1e-4) << names[i];
  }
}

TEST(Cube, FacesHaveTheTangentsOfPerspective) {
  const auto faces = faces_of(white_light({cloud_towards({{0.3, -0.2, 1}}, 2, 0.01)}));
  const reference::Splat splat = only_splat(faces.at("front"));
  EXPECT_NEAR(splat.x, 0.5 * side * 1.3, 1e-4);
  EXPECT_NEAR(splat.y, 0.5 * side * 0.8, 1e-4);
}

// Every edge by a cloud on it, which must show the same pixels on both of its sides.
TEST(Cube, EdgesContinueInTheNextFace) {
  struct Edge {
    Vec3 direction;
    const char *a, *b;
  };
  const Edge edges[] = {
      {{{1, 0.3, 1}}, "front", "right"}, {{{1, 0.3, -1}}, "right", "back"},
      {{{-1, 0.3, -1}}, "back", "left"}, {{{-1, 0.3, 1}}, "left", "front"},
      {{{0.3, -1, 1}}, "front", "up"},   {{{0.3, 1, 1}}, "front", "down"},
      {{{1, -1, 0.3}}, "right", "up"},   {{{-1, 1, 0.3}}, "left", "down"},
      {{{0.3, -1, -1}}, "back", "up"},   {{{0.3, 1, -1}}, "back", "down"},
  };
  for (const Edge& edge : edges) {
    const auto faces = faces_of(white_light({cloud_towards(edge.direction, 2, 0.1)}));
    double light[2] = {}, brightest[2] = {};
    const char* names[] = {edge.a, edge.b};
    for (int i = 0; i < 2; ++i) {
      const ReferenceImage image = reference::render(faces.at(names[i]));
      for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += 4) {
        light[i] += image.pixels[pixel];
        brightest[i] = std::max(brightest[i], image.pixels[pixel]);
      }
    }
    EXPECT_GT(light[0], 1) << edge.a << " and " << edge.b;
    EXPECT_NEAR(light[0], light[1], 1e-5 * light[0]) << edge.a << " and " << edge.b;
    EXPECT_NEAR(brightest[0], brightest[1], 1e-5) << edge.a << " and " << edge.b;
  }
}

TEST(Cube, CloudsHaveOneDepthInAllFaces) {
  const auto faces = faces_of(white_light({cloud_towards({{0.9, 0.4, 1}}, 2, 0.05)}));
  const reference::Splat front = only_splat(faces.at("front"));
  for (const char* name : {"right", "down"}) {
    const reference::Splat other = only_splat(faces.at(name));
    EXPECT_EQ(other.key, front.key);
  }
}

TEST(Cube, ShowsAnEvenSkyEvenly) {
  for (const auto& [name, frame] : faces_of(even_sky(8000, 0.05))) {
    const ReferenceImage image = reference::render(frame);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x)
        EXPECT_NEAR(red_of(image, x, y), 1, 0.06) << name << ": " << x << ", " << y;
    }
  }
}

TEST(Cube, FacesAreSquareAndOf90Degrees) {
  EXPECT_THROW(wide_frame({Projection::cube, 40, 30}, {}), UsageError);
  EXPECT_THROW(wide_frame({Projection::cube, 40, 40, 60.0}, {}), UsageError);
  EXPECT_NO_THROW(wide_frame({Projection::cube, 40, 40, 90.0}, {}));
}

}  // namespace
}  // namespace splotchcl::test
