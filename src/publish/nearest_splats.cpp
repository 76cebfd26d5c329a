#include "publish/nearest_splats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "publish/viewer_picture.h"

namespace splotchcl {
namespace {

constexpr std::array<double, 5> first_gains = {1.0 / 4, 1.0 / 2, 1, 2, 4};
constexpr std::array<double, 3> hues_at = {1.0 / 32, 1.0 / 2, 1};
constexpr double gain_step = 1.2;
constexpr int most_steps = 16;

class Trials {
 public:
  Trials(const std::vector<LightSplat>& splats, const Frame& frame, const Image& shown,
         const DisplayLight& display)
      : splats_(splats), frame_(frame), shown_(shown), display_(display) {}

  // Whether this is nearer than all before.
  bool improves(const LightToOpacity& opacity) {
    NearestSplats tried;
    tried.opacity = opacity;
    tried.splats = viewer_splats(splats_, frame_, display_, opacity);
    measure(picture_of_viewers(tried.splats, frame_), tried);
    const bool is_nearer = !has_any_ || tried.rms_difference < best_.rms_difference;
    if (is_nearer) best_ = std::move(tried);
    has_any_ = true;
    return is_nearer;
  }

  // From the best gain up and down, as long as that helps.
  void refine() {
    const LightToOpacity from = best_.opacity;
    for (const double step : {gain_step, 1 / gain_step}) {
      LightToOpacity next = from;
      for (int i = 0; i < most_steps; ++i) {
        next.gain *= step;
        if (!improves(next)) break;
      }
    }
  }

  const NearestSplats& best() const { return best_; }

 private:
  void measure(const Image& picture, NearestSplats& tried) const {
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      if (i % 4 == 3) continue;
      const double difference =
          std::abs(static_cast<double>(picture.pixels[i]) - static_cast<double>(shown_.pixels[i]));
      sum += difference * difference;
      largest = std::max(largest, difference);
    }
    const double values = 0.75 * static_cast<double>(picture.pixels.size());
    tried.rms_difference = std::sqrt(sum / std::max(values, 1.0));
    tried.largest_difference = largest;
  }

  const std::vector<LightSplat>& splats_;
  const Frame& frame_;
  const Image& shown_;
  const DisplayLight& display_;
  NearestSplats best_;
  bool has_any_ = false;
};

}  // namespace

NearestSplats nearest_splats(const std::vector<LightSplat>& splats, const Frame& frame,
                             const Image& exact, const DisplayLight& display) {
  const Image shown = displayed(exact, display);
  Trials trials(splats, frame, shown, display);
  std::set<double> exponents = {1, std::min(1 / display.gamma, 1.0)};
  exponents.insert(std::sqrt(*exponents.begin()));
  for (const double exponent : exponents) {
    for (const double gain : first_gains)
      trials.improves({gain, exponent});
  }
  const LightToOpacity best = trials.best().opacity;
  for (const double hue_at : hues_at)
    trials.improves({best.gain, best.exponent, hue_at});
  trials.refine();
  return trials.best();
}

}  // namespace splotchcl
