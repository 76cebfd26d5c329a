#pragma once

#include <cstdint>
#include <vector>

#include "map/geometry.h"
#include "map/placed_particles.h"
#include "map/quantity.h"
#include "map/sums.h"

namespace splotchcl {

// A quantity of placed particles: which sums it needs, and what follows from them. Weights and
// values are brought to numbers near 1, whatever the snapshot's units are.
class WeightedValues {
 public:
  // `floor` is a part of the mean of the weights' column. Each particle that was read stands for
  // `particles_per_drawn` of the snapshot; the weights of those that stand for more are larger.
  WeightedValues(const PlacedParticles& placed, const MapQuantity& quantity, double floor,
                 const MapGeometry& geometry, double particles_per_drawn);

  // Values of the map in the snapshot's units, row 0 at the top. Not a number where the weights
  // of a mean are below the floor.
  std::vector<double> draw(const SumPicture& picture, const DrawFrame& draw);

  // Of the weights' column, in the snapshot's units.
  double floor() const;
  // Of the map's values, likewise; 0 where they are means.
  double value_floor() const;
  std::uint64_t bad() const { return bad_; }

  // As they are drawn.
  const std::vector<float>& weights() const { return weight_; }
  const std::vector<double>& weight_sums() const { return weight_sums_; }  // after draw()
  // Whether a sum of weights, as it is drawn, reaches the floor.
  bool is_known(double sum) const { return sum >= white_ && sum > 0; }

 private:
  bool needs_values() const;
  void read_weights(const MapQuantity& quantity);
  void read_values(const MapQuantity& quantity);
  PixelSums draw_factors(const std::vector<float>& factors, const SumPicture& picture,
                         const DrawFrame& draw) const;
  std::vector<float> factors(double subtracted) const;
  std::vector<double> means(const PixelSums& sums) const;
  double area_factor() const;

  const PlacedParticles& placed_;
  MapQuantity::Kind kind_;
  double pixel_;
  bool is_slice_;
  std::vector<float> weight_;  // over weight_unit_; 0 for a bad particle
  std::vector<float> value_;   // over value_unit_
  double weight_unit_ = 1, value_unit_ = 1;
  double white_ = 1;
  std::uint64_t bad_ = 0;
  std::vector<double> weight_sums_;
};

}  // namespace splotchcl
