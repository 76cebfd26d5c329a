// What must not change a picture: crops, how particles are shared among components, bad
// particles, earlier frames, numbers of threads.
#include "device/cases.h"
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Column picked(const Column& column, const std::vector<std::size_t>& particles, std::size_t stride) {
  std::vector<float> values;
  for (const std::size_t i : particles) {
    for (std::size_t k = 0; k < stride; ++k)
      values.push_back(column[stride * i + k]);
  }
  return Column::owning(values);
}

// These particles of the component, in this order.
DrawnComponent picked(const DrawnComponent& component, const std::vector<std::size_t>& particles) {
  DrawnComponent part = component;
  part.particles.count = particles.size();
  part.particles.position = picked(component.particles.position, particles, 3);
  part.particles.smoothing_length = picked(component.particles.smoothing_length, particles, 1);
  part.particles.weight = picked(component.particles.weight, particles, 1);
  part.particles.color = picked(component.particles.color, particles, 1);
  return part;
}

std::vector<std::size_t> every(std::size_t step, std::size_t first, std::size_t end) {
  std::vector<std::size_t> particles;
  for (std::size_t i = first; i < end; i += step)
    particles.push_back(i);
  return particles;
}

class Consistency : public PictureTest {};

TEST_F(Consistency, ACropIsAPartOfTheWholePicture) {
  CloudSetup setup;
  setup.width = 210;
  setup.height = 150;
  for (const LightPlan plan : all_plans) {
    Frame frame = clouds_for(plan, setup);
    const Image whole = draw(frame);
    for (const Rectangle& crop : {Rectangle{0, 0, 50, 40}, Rectangle{37, 53, 101, 67},
                                  Rectangle{209, 149, 1, 1}, Rectangle{0, 70, 210, 1}}) {
      frame.crop = crop;
      const Image part = draw(frame);
      Image expected(crop.width, crop.height);
      for (int y = 0; y < crop.height; ++y)
        std::copy_n(whole.at(crop.x, crop.y + y), 4 * crop.width, expected.at(0, y));
      EXPECT_LE(largest_difference(part, expected), 2 * frame.tolerance) << name(plan);
    }
  }
}

// A pixel's sum of n terms in another order differs by at most n roundings of each sum,
// relative to the light or depth; a frame of 500 clouds: 2 * 500 * 2^-24.
constexpr double sum_in_another_order = 2 * 500 * 0x1p-24;

TEST_F(Consistency, SharingParticlesAmongComponentsDoesNotChangeASum) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::proportional}) {
    Frame frame = clouds_for(plan);
    const Image together = draw(frame);
    const DrawnComponent all = frame.components.front();
    frame.components = {picked(all, every(2, 0, 500)), picked(all, every(2, 1, 500))};
    ASSERT_EQ(choose_light(frame), plan);
    EXPECT_LE(largest_difference(draw(frame), together), sum_in_another_order) << name(plan);
    frame.components = {picked(all, every(1, 0, 123)), picked(all, every(1, 123, 500))};
    EXPECT_LE(largest_difference(draw(frame), together), sum_in_another_order) << name(plan);
  }
}

TEST_F(Consistency, ShufflingParticlesDoesNotChangeASum) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::proportional}) {
    Frame frame = clouds_for(plan);
    const Image in_order = draw(frame);
    std::vector<std::size_t> shuffled = every(1, 0, 500);
    Random random(3);
    for (std::size_t i = shuffled.size(); i > 1; --i)
      std::swap(shuffled[i - 1],
                shuffled[static_cast<std::size_t>(random.uniform(0, static_cast<double>(i)))]);
    frame.components = {picked(frame.components.front(), shuffled)};
    EXPECT_LE(largest_difference(draw(frame), in_order), sum_in_another_order) << name(plan);
  }
}

// Depths decide: where no two are equal, the order in the file does not matter at all.
TEST_F(Consistency, ShufflingParticlesOfDifferentDepthsGivesTheSameBits) {
  Frame frame = clouds_for(LightPlan::ordered);
  const Image in_order = draw(frame);
  std::vector<std::size_t> reversed = every(1, 0, 500);
  std::reverse(reversed.begin(), reversed.end());
  frame.components = {picked(frame.components.front(), reversed)};
  EXPECT_EQ(draw(frame).pixels, in_order.pixels);
}

// Ties stay in the file's order: so shuffled that those of equal depth do, the bits are the
// same; shuffled in any way, the picture is the oracle's of that file.
TEST_F(Consistency, ShufflingParticlesOfEqualDepthsFollowsTheFile) {
  Frame frame = clouds_for(LightPlan::ordered);
  DrawnComponent& clouds = frame.components.front();
  std::vector<float> positions(clouds.particles.position.data(),
                               clouds.particles.position.data() + 1500);
  constexpr std::size_t depths = 7;
  for (std::size_t i = 0; i < 500; ++i)
    positions[3 * i + 2] = static_cast<float>(1 + i % depths);
  clouds.particles.position = Column::owning(positions);
  const Image in_order = draw(frame);
  const DrawnComponent all = clouds;

  std::vector<std::size_t> by_depth;
  for (const std::size_t depth : {4, 1, 6, 0, 3, 5, 2}) {
    for (const std::size_t i : every(depths, depth, 500))
      by_depth.push_back(i);
  }
  frame.components = {picked(all, by_depth)};
  EXPECT_EQ(draw(frame).pixels, in_order.pixels);

  std::vector<std::size_t> reversed = every(1, 0, 500);
  std::reverse(reversed.begin(), reversed.end());
  frame.components = {picked(all, reversed)};
  EXPECT_LE(largest_error(draw(frame), reference::render(frame)), frame.tolerance);
  EXPECT_NE(draw(frame).pixels, in_order.pixels) << "the order of ties should show here";
}

TEST_F(Consistency, BadParticlesLeaveNoTrace) {
  for (const LightPlan plan : all_plans) {
    Frame frame = clouds_for(plan);
    const Image good = draw(frame);
    DrawnComponent& component = frame.components.front();
    const auto with_bad = [](const Column& column, std::size_t stride, float bad) {
      std::vector<float> values;
      for (std::size_t i = 0; i < column.size(); i += stride) {
        // One before every third particle.
        if (i / stride % 3 == 0) values.insert(values.end(), stride, bad);
        for (std::size_t k = 0; k < stride; ++k)
          values.push_back(column[i + k]);
      }
      return Column::owning(values);
    };
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    component.particles.position = with_bad(component.particles.position, 3, 1);
    component.particles.smoothing_length = with_bad(component.particles.smoothing_length, 1, 5);
    component.particles.weight = with_bad(component.particles.weight, 1, nan);
    component.particles.color = with_bad(component.particles.color, 1, 1);
    component.particles.count = component.particles.weight.size();
    EXPECT_EQ(draw(frame).pixels, good.pixels) << name(plan);
    EXPECT_EQ(renderer().stats().bad_particles, 167u);
    EXPECT_EQ(renderer().stats().particles, 667u);
  }
}

TEST_F(Consistency, OneRendererDrawsTheSameBitsAgainWhateverItDrewBetween) {
  for (const CompositeShape shape : {CompositeShape::rows, CompositeShape::groups}) {
    CloudSetup larger;
    larger.width = 300;
    larger.height = 40;
    larger.count = 2000;
    std::vector<Image> first;
    for (const LightPlan plan : all_plans) {
      first.push_back(draw(clouds_for(plan), shape));
      draw(clouds_for(plan, larger), shape);
    }
    for (std::size_t i = 0; i < first.size(); ++i)
      EXPECT_EQ(draw(clouds_for(all_plans[i]), shape).pixels, first[i].pixels)
          << name(all_plans[i]);
  }
}

TEST_F(Consistency, TwoRenderersDrawTheSameBits) {
  for (const LightPlan plan : all_plans) {
    const Frame frame = clouds_for(plan);
    Renderer other;
    EXPECT_EQ(other.render(frame).pixels, renderer(CompositeShape::automatic).render(frame).pixels);
  }
}

constexpr const char* picture_variable = "SPLOTCHCL_TEST_PICTURE";

// Draws pictures to the file that the environment names: the next test runs this one in
// processes of its own, since OpenCL counts its threads once.
TEST(ConsistencyOfThreads, DISABLED_DrawToAFile) {
  const char* path = std::getenv(picture_variable);
  ASSERT_NE(path, nullptr);
  std::ofstream file(path, std::ios::binary);
  for (const CompositeShape shape : {CompositeShape::rows, CompositeShape::groups}) {
    Renderer renderer({"", shape});
    for (const double tolerance : {1e-3, 0.0}) {
      CloudSetup setup;
      setup.count = tolerance > 0 ? 20000 : 1000;
      for (const LightPlan plan : all_plans) {
        Frame frame = clouds_for(plan, setup);
        frame.tolerance = tolerance;
        const Image image = renderer.render(frame);
        file.write(reinterpret_cast<const char*>(image.pixels.data()),
                   static_cast<std::streamsize>(image.pixels.size() * sizeof(float)));
      }
    }
  }
  ASSERT_TRUE(file.flush().good());
}

std::string drawn_by_threads(int threads) {
  const std::string path = testing::TempDir() + "splotchcl_threads_" + std::to_string(threads) +
                           "_" + std::to_string(std::rand());
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command =
      "POCL_MAX_PTHREAD_COUNT=" + std::to_string(threads) + " " + picture_variable + "='" + path +
      "' '" + program +
      "' --gtest_also_run_disabled_tests "
      "--gtest_filter=ConsistencyOfThreads.DISABLED_DrawToAFile > /dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::remove(path.c_str());
  return bytes;
}

TEST(ConsistencyOfThreads, AnyNumberDrawsTheSameBits) {
  const std::string one = drawn_by_threads(1);
  EXPECT_EQ(one.size(), 2u * 2u * 3u * 4u * 100u * 70u * sizeof(float));
  EXPECT_EQ(drawn_by_threads(2), one);
  EXPECT_EQ(drawn_by_threads(7), one);
}

}  // namespace
}  // namespace splotchcl::test
