#include "scene/statistics.h"
#include "testing.h"

namespace splotchcl {
namespace {

// A ball of particles, denser towards its centre, seen from ten radii away. Lengths in
// `length` units, masses in `mass` units.
Frame ball(double length, double mass, int width = 400, int height = 400) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<float> position, h;
  for (int i = 0; i < 20000; ++i) {
    const double radius = std::exp(normal(random));
    for (int axis = 0; axis < 3; ++axis) {
      position.push_back(static_cast<float>(0.3 * length * radius * normal(random)));
    }
    h.push_back(static_cast<float>(0.1 * length * radius));
  }
  DrawnComponent component;
  component.particles.count = h.size();
  component.particles.position = Column::owning(std::move(position));
  component.particles.smoothing_length = Column::owning(std::move(h));
  component.particles.weight = Column::uniform(static_cast<float>(mass));
  component.palette.emission = {Rgb{1, 1, 1}};

  Camera camera;
  camera.position = {{0, -10 * length, 0}};
  camera.look_at = {{0, 0, 0}};
  camera.sky = {{0, 0, 1}};
  camera.field_of_view_degrees = 30;
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.crop = {0, 0, width, height};
  frame.camera = make_camera_frame(camera, width, height);
  frame.components = {component};
  return frame;
}

double reference_of(const Frame& frame) {
  return find_reference_column(frame.components[0], frame).value();
}

TEST(ReferenceColumn, GrowsWithTheMasses) {
  // Single precision of the mass.
  EXPECT_NEAR(reference_of(ball(1, 1e-9)) / reference_of(ball(1, 1)), 1e-9, 1e-15);
}

TEST(ReferenceColumn, FallsWithTheSquareOfTheLengthUnit) {
  const double ratio = reference_of(ball(1024, 1)) / reference_of(ball(1, 1));
  EXPECT_NEAR(ratio * 1024 * 1024, 1, 1e-5);
}

TEST(ReferenceColumn, OfTheHighestPictureNeedsNoMoreThanOthers) {
  // A coarse grid of fixed width would take 40 GB.
  EXPECT_TRUE(std::isfinite(reference_of(ball(1, 1, 1, 65536))));
  EXPECT_TRUE(std::isfinite(reference_of(ball(1, 1, 65536, 1))));
}

TEST(ReferenceColumn, DoesNotDependOnTheSizeOfThePicture) {
  EXPECT_NEAR(reference_of(ball(1, 1, 2000, 2000)) / reference_of(ball(1, 1, 400, 400)), 1, 1e-9);
}

TEST(ReferenceColumn, IsTheSameEveryTime) {
  EXPECT_EQ(reference_of(ball(1, 1)), reference_of(ball(1, 1)));
}

TEST(ReferenceColumn, OfAnEvenSheetIsTheSheetsColumn) {
  // One particle per unit of area, well overlapping, beyond the borders of the picture.
  Frame frame = ball(1, 1);
  std::vector<float> position, h, mass;
  for (int i = -60; i <= 60; ++i) {
    for (int k = -60; k <= 60; ++k) {
      position.insert(position.end(), {static_cast<float>(i), 0, static_cast<float>(k)});
    }
  }
  Particles& particles = frame.components[0].particles;
  particles.count = position.size() / 3;
  particles.position = Column::owning(std::move(position));
  particles.smoothing_length = Column::uniform(6);
  particles.weight = Column::uniform(3);
  Camera camera;
  camera.position = {{0, -100, 0}};
  camera.look_at = {{0, 0, 0}};
  camera.sky = {{0, 0, 1}};
  camera.projection = Projection::orthographic;
  camera.field_of_view_degrees = 30;
  frame.projection = Projection::orthographic;
  frame.camera = make_camera_frame(camera, 400, 400);
  // The grid shares a cloud out by areas, not exactly by its profile.
  EXPECT_NEAR(reference_of(frame), 3, 0.3);
}

TEST(ReferenceColumn, CarriesTheIntensity) {
  Frame frame = ball(1, 1);
  const double without = reference_of(frame);
  frame.components[0].particles.intensity = Column::uniform(0.25f);
  EXPECT_NEAR(reference_of(frame) / without, 0.25, 1e-9);
}

TEST(ReferenceColumn, PassesOverBadParticles) {
  Frame frame = ball(1, 1);
  const double expected = reference_of(frame);
  Particles& particles = frame.components[0].particles;
  std::vector<float> h(particles.smoothing_length.data(),
                       particles.smoothing_length.data() + particles.count);
  std::vector<float> position(particles.position.data(),
                              particles.position.data() + 3 * particles.count);
  position.insert(position.end(), {0, std::nanf(""), 0});
  h.push_back(1);
  position.insert(position.end(), {0, 0, 0});
  h.push_back(-1);
  particles.count += 2;
  particles.position = Column::owning(std::move(position));
  particles.smoothing_length = Column::owning(std::move(h));
  EXPECT_EQ(reference_of(frame), expected);
}

TEST(ReferenceColumn, IsNothingWhenTheCameraSeesNothing) {
  Frame frame = ball(1, 1);
  frame.camera.forward = {{0, -1, 0}};
  EXPECT_FALSE(find_reference_column(frame.components[0], frame));
}

TEST(ReferenceColumn, OfTheLargestSampleIsThatOfAll) {
  constexpr std::size_t count = 2 * most_sampled + 700001;  // every ninth is looked at
  std::vector<float> position(3 * count), h(count);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (float& x : position)
    x = uniform(random);
  for (float& length : h)
    length = 0.1F * (1.5F + uniform(random));
  const std::size_t stride = least_sample_stride(count);
  ASSERT_EQ(stride, 3U);
  Frame all = ball(1, 1), sample = all;
  std::vector<float> sampled_position, sampled_h;
  for (std::size_t i = 0; i < count; i += stride) {
    sampled_position.insert(sampled_position.end(), &position[3 * i], &position[3 * i] + 3);
    sampled_h.push_back(h[i]);
  }
  Particles& particles = all.components[0].particles;
  particles.count = count;
  particles.position = Column::owning(std::move(position));
  particles.smoothing_length = Column::owning(std::move(h));
  Particles& of_sample = sample.components[0].particles;
  of_sample.count = sampled_h.size();
  of_sample.position = Column::owning(std::move(sampled_position));
  of_sample.smoothing_length = Column::owning(std::move(sampled_h));
  EXPECT_EQ(
      find_reference_column(sample.components[0], sample, ParticlePass(of_sample.count), stride),
      find_reference_column(all.components[0], all));
}

TEST(SampleStride, IsOfTheLargestSampleAndNestsInIt) {
  for (const std::size_t count : {1ULL, 1999999ULL, 2000001ULL, 16777216ULL, 999999937ULL}) {
    const std::size_t least = least_sample_stride(count);
    EXPECT_LE(ceil_divide(count, least), most_sampled);
    for (const std::size_t limit : {1UL, 512UL, 200000UL, 500000UL, most_sampled}) {
      const std::size_t stride = sample_stride(count, limit);
      EXPECT_LE(ceil_divide(count, stride), limit) << count;
      EXPECT_EQ(stride % least, 0U) << count << " " << limit;
      EXPECT_EQ(stride, least * sample_stride(ceil_divide(count, least), limit)) << count;
    }
  }
}

}  // namespace
}  // namespace splotchcl
