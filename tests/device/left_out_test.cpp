#include "device/counted_column.h"
#include "device/pictures.h"
#include "device/stages.h"
#include "frames/random_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Boxes that are known before particles are read: what is out of view is left out in the first
// frame, and is not read.

constexpr std::size_t block_particles = 32;
constexpr std::size_t particles_in_view = 1000;

std::shared_ptr<const ParticleBoxes> boxes_of(const Particles& particles) {
  ParticleBoxes boxes;
  boxes.block_particles = block_particles;
  for (std::size_t begin = 0; begin < particles.count; begin += block_particles) {
    ParticleBox box = {{1e30f, 1e30f, 1e30f}, {-1e30f, -1e30f, -1e30f}, 0};
    for (std::size_t i = begin; i < std::min(particles.count, begin + block_particles); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], particles.position[3 * i + axis]);
        box.upper[axis] = std::max(box.upper[axis], particles.position[3 * i + axis]);
      }
      box.largest_smoothing_length =
          std::max(box.largest_smoothing_length, particles.smoothing_length[i]);
    }
    boxes.boxes.push_back(box);
  }
  return std::make_shared<const ParticleBoxes>(std::move(boxes));
}

// Clouds in view, and before them in the file twice as many that lie far beside it.
Frame scene(bool is_ordered) {
  CloudSetup setup;
  setup.count = 3 * static_cast<int>(particles_in_view);
  DrawnComponent clouds = random_clouds(setup);
  Particles& particles = clouds.particles;
  std::vector<float> positions(particles.position.data(),
                               particles.position.data() + particles.position.size());
  for (std::size_t i = 0; i < particles.count - particles_in_view; ++i)
    positions[3 * i] += 5000;
  particles.position = Column::owning(std::move(positions));
  if (is_ordered) clouds.absorption = {Absorption::Kind::gray, 0.2};
  return frame_of(setup.width, setup.height, {clouds});
}

class KnownBoxes : public StageTest, public testing::WithParamInterface<std::tuple<bool, bool>> {
 protected:
  void SetUp() override {
    device().traits.choose_shape(std::get<0>(GetParam()));
    whole_ = device().traits;
    device().traits.project_block = std::get<0>(GetParam()) ? block_particles : GROUP_ITEMS;
    device().traits.chunk_blocks = 8;
  }
  void TearDown() override { device().traits = whole_; }

  bool is_ordered() const { return std::get<1>(GetParam()); }

  Image draw(const Frame& frame) {
    DrawnOnce drawn = draw_with_plan(device(), frame, make_plan(frame));
    counts_ = drawn.counts;
    return std::move(drawn.image);
  }
  const DrawCounts& counts() const { return counts_; }

 private:
  DeviceTraits whole_;
  DrawCounts counts_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, KnownBoxes, testing::Combine(testing::Bool(), testing::Bool()),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) ? "rows" : "groups") +
                                  (std::get<1>(info.param) ? "_ordered" : "_sums");
                         });

TEST_P(KnownBoxes, LeaveOutBlocksOfAFirstFrameAndChangeNoBit) {
  Frame frame = scene(is_ordered());
  const Image without = draw(frame);
  EXPECT_EQ(counts().blocks_left_out, 0u);
  const std::uint64_t visible = counts().visible;
  Particles& particles = frame.components.front().particles;
  particles.boxes = boxes_of(particles);
  const Image with = draw(frame);
  EXPECT_EQ(with.pixels, without.pixels);
  EXPECT_EQ(counts().visible, visible);
  const std::size_t blocks_beside = 2 * particles_in_view / device().traits.project_block;
  EXPECT_GE(counts().blocks_left_out + 1, blocks_beside);
}

TEST_P(KnownBoxes, KeepWhatIsOutOfViewUnread) {
  Frame frame = scene(is_ordered());
  const Image in_memory = draw(frame);
  Particles& particles = frame.components.front().particles;
  particles.boxes = boxes_of(particles);
  const auto lengths = std::make_shared<const CountedColumn>(particles.smoothing_length);
  particles.smoothing_length = Column::made_by(lengths);
  const FramePlan plan = make_plan(frame);
  const std::size_t before = lengths->made();
  EXPECT_EQ(draw(frame).pixels, in_memory.pixels);
  // Once for the plan within; once, in windows of keys and in order twice, for the projection.
  const std::size_t passes = is_ordered() ? 3 : 1;
  const std::size_t in_view = particles_in_view + device().traits.project_block;
  EXPECT_LE(lengths->made() - before, before + passes * in_view);
}

TEST(ParticleBoxes, AroundAStretchHoldAllOfItsBlocks) {
  const ParticleBoxes boxes = {
      10, {{{0, 0, 0}, {1, 1, 1}, 2}, {{5, -1, 0}, {6, 1, 1}, 1}, {{9, 9, 9}, {9, 9, 9}, 7}}};
  const ParticleBox both = boxes.around(9, 11);
  EXPECT_EQ(both.lower[0], 0);
  EXPECT_EQ(both.lower[1], -1);
  EXPECT_EQ(both.upper[0], 6);
  EXPECT_EQ(both.largest_smoothing_length, 2);
  EXPECT_EQ(boxes.around(10, 20).lower[0], 5);
}

// Blocks of particles out of view are not projected when the same particles are drawn again, and
// pictures keep their bits.

class BlocksOutOfView : public testing::TestWithParam<CompositeShape> {
 protected:
  static void TearDownTestSuite() { renderers_.clear(); }

  static Renderer& renderer(CompositeShape shape) {
    RendererOptions options;
    options.shape = shape;
    options.columns_stay = true;
    std::unique_ptr<Renderer>& renderer = renderers_[shape];
    if (!renderer) renderer = std::make_unique<Renderer>(options);
    return *renderer;
  }

  static Image draw(const Frame& frame, CompositeShape shape) {
    return renderer(shape).render(frame);
  }

  // Clusters here and there, each as many clouds as a block of a processor has.
  static DrawnComponent clusters() {
    Random random(11);
    std::vector<Cloud> clouds;
    for (int cluster = 0; cluster < 6; ++cluster) {
      const double x = random.uniform(-90, 90), y = random.uniform(-90, 90);
      const double z = random.uniform(-90, 90), widest = random.logarithmic(0.1, 10);
      for (int i = 0; i < 8192; ++i) {
        clouds.push_back({x + random.uniform(-9, 9), y + random.uniform(-9, 9),
                          z + random.uniform(-9, 9), random.logarithmic(0.01, widest),
                          random.logarithmic(1e-3, 1e-1)});
      }
    }
    return component_of(clouds, two_colors());
  }

  static Frame frame_for(const DrawnComponent& component) {
    Frame frame = frame_of(64, 48, {component});
    frame.projection = Projection::perspective;
    return frame;
  }

  // From among the clusters, from beside them and from afar.
  static void look(std::uint64_t seed, Frame& frame) {
    Random random(seed);
    const double distance = random.logarithmic(10, 400);
    Camera camera;
    camera.projection = frame.projection;
    camera.field_of_view_degrees = random.uniform(3, 100);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      camera.position.a[axis] = distance * random.uniform(-1, 1);
      camera.look_at.a[axis] = random.uniform(-90, 90);
    }
    frame.camera = make_camera_frame(camera, frame.width, frame.height);
  }

  // What it is without boxes: as if nothing had been drawn before.
  Image draw_alone(const Frame& frame) {
    draw(frame_of(8, 8, {component_of({Cloud{0, 0, 5, 1, 1}}, two_colors())}), GetParam());
    Image image = draw(frame, GetParam());
    EXPECT_EQ(stats().blocks_left_out, 0U);
    return image;
  }

  const RenderStats& stats() { return renderer(GetParam()).stats(); }

  // Returns how many blocks were left out.
  std::uint64_t expect_same_bits_again(const Frame& frame, std::uint64_t seed) {
    const Image alone = draw_alone(frame);
    const RenderStats before = stats();
    const Image again = draw(frame, GetParam());
    EXPECT_EQ(again.pixels, alone.pixels) << "camera " << seed;
    EXPECT_EQ(stats().drawn_particles, before.drawn_particles);
    EXPECT_EQ(stats().bad_particles, before.bad_particles);
    EXPECT_EQ(stats().tile_entries, before.tile_entries);
    EXPECT_EQ(stats().drawn_most_exactly, before.drawn_most_exactly);
    return stats().blocks_left_out;
  }

  void expect_same_bits(Frame frame) {
    std::uint64_t left_out = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      look(seed, frame);
      left_out += expect_same_bits_again(frame, seed);
    }
    EXPECT_GT(left_out, 8U);
  }

 private:
  static inline std::map<CompositeShape, std::unique_ptr<Renderer>> renderers_;
};

TEST_P(BlocksOutOfView, ChangeNoBitOfASum) {
  expect_same_bits(frame_for(clusters()));
}

TEST_P(BlocksOutOfView, ChangeNoBitWhereLayersAreOrdered) {
  DrawnComponent component = clusters();
  component.absorption = {Absorption::Kind::gray, 0.2};
  expect_same_bits(frame_for(component));
}

TEST_P(BlocksOutOfView, ChangeNoBitInParallelProjection) {
  Frame frame = frame_for(clusters());
  frame.projection = Projection::orthographic;
  expect_same_bits(frame);
}

TEST_P(BlocksOutOfView, ChangeNoBitOfSplatsThatAreNeverNarrow) {
  Frame frame = frame_for(clusters());
  frame.kernel.min_radius_pixels = 5;
  frame.far_limit = 60;
  expect_same_bits(frame);
}

TEST_P(BlocksOutOfView, ChangeNoBitOfWhatALensBlurs) {
  Frame frame = frame_for(clusters());
  frame.lens = {0.5, 60};
  frame.fade.near_length = 30;
  expect_same_bits(frame);
  frame.lens = {0.05, 10};
  expect_same_bits(frame);
}

TEST_P(BlocksOutOfView, ChangeNoBitOfCloudsAroundTheCamera) {
  Frame frame = frame_for(clusters());
  frame.through_clouds = true;
  expect_same_bits(frame);
  frame.components.front().absorption = {Absorption::Kind::gray, 0.2};
  frame.far_limit = 60;
  expect_same_bits(frame);
}

TEST_P(BlocksOutOfView, StillCountTheirBadParticles) {
  DrawnComponent component = clusters();
  const Column& position = component.particles.position;
  std::vector<float> positions(position.data(), position.data() + position.size());
  for (std::size_t i = 0; i < positions.size(); i += 3000)
    positions[i] = std::numeric_limits<float>::quiet_NaN();
  component.particles.position = Column::owning(std::move(positions));
  expect_same_bits(frame_for(component));
  EXPECT_EQ(stats().bad_particles, 50U);
}

// A simulation may change its arrays in place.
TEST(BlocksOutOfViewOfArrays, AreProjectedWhereValuesMayChange) {
  std::vector<float> position(3 * 8192, 1e6F);
  Frame frame = frame_of(16, 12, {component_of(std::vector<Cloud>(8192, Cloud{}), two_colors())});
  Particles& particles = frame.components.front().particles;
  particles.position = Column(nullptr, position.data(), position.size());
  Renderer renderer;
  renderer.render(frame);
  renderer.render(frame);
  EXPECT_EQ(renderer.stats().blocks_left_out, 0U);
}

INSTANTIATE_TEST_SUITE_P(, BlocksOutOfView,
                         testing::Values(CompositeShape::rows, CompositeShape::groups));

}  // namespace
}  // namespace splotchcl::test
