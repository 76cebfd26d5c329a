#include "device/frame/column_interpolator.h"

#include <algorithm>

#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

void copy(const float (&from)[3], float (&to)[3]) {
  std::copy(std::begin(from), std::end(from), std::begin(to));
}

shared::InterpolateParameters parameters_of(const DeviceContext& device, const IdMatch& match,
                                            int values_per_particle) {
  shared::InterpolateParameters p{};
  p.in_first = static_cast<unsigned>(match.place_in_second.size());
  p.particles = static_cast<unsigned>(match.particles());
  p.particles_of_item = device.traits.interpolate_block;
  p.width = static_cast<unsigned>(values_per_particle);
  return p;
}

shared::PathParameters parameters_of(const PathNumbers& path, const SnapshotColumns& snapshots) {
  shared::PathParameters p{};
  copy(path.shift_high, p.shift_high);
  copy(path.shift_low, p.shift_low);
  p.size_high = path.size_high;
  p.size_low = path.size_low;
  p.inverse_size = path.inverse_size;
  copy(path.lower, p.lower);
  copy(path.upper, p.upper);
  p.first_rate = path.first_rate;
  p.second_rate = path.second_rate;
  p.of_way = path.of_way;
  p.of_first_tangent = path.of_first_tangent;
  p.of_second_tangent = path.of_second_tangent;
  p.from_first = path.from_first;
  p.from_second = path.from_second;
  p.is_periodic = path.is_periodic;
  p.is_straight = path.is_straight;
  p.first_velocity_stride = snapshots.first_velocity_stride;
  p.second_velocity_stride = snapshots.second_velocity_stride;
  return p;
}

Launch launch_of(DeviceContext& device, const char* kernel) {
  const Program program = device.programs.get(
      program_source("kernels/interpolate/interpolate.cl", device.traits.lanes()));
  return Launch(device, "interpolate", program.create_kernel(kernel));
}

void run(Launch& launch, const shared::InterpolateParameters& p) {
  const std::size_t items = ceil_divide(p.particles, p.particles_of_item);
  if (p.particles_of_item > 1) {
    launch.run_items(items);
  } else {
    launch.run_grid(items, 1, 1);
  }
}

}  // namespace

void order_second_on_device(DeviceContext& device, const IdMatch& match, int values_per_particle,
                            const compute::buffer& second, const compute::buffer& place_in_second,
                            const compute::buffer& appearing, const compute::buffer& ordered) {
  const shared::InterpolateParameters p = parameters_of(device, match, values_per_particle);
  Launch launch = launch_of(device, "order_second");
  launch.value(p).arg(second).arg(place_in_second).arg(appearing).arg(ordered);
  run(launch, p);
}

void interpolate_on_device(DeviceContext& device, const ColumnBetween& column,
                           const SnapshotColumns& snapshots, const compute::buffer& values) {
  shared::InterpolateParameters p =
      parameters_of(device, *column.match, column.values_per_particle);
  p.first_stride = snapshots.first_stride;
  p.second_stride = snapshots.second_stride;
  p.logarithmic = column.kind == ColumnBetween::Kind::logarithmic;
  p.fraction = column.fraction;
  p.vanishing = column.fades ? column.vanishing : 1.0F;
  p.appearing = column.fades ? column.appearing : 1.0F;
  const bool is_position = column.kind == ColumnBetween::Kind::position;
  Launch launch = launch_of(device, is_position ? "interpolate_positions" : "interpolate_values");
  launch.value(p);
  if (is_position) launch.value(parameters_of(column.path, snapshots));
  launch.arg(snapshots.first).arg(snapshots.second);
  if (is_position) launch.arg(snapshots.first_velocity).arg(snapshots.second_velocity);
  launch.arg(snapshots.place_in_second).arg(values);
  run(launch, p);
}

}  // namespace splotchcl
