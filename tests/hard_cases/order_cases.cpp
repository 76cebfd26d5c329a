// Depths and keys that sorting may get wrong.
#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr int side = 64;

std::vector<Cloud> overlapping_clouds(int count) {
  Random random(21);
  std::vector<Cloud> clouds;
  for (int i = 0; i < count; ++i) {
    Cloud cloud;
    cloud.x = random.uniform(-0.4, 0.4) * side;
    cloud.y = random.uniform(-0.4, 0.4) * side;
    cloud.z = random.uniform(1, 100);
    cloud.sigma = random.logarithmic(1, 8);
    cloud.column = random.logarithmic(0.1, 2);
    clouds.push_back(cloud);
  }
  return clouds;
}

Frame frame_of_clouds(const std::vector<Cloud>& clouds, LightPlan plan) {
  return lit(frame_of(side, side, {in_random_colors(component_of(clouds, two_colors()))}), plan);
}

Frame equal_depths(LightPlan plan) {
  std::vector<Cloud> clouds = overlapping_clouds(2000);
  for (Cloud& cloud : clouds)
    cloud.z = 7;
  return frame_of_clouds(clouds, plan);
}

template <class Compare>
Frame ordered_input(Compare compare, LightPlan plan) {
  std::vector<Cloud> clouds = overlapping_clouds(2000);
  std::sort(clouds.begin(), clouds.end(),
            [compare](const Cloud& a, const Cloud& b) { return compare(a.z, b.z); });
  return frame_of_clouds(clouds, plan);
}

// `count` clouds of this width and column at one point.
Frame coincident(int count, double sigma, double column, LightPlan plan) {
  const std::vector<Cloud> clouds(static_cast<std::size_t>(count),
                                  Cloud{0.3, -0.4, 5, sigma, column});
  return frame_of_clouds(clouds, plan);
}

HardCase coincident_clouds(const std::string& name, int count, double sigma, double column,
                           Drawn in_groups = Drawn::always) {
  HardCase hard;
  hard.name = name;
  hard.why = "every disc ends at the same distance, where each is negligible and the sum is not";
  hard.in_groups = in_groups;
  hard.frame = [=](LightPlan plan) { return coincident(count, sigma, column, plan); };
  return hard;
}

// Sort keys of every awkward kind, far more often equal than not.
Frame awkward_keys(bool descending) {
  constexpr float denormal = std::numeric_limits<float>::denorm_min();
  constexpr float huge = std::numeric_limits<float>::max();
  constexpr float smallest = std::numeric_limits<float>::min();
  const std::vector<float> awkward = {-0.0f,    0.0f,      denormal, -denormal, 1e-40f, -1e-40f,
                                      smallest, -smallest, huge,     -huge,     1.0f,   -1.0f};
  DrawnComponent clouds = in_random_colors(component_of(overlapping_clouds(600), two_colors()));
  std::vector<float> keys;
  Random random(3);
  for (std::size_t i = 0; i < clouds.particles.count; ++i) {
    keys.push_back(awkward[static_cast<std::size_t>(random.uniform(0, 12))]);
  }
  clouds.particles.sort_field = Column::owning(keys);
  Frame frame = lit(frame_of(side, side, {clouds}), LightPlan::ordered);
  frame.sort = {SortOrder::By::field, "key", descending};
  return frame;
}

// Depths of -0, +0 and denormals straight in front of an orthographic camera.
Frame awkward_depths(LightPlan plan) {
  const std::vector<double> awkward = {-0.0, 0.0, 1e-45, 1e-40, 1.2e-38, 3e38, 1e-30, 1};
  std::vector<Cloud> clouds = overlapping_clouds(600);
  for (std::size_t i = 0; i < clouds.size(); ++i)
    clouds[i].z = awkward[i * 7 % awkward.size()];
  return frame_of_clouds(clouds, plan);
}

// The clouds of few depths in any order in the file: those of equal depth stay in that order.
Frame shuffled_ties(LightPlan plan) {
  std::vector<Cloud> clouds = overlapping_clouds(2000);
  Random random(5);
  for (Cloud& cloud : clouds)
    cloud.z = std::floor(random.uniform(1, 20));
  return frame_of_clouds(clouds, plan);
}

// A camera that looks along +z at `origin` from this distance; widths and positions are relative.
Frame seen_from_afar(const Vec3& origin, double distance, DrawnComponent clouds, LightPlan plan) {
  Camera camera;
  camera.look_at = origin;
  camera.position = {{origin.a[0], origin.a[1], origin.a[2] - distance}};
  camera.sky = {{0, -1, 0}};
  // A length of 1 at the look-at point is a pixel.
  camera.field_of_view_degrees = 2 * std::atan(0.5 * side / distance) * 180 / pi;
  clouds.particles.origin = origin;
  return lit(seen_by(camera, side, side, {clouds}), plan);
}

// Clouds 1e-8 of their distance apart, the farthest first in the file.
Frame depths_beyond_floats(LightPlan plan) {
  std::vector<Cloud> clouds = overlapping_clouds(600);
  for (std::size_t i = 0; i < clouds.size(); ++i)
    clouds[i].z = 1e-3 * static_cast<double>(clouds.size() - i);
  return seen_from_afar({{3e4, 2e4, 1e4}}, 1e5,
                        in_random_colors(component_of(clouds, two_colors())), plan);
}

// The same picture, ordered by places in the file.
ReferenceImage last_in_front(Frame frame) {
  Particles& particles = frame.components.front().particles;
  std::vector<float> places;
  for (std::size_t i = 0; i < particles.count; ++i)
    places.push_back(static_cast<float>(i));
  particles.sort_field = Column::owning(places);
  frame.sort = {SortOrder::By::field, "place", true};
  return reference::render(frame);
}

HardCase depths_beyond_floats() {
  HardCase hard;
  hard.name = "DepthsBeyondFloats";
  hard.why = "single precision takes clouds 0.001 apart, 1e5 away, for equally far";
  hard.frame = [](LightPlan plan) { return depths_beyond_floats(plan); };
  hard.exact = last_in_front;
  return hard;
}

// Clouds at the near limit, some of them a rounding nearer.
Frame depths_at_the_near_limit(LightPlan plan) {
  std::vector<Cloud> clouds = overlapping_clouds(600);
  Random random(6);
  for (Cloud& cloud : clouds)
    cloud.z = 300 * (1 + 1e-7 * std::floor(random.uniform(-3, 4)));
  Frame frame = seen_from_afar({{3e4, 2e4, 1e4}}, 1e3,
                               in_random_colors(component_of(clouds, two_colors())), plan);
  frame.near_limit = 1300;
  return frame;
}

}  // namespace

std::vector<HardCase> order_cases() {
  const std::vector<LightPlan> ordered = {LightPlan::ordered};
  return {
      {"EqualDepths", "only a stable sort keeps the file's order", equal_depths},
      {"ShuffledTies", "equal depths lie all over the file, which decides their order",
       shuffled_ties},
      {"SortedInput", "every block of the sort meets few digits",
       [](LightPlan plan) { return ordered_input(std::less<>(), plan); }},
      {"ReversedInput", "every particle moves as far as it can",
       [](LightPlan plan) { return ordered_input(std::greater<>(), plan); }},
      {"CoincidentGrains", "all light falls on one pixel and none may leak or be lost",
       [](LightPlan plan) { return coincident(2000, 0.2, 0.05, plan); }},
      coincident_clouds("CoincidentClouds", 2000, 5, 0.2),
      coincident_clouds("CoincidentFaintClouds", 20000, 5, 0.01, Drawn::in_long_tests),
      coincident_clouds("FewerCoincidentFaintClouds", 2000, 5, 0.01),
      coincident_clouds("CoincidentWideClouds", 2000, 12, 0.2),
      {"AwkwardKeys", "-0 equals +0, denormals and huge keys keep their places",
       [](LightPlan) { return awkward_keys(false); }, ordered},
      {"AwkwardKeysDescending", "the same, the largest in front",
       [](LightPlan) { return awkward_keys(true); }, ordered},
      {"AwkwardDepths", "depths of -0, +0 and denormals are in front of the camera",
       awkward_depths},
      depths_beyond_floats(),
      {"DepthsAtTheNearLimit", "single precision cannot tell on which side of the limit clouds are",
       depths_at_the_near_limit},
  };
}

}  // namespace splotchcl::test
