// Flights through clouds are continuous: the picture changes by as much as the camera moves, in
// steps of any length, and nothing pops.
#include "device/pictures.h"
#include "frames/random_frames.h"
#include "splotchcl/load.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Frame moved(Frame frame, const Vec3& start, const Vec3& along, double way) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    frame.camera.position.a[axis] = start.a[axis] + way * along.a[axis];
  return frame;
}

// A star cluster around the origin: many stars of one softening length, denser in the middle.
std::vector<Cloud> cluster(int count, double sigma) {
  Random random(3);
  std::vector<Cloud> clouds;
  for (int i = 0; i < count; ++i) {
    const double radius = random.logarithmic(0.05, 3);
    const Vec3 direction = {{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}};
    clouds.push_back(cloud_towards(direction, radius, sigma / radius, 0.05));
  }
  return clouds;
}

class Flights : public PictureTest {
 protected:
  // The pictures of a flight in so many steps, and that of its start.
  static std::vector<Image> pictures(const Frame& frame, const Vec3& start, const Vec3& along,
                                     double length, int steps) {
    std::vector<Image> images;
    for (int i = 0; i <= steps; ++i)
      images.push_back(draw(moved(frame, start, along, length * i / steps)));
    return images;
  }

  // The largest change from one to the next of every `stride`-th picture, over max(1, light).
  static double largest_change(const std::vector<Image>& images, std::size_t stride) {
    double largest = 0;
    for (std::size_t i = stride; i < images.size(); i += stride)
      largest = std::max(largest, largest_difference(images[i], images[i - stride]));
    return largest;
  }

  // What the picture changes by per length is found from the longest steps, with a quarter more for
  // what shorter ones find between them.
  static void expect_continuous(const Frame& frame, const Vec3& start, const Vec3& along,
                                double length, int steps, const std::string& what) {
    const std::vector<Image> images = pictures(frame, start, along, length, 4 * steps);
    const double noise = 2 * frame.tolerance;
    const double per_step = 1.25 * largest_change(images, 4);
    EXPECT_GT(per_step, 2 * noise) << "there must be something to see: " << what;
    EXPECT_LE(largest_change(images, 2), per_step / 2 + noise) << what;
    EXPECT_LE(largest_change(images, 1), per_step / 4 + noise) << what;
  }
};

Frame frame_of_flight(Projection projection, const std::vector<DrawnComponent>& components,
                      int side = 24) {
  WideCamera camera;
  camera.projection = projection;
  camera.width = camera.height = side;
  if (projection == Projection::equirectangular) camera.height = side / 2;
  Frame frame = wide_frame(camera, components);
  frame.through_clouds = true;
  return frame;
}

constexpr Projection projections[] = {Projection::perspective, Projection::fisheye,
                                      Projection::equirectangular, Projection::cube};

TEST_F(Flights, ThroughOneCloudAreContinuous) {
  for (const Projection projection : projections) {
    const Frame frame = frame_of_flight(projection, {white_light({{0.1, 0.05, 0, 1, 1}})});
    expect_continuous(frame, {{0, 0, -14}}, {{0, 0, 1}}, 17, 60,
                      "projection " + std::to_string(static_cast<int>(projection)));
  }
}

// Where today's splats are left out at a tenth of their smoothing length.
TEST_F(Flights, PopWithSplatsAlone) {
  Frame frame = frame_of_flight(Projection::perspective, {white_light({{0.1, 0.05, 0, 1, 1}})});
  frame.through_clouds = false;
  const std::vector<Image> images = pictures(frame, {{0, 0, -14}}, {{0, 0, 1}}, 17, 240);
  EXPECT_GT(largest_change(images, 1), 0.7 * largest_change(images, 4));
}

TEST_F(Flights, ThroughAStarClusterAreContinuous) {
  const Frame frame = frame_of_flight(Projection::perspective, {white_light(cluster(400, 0.1))});
  expect_continuous(frame, {{0, 0, -2}}, {{0, 0, 1}}, 2.5, 100, "cluster");
}

// A component of the real run, as a scene that names nothing draws it.
std::optional<DrawnComponent> gas_of_a_universe() {
  const std::filesystem::path path = data_folder() / "lcdm/fmt2_snapshot_006";
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::unique_ptr<Snapshot> snapshot = open_snapshot(path);
  std::vector<std::string> notes;
  return load_frame(suggest_scene(*snapshot), *snapshot, notes).components.front();
}

// Past the middle of its densest halo, in which the camera stands in hundreds of clouds.
TEST_F(Flights, ThroughAUniverseAreContinuous) {
  const std::optional<DrawnComponent> gas = gas_of_a_universe();
  if (!gas) GTEST_SKIP() << "no lcdm in " << data_folder();
  DrawnComponent component = *gas;
  component.absorption = {Absorption::Kind::none, 0};
  component.brightness *= 0.03;
  const Frame frame = frame_of_flight(Projection::perspective, {component}, 16);
  Vec3 start = component.particles.origin;
  const double center[] = {30370.6, 18842.9, 12201.9};
  for (std::size_t axis = 0; axis < 3; ++axis)
    start.a[axis] = center[axis];
  start.a[2] -= 320;
  expect_continuous(frame, start, {{0, 0, 1}}, 640, 8, "lcdm");
}

// What changes order from one frame to the next explains, in any pixel: the sum over pairs of
// |q_i - q_j| (1 - exp(-tau_i)) (1 - exp(-tau_j)), of peaks.
double explained_by_order(const Frame& from, const Frame& to) {
  const auto sorted = [](const Frame& frame) {
    std::vector<reference::Splat> splats = reference::project(frame);
    reference::sort(splats, frame.sort);
    return splats;
  };
  const std::vector<reference::Splat> before = sorted(from), after = sorted(to);
  std::vector<std::size_t> place(particle_count(from), after.size());
  for (std::size_t i = 0; i < after.size(); ++i)
    place[after[i].particle] = i;
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t k = i + 1; k < before.size(); ++k) {
      if (place[before[i].particle] < place[before[k].particle]) continue;
      double largest = 0;
      for (int c = 0; c < 3; ++c) {
        const reference::Splat &a = before[i], &b = before[k];
        const double tau_a = a.weight * a.absorption[c], tau_b = b.weight * b.absorption[c];
        largest = std::max(
            largest, std::abs(a.emission[c] / a.absorption[c] - b.emission[c] / b.absorption[c]) *
                         -std::expm1(-tau_a) * -std::expm1(-tau_b));
      }
      sum += largest;
    }
  }
  return sum;
}

TEST_F(Flights, InOrderedScenesChangeByNoMoreThanCloudsThatChangeOrderExplain) {
  DrawnComponent red = component_of(cluster(20, 0.4), one_color(1, 0.3f, 0.1f));
  std::vector<Cloud> others = cluster(40, 0.3);
  others.erase(others.begin(), others.begin() + 20);
  DrawnComponent blue = component_of(others, one_color(0.2f, 0.4f, 1));
  red.absorption = {Absorption::Kind::factor, 0.5};
  blue.absorption = {Absorption::Kind::factor, 2};
  const Frame frame = frame_of_flight(Projection::perspective, {red, blue});
  ASSERT_EQ(choose_light(frame), LightPlan::ordered);
  const Vec3 start = {{0, 0, -2}}, along = {{0, 0, 1}};
  constexpr std::size_t steps = 240;
  const std::vector<Image> images = pictures(frame, start, along, 3, steps);
  const auto beyond_order = [&](std::size_t stride) {
    const auto at = [&](std::size_t i) {
      return moved(frame, start, along, 3.0 * static_cast<double>(i) / steps);
    };
    double largest = 0;
    for (std::size_t i = stride; i <= steps; i += stride) {
      largest = std::max(largest, largest_difference(images[i], images[i - stride]) -
                                      explained_by_order(at(i - stride), at(i)));
    }
    return largest;
  };
  const double noise = 2 * frame.tolerance, per_step = 1.25 * beyond_order(4);
  EXPECT_GT(per_step, 2 * noise);
  EXPECT_LE(beyond_order(2), per_step / 2 + noise);
  EXPECT_LE(beyond_order(1), per_step / 4 + noise);
}

}  // namespace
}  // namespace splotchcl::test
