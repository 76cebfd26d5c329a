// Pictures in all directions with small tolerances: single precision places their clouds a
// rounding of the direction beside where they are, near poles and behind a dome much more.
#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"
#include "scene/projection.h"
#include "splotchcl/cube.h"
#include "splotchcl/stereo.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr double tolerance = 1e-5;

// A camera that looks along no axis, with an origin near it.
Frame looking_around(Projection projection, int width, int height,
                     std::optional<double> field_of_view = std::nullopt) {
  Camera camera;
  camera.position = {{0.3, -0.2, 0.5}};
  camera.look_at = camera.position + Vec3{{0.48, -0.6, 0.64}};
  camera.sky = {{0.1, 1, 0.3}};
  camera.projection = projection;
  camera.field_of_view_degrees = field_of_view;
  Frame frame = seen_by(camera, width, height, {});
  frame.tolerance = tolerance;
  return frame;
}

Frame panorama() {
  return looking_around(Projection::equirectangular, 128, 64);
}

Frame dome(double field_of_view) {
  return looking_around(Projection::fisheye, 80, 80, field_of_view);
}

Frame seen_from_the_right(Frame frame) {
  Stereo stereo;
  stereo.angle_degrees = 12;
  frame.camera = eye_camera(frame.camera, frame.projection, stereo, Eye::right);
  return frame;
}

// `direction`: along the camera's right, down and forward axes; sigma in pixels where the
// picture is not stretched.
Cloud cloud_in(const Frame& frame, const Vec3& direction, double distance, double sigma,
               double column) {
  const CameraFrame& camera = frame.camera;
  const double size = std::hypot(direction.a[0], direction.a[1], direction.a[2]);
  const Vec3 at = camera.position + (camera.right * direction.a[0] + camera.down * direction.a[1] +
                                     camera.forward * direction.a[2]) *
                                        (distance / size);
  return {at.a[0], at.a[1], at.a[2], distance * sigma / camera.focal_pixels, column};
}

// 300 stars and clouds, each in a direction of its own.
Frame with_clouds(Frame frame, LightPlan plan, const std::function<Vec3(Random&)>& direction) {
  Random random(61);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 300; ++i) {
    const bool is_star = i % 3 == 0;
    const double sigma = is_star ? random.logarithmic(0.3, 2) : random.logarithmic(1, 20);
    const double column = is_star ? random.logarithmic(1, 100) : random.logarithmic(0.01, 1);
    clouds.push_back(cloud_in(frame, direction(random), random.uniform(0.5, 4), sigma, column));
  }
  frame.components = {in_random_colors(component_of(clouds, two_colors()))};
  return lit(frame, plan);
}

Vec3 any_direction(Random& random) {
  return {{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
}

Vec3 at_longitude(double longitude, double latitude) {
  return {{std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
           std::cos(latitude) * std::cos(longitude)}};
}

Vec3 near_a_pole(Random& random) {
  const double latitude = 0.5 * pi - random.logarithmic(1e-6, 0.3);
  return at_longitude(random.uniform(-pi, pi), random.uniform() < 0.5 ? latitude : -latitude);
}

Vec3 near_the_seam(Random& random) {
  return at_longitude(pi + random.uniform(-0.1, 0.1), random.uniform(-1.2, 1.2));
}

Vec3 behind(Random& random) {
  const double angle = pi - random.logarithmic(1e-5, 1), around = random.uniform(-pi, pi);
  return {
      {std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)}};
}

// On the edges of all faces, and around the planes in which a face ends.
Vec3 on_an_edge(Random& random) {
  const double step = 1 + random.uniform(-0.05, 0.05);
  const double along = random.uniform(-1, 1);
  const Vec3 edges[] = {{{1, along, step}},    {{-step, along, 1}}, {{along, step, -1}},
                        {{along, -1, step}},   {{1, along, 0.01}},  {{step, 1, along}},
                        {{-1, -step, -along}}, {{along, 1, 1e-6}}};
  return edges[static_cast<std::size_t>(random.uniform(0, 8))];
}

Frame face(std::size_t face) {
  Frame frame = looking_around(Projection::cube, 64, 64);
  frame.camera = cube_faces(frame.camera)[face].camera;
  return frame;
}

// Their light, not their peak, is what a pixel shows of them.
Frame stars_beside_a_face(LightPlan plan, std::optional<double> cut) {
  Frame frame = face(0);
  frame.tolerance = 1e-3;
  frame.kernel.cut = cut;
  Random random(83);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 200; ++i) {
    const double across = (i % 2 == 0 ? 1 : -1) * (1 + random.uniform(0.01, 0.12));
    const Vec3 direction = {{across, random.uniform(-0.9, 0.9), 1}};
    const double sigma = random.logarithmic(0.1, 0.6), light = random.logarithmic(0.3, 20);
    const double column = light * std::max(1.0, 1 / (pi * sigma * sigma));
    clouds.push_back(cloud_in(frame, direction, 1, sigma, column));
  }
  frame.components = {component_of(clouds, one_color(1, 1, 1))};
  return lit(frame, plan);
}

// As narrow as a cloud around the camera can be, and far from all pixels whose numbers are
// multiples of 8.
Frame narrow_cloud_around(LightPlan plan) {
  constexpr double place = 136.5, widths = 11;
  Frame frame = looking_around(Projection::fisheye, 256, 256, 360);
  frame.through_clouds = true;
  const Vec3 direction = direction_at(place, place, frame.camera, frame.projection);
  frame.components = {
      component_of({cloud_in(frame, direction, 1, frame.camera.focal_pixels / widths, 0.4)},
                   one_color(1, 1, 1))};
  return lit(frame, plan);
}

// A disc of two pixels of a cloud that is a hundred wide, between the nodes of what is smooth.
Frame small_disc_around(LightPlan plan) {
  Camera camera;
  camera.field_of_view_degrees = 60;
  camera.sky = {{0, -1, 0}};
  camera.look_at = {{0, 0, 1}};
  Frame frame = seen_by(camera, 512, 512,
                        {component_of({{-0.5113, -0.9270, 11.4512, 1, 1}}, one_color(1, 1, 1))});
  frame.through_clouds = true;
  frame.kernel.cut = 0.05;
  return lit(frame, plan);
}

// A crop of a panorama of 16384 x 8192 around this place, with clouds there only.
Frame part_of_a_large_panorama(int x, int y, LightPlan plan) {
  Frame frame = looking_around(Projection::equirectangular, 16384, 8192);
  frame.crop = {x, y, 96, 64};
  return with_clouds(frame, plan, [&](Random& random) {
    const double focal = frame.camera.focal_pixels;
    return at_longitude((x + random.uniform(-20, 116) - frame.camera.center_x) / focal,
                        (frame.camera.center_y - y - random.uniform(-20, 84)) / focal);
  });
}

// Camera and clouds lie around 1e8 lengths from the coordinates' origin.
Frame far_panorama(LightPlan plan) {
  const Vec3 far = {{1e8, -2e8, 3e8}};
  Frame frame = with_clouds(panorama(), plan, any_direction);
  frame.camera.position = frame.camera.position + far;
  frame.components.front().particles.origin = far;
  return frame;
}

HardCase in_view(const std::string& name, const std::string& why, const Frame& view,
                 const std::function<Vec3(Random&)>& direction) {
  return {name, why, [=](LightPlan plan) { return with_clouds(view, plan, direction); }};
}

}  // namespace

std::vector<HardCase> wide_angle_cases() {
  return {
      in_view("Dome", "bright stars a rounding beside their place", dome(180), any_direction),
      in_view("DomeOf360Degrees", "the point behind the camera becomes the rim", dome(360), behind),
      in_view("DomeFromTheRight", "each direction is turned", seen_from_the_right(dome(200)),
              any_direction),
      in_view("Panorama", "an angle, not a ratio", panorama(), any_direction),
      in_view("PanoramaAtThePoles", "longitudes are magnified, widths leave the picture",
              panorama(), near_a_pole),
      in_view("PanoramaAtTheSeam", "copies on both sides meet", panorama(), near_the_seam),
      in_view("PanoramaFromTheRight", "each direction is turned", seen_from_the_right(panorama()),
              any_direction),
      {"PanoramaAt1e8", "coordinates of which single precision keeps no digit", far_panorama},
      {"PartOfAPanoramaOf16384", "pixel coordinates of 16384 have steps of 0.001",
       [](LightPlan plan) { return part_of_a_large_panorama(9000, 3000, plan); }},
      {"PartOfAPanoramaAtAPole", "the same, with steps of radians near the pole",
       [](LightPlan plan) { return part_of_a_large_panorama(0, 0, plan); }},
      in_view("FaceOfACube", "every cloud in one of six pictures", face(0), any_direction),
      in_view("EdgesOfACube", "clouds on the edges are in two or three", face(2), on_an_edge),
      {"StarsBesideAFaceOfACube", "they are wider along x than along y",
       [](LightPlan plan) { return stars_beside_a_face(plan, std::nullopt); }},
      {"DiscsBesideAFaceOfACube", "what is cut off ends sharply",
       [](LightPlan plan) { return stars_beside_a_face(plan, 1.5); }},
      {"NarrowCloudAround", "what is smooth is worked out at few pixels", narrow_cloud_around},
      {"SmallDiscAround", "where the kernel is cut, nothing is smooth", small_disc_around},
      in_view("FaceOfACubeFromTheRight", "each direction is turned", seen_from_the_right(face(1)),
              any_direction),
  };
}

}  // namespace splotchcl::test
