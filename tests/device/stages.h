#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "device/binner.h"
#include "device/compositor.h"
#include "device/device_context.h"
#include "device/frame_layout.h"
#include "device/particle_buffers.h"
#include "device/projector.h"
#include "device/scenes.h"
#include "device/sorter.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

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

inline std::uint64_t identity_of(const kernel::Splat& splat) {
  return static_cast<std::uint64_t>(std::lround(static_cast<double>(splat.color) * identity_steps));
}

// What compositing makes of a splat in a list, in the layout of the sums and of the
// ordered plan (common.cl, TileSplat).
struct ListedSplat {
  double x = 0, y = 0, sigma = 0, radius = 0;  // x and y in the tile
  std::uint64_t particle = 0;
};

// The device's stages of one frame, run one by one, with what they leave in the device's
// memory read back. The frame should have identities.
class Stages {
 public:
  // `lanes`: project eight particles at a time, as on a processor, or one, as on a GPU.
  Stages(DeviceContext& device, const Frame& frame, bool lanes = true, bool rows = true)
      : frame_(frame),
        plan_(make_plan(frame_)),
        device_(device),
        layout_(make_layout(frame_, plan_, rows)),
        grids_(device_.buffers.upload("grids", layout_.grids)),
        particles_(device_),
        projector_(device_, frame_, layout_, grids_),
        binner_(device_, layout_, frame_, plan_, grids_) {
    device_.traits.rows = lanes;
  }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  // Projects all components at once, as the ordered plan does.
  void project() {
    std::vector<ParticleBuffers> buffers;
    for (const DrawnComponent& component : frame_.components)
      buffers.push_back(particles_.get(component.particles));
    splat_count_ = projector_.project_all(frame_.components, buffers);
  }
  // After project().
  std::vector<kernel::Splat> splats() { return read<kernel::Splat>("splats", splat_count_); }
  std::vector<std::uint32_t> keys() { return read<std::uint32_t>("keys", splat_count_); }

  // After project(): the particles in the device's order, nearest first.
  std::vector<std::uint64_t> sorted_particles() {
    sort();
    const std::vector<kernel::Splat> all = splats();
    std::vector<std::uint64_t> particles;
    for (const std::uint32_t slot : read<std::uint32_t>(order_, splat_count_))
      particles.push_back(identity_of(all[slot]));
    return particles;
  }

  // The lists of all splats of the first component, in one pass; false if they do not fit.
  bool try_bin(TileLists& lists) {
    if (plan_.light == LightPlan::ordered) {
      project();
      sort();
      return binner_.bin_order(order_, 0, splat_count_, lists);
    }
    const DrawnComponent& component = frame_.components.front();
    const SplatBlocks blocks =
        projector_.project_chunk(component, 0, particles_.get(component.particles), 0,
                                 static_cast<std::uint32_t>(component.particles.count));
    return binner_.bin_blocks(blocks, 0, blocks.stride, lists);
  }
  TileLists bin() {
    TileLists lists;
    EXPECT_TRUE(try_bin(lists));
    return lists;
  }

  // The lists' splats, tile after tile.
  std::vector<ListedSplat> entries(const TileLists& lists) {
    const bool ordered = plan_.light == LightPlan::ordered;
    const std::size_t floats = ordered ? 10 : 7;
    const auto values = read<float>(lists.entries, lists.entry_count * floats);
    std::vector<ListedSplat> entries;
    for (std::size_t i = 0; i < values.size(); i += floats) {
      ListedSplat entry;
      entry.x = static_cast<double>(values[i]);
      entry.y = static_cast<double>(values[i + 1]);
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
  std::vector<T> read(const compute::buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) {
      device_.queue.enqueue_read_buffer(buffer, 0, count * sizeof(T), values.data());
    }
    return values;
  }
  template <class T>
  std::vector<T> read(const std::string& name, std::size_t count) {
    return read<T>(device_.buffers.get(name, 0), count);
  }

  const Frame& frame() const { return frame_; }
  const Plan& plan() const { return plan_; }
  const FrameLayout& layout() const { return layout_; }
  const Projector& projector() const { return projector_; }
  DeviceContext& device() { return device_; }

 private:
  void sort() {
    order_ =
        Sorter(device_)
            .sort({device_.buffers.get("keys", 0), device_.buffers.get("order", 0)}, splat_count_)
            .values;
  }

  const Frame frame_;
  const Plan plan_;
  DeviceContext& device_;
  const FrameLayout layout_;
  compute::buffer grids_;
  ParticleStore particles_;
  Projector projector_;
  Binner binner_;
  compute::buffer order_;
  std::uint32_t splat_count_ = 0;
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

}  // namespace splotchcl::test
