#include "certificate/certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "certificate/color_light.h"
#include "certificate/octave_errors.h"
#include "certificate/picture_light.h"
#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

// What is less than this part of the promise is not looked at closely.
constexpr double negligible_part = 0.02;
// Where the promise is broken, whatever does more than this part of it is to be drawn better;
constexpr double least_part = 0.03;
// as bright splats, which take several times as long, only where all of them do this much;
constexpr double least_of_peaks = 0.3;
// as more slabs, of which each takes a part of a frame;
constexpr double least_of_slabs = 0.3, most_times_slabs = 100;
// and by so much more than what was found to be missing.
constexpr double margin = 1.5;
// What pixels err by in extended precision, and what lies behind depths of 1 each
// (docs/dev/accuracy.md, "Tolerance 0").
constexpr double of_extended = 7e-7, of_extended_depth = 6e-8;
// What colors may do before all of a picture's numbers get more digits.
constexpr double most_of_colors = 0.5;
// What is left for ends, at least, where nothing makes peaks smaller.
constexpr double least_room = 0.05;
// Where ends and peaks both break it, peaks are left a part of it.
constexpr double others = 4;

// Errors of one octave of splats in one block of pixels, over what is promised there.
struct Part {
  double ends = 0, peaks = 0, even = 0;
  double peak_light = 0;      // the light of the peaks that lie upon one another
  bool is_of_itself = false;  // peaks are counted as parts of themselves
};

// The part of itself by which every splat may err: the polynomial of exp, means of bright splats,
// and the roundings of sums. These have either sign: 6.5 standard deviations are passed once in
// 1e10 (docs/dev/accuracy.md).
double part_of_all_splats(const CollectedSplats& splats, const FramePlan& plan) {
  const double rounding = 0x1p-24, deviations = 6.5;
  const double of_sums = deviations * rounding * std::sqrt((splats.longest_list + 1) / 3);
  return plan.shape_error + plan.shares.pixel_mean + 8 * rounding + of_sums;
}

// What pixels err by whatever splats lie there. Series of phi make layers err by parts of
// themselves, of which a picture's light knows what they do.
double error_of_all_pixels(const CollectedSplats& splats, const FramePlan& plan) {
  constexpr double of_the_light = 8 * 0x1p-24;  // roundings of the light itself
  return (plan.needs_sort() ? 0 : plan.shares.phi) + plan.shares.early_stop +
         (plan.certify ? of_the_light : 0) + splats.around * plan.shares.promise;
}

Certificate even_certificate(const Image& image, double error, double promise) {
  Certificate certificate;
  certificate.blocks = BlockErrors(image.width, image.height);
  std::fill(certificate.blocks.errors.begin(), certificate.blocks.errors.end(),
            static_cast<float>(error));
  certificate.error_of_promise = error / promise;
  certificate.worst.rest = certificate.error_of_promise;
  return certificate;
}

// What colors do: bounded, or where that is not known estimated.
struct ColorError {
  double error = 0;
  bool is_bound = true;
};

// The picture says little of what opaque channels hide and others show: where not even extended
// precision would make the bound a part of what is promised, an estimate is left.
ColorError error_of_colors(const ColorLight& colors, std::size_t block, const BlockLight& light,
                           const FramePlan& plan, double estimate, double promise) {
  constexpr double gained_by_extended = 1e-4;  // of the roundings of a color
  if (!plan.certify || !colors.has_bounds()) return {estimate, false};
  const double bound = colors.bound_in_block(block, light);
  const double least = plan.is_extended() ? bound : gained_by_extended * bound;
  const bool hides_too_much =
      plan.needs_sort() && least > std::max(estimate, most_of_colors * promise);
  return hides_too_much ? ColorError{estimate, false} : ColorError{bound, true};
}

// All that the approximations of a drawn frame do to its blocks of pixels.
class FrameErrors {
 public:
  FrameErrors(const CollectedSplats& splats, const Image& image, const Frame& frame,
              const FramePlan& plan)
      : picture_(measure_light(image, splats.depths, frame, plan)),
        is_bound_(plan.certify),
        is_cut_(frame.kernel.cut.has_value()),
        promise_(plan.shares.promise),
        rest_(error_of_all_pixels(splats, plan)),
        part_of_all_(plan.certify ? part_of_all_splats(splats, plan) : 0),
        colors_(image, splats.depths, frame, plan),
        light_behind_(plan.light_behind),
        part_of_layers_(plan.needs_sort() ? plan.layers.part : 0),
        slabs_(plan.slabs),
        of_slabs_(splats.of_slabs),
        plan_(plan) {
    for (std::size_t octave = 0; octave < lights_.size(); ++octave)
      lights_[octave] = plan.needs.widths[octave].light;
    std::vector<std::optional<OctaveErrors>> octaves(splats.cells.size());
    for_blocks(octaves.size(), 1, [&](std::size_t first, std::size_t) {
      octaves[first].emplace(splats.cells[first], frame, plan);
    });
    octaves_.reserve(octaves.size());
    for (std::optional<OctaveErrors>& octave : octaves)
      octaves_.push_back(std::move(*octave));
  }

  std::size_t block_count() const { return picture_.blocks.size(); }

  double promise_of(std::size_t block) const { return promise_ * picture_.blocks[block].allowed; }

  // Over what is promised there; and of each octave its part.
  ErrorParts in_block(std::size_t block, std::vector<Part>& parts) const {
    const BlockLight& light = picture_.blocks[block];
    const double promise = promise_of(block), response = light.response / promise;
    const PixelBlock pixels = pixels_of_block(block, picture_.columns);
    share_even_light(pixels, light.even / promise, parts);
    ErrorParts sums;
    if (!of_slabs_.empty()) sums.slabs = static_cast<double>(of_slabs_[block]) / promise;
    sums.rest = of_colors(block).error +
                (rest_ + part_of_all_ * light.parts + part_of_layers_ * light.layers) / promise_;
    double light_of_itself = 0;
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
      parts[i].ends = response * octaves_[i].of_ends(pixels, negligible_part / response);
      const double peaks = octaves_[i].of_peaks(pixels, negligible_part / response);
      parts[i].peak_light = peaks > 0 ? peaks / octaves_[i].peak_error() : 0;
      const double of_itself =
          octaves_[i].part_of_itself(parts[i].peak_light) * light.relative / promise_;
      parts[i].peaks = std::min(response * peaks, of_itself);
      if (is_bound_) sums.rest += response * octaves_[i].of_places(pixels);
      sums.ends += parts[i].ends;
      sums.even += parts[i].even;
      parts[i].is_of_itself = of_itself < response * peaks;
      if (parts[i].is_of_itself)
        light_of_itself += parts[i].peak_light;
      else
        sums.peaks += parts[i].peaks;
    }
    // Where splats of several octaves err by parts of themselves, all of them err by no more than
    // the largest part, of their light together, since that is what fades to 1.
    double most_of_itself = 0;
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
      if (parts[i].is_of_itself)
        most_of_itself = std::max(most_of_itself, octaves_[i].part_of_itself(light_of_itself));
    }
    sums.peaks += most_of_itself * light.relative / promise_;
    return sums;
  }

  // What nothing but more digits of colors makes smaller, over what is promised.
  ColorError of_colors(std::size_t block) const {
    if (colors_.are_exact()) return {};
    const PixelBlock pixels = pixels_of_block(block, picture_.columns);
    double light = 0;
    for (const OctaveErrors& octave : octaves_)
      light += octave.light(pixels);
    const BlockLight& of_block = picture_.blocks[block];
    const double estimate =
        colors_.in_block(block, of_block, light / light_behind_, negligible_part * promise_);
    ColorError error = error_of_colors(colors_, block, of_block, plan_, estimate, promise_);
    error.error /= promise_;
    return error;
  }

  std::vector<Part> parts() const { return std::vector<Part>(octaves_.size()); }

  void add_needs(std::size_t block, const std::vector<Part>& parts, const ErrorParts& sums,
                 SplatNeeds& needs) const {
    const double error = sums.sum(), layers = picture_.blocks[block].layers;
    if (part_of_layers_ * layers / promise_ > least_part)
      needs.response_to_layers = std::max(needs.response_to_layers, margin * layers);
    // Peaks may be as small as they get.
    const double room = std::max(least_room, 1 - sums.rest - sums.peaks);
    const double of_ends = std::max(error, (sums.ends + sums.even) / room);
    // What changes of order do falls a little more slowly than slabs are more.
    if (sums.slabs > least_of_slabs) {
      const double more = std::min(2 * margin * std::max(1.0, error), most_times_slabs);
      needs.slabs = std::max(needs.slabs, static_cast<int>(std::ceil(more * slabs_)));
    }
    double peaks = 0, on_grids = 0;
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
      peaks += parts[i].peaks;
      if (!octaves_[i].is_on_picture()) on_grids += parts[i].peak_light;
      WidthNeed& need = needs.widths[static_cast<std::size_t>(octaves_[i].octave())];
      if (parts[i].ends > least_part || parts[i].even > least_part)
        need.farther = std::max(need.farther, std::log(margin * of_ends));
    }
    if (peaks <= least_of_peaks) return;
    // So many times smaller errors of peaks leave what is promised to the others.
    const double less = margin * std::min(error, others * peaks);
    // All coarse grids are made for what lies on any of them.
    needs.grid_light = std::max(needs.grid_light, margin * on_grids);
    // Edges of cut splats have no coarse grid that is good enough (make_plan.cpp).
    if (is_cut_ && on_grids > 0) needs.grid_light = std::max(needs.grid_light, margin);
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
      WidthNeed& need = needs.widths[static_cast<std::size_t>(octaves_[i].octave())];
      // Those beside the picture's own grid are drawn on it where no blurred grid is good enough.
      if (octaves_[i].level() == 0 && parts[i].peaks > least_part)
        need.light = std::max(need.light, more_light(octaves_[i], parts[i].peak_light, less));
    }
  }

 private:
  // What splats of an octave are to count as, for errors of their peaks to become so many times
  // smaller: their light, and as many times what they counted as, since the picture may amplify
  // errors and several octaves share the promise. Once all are means that keep their digits, more
  // gives nothing.
  double more_light(const OctaveErrors& octave, double peak_light, double times) const {
    const double had = lights_[static_cast<std::size_t>(octave.octave())];
    const double in_proportion = std::min(times * std::max(1.0, had), octave.light_of_means());
    return std::max({margin * peak_light, had, in_proportion});
  }

  // The block's even light, shared out among the octaves by how much light they have there.
  void share_even_light(const PixelBlock& pixels, double even, std::vector<Part>& parts) const {
    double light = 0;
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
      parts[i].even = octaves_[i].light(pixels);
      light += parts[i].even;
    }
    for (std::size_t i = 0; i < octaves_.size(); ++i)
      parts[i].even *= light > 0 ? octaves_[i].even_part() * even / light : 0;
  }

  PictureLight picture_;
  std::vector<OctaveErrors> octaves_;
  bool is_bound_, is_cut_;
  double promise_, rest_, part_of_all_;
  ColorLight colors_;
  double light_behind_, part_of_layers_;
  int slabs_;
  const std::vector<float>& of_slabs_;
  const FramePlan& plan_;
  std::array<double, width_octaves> lights_{};  // that splats counted as
};

// Whether so many blocks or fewer lie between it and a side of the crop that is none of the
// picture.
bool is_at_edge(std::size_t block, const BlockErrors& blocks, const Frame& frame, int edge) {
  const int x = static_cast<int>(block) % blocks.columns;
  const int y = static_cast<int>(block) / blocks.columns;
  const Rectangle& crop = frame.crop;
  return (crop.x > 0 && x < edge) || (crop.y > 0 && y < edge) ||
         (crop.x + crop.width < frame.width && blocks.columns - 1 - x < edge) ||
         (crop.y + crop.height < frame.height && blocks.rows - 1 - y < edge);
}

}  // namespace

bool needs_depths(const Frame& frame, const FramePlan& plan) {
  if (plan.light == LightPlan::emission) return false;
  return plan.needs_sort() || parts_of_colors(frame, plan).of_brightest > 0;
}

Certificate certify(const CollectedSplats& splats, const Image& image, const Frame& frame,
                    const FramePlan& plan, int edge) {
  constexpr std::size_t blocks_at_once = 256;
  if (!plan.has_errors_of_splats && !plan.needs_sort() && !plan.certify) {
    const ColorLight colors(image, splats.depths, frame, plan);
    const double of_colors = colors.are_exact() ? 0 : negligible_part * plan.shares.promise;
    const double error = error_of_all_pixels(splats, plan);
    if (colors.are_within(of_colors))
      return even_certificate(image, error + of_colors, plan.shares.promise);
  }
  const FrameErrors errors(splats, image, frame, plan);
  std::vector<ErrorParts> blocks(errors.block_count());
  for_blocks(blocks.size(), blocks_at_once, [&](std::size_t first, std::size_t last) {
    std::vector<Part> parts = errors.parts();
    for (std::size_t b = first; b < last; ++b)
      blocks[b] = errors.in_block(b, parts);
  });

  Certificate certificate;
  certificate.blocks = BlockErrors(image.width, image.height);
  std::vector<Part> parts = errors.parts();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (is_at_edge(b, certificate.blocks, frame, edge)) continue;
    const double error = blocks[b].sum();
    certificate.blocks.errors[b] = static_cast<float>(error * plan.shares.promise);
    if (plan.certify) certificate.is_bound &= errors.of_colors(b).is_bound;
    // What is no number is larger than any.
    if (!(error <= certificate.error_of_promise)) {
      certificate.error_of_promise = error;
      certificate.worst = blocks[b];
    }
    if (error <= 1) {
      if (error > certificate.worst_kept.sum()) certificate.worst_kept = blocks[b];
      continue;
    }
    const ErrorParts sums = errors.in_block(b, parts);
    errors.add_needs(b, parts, sums, certificate.needs);
    certificate.needs_extended |= errors.of_colors(b).error > most_of_colors;
  }
  return certificate;
}

Certificate certify_extended(const CollectedSplats& splats, const Image& image, const Frame& frame,
                             const FramePlan& plan) {
  const double promise = std::max(frame.tolerance, extended_tolerance);
  Certificate certificate = even_certificate(image, extended_tolerance, promise);
  const ColorLight colors(image, splats.depths, frame, plan);
  if (colors.are_exact() && !plan.needs_sort()) return certificate;
  const PictureLight picture = measure_light(image, splats.depths, frame, plan);
  for (std::size_t b = 0; b < picture.blocks.size(); ++b) {
    const BlockLight& light = picture.blocks[b];
    const ColorError of_colors =
        error_of_colors(colors, b, light, plan, colors.in_block(b, light, 0, 0), promise);
    certificate.is_bound &= of_colors.is_bound;
    const double error = std::max(extended_tolerance,
                                  of_extended + of_extended_depth * light.behind + of_colors.error);
    certificate.blocks.errors[b] = static_cast<float>(error);
    certificate.error_of_promise = std::max(certificate.error_of_promise, error / promise);
  }
  certificate.worst.rest = certificate.error_of_promise;
  return certificate;
}

}  // namespace splotchcl
