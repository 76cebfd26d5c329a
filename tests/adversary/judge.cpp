#include "adversary/judge.h"

#include "adversary/map_judge.h"
#include "adversary/shown_judge.h"
#include "adversary/trial_frame.h"
#include "splotchcl/plan.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

// Whether a disc's centre is so close to one of this pixel's edges that it may lie in either pixel,
// of which the one that holds it shows it however small it is.
bool may_hold_center(double place, int pixel, double known_to) {
  return std::min(std::abs(place - pixel), std::abs(place - pixel - 1)) <= known_to;
}

// Pixels whose centre is so close to the edge of a cut disc that single precision may put it on
// either side, or whose edge is so close to a disc's centre, which docs/accuracy.md takes out of
// the promise.
std::vector<bool> pixels_on_cut_edges(const Frame& frame) {
  const Rectangle& crop = frame.crop;
  std::vector<bool> on_edge(static_cast<std::size_t>(crop.width) *
                            static_cast<std::size_t>(crop.height));
  if (!frame.kernel.cut) return on_edge;
  for (const reference::Splat& splat : reference::project(frame)) {
    const double edge = *frame.kernel.cut * splat.sigma;
    const double known_to = 1e-6 * (std::max(frame.width, frame.height) + edge);
    for (int y = 0; y < crop.height; ++y) {
      for (int x = 0; x < crop.width; ++x) {
        const double distance =
            std::hypot((crop.x + x + 0.5 - splat.x) / splat.stretch, crop.y + y + 0.5 - splat.y);
        const bool is_beside =
            std::hypot(crop.x + x + 0.5 - splat.x, crop.y + y + 0.5 - splat.y) < 1 &&
            (may_hold_center(splat.x, crop.x + x, known_to) ||
             may_hold_center(splat.y, crop.y + y, known_to));
        if (std::abs(distance - edge) > known_to && !is_beside) continue;
        on_edge[static_cast<std::size_t>(y * crop.width + x)] = true;
      }
    }
  }
  return on_edge;
}

// Pixel by pixel.
double certified_at(const FrameCheck& check, int pixel, int width) {
  return static_cast<double>(check.blocks.at(pixel % width, pixel / width));
}

void compare(const Image& image, const ReferenceImage& exact, const std::vector<bool>& left_out,
             const FrameCheck& check, Measurement& worst) {
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3 || left_out[i / 4]) continue;
    const auto drawn = static_cast<double>(image.pixels[i]);
    const double error =
        std::abs(drawn - exact.pixels[i]) / std::max(1.0, std::abs(exact.pixels[i]));
    const auto pixel = static_cast<int>(i / 4);
    if (check.is_bound && error > 0) {
      const double certified = certified_at(check, pixel, exact.width);
      worst.certified = std::max(worst.certified, certified);
      worst.over_certified = std::max(worst.over_certified, error / certified);
    }
    if (error <= worst.error) continue;
    worst.error = std::isfinite(error) ? error : 1e300;
    worst.x = pixel % exact.width;
    worst.y = pixel / exact.width;
    worst.channel = static_cast<int>(i % 4);
    worst.drawn = drawn;
    worst.exact = exact.pixels[i];
  }
}

}  // namespace

Measurement Judge::measure(const Trial& trial) {
  if (trial.map != MapKind::none) return measure_map_or_refusal(trial);
  if (trial.shown.is_on > 0) return measure_shown(trial, renderer(trial.shape, false));
  const Frame frame = make_frame(trial);
  const Frame merged = make_merged_frame(trial);
  Renderer& renderer = this->renderer(trial.shape, trial.certify > 0);
  PlanOptions options;
  options.certify = trial.certify > 0;
  if (trial.slabs > 0) options.slabs = static_cast<int>(trial.slabs);
  const Image image = renderer.render(frame, make_plan(frame, options));
  Measurement measurement;
  measurement.plan = choose_light(frame);
  measurement.promise = std::max(trial.tolerance, extended_tolerance);
  compare(image, reference::render(merged), pixels_on_cut_edges(merged), renderer.stats().check,
          measurement);
  return measurement;
}

// A map that is refused breaks no promise.
Measurement Judge::measure_map_or_refusal(const Trial& trial) {
  try {
    return measure_map(trial, renderer(trial.shape, false));
  } catch (const UsageError&) {
    Measurement none;
    none.promise = std::max(trial.tolerance, extended_tolerance);
    return none;
  }
}

Renderer& Judge::renderer(CompositeShape shape, bool certify) {
  std::unique_ptr<Renderer>& renderer = renderers_[{shape, certify}];
  if (renderer) return *renderer;
  RendererOptions options;
  options.shape = shape;
  options.certify = certify;
  renderer = std::make_unique<Renderer>(options);
  return *renderer;
}

}  // namespace splotchcl::adversary
