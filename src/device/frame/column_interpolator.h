#pragma once

#include "between/interpolation.h"
#include "device/opencl/device_context.h"

namespace splotchcl {

// What the device has of the two snapshots: of the first in its own order, of the second as
// order_second_on_device() puts it. Strides are 0 where one value serves all, or none.
struct SnapshotColumns {
  compute::buffer first, second, first_velocity, second_velocity, place_in_second;
  int first_stride = 0, second_stride = 0, first_velocity_stride = 0, second_velocity_stride = 0;
};

// A column of the second snapshot in the order of the particles between the two. Does not wait.
void order_second_on_device(DeviceContext& device, const IdMatch& match, int values_per_particle,
                            const compute::buffer& second, const compute::buffer& place_in_second,
                            const compute::buffer& appearing, const compute::buffer& ordered);

// Makes a column between two snapshots on the device, to the bits of interpolate(): the stage
// `interpolate`. Does not wait.
void interpolate_on_device(DeviceContext& device, const ColumnBetween& column,
                           const SnapshotColumns& snapshots, const compute::buffer& values);

}  // namespace splotchcl
