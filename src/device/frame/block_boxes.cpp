#include "device/frame/block_boxes.h"

#include <algorithm>
#include <array>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <iterator>
#include <utility>

#include "device/frame/particle_store.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "surroundings/cloud_around.h"

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
  Choices choices = device.traits.lanes();
  choices.push_back(flag("VECTOR_COLORS", has_own_colors));
  const Program find_boxes =
      device.programs.get(program_source("kernels/project/boxes.cl", choices));
  Launch launch(device, "boxes", find_boxes.create_kernel("find_boxes"));
  pass_columns(launch.value(p), buffers);
  launch.arg(boxes).run_items(count);
  return device.pool.download(boxes, count);
}

// Single precision knows an offset from the camera to a few times 1e-7 of the coordinates it is
// the difference of, and the projection is three products and sums of that.
constexpr double rounding = 1e-5;
// Beyond that coordinates, or their squares, may be no numbers in the kernels.
constexpr double most = 1e18;
// Clouds are around the camera where rounded lengths say so.
constexpr double room_around = 1.001;

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

ViewBounds::ViewBounds(const Frame& frame, const DrawnComponent& component,
                       const shared::ProjectParameters<float>& p)
    : camera_(),
      sigma_per_h_(frame.kernel.width * component.size_factor),
      around_(has_clouds_around(frame) ? room_around * all_splat : 0) {
  using namespace boost::qvm;
  const Vec3 camera = frame.camera.position - component.particles.origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
    camera_[axis] = camera.a[axis];
  if (is_wide_angle(frame.projection)) return;
  add_edges(frame, p);
  add_limits(frame, p);
}

void ViewBounds::add(const Vec3& normal, double of_sigma, double constant) {
  planes_.push_back({{normal.a[0], normal.a[1], normal.a[2]}, of_sigma, constant});
}

// may_be_seen() in kernels/project/splat_widths.cl, times the depth: a splat at x pixels from the
// picture's middle, which are f X / Z, is not looked at where x + reach < left.
void ViewBounds::add_edges(const Frame& frame, const shared::ProjectParameters<float>& p) {
  using namespace boost::qvm;
  const CameraFrame& camera = frame.camera;
  const bool is_perspective = frame.projection != Projection::orthographic;
  const double f = static_cast<double>(p.pixels_per_length);
  // In extended precision ten sigma and some roundings are looked at.
  const double reach = 1.01 * std::max(static_cast<double>(p.reach), 10.0);
  const double least_sigma = drawn_width(0, frame.kernel).sigma + 1e-5;
  const double pixels = reach * least_sigma + 6 + 1e-3 * (frame.width + frame.height);
  // A lens widens by a length times |f - f Z / focus| of pixels times the depth, at most by both.
  const double of_lens = reach * sigma_per_scale(frame.lens);
  const double beyond_focus = of_lens * scale_in_focus(frame);
  const auto edge = [&](const Vec3& across, double center_to_edge) {
    const double room = center_to_edge + pixels;
    if (is_perspective) {
      add(f * across + (room + beyond_focus) * camera.forward, f * reach, f * of_lens);
    } else {
      add(f * across, f * reach, room);
    }
  };
  const auto number = [](float value) { return static_cast<double>(value); };
  edge(camera.right, number(p.center_x) - number(p.seen_left));
  edge(-camera.right, number(p.seen_right_end) - number(p.center_x));
  edge(camera.down, number(p.center_y) - number(p.seen_top));
  edge(-camera.down, number(p.seen_bottom) - number(p.center_y));
}

void ViewBounds::add_limits(const Frame& frame, const shared::ProjectParameters<float>& p) {
  using namespace boost::qvm;
  const double nearest = static_cast<double>(p.near_limit);
  add(frame.camera.forward, 0, 1e-3 * std::abs(nearest) - nearest);
  const double farthest = static_cast<double>(p.far_limit);
  if (std::isfinite(farthest)) add(-frame.camera.forward, 0, farthest + 1e-3 * std::abs(farthest));
}

bool ViewBounds::leave_out(const shared::BlockBox& box) const {
  if (box.lower[0] > box.upper[0]) return !planes_.empty();  // none is good
  std::array<double, 3> middle, half;
  double coordinates = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lower = static_cast<double>(box.lower[axis]);
    const double upper = static_cast<double>(box.upper[axis]);
    middle[axis] = 0.5 * (lower + upper) - camera_[axis];
    half[axis] = 0.5 * (upper - lower);
    coordinates += std::abs(camera_[axis]) + std::max(std::abs(lower), std::abs(upper));
  }
  if (!(coordinates < most)) return false;
  const double sigma = sigma_per_h_ * static_cast<double>(box.largest_h);
  double beside2 = 0;  // of the camera, squared
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double beside = std::abs(middle[axis]) - half[axis] - rounding * coordinates;
    beside2 += std::pow(std::max(beside, 0.0), 2);
  }
  if (around_ > 0 && beside2 <= std::pow(around_ * sigma, 2)) return false;
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    double highest = plane.of_sigma * sigma + plane.constant, size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      highest += plane.normal[axis] * middle[axis] + std::abs(plane.normal[axis]) * half[axis];
      size += std::abs(plane.normal[axis]);
    }
    return highest + rounding * size * coordinates < 0;
  });
}

}  // namespace splotchcl
