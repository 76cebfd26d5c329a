#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "map/geometry.h"
#include "map/quantity.h"
#include "splotchcl/scene.h"
#include "splotchcl/views.h"

namespace splotchcl {

// Sums over particles, pixel by pixel, as the red, green and blue of one frame that nothing
// absorbs: they share their splats.
struct SumRequest {
  // Of each placed particle, >= 0: what its kernel spreads over the picture. It outlives the
  // request.
  const std::vector<float>& weight;
  // Three factors >= 0 of each placed particle, one for each sum; empty: the weights alone are
  // summed up. The second and the third are two parts of one sum, as what lies above 0 and below.
  std::vector<float> factors;
  // Per pixel, > 0, and at least least_floor() of the weights. Each sum is known to the tolerance
  // of itself, or of both parts together, or of this or least_floor() where that is more.
  double floor = 1;
  // Else they are three sums, of which each is known to the tolerance of itself or of the floor.
  bool are_parts = true;
};

// Per pixel, row 0 at the top, in the weights' unit; without factors the first one alone.
using PixelSums = std::array<std::vector<double>, 3>;

struct SumPicture {
  int width = 0, height = 0;
  double kernel_width = 1;  // sigma = kernel_width * h
  double tolerance = 1e-3;
};

// The least floor that sums of these may have: a hair of what the brightest particle gives a pixel,
// beyond which devices have no digits. `factors` may be empty (SumRequest).
double least_floor(const std::vector<float>& size, const std::vector<float>& weight,
                   const std::vector<float>& factors, double kernel_width);

// `size` is h of each placed particle in pixels.
PixelSums draw_sums(const PlacedParticles& placed, const std::vector<float>& size,
                    SumRequest request, const SumPicture& picture, const DrawFrame& draw);

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
