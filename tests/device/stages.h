#pragma once

#include "device/opencl/device_context.h"
#include "device/pipeline.h"
#include "device/scenes.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"
#include "testing.h"

namespace splotchcl::test {

// Every particle gets a palette position of its own, and a palette in which it can be read
// back from red / green: particle i of all components has position i / identity_steps.
constexpr double identity_steps = 1 << 20;

inline Frame with_identities(Frame frame) {
  std::size_t next = 0;
  for (DrawnComponent& component : frame.components) {
    std::vector<float> colors;
    for (std::size_t i = 0; i < component.particles.count; ++i, ++next) {
      colors.push_back(static_cast<float>(static_cast<double>(next) / identity_steps));
    }
    component.particles.color = Column::owning(colors);
    component.color = ScalarMap{};
    component.palette.emission = {Rgb{0, 1, 1}, Rgb{1, 1, 1}};
  }
  return frame;
}

inline std::uint64_t identity_of(const shared::Splat& splat) {
  return static_cast<std::uint64_t>(std::lround(static_cast<double>(splat.color) * identity_steps));
}

// Where a splat's center lies, in pixels of the whole picture.
struct PicturePlace {
  double x = 0, y = 0;
  std::uint32_t grid = 0;
  double pixel = 1;  // of its grid
};

inline PicturePlace place_of(const shared::Splat& splat, const PictureLayout& layout,
                             const FramePlan& plan) {
  PicturePlace place;
  place.grid = splat.component_and_grid >> 16 & 0xffu;
  const shared::Grid& grid = layout.grids[place.grid];
  place.pixel = std::ldexp(1.0, plan.pyramid.grids[place.grid].level);
  const int power = static_cast<int>(splat.component_and_grid >> 24) - grid.place_bits;
  place.x = place.pixel * (std::ldexp(splat.x, power) + grid.middle_x - grid.guard);
  place.y = place.pixel * (std::ldexp(splat.y, power) + grid.middle_y - grid.guard);
  return place;
}

// What compositing makes of a splat in a list (kernels/bin/bin.h, TileSplat).
struct ListedSplat {
  double x = 0, y = 0, sigma = 0, radius = 0;  // x and y from the tile's corner
  std::uint64_t particle = 0;
};

// The stages of one frame, run one by one, with what they hand on read back. The frame should
// have identities.
class Stages {
 public:
  // `rows`: the shape of a processor, which projects eight particles at a time, or that of a
  // GPU.
  Stages(DeviceContext& device, const Frame& frame, bool rows = true)
      : frame_(frame), plan_(make_plan(frame_)), device_(device), particles_(device) {
    device.traits.choose_shape(rows);
    pipeline_ = std::make_unique<Pipeline>(device, particles_, frame_, plan_);
  }
  // Kernels may still read the frame's columns.
  ~Stages() { device_.queue.finish(); }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  // Projects all components at once, as the ordered plan does.
  void project() { keyed_ = pipeline_->project_all(); }
  // After project().
  std::vector<shared::Splat> splats() {
    const std::vector<shared::Splat> all = splats_in_slots(keyed_.splats, slots());
    std::vector<shared::Splat> splats;
    for (const std::uint32_t slot : slots())
      splats.push_back(all[slot]);
    return splats;
  }
  // As the sort has them: of 48 bits, or of 32 where a field is the key.
  std::vector<std::uint64_t> keys() {
    const std::vector<std::uint32_t> upper = read(keyed_.keys, keyed_.count);
    std::vector<std::uint64_t> keys(upper.begin(), upper.end());
    if (frame_.sort.by == SortOrder::By::field) return keys;
    const std::vector<std::uint32_t> slots = this->slots();
    const std::vector<std::uint16_t> ends =
        read(keyed_.key_ends, static_cast<std::size_t>(keyed_.key_ends.size()));
    for (std::size_t i = 0; i < keys.size(); ++i)
      keys[i] = keys[i] << 16 | ends[slots[i]];
    return keys;
  }
  const KeyedSplats& keyed() const { return keyed_; }
  // Where its splats lie.
  std::vector<std::uint32_t> slots() { return read(keyed_.order, keyed_.count); }

  // The particles in the device's order, nearest first.
  std::vector<std::uint64_t> sorted_particles() {
    project();
    sort();
    const std::vector<std::uint32_t> order = read(sorted_.order, sorted_.count);
    const std::vector<shared::Splat> all = splats_in_slots(sorted_.splats, order);
    std::vector<std::uint64_t> particles;
    for (const std::uint32_t slot : order)
      particles.push_back(identity_of(all[slot]));
    return particles;
  }

  // Counts the tiles of all splats of the first chunk.
  const CountedSplats& count() {
    if (plan_.needs_sort()) {
      project();
      sort();
      counted_ = pipeline_->binner().count(sorted_,
                                           splat_chunks(sorted_.count, 0, device_.traits).front());
    } else {
      blocks_ = pipeline_->project(pipeline_->particle_chunks().front());
      counted_ = pipeline_->binner().count(blocks_);
    }
    return counted_;
  }
  // Their lists, which must fit into one band.
  TileLists bin() {
    count();
    EXPECT_EQ(counted_.bands.size(), 1u);
    return pipeline_->binner().make_lists(counted_, counted_.bands.front());
  }
  // After bin().
  const std::vector<std::uint32_t>& lengths() const { return counted_.lengths; }

  // The lists' splats, tile after tile.
  std::vector<ListedSplat> entries(const TileLists& lists) {
    const std::size_t floats = context().variant.tile_splat_bytes() / sizeof(float);
    const std::vector<float> values = read_as<float>(lists.entries, lists.entry_count * floats);
    std::vector<ListedSplat> entries;
    for (std::size_t i = 0; i < values.size(); i += floats) {
      ListedSplat entry;
      entry.x = static_cast<double>(values[i]) + 0.5 * context().variant.tile_width;
      entry.y = static_cast<double>(values[i + 1]) + 0.5 * context().variant.tile_height;
      entry.sigma = static_cast<double>(values[i + 2]);
      entry.radius = static_cast<double>(values[i + 3]);
      const double position =
          static_cast<double>(values[i + 4]) / static_cast<double>(values[i + 5]);
      entry.particle = static_cast<std::uint64_t>(std::lround(position * identity_steps));
      entries.push_back(entry);
    }
    return entries;
  }

  template <class T>
  std::vector<T> read(const Buffer<T>& buffer, std::size_t count) {
    return device_.pool.download(buffer, count);
  }
  template <class T, class Stored>
  std::vector<T> read_as(const Buffer<Stored>& buffer, std::size_t count) {
    const std::vector<Stored> stored = read(buffer, count * sizeof(T) / sizeof(Stored));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), stored.data(), count * sizeof(T));
    return values;
  }

  const Frame& frame() const { return frame_; }
  const FramePlan& plan() const { return plan_; }
  const StageContext& context() const { return pipeline_->context(); }
  const PictureLayout& layout() const { return context().layout; }

 private:
  void sort() { sorted_ = pipeline_->sorter().sort(std::move(keyed_)); }
  // As many as there are up to the last of these; between blocks of particles lie slots of none.
  std::vector<shared::Splat> splats_in_slots(const Buffer<std::byte>& memory,
                                             const std::vector<std::uint32_t>& slots) {
    const std::size_t count = slots.empty() ? 0 : *std::max_element(slots.begin(), slots.end()) + 1;
    const std::size_t bytes = context().variant.splat_bytes();
    const std::vector<std::byte> stored = read_as<std::byte>(memory, count * bytes);
    std::vector<shared::Splat> splats(count);
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(&splats[i], stored.data() + i * bytes, sizeof(shared::Splat));
    return splats;
  }

  const Frame frame_;
  const FramePlan plan_;
  DeviceContext& device_;
  ParticleStore particles_;
  std::unique_ptr<Pipeline> pipeline_;
  KeyedSplats keyed_;
  SortedSplats sorted_;
  SplatBlocks blocks_;
  CountedSplats counted_;
};

// Tests of stages share one device and its compiled kernels.
class StageTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { device_ = std::make_unique<DeviceContext>(choose_device("")); }
  static void TearDownTestSuite() { device_.reset(); }
  static DeviceContext& device() { return *device_; }

 private:
  static inline std::unique_ptr<DeviceContext> device_;
};

// Index for index.
inline void expect_order_of_the_oracle(DeviceContext& device, Frame frame) {
  frame = with_identities(frame);
  Stages stages(device, frame);
  const std::vector<std::uint64_t> order = stages.sorted_particles();
  std::vector<reference::Splat> expected = reference::project(frame);
  reference::sort(expected, frame.sort);
  ASSERT_EQ(order.size(), expected.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ(order[i], expected[i].particle) << "at place " << i;
  }
}

}  // namespace splotchcl::test
