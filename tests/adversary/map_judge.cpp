#include "adversary/map_judge.h"

#include "adversary/exact_map.h"
#include "adversary/places.h"
#include "splotchcl/map.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

// Of a sum over the map, over that of the weights.
double mean_of(const ExactMap& map, double (*of_pixel)(const PixelOfMap&)) {
  double sum = 0, weights = 0;
  for (const PixelOfMap& pixel : map) {
    sum += of_pixel(pixel);
    weights += pixel.weight;
  }
  return weights > 0 ? sum / weights : 0;
}
double mean_size(const ExactMap& map) {
  return mean_of(map, [](const PixelOfMap& pixel) { return pixel.both(); });
}

// A value of the map, and by how many tolerances it may err.
struct Value {
  double exact = 0, allowed = 0;
};

// Sums of weights times something of the values, and the floor of both of their parts: of their
// mean, or a hair of what the brightest particle gives a pixel.
class Sums {
 public:
  Sums() = default;
  Sums(const Trial& trial, const OfValue& of_value, double floor)
      : pixels_(exact_map(trial, of_value)), size_(mean_size(pixels_)) {
    const auto light = [&](double value) { return std::max(std::abs(of_value(value)), size_); };
    floor_ = std::max(floor * size_, 0x1p-50 * brightest_particle(trial, light));
  }

  const PixelOfMap& at(std::size_t i) const { return pixels_[i]; }
  std::size_t count() const { return pixels_.size(); }
  double size() const { return size_; }
  double mean() const {
    return mean_of(pixels_, [](const PixelOfMap& pixel) { return pixel.above - pixel.below; });
  }

  // Whether the ends of kernels decide about it.
  bool is_open(std::size_t i, double least) const {
    return pixels_[i].open_both > least * std::max(pixels_[i].both(), floor_);
  }
  Value sum_at(std::size_t i) const {
    const PixelOfMap& pixel = pixels_[i];
    return {pixel.above - pixel.below, signs_at(i) * std::max(pixel.both(), floor_)};
  }
  // A mean errs as its two sums do.
  Value mean_at(std::size_t i) const {
    const PixelOfMap& pixel = pixels_[i];
    const double size = pixel.both() / pixel.weight;
    return {(pixel.above - pixel.below) / pixel.weight,
            signs_at(i) * (size + std::max(size, floor_ / pixel.weight))};
  }

 private:
  // What lies above and below 0 counts apart.
  double signs_at(std::size_t i) const {
    return pixels_[i].above > 0 && pixels_[i].below > 0 ? 2 : 1;
  }

  ExactMap pixels_;
  double size_ = 0, floor_ = 0;
};

class Promise {
 public:
  Promise(const Trial& trial, double floor)
      : kind_(trial.map),
        floor_(floor),
        values_(
            trial, [](double value) { return value; }, floor) {
    if (kind_ != MapKind::dispersion) return;
    // Of deviations in double precision, which 0 has where all values are the same.
    rounding_ = std::pow(0x1p-48 * values_.size(), 2);
    const double mean = values_.mean();
    values_ = Sums(
        trial, [mean](double value) { return value - mean; }, floor);
    squares_ = Sums(
        trial, [mean](double value) { return std::pow(value - mean, 2); }, floor);
  }

  // Means are not numbers below the floor; at it a rounding decides.
  bool has_value(std::size_t i, double tolerance) const {
    const double weight = values_.at(i).weight, least = 1e-3 * tolerance;
    if (values_.at(i).open_weight > least * std::max(weight, floor_)) return false;
    if (kind_ == MapKind::column) return true;
    if (values_.is_open(i, least)) return false;
    if (kind_ == MapKind::integral) return true;
    if (kind_ == MapKind::dispersion && squares_.is_open(i, least)) return false;
    return weight >= floor_ * (1 + 2 * tolerance);
  }

  // Of dispersions the square.
  Value value(std::size_t i) const {
    if (kind_ == MapKind::column) {
      const double weight = values_.at(i).weight;
      return {weight, std::max(weight, floor_)};
    }
    if (kind_ == MapKind::integral) return values_.sum_at(i);
    const Value first = values_.mean_at(i);
    if (kind_ == MapKind::mean) return first;
    const Value second = squares_.mean_at(i);
    return {second.exact - first.exact * first.exact,
            second.allowed + 2 * std::abs(first.exact) * first.allowed + rounding_};
  }

  std::size_t count() const { return values_.count(); }

 private:
  MapKind kind_;
  double floor_, rounding_ = 0;
  Sums values_, squares_;
};

}  // namespace

Measurement measure_map(const Trial& trial, Renderer& renderer) {
  std::vector<std::string> notes;
  const Map map = draw_map(
      map_scene_of(trial), map_snapshot_of(trial),
      [&renderer](const Frame& frame) { return renderer.render(frame); }, notes);
  Measurement worst;
  worst.promise = std::max(trial.tolerance, extended_tolerance);
  const Promise promise(trial, map.floor);
  for (std::size_t i = 0; i < promise.count(); ++i) {
    if (!promise.has_value(i, worst.promise)) continue;
    const Value value = promise.value(i);
    auto drawn = static_cast<double>(map.values[i]);
    if (trial.map == MapKind::dispersion) drawn *= drawn;
    const double error = std::abs(drawn - value.exact) / value.allowed;
    if (drawn == value.exact || error <= worst.error) continue;
    worst.error = std::isfinite(error) ? error : 1e300;
    worst.x = static_cast<int>(i) % map.width;
    worst.y = static_cast<int>(i) / map.width;
    worst.drawn = drawn;
    worst.exact = value.exact;
  }
  return worst;
}

}  // namespace splotchcl::adversary
