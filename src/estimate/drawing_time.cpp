#include "estimate/drawing_time.h"

#include <algorithm>

namespace splotchcl {
namespace {

// Nanoseconds on two cores.
struct Rates {
  double particle, extended_particle;       // projected
  double sorted;                            // splat
  double binned;                            // tile entry
  double entry;                             // composited, besides
  double fast_row, full_row, extended_row;  // eight pixels of it, by precision
  double pixel;                             // resolved
};

// Of a pixel that a slab is laid on.
constexpr double laid_pixel = 17;

constexpr Rates rates_of_sums = {11.6, 90, 0, 9, 4, 1.1, 2.3, 3, 7.2};
constexpr Rates rates_in_order = {22, 180, 13, 19, 35, 0.5, 0.9, 6, 8.3};

double row_part(const Rates& rates, Precision precision) {
  switch (precision) {
    case Precision::fast:
      return rates.fast_row;
    case Precision::full:
      return rates.full_row;
    case Precision::extended:
      return rates.extended_row;
  }
  return rates.fast_row;
}

}  // namespace

double estimate_seconds(const Frame& frame, const FramePlan& plan, const SplatWork& work,
                        int cores) {
  const Rates& rates = plan.needs_sort() ? rates_in_order : rates_of_sums;
  const double pixels =
      static_cast<double>(frame.crop.width) * static_cast<double>(frame.crop.height);
  const double nanoseconds = (plan.is_extended() ? rates.extended_particle : rates.particle) *
                                 static_cast<double>(particle_count(frame)) +
                             rates.sorted * work.splats +
                             (rates.binned + rates.entry) * work.tile_entries +
                             row_part(rates, plan.precision) * work.row_parts +
                             (rates.pixel + laid_pixel * plan.slabs) * pixels;
  return 1e-9 * nanoseconds * 2 / std::max(cores, 1);
}

}  // namespace splotchcl
