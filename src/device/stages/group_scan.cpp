#include "device/stages/group_scan.h"

#include <vector>

#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"

namespace splotchcl {

GroupScan::GroupScan(DeviceContext& device)
    : device_(device),
      program_(device.programs.get(program_source("kernels/scan/scan_groups.cl"))),
      nothing_(device.pool.upload(std::vector<std::uint32_t>{0}, "start of a scan")) {}

void GroupScan::scan(const char* stage, const Buffer<std::uint32_t>& values,
                     std::uint32_t count) const {
  shared::ScanParameters parameters{count, 0};
  const std::uint32_t groups = ceil_divide(count, SCAN_STRETCH);
  // An empty list has a sum, too.
  if (groups <= 1) {
    Launch(device_, stage, program_.create_kernel("scan_stretches"))
        .value(parameters)
        .arg(values)
        .arg(nothing_)
        .run_groups(1, GROUP_ITEMS);
    return;
  }
  const auto sums = device_.pool.get<std::uint32_t>(std::uint64_t{groups} + 1, "sums of stretches");
  Launch(device_, stage, program_.create_kernel("scan_reduce"))
      .value(parameters)
      .arg(values)
      .arg(sums)
      .run_groups(groups, GROUP_ITEMS);
  if (groups <= SCAN_STRETCH) {
    parameters.adds_up_groups = 1;
  } else {
    scan(stage, sums, groups);
  }
  Launch(device_, stage, program_.create_kernel("scan_stretches"))
      .value(parameters)
      .arg(values)
      .arg(sums)
      .run_groups(groups, GROUP_ITEMS);
}

}  // namespace splotchcl
