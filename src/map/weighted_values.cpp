#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "map/sums.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

constexpr std::size_t denominator = 0, above = 1, below = 2;  // the channels of a frame

}  // namespace

WeightedValues::WeightedValues(const PlacedParticles& placed, const MapQuantity& quantity,
                               double floor, const MapGeometry& geometry, double kernel_width,
                               double particles_per_drawn)
    : placed_(placed),
      kind_(quantity.kind),
      pixel_(geometry.pixel),
      is_slice_(!placed.in_plane.empty()),
      weight_(placed.count(), 0.0F) {
  if (needs_values()) value_ = quantity.value;
  read_weights(quantity);
  double inside = 0;
  for (std::size_t i = 0; i < placed.count(); ++i)
    inside += static_cast<double>(placed.share[i]) * static_cast<double>(weight_[i]);
  const double mean = inside / (static_cast<double>(geometry.width) * geometry.height);
  floor_ = std::max(floor * mean, least_floor(placed.size, weight_, {}, kernel_width));
  if (!(floor_ > 0)) floor_ = 1;
  weight_unit_ *= particles_per_drawn * quantity.weight_unit;
}

bool WeightedValues::needs_values() const {
  return kind_ != MapQuantity::Kind::column && kind_ != MapQuantity::Kind::counts;
}

double WeightedValues::weight_of(const MapQuantity& quantity, std::size_t i) const {
  return static_cast<double>(quantity.weight[placed_.source[i]]) *
         (is_slice_ ? placed_.in_plane[i] : 1);
}

void WeightedValues::read_weights(const MapQuantity& quantity) {
  double sum = 0;
  // Images of a particle follow each other.
  const auto is_first_image = [this](std::size_t i) {
    return i == 0 || placed_.source[i] != placed_.source[i - 1];
  };
  std::vector<std::size_t> bad;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    if (quantity.is_good(placed_.source[i])) {
      sum += weight_of(quantity, i);
      continue;
    }
    bad.push_back(i);
    if (is_first_image(i)) ++bad_;
  }
  if (sum > 0) weight_unit_ = sum / static_cast<double>(weight_.size());
  for (std::size_t i = 0; i < weight_.size(); ++i)
    weight_[i] = static_cast<float>(weight_of(quantity, i) / weight_unit_);
  for (const std::size_t i : bad)
    weight_[i] = 0;
}

// From a sum per pixel to one per area, or per volume in a plane; counts stay per pixel.
double WeightedValues::area_factor() const {
  if (kind_ == MapQuantity::Kind::counts) return 1;
  return 1 / (is_slice_ ? pixel_ * pixel_ * pixel_ : pixel_ * pixel_);
}

double WeightedValues::floor() const {
  return floor_ * weight_unit_ * area_factor();
}

double WeightedValues::value_floor() const {
  switch (kind_) {
    case MapQuantity::Kind::column:
    case MapQuantity::Kind::counts:
      return floor();
    case MapQuantity::Kind::integral:
      return floor() * value_unit_;
    case MapQuantity::Kind::mean:
    case MapQuantity::Kind::dispersion:
      break;
  }
  return 0;
}

double WeightedValues::mean_of(const OfValue& of_value) const {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const double weight = static_cast<double>(placed_.share[i]) * static_cast<double>(weight_[i]);
    if (!(weight > 0)) continue;
    sum += weight * of_value(value_of(i));
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

PixelSums WeightedValues::draw_weights(const SumPicture& picture, const DrawFrame& draw) const {
  return draw_sums(placed_, placed_.size, {weight_, {}, floor_}, picture, draw);
}

// One for the weights alone, and what lies above 0 and below it: colors cannot be negative. In
// their unit all have the same mean, and so the same floor.
WeightedValues::ValueSums WeightedValues::draw_values(const OfValue& of_value,
                                                      const SumPicture& picture,
                                                      const DrawFrame& draw) const {
  constexpr double most = std::numeric_limits<float>::max();
  ValueSums drawn;
  const double size = mean_of([&](double value) { return std::abs(of_value(value)); });
  if (size > 0) drawn.unit = size;
  std::vector<float> factors(3 * weight_.size(), 0.0F);
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    factors[3 * i + denominator] = 1;
    if (!(weight_[i] > 0)) continue;
    const double value = of_value(value_of(i)) / drawn.unit;
    factors[3 * i + (value > 0 ? above : below)] =
        static_cast<float>(std::min(std::abs(value), most));
  }
  // Beside the largest of values whose range is very large the weights would have no digits left.
  const bool is_floor_raised =
      least_floor(placed_.size, weight_, factors, picture.kernel_width) > floor_;
  drawn.sums =
      draw_sums(placed_, placed_.size, {weight_, std::move(factors), floor_}, picture, draw);
  if (is_floor_raised) drawn.sums[denominator] = draw_weights(picture, draw)[denominator];
  return drawn;
}

std::vector<double> WeightedValues::means(const ValueSums& drawn) const {
  const PixelSums& sums = drawn.sums;
  std::vector<double> means(sums[denominator].size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double weight = sums[denominator][i];
    if (is_known(weight)) means[i] = drawn.unit * (sums[above][i] - sums[below][i]) / weight;
  }
  return means;
}

// Of deviations from the mean of all, which lose fewer digits than the values themselves.
std::vector<double> WeightedValues::draw_dispersion(const SumPicture& picture,
                                                    const DrawFrame& draw) {
  const double mean = mean_of([](double value) { return value; });
  const ValueSums drawn = draw_values([mean](double value) { return value - mean; }, picture, draw);
  keep(drawn.sums[denominator]);
  const std::vector<double> first = means(drawn);
  const auto square = [mean](double value) { return (value - mean) * (value - mean); };
  std::vector<double> values = means(draw_values(square, picture, draw));
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Rounding may leave a hair below 0 where all values are the same.
    const double variance = values[i] - first[i] * first[i];
    values[i] = std::isnan(variance) ? variance : std::sqrt(std::max(0.0, variance));
  }
  return values;
}

// Three channels are the colors of a frame.
std::vector<double> WeightedValues::draw_channels(const VelocityChannels& channels,
                                                  const SumPicture& picture,
                                                  const DrawFrame& draw) const {
  constexpr int at_once = 3;
  std::vector<double> values;
  for (int first = 0; first < channels.count; first += at_once) {
    const int end = std::min(first + at_once, channels.count);
    std::vector<float> factors(at_once * weight_.size(), 0.0F);
    for (std::size_t i = 0; i < weight_.size(); ++i) {
      if (!(weight_[i] > 0)) continue;
      for (int c = first; c < end; ++c)
        factors[at_once * i + static_cast<std::size_t>(c - first)] =
            static_cast<float>(channels.part(placed_.source[i], c));
    }
    const SumRequest request = {weight_, std::move(factors), floor_ / channels.count, false};
    PixelSums sums = draw_sums(placed_, placed_.size, request, picture, draw);
    for (int c = first; c < end; ++c) {
      const std::vector<double>& sum = sums[static_cast<std::size_t>(c - first)];
      values.insert(values.end(), sum.begin(), sum.end());
    }
  }
  for (double& value : values)
    value *= weight_unit_ * area_factor();
  return values;
}

// They are as large as the map.
void WeightedValues::keep(const std::vector<double>& sums) {
  if (keeps_weight_sums_) weight_sums_ = sums;
}

std::vector<double> WeightedValues::draw(const SumPicture& picture, const DrawFrame& draw) {
  if (kind_ == MapQuantity::Kind::dispersion) return draw_dispersion(picture, draw);
  if (!needs_values()) {
    PixelSums sums = draw_weights(picture, draw);
    std::vector<double> values = std::move(sums[denominator]);
    keep(values);
    for (double& value : values)
      value *= weight_unit_ * area_factor();
    return values;
  }
  const ValueSums drawn = draw_values([](double value) { return value; }, picture, draw);
  keep(drawn.sums[denominator]);
  if (kind_ == MapQuantity::Kind::mean) return means(drawn);
  value_unit_ = drawn.unit;
  std::vector<double> values(drawn.sums[denominator].size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] =
        (drawn.sums[above][i] - drawn.sums[below][i]) * value_unit_ * weight_unit_ * area_factor();
  }
  return values;
}

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
