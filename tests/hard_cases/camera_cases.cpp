// Cameras, positions and units that single precision finds hard.
#include <cmath>

#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"

namespace splotchcl::test {
namespace {

constexpr int width = 96, height = 64;

// Clouds in a ball of this radius around the origin, widths and columns relative to it.
DrawnComponent ball(double radius, int count, std::uint64_t seed = 41) {
  Random random(seed);
  std::vector<Cloud> clouds;
  while (static_cast<int>(clouds.size()) < count) {
    Cloud cloud;
    cloud.x = random.uniform(-1, 1);
    cloud.y = random.uniform(-1, 1);
    cloud.z = random.uniform(-1, 1);
    if (cloud.x * cloud.x + cloud.y * cloud.y + cloud.z * cloud.z > 1) continue;
    cloud.x *= radius;
    cloud.y *= radius;
    cloud.z *= radius;
    cloud.sigma = radius * random.logarithmic(0.005, 0.3);
    cloud.column = random.logarithmic(0.01, 1);
    clouds.push_back(cloud);
  }
  return in_random_colors(component_of(clouds, two_colors()));
}

// The camera's picture shows a ball of this radius around `centre` in full.
Camera camera_at(const Vec3& center, double radius, double field_of_view) {
  const double half_view = 0.5 * field_of_view * pi / 180;
  const double distance = 1.6 * radius / std::tan(half_view);
  // Any direction that is no axis.
  const Vec3 direction = {{0.48, -0.6, 0.64}};
  Camera camera;
  camera.look_at = center;
  camera.position = center + direction * distance;
  camera.sky = {{0.1, 1, 0.3}};
  camera.field_of_view_degrees = field_of_view;
  return camera;
}

Frame ball_seen_at(double field_of_view, LightPlan plan) {
  return lit(seen_by(camera_at({{0, 0, 0}}, 1, field_of_view), width, height, {ball(1, 400)}),
             plan);
}

Frame widest_view(LightPlan plan) {
  Camera camera;
  camera.look_at = {{0.3, 0.5, 0.8}};
  camera.field_of_view_degrees = 179;
  return lit(seen_by(camera, width, height, {ball(1, 3000)}), plan);
}

// An orthographic camera this many picture widths away.
Frame far_orthographic(double widths, LightPlan plan) {
  Camera camera = camera_at({{0, 0, 0}}, 1, 45);
  const double distance = 3.2 * widths;
  camera.position = Vec3{{0.48, -0.6, 0.64}} * distance;
  camera.field_of_view_degrees = 2 * std::atan(1.6 / distance) * 180 / pi;
  camera.projection = Projection::orthographic;
  return lit(seen_by(camera, width, height, {ball(1, 400)}), plan);
}

// Particles in, right before and behind the camera, some of them huge.
Frame around_the_camera(LightPlan plan) {
  Random random(43);
  std::vector<Cloud> clouds;
  for (const double z : {0.0, 1e-30, 1e-6, 1e-3, 0.01, 0.1, 1.0, -1e-30, -1e-6, -0.01, -1.0}) {
    for (const double sigma : {1e-6, 1e-3, 0.05, 1.0}) {
      for (int i = 0; i < 3; ++i) {
        const double x = i == 0 ? 0 : z * random.uniform(-0.4, 0.4);
        const double y = i == 0 ? 0 : z * random.uniform(-0.3, 0.3);
        clouds.push_back({x, y, z, sigma, 0.02});
      }
    }
  }
  Camera camera;
  camera.field_of_view_degrees = 60;
  return lit(seen_by(camera, width, height, {in_random_colors(component_of(clouds, two_colors()))}),
             plan);
}

Frame far_origin(LightPlan plan) {
  const Vec3 center = {{1e8, -2e8, 3e8}};
  DrawnComponent clouds = ball(1, 400);
  clouds.particles.origin = center;
  return lit(seen_by(camera_at(center, 1, 40), width, height, {clouds}), plan);
}

// The stored positions themselves lie around 1e8, where single precision has steps of 8.
Frame far_positions(LightPlan plan) {
  const Vec3 center = {{1e8, -2e8, 3e8}};
  DrawnComponent clouds = ball(1000, 400);
  std::vector<float> positions;
  for (std::size_t i = 0; i < 3 * clouds.particles.count; ++i) {
    positions.push_back(
        static_cast<float>(center.a[i % 3] + static_cast<double>(clouds.particles.position[i])));
  }
  clouds.particles.position = Column::owning(positions);
  return lit(seen_by(camera_at(center, 1000, 40), width, height, {clouds}), plan);
}

// A galaxy of 1e-6 of a box, with its positions stored from the box's corner or its own
// centre, and the rest of the box around it.
Frame galaxy_in_a_box(bool from_the_corner, LightPlan plan) {
  const Vec3 center = {{0.3, 0.61, 0.74}};
  DrawnComponent galaxy = ball(1e-6, 400);
  if (from_the_corner) {
    std::vector<float> positions;
    for (std::size_t i = 0; i < 3 * galaxy.particles.count; ++i) {
      positions.push_back(
          static_cast<float>(center.a[i % 3] + static_cast<double>(galaxy.particles.position[i])));
    }
    galaxy.particles.position = Column::owning(positions);
  } else {
    galaxy.particles.origin = center;
  }
  DrawnComponent box = ball(0.5, 300, 47);
  box.particles.origin = {{0.5, 0.5, 0.5}};
  box.brightness = 0.05;
  return lit(seen_by(camera_at(center, 1e-6, 45), width, height, {galaxy, box}), plan);
}

Frame sky_almost_parallel(LightPlan plan) {
  Camera camera = camera_at({{0, 0, 0}}, 1, 40);
  const Vec3 view = camera.look_at - camera.position;
  camera.sky = view + Vec3{{1e-7, 0, 0}};
  return lit(seen_by(camera, width, height, {ball(1, 400)}), plan);
}

// A cluster in centimetres and grams, as some snapshots store it: 1e23 cm and up to 3e38 g,
// seen through a telescope.
Frame in_centimetres(LightPlan plan) {
  constexpr double radius = 1e23, column = 1e-7;
  DrawnComponent cluster = ball(radius, 400);
  std::vector<float> masses;
  for (std::size_t i = 0; i < cluster.particles.count; ++i) {
    const double sigma = static_cast<double>(cluster.particles.smoothing_length[i]);
    masses.push_back(static_cast<float>(column * pi * sigma * sigma));
  }
  cluster.particles.weight = Column::owning(masses);
  cluster.reference_column = 4 * column;
  return lit(seen_by(camera_at({{0, 0, 0}}, radius, 5), width, height, {cluster}), plan);
}

}  // namespace

std::vector<HardCase> camera_cases() {
  return {
      {"ParticlesAroundTheCamera", "z of 0 and just above, discs of the whole sky",
       around_the_camera},
      {"OriginAt1e8", "coordinates of which single precision keeps no digit of the picture",
       far_origin},
      {"PositionsAt1e8", "the camera must be subtracted before anything is rounded", far_positions},
      {"GalaxyOf1e_6OfTheBox", "the camera lies far from the box's origin, relative to the galaxy",
       [](LightPlan plan) { return galaxy_in_a_box(false, plan); }},
      {"GalaxyOf1e_6FromTheCorner", "the same, with positions in steps of a few pixels",
       [](LightPlan plan) { return galaxy_in_a_box(true, plan); }},
      {"FieldOfView0_001Degrees",
       "the camera is 1e5 times as far as the picture is wide: offsets from it in single "
       "precision are pixels apart",
       [](LightPlan plan) { return ball_seen_at(0.001, plan); }},
      {"FieldOfView1Degree", "a telescope's view: the camera is 60 widths away",
       [](LightPlan plan) { return ball_seen_at(1, plan); }},
      {"FieldOfView179Degrees", "most particles lie almost in the camera's plane", widest_view},
      {"OrthographicFrom1e4Widths", "an orthographic camera may stand anywhere",
       [](LightPlan plan) { return far_orthographic(1e4, plan); }},
      {"SkyAlmostParallel", "the picture's upward direction is a difference of 1e-7",
       sky_almost_parallel},
      {"Centimetres", "masses near the largest float meet areas of 1e46 in one product",
       in_centimetres},
  };
}

}  // namespace splotchcl::test
