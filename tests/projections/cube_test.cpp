// Six faces of a cube against closed forms and each other.
#include "splotchcl/cube.h"

#include "projections/wide_frames.h"
#include "testing.h"

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

// What the faces front and right show of a cloud in the directions of the edge between them. Moved
// by half a pixel, the last column of the one and the first of the other have their centers there.
struct LightOnEdge {
  std::vector<double> front, right;
  double brightest = 0;
};

LightOnEdge light_on_edge(const DrawnComponent& component, int size) {
  Frame front = wide_frame({Projection::cube, size, size}, {component});
  Frame right = front;
  for (const CubeFace& face : cube_faces(front.camera)) {
    if (face.name == std::string("right")) right.camera = face.camera;
  }
  front.camera.center_x -= 0.5;
  right.camera.center_x += 0.5;
  LightOnEdge light;
  const ReferenceImage left_side = reference::render(front), right_side = reference::render(right);
  for (int y = 0; y < size; ++y) {
    light.front.push_back(red_of(left_side, size - 1, y));
    light.right.push_back(red_of(right_side, 0, y));
    light.brightest = std::max(light.brightest, light.front.back());
  }
  return light;
}

// Clouds off the edge, along it and beside it, of this width, each by itself.
double largest_difference_on_edge(double sigma, int size) {
  double largest = 0;
  for (const double height : {0.0, 0.35, 0.7, 0.95}) {
    for (const double beside : {-1.5, -0.7, -0.2, 0.4, 1.1}) {
      const Vec3 direction = {{1 + beside * sigma, height, 1 - beside * sigma}};
      const LightOnEdge light =
          light_on_edge(white_light({cloud_towards(direction, 2, sigma)}), size);
      EXPECT_GT(light.brightest, 0);
      for (std::size_t y = 0; y < light.front.size(); ++y)
        largest = std::max(largest, std::abs(light.front[y] - light.right[y]));
    }
  }
  return largest;
}

// Around the camera, and farther away: what rays find, the same from either face.
TEST(Cube, FacesAgreeOnWideClouds) {
  for (const double sigma : {0.5, 0.2, 0.1, 0.084})
    EXPECT_LT(largest_difference_on_edge(sigma, 64), 1e-9) << sigma;
}

// On the edge pixels of both faces have the same footprint.
TEST(Cube, FacesAgreeOnNarrowClouds) {
  constexpr int size = 128;
  for (const double pixels : {5.0, 3.0, 1.5, 0.7, 0.1}) {
    const double sigma = pixels / (0.5 * size);
    EXPECT_LT(largest_difference_on_edge(sigma, size), 1e-9) << pixels << " pixels";
  }
}

TEST(Cube, CloudsKeepTheirLightWhateverTheirWidth) {
  constexpr int size = 80;
  for (const double sigma : {1e-4, 3e-3, 0.01, 0.03, 0.06}) {
    for (const double tangent : {0.0, 0.45, 0.6}) {
      const Frame frame =
          wide_frame({Projection::cube, size, size},
                     {white_light({cloud_towards({{tangent, 0.31, 1}}, 2, sigma)})});
      const ReferenceImage image = reference::render(frame);
      double light = 0;
      for (std::size_t pixel = 0; pixel < image.pixels.size(); pixel += 4)
        light += image.pixels[pixel];
      const double focal = 0.5 * size, secant = std::sqrt(1 + tangent * tangent + 0.31 * 0.31);
      // A solid angle of a face is its area times the cube of the secant; wide clouds reach where
      // that is larger.
      const double expected = pi * std::pow(focal * sigma, 2) * std::pow(secant, 3);
      EXPECT_NEAR(light / expected, 1, 0.003 + 6 * sigma * sigma) << sigma << " at " << tangent;
    }
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
