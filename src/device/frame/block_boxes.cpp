#include "device/frame/block_boxes.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "device/frame/column_arguments.h"
#include "device/frame/particle_store.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"

namespace splotchcl {
namespace {

// Made for one moment between two snapshots, they are not drawn again.
bool are_of_one_moment(const Particles& particles) {
  const auto columns = particles.columns();
  return std::any_of(columns.begin(), columns.end(),
                     [](const Column* column) { return column->source() != nullptr; });
}

BlockBoxes::Boxes make_boxes(DeviceContext& device, const Particles& particles,
                             const ParticleBuffers& buffers) {
  shared::ProjectParameters<float> p{};
  p.launch.end_particle = static_cast<unsigned>(particles.count);
  p.launch.block_particles = device.traits.project_block;
  set_strides(buffers, p.launch);
  const bool has_own_colors = !particles.color_vector.is_absent();
  const std::size_t count = ceil_divide(particles.count, p.launch.block_particles);
  const auto boxes = device.pool.get<shared::BlockBox>(count, "boxes of blocks");
  Choices choices = lanes_of(device.traits);
  choices.push_back(flag("VECTOR_COLORS", has_own_colors));
  const Program find_boxes =
      device.programs.get(program_source("kernels/project/boxes.cl", choices));
  Launch launch(device, "boxes", find_boxes.create_kernel("find_boxes"));
  pass_columns(launch.value(p), buffers);
  launch.arg(boxes).run_items(count);
  return device.pool.download(boxes, count);
}

}  // namespace

const BlockBoxes::Boxes* BlockBoxes::find(DeviceContext& device, const Particles& particles,
                                          const ParticleBuffers& buffers, std::uint64_t frame) {
  if (particles.count == 0 || are_of_one_moment(particles)) return nullptr;
  const auto known = std::find_if(known_.begin(), known_.end(), [&](const Known& entry) {
    return have_same_columns(entry.particles, particles);
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

// How many of them are bad is not known: blocks that hold some have no end, and are not left out.
const BlockBoxes::Boxes& BlockBoxes::given(const std::shared_ptr<const ParticleBoxes>& boxes,
                                           std::size_t count, std::uint32_t block_particles,
                                           std::uint64_t frame) {
  const auto known = std::find_if(given_.begin(), given_.end(),
                                  [&](const Given& entry) { return entry.boxes == boxes; });
  if (known != given_.end()) {
    known->last_frame = frame;
    return known->of_blocks;
  }
  Given given = {boxes, frame, {}};
  for (std::size_t first = 0; first < count; first += block_particles) {
    const ParticleBox box = boxes->around(first, std::min(count, first + block_particles));
    shared::BlockBox block{};
    std::copy(std::begin(box.lower), std::end(box.lower), block.lower);
    std::copy(std::begin(box.upper), std::end(box.upper), block.upper);
    block.largest_h = box.largest_smoothing_length;
    given.of_blocks.push_back(block);
  }
  given_.push_back(std::move(given));
  return given_.back().of_blocks;
}

void BlockBoxes::forget_before(std::uint64_t frame) {
  given_.remove_if([frame](const Given& entry) { return entry.last_frame < frame; });
  known_.remove_if([frame](const Known& entry) { return entry.last_frame < frame; });
}

}  // namespace splotchcl
