#include "device/frame/block_boxes.h"

#include <algorithm>
#include <array>

#include "device/frame/column_arguments.h"
#include "device/frame/particle_store.h"
#include "device/frame/specialization.h"
#include "device/opencl/launch.h"

namespace splotchcl {
namespace {

std::array<const Column*, 7> columns_of(const Particles& p) {
  return {&p.position,  &p.smoothing_length, &p.weight,    &p.color,
          &p.intensity, &p.color_vector,     &p.sort_field};
}

// Made for one moment between two snapshots, they are not drawn again.
bool are_of_one_moment(const Particles& particles) {
  const auto columns = columns_of(particles);
  return std::any_of(columns.begin(), columns.end(),
                     [](const Column* column) { return column->source() != nullptr; });
}

bool is_same(const Column& a, const Column& b) {
  if (a.is_array() || b.is_array()) return a.data() == b.data() && a.size() == b.size();
  if (a.is_uniform() || b.is_uniform()) {
    return a.is_uniform() && b.is_uniform() && a.uniform_value() == b.uniform_value();
  }
  return true;
}

bool are_same(const Particles& a, const Particles& b) {
  const auto first = columns_of(a), second = columns_of(b);
  return a.count == b.count &&
         std::equal(first.begin(), first.end(), second.begin(),
                    [](const Column* x, const Column* y) { return is_same(*x, *y); });
}

BlockBoxes::Boxes make_boxes(DeviceContext& device, const Particles& particles,
                             const ParticleBuffers& buffers) {
  shared::ProjectParameters p{};
  p.end_particle = static_cast<unsigned>(particles.count);
  p.block_particles = device.traits.project_block;
  set_strides(buffers, p);
  const bool has_own_colors = !particles.color_vector.is_absent();
  const std::size_t count =
      (particles.count + p.block_particles - 1) / std::size_t{p.block_particles};
  const auto boxes = device.pool.get<shared::BlockBox>(count, "boxes of blocks");
  const compute::program program =
      device.programs.get(Specialization::boxes(device.traits.rows, has_own_colors));
  Launch launch(device, "boxes", program.create_kernel("find_boxes"));
  pass_columns(launch.value(p), buffers);
  if (has_own_colors) launch.arg(buffers.own_color);
  launch.arg(boxes).run_items(count);
  return device.pool.download(boxes, count);
}

}  // namespace

const BlockBoxes::Boxes* BlockBoxes::find(DeviceContext& device, const Particles& particles,
                                          const ParticleBuffers& buffers, std::uint64_t frame) {
  if (particles.count == 0 || are_of_one_moment(particles)) return nullptr;
  const auto known = std::find_if(known_.begin(), known_.end(), [&](const Known& entry) {
    return are_same(entry.particles, particles);
  });
  if (known == known_.end()) {
    known_.push_back({particles, frame, frame, {}});
    return nullptr;
  }
  known->last_frame = frame;
  if (known->first_frame == frame) return nullptr;
  if (known->boxes.empty()) known->boxes = make_boxes(device, particles, buffers);
  return &known->boxes;
}

void BlockBoxes::forget_all_but(std::uint64_t frame) {
  known_.remove_if([frame](const Known& entry) { return entry.last_frame != frame; });
}

}  // namespace splotchcl
