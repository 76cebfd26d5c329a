#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "map/geometry.h"
#include "map/placed_particles.h"
#include "map/quantity.h"
#include "map/sums.h"

namespace splotchcl {

// A quantity of placed particles: which sums it needs, and what follows from them. Weights and
// values are brought to numbers whose means are 1, whatever the snapshot's units are.
class WeightedValues {
 public:
  // `floor` is a part of the mean of the weights' column; it may be raised (least_floor()). Each
  // particle that was read stands for `particles_per_drawn` of the snapshot; the weights of those
  // that stand for more are larger.
  WeightedValues(const PlacedParticles& placed, const MapQuantity& quantity, double floor,
                 const MapGeometry& geometry, double kernel_width, double particles_per_drawn);

  // Values of the map in the snapshot's units, row 0 at the top. Not a number where the weights
  // of a mean are below the floor.
  std::vector<double> draw(const SumPicture& picture, const DrawFrame& draw);

  // The same of sums in channels, one after the other.
  std::vector<double> draw_channels(const VelocityChannels& channels, const SumPicture& picture,
                                    const DrawFrame& draw) const;

  // Of the weights' column, in the snapshot's units.
  double floor() const;
  // Of the map's values, likewise; 0 where they are means. After draw().
  double value_floor() const;
  std::uint64_t bad() const { return bad_; }

  // As they are drawn.
  const std::vector<float>& weights() const { return weight_; }
  // After draw(), where they were to be kept before it.
  void keep_weight_sums() { keeps_weight_sums_ = true; }
  const std::vector<double>& weight_sums() const { return weight_sums_; }
  // Whether a sum of weights, as it is drawn, reaches the floor.
  bool is_known(double sum) const { return sum >= floor_ && sum > 0; }

 private:
  // Sums of weights times something of the particles' values.
  struct ValueSums {
    PixelSums sums;
    double unit = 1;  // of those above 0 and below it
  };
  using OfValue = std::function<double(double)>;

  bool needs_values() const;
  double weight_of(const MapQuantity& quantity, std::size_t i) const;
  void read_weights(const MapQuantity& quantity);
  double value_of(std::size_t i) const { return static_cast<double>(value_[placed_.source[i]]); }
  // The mean of something of the values by the weights within the picture.
  double mean_of(const OfValue& of_value) const;
  PixelSums draw_weights(const SumPicture& picture, const DrawFrame& draw) const;
  ValueSums draw_values(const OfValue& of_value, const SumPicture& picture,
                        const DrawFrame& draw) const;
  std::vector<double> draw_dispersion(const SumPicture& picture, const DrawFrame& draw);
  std::vector<double> means(const ValueSums& drawn) const;
  double area_factor() const;
  void keep(const std::vector<double>& sums);

  const PlacedParticles& placed_;
  MapQuantity::Kind kind_;
  double pixel_;
  bool is_slice_;
  std::vector<float> weight_;  // over weight_unit_; 0 for a bad particle
  Column value_;               // of the particles that were placed
  double weight_unit_ = 1;
  double value_unit_ = 1;  // of an integral's values: their mean size, after draw()
  double floor_ = 1;
  std::uint64_t bad_ = 0;
  bool keeps_weight_sums_ = false;
  std::vector<double> weight_sums_;
};

// (sum w)^2 / sum w^2 per pixel, with w what each particle adds there: how many particles of equal
// weight would be as noisy. Not a number where the weights are below the floor. `weighted` has been
// drawn.
// `floor` is the map's, a part of the mean.
std::vector<float> draw_effective_particles(const PlacedParticles& placed,
                                            const WeightedValues& weighted,
                                            const SumPicture& picture, double floor,
                                            const DrawFrame& draw);

}  // namespace splotchcl
