#include "map/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/constants.h"

namespace splotchcl {

// The square of a Gaussian is one of sigma / sqrt(2), and drawn so wide, that those far below a
// pixel stay in theirs. With s^2 = sigma^2 + 1 / (2 pi) in pixels a particle of mass m adds m^2 /
// (2 pi s^2) in all, which for one far below a pixel is m^2.
std::vector<float> draw_effective_particles(const PlacedParticles& placed,
                                            const WeightedValues& weighted,
                                            const SumPicture& picture, double floor,
                                            const DrawFrame& draw) {
  const std::size_t count = placed.count();
  std::vector<float> size(count), weight(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double sigma = picture.kernel_width * static_cast<double>(placed.size[i]);
    const double square = sigma * sigma + 1 / (2 * pi);
    const auto mass = static_cast<double>(weighted.weights()[i]);
    size[i] = static_cast<float>(static_cast<double>(placed.size[i]) / std::sqrt(2.0));
    weight[i] = static_cast<float>(mass * mass / (2 * pi * square));
  }
  // By the square of the floor below the mean, since squares of many small weights are small.
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i)
    squares += static_cast<double>(placed.share[i]) * static_cast<double>(weight[i]);
  const double pixels = static_cast<double>(picture.width) * picture.height;
  const double least = squares > 0 ? floor * floor * squares / pixels : 1;
  const PixelSums sums = draw_sums(placed, size, {weight, {}, least}, picture, draw);
  // Of equal weights all would count, and one at least does: beyond that lies the error of both
  // sums.
  const auto most = static_cast<double>(std::count_if(
      weighted.weights().begin(), weighted.weights().end(), [](float w) { return w > 0; }));
  std::vector<float> effective(sums[0].size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < effective.size(); ++i) {
    const double sum = weighted.weight_sums()[i];
    if (!weighted.is_known(sum) || !(sums[0][i] > 0)) continue;
    effective[i] = static_cast<float>(std::clamp(sum * sum / sums[0][i], 1.0, most));
  }
  return effective;
}

}  // namespace splotchcl
