#include "map/weighted_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splotchcl {
namespace {

constexpr std::size_t denominator = 0, above = 1, below = 2;  // the channels of a frame

// The one in the middle of those that are not 0; 1 where all are.
double typical_size(std::vector<float> values) {
  for (float& value : values)
    value = std::abs(value);
  values.erase(std::remove(values.begin(), values.end(), 0.0F), values.end());
  if (values.empty()) return 1;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

}  // namespace

WeightedValues::WeightedValues(const PlacedParticles& placed, const MapQuantity& quantity,
                               double floor, const MapGeometry& geometry,
                               double particles_per_drawn)
    : placed_(placed),
      kind_(quantity.kind),
      pixel_(geometry.pixel),
      is_slice_(!placed.in_plane.empty()),
      weight_(placed.count(), 0.0F),
      value_(needs_values() ? placed.count() : 0, 0.0F) {
  if (needs_values()) read_values(quantity);
  read_weights(quantity);
  double inside = 0;
  for (std::size_t i = 0; i < placed.count(); ++i)
    inside += static_cast<double>(placed.share[i]) * static_cast<double>(weight_[i]);
  const double mean = inside / (static_cast<double>(geometry.width) * geometry.height);
  white_ = mean > 0 ? floor * mean : 1;
  weight_unit_ *= particles_per_drawn;
}

bool WeightedValues::needs_values() const {
  return kind_ != MapQuantity::Kind::column && kind_ != MapQuantity::Kind::counts;
}

void WeightedValues::read_values(const MapQuantity& quantity) {
  for (std::size_t i = 0; i < placed_.count(); ++i)
    value_[i] = quantity.value[placed_.source[i]];
  std::vector<float> finite;
  std::copy_if(value_.begin(), value_.end(), std::back_inserter(finite),
               [](float value) { return std::isfinite(value); });
  value_unit_ = typical_size(std::move(finite));
  for (float& value : value_)
    value = static_cast<float>(static_cast<double>(value) / value_unit_);
}

void WeightedValues::read_weights(const MapQuantity& quantity) {
  std::vector<double> weights(placed_.count(), 0);
  double sum = 0;
  // Images of a particle follow each other.
  const auto is_first_image = [this](std::size_t i) {
    return i == 0 || placed_.source[i] != placed_.source[i - 1];
  };
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!quantity.is_good(placed_.source[i])) {
      if (is_first_image(i)) ++bad_;
      if (!value_.empty()) value_[i] = 0;
      continue;
    }
    weights[i] = static_cast<double>(quantity.weight[placed_.source[i]]) *
                 (is_slice_ ? placed_.in_plane[i] : 1);
    sum += weights[i];
  }
  if (sum > 0) weight_unit_ = sum / static_cast<double>(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i)
    weight_[i] = static_cast<float>(weights[i] / weight_unit_);
}

// From a sum per pixel to one per area, or per volume in a plane; counts stay per pixel.
double WeightedValues::area_factor() const {
  if (kind_ == MapQuantity::Kind::counts) return 1;
  return 1 / (is_slice_ ? pixel_ * pixel_ * pixel_ : pixel_ * pixel_);
}

double WeightedValues::floor() const {
  return white_ * weight_unit_ * area_factor();
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

// One for the weights alone, and what of the values lies above 0 and below it: colors cannot be
// negative.
std::vector<float> WeightedValues::factors(double subtracted) const {
  std::vector<float> factors(3 * weight_.size(), 0.0F);
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    factors[3 * i + denominator] = 1;
    if (value_.empty()) continue;
    const auto value = static_cast<float>(static_cast<double>(value_[i]) - subtracted);
    factors[3 * i + above] = std::max(value, 0.0F);
    factors[3 * i + below] = std::max(-value, 0.0F);
  }
  return factors;
}

PixelSums WeightedValues::draw_factors(const std::vector<float>& factors, const SumPicture& picture,
                                       const DrawFrame& draw) const {
  return draw_sums(placed_, placed_.size, {weight_, factors, white_}, picture, draw);
}

std::vector<double> WeightedValues::means(const PixelSums& sums) const {
  std::vector<double> means(sums[denominator].size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double weight = sums[denominator][i];
    if (is_known(weight)) means[i] = (sums[above][i] - sums[below][i]) / weight;
  }
  return means;
}

std::vector<double> WeightedValues::draw(const SumPicture& picture, const DrawFrame& draw) {
  // Deviations from the mean of all lose fewer digits than the values themselves.
  double mean = 0, sum = 0;
  for (std::size_t i = 0; i < value_.size() && kind_ == MapQuantity::Kind::dispersion; ++i) {
    mean += static_cast<double>(weight_[i]) * static_cast<double>(value_[i]);
    sum += static_cast<double>(weight_[i]);
  }
  mean = sum > 0 ? mean / sum : 0;
  PixelSums sums = draw_factors(factors(mean), picture, draw);
  weight_sums_ = sums[denominator];

  std::vector<double> values;
  switch (kind_) {
    case MapQuantity::Kind::column:
    case MapQuantity::Kind::counts:
      values = weight_sums_;
      for (double& value : values)
        value *= weight_unit_ * area_factor();
      return values;
    case MapQuantity::Kind::integral:
      values.resize(weight_sums_.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = (sums[above][i] - sums[below][i]) * weight_unit_ * value_unit_ * area_factor();
      return values;
    case MapQuantity::Kind::mean:
      values = means(sums);
      for (double& value : values)
        value *= value_unit_;
      return values;
    case MapQuantity::Kind::dispersion:
      break;
  }
  const std::vector<double> first = means(sums);
  std::vector<float> squares = factors(mean);
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const float deviation = squares[3 * i + above] - squares[3 * i + below];
    squares[3 * i + above] = deviation * deviation;
    squares[3 * i + below] = 0;
  }
  values = means(draw_factors(squares, picture, draw));
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Rounding may leave a hair below 0 where all values are the same.
    const double variance = values[i] - first[i] * first[i];
    values[i] = std::isnan(variance) ? variance : value_unit_ * std::sqrt(std::max(0.0, variance));
  }
  return values;
}

}  // namespace splotchcl
