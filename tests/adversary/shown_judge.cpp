#include "adversary/shown_judge.h"

#include "adversary/trial_frame.h"
#include "finish/effects.h"
#include "finish/tone.h"
#include "pictures/other_scenes.h"
#include "pictures/units_of_white.h"
#include "splotchcl/plan.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

constexpr double gamma = 2.2;

FinishSettings finish_of(const Trial& trial) {
  const Shown& shown = trial.shown;
  FinishSettings finish;
  finish.tone = trial.tone;
  finish.exposure = shown.exposure;
  finish.white = shown.white;
  if (shown.automatic > 0) {
    finish.exposure.reset();
    finish.white.reset();
  }
  if (shown.balance > 0) finish.white_balance = shown.balance;
  finish.bloom = shown.bloom;
  finish.highlights = shown.highlights;
  finish.saturation = shown.saturation;
  finish.contrast = shown.contrast;
  finish.contrast_pivot = shown.pivot;
  return finish;
}

// As the program draws it, until it keeps its promise under the exposure that it finds.
DrawnPictures draw(const Trial& trial, const Frame& frame, Renderer& renderer) {
  Scene scene;
  scene.image.gamma = gamma;
  scene.finish = finish_of(trial);
  const auto draw_frame = [&](const Frame& view) {
    PlanOptions options;
    if (trial.slabs > 0) options.slabs = static_cast<int>(trial.slabs);
    return renderer.render(view, make_plan(view, options));
  };
  const auto keeps_promise = [&](double gain) {
    const std::vector<double>& errors = renderer.stats().check.errors_of_promise;
    return !errors.empty() && keeps_promise_at(gain, errors.back());
  };
  std::vector<std::string> notes;
  OtherScenes others;
  return draw_pictures(scene, frame, SnapshotInfo(), draw_frame, notes, others, PictureLight::shown,
                       keeps_promise);
}

double brightest(const Image& image, std::size_t pixel) {
  const float* const channels = &image.pixels[4 * pixel];
  return static_cast<double>(std::max({channels[0], channels[1], channels[2]}));
}

// In units of white or, beyond it, of the pixel's brightest channel: before saturation and
// contrast, too, where no curve has ended at white.
double unit_of(const Image& toned, const Image& shown, std::size_t pixel) {
  return std::max({1.0, brightest(toned, pixel), brightest(shown, pixel)});
}

void compare(const Image& image, const Image& toned, const Image& exact, Measurement& worst) {
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const auto drawn = static_cast<double>(image.pixels[i]);
    const auto right = static_cast<double>(exact.pixels[i]);
    const double error = std::abs(drawn - right) / unit_of(toned, exact, i / 4);
    if (error <= worst.error) continue;
    worst.error = std::isfinite(error) ? error : 1e300;
    worst.x = static_cast<int>(i / 4) % exact.width;
    worst.y = static_cast<int>(i / 4) / exact.width;
    worst.channel = static_cast<int>(i % 4);
    worst.drawn = drawn;
    worst.exact = right;
  }
}

// Gray absorption has no light that could be brightened, and is drawn to extended_tolerance at
// best.
double promise_of(const Trial& trial, const FinishSettings& finish) {
  if (trial.light != Light::gray) return trial.tolerance;
  return std::max(trial.tolerance, extended_tolerance * display_gain(finish, gamma).total());
}

}  // namespace

Measurement measure_shown(const Trial& trial, Renderer& renderer) {
  const Frame frame = make_frame(trial);
  const DrawnPictures drawn = draw(trial, frame, renderer);
  Measurement measurement;
  measurement.plan = choose_light(frame);
  measurement.promise = promise_of(trial, drawn.finish);
  Image exact = reference::render(make_merged_frame(trial)).to_float();
  add_bloom(exact, drawn.finish.bloom);
  FinishSettings only_toned = drawn.finish;
  only_toned.saturation = only_toned.contrast = 1;
  Image toned = exact;
  adjust_light(toned, only_toned, gamma);
  adjust_light(exact, drawn.finish, gamma);
  compare(drawn.pictures.front().image, toned, exact, measurement);
  return measurement;
}

}  // namespace splotchcl::adversary
