#include "device/opencl/native_exp2.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "device/opencl/launch.h"
#include "kernels/common/group.h"

namespace splotchcl {
namespace {

// Two in three of what the error budget counts of the polynomial (splat_limits.cpp), since an error
// may be larger between the places that are tried.
constexpr double most_error = 1.8e-6;
constexpr double lowest = -126;

std::vector<float> places() {
  constexpr int in_each_half = 1 << 15;
  std::vector<float> t;
  for (int i = 0; i < in_each_half; ++i) {
    const double part = static_cast<double>(i) / in_each_half;
    t.push_back(static_cast<float>(-part));
    t.push_back(static_cast<float>(lowest * part));
  }
  t.push_back(static_cast<float>(lowest));
  while (t.size() % GROUP_ITEMS != 0)
    t.push_back(static_cast<float>(lowest - static_cast<double>(t.size() % GROUP_ITEMS)));
  return t;
}

}  // namespace

double error_of_native_exp2(DeviceContext& device) {
  const std::vector<float> t = places();
  const auto values = device.pool.get<float>(t.size(), "tried values");
  Launch(device, "open",
         device.programs.get(program_source("kernels/composite/try_native_exp2.cl"))
             .create_kernel("try_native_exp2"))
      .arg(device.pool.upload(t, "tried places"))
      .arg(values)
      .run_groups(t.size() / GROUP_ITEMS, GROUP_ITEMS);
  const std::vector<float> found = device.pool.download(values, t.size());
  device.timer.clear();
  double largest = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double expected = std::exp2(std::max(static_cast<double>(t[i]), lowest));
    const double value = static_cast<double>(found[i]);
    const bool is_below = static_cast<double>(t[i]) < lowest;
    const double error =
        is_below ? (std::abs(value) <= expected ? 0 : std::numeric_limits<double>::infinity())
                 : std::abs(value / expected - 1);
    largest = error >= 0 ? std::max(largest, error) : std::numeric_limits<double>::infinity();
  }
  return largest;
}

bool native_exp2_serves(DeviceContext& device) {
  return error_of_native_exp2(device) <= most_error;
}

}  // namespace splotchcl
