#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "splotchcl/finish.h"
#include "splotchcl/image.h"

namespace splotchcl {

// How many pixels have how much light in their brightest channel. Bins are a 256th of an octave
// wide at most, so that what follows does not hang on a picture's last digits.
class LightHistogram {
 public:
  LightHistogram();
  void add(const Image& image);

  // The upper edge of the bin that has the brightest light but one part of what is at least
  // `lowest`; 0 where nothing is.
  double exceeded_by(double part, double lowest) const;
  // Of all pixels, how many have at least `lowest`.
  double part_from(double lowest) const;
  // The lower edge of the darkest bin of the brightest pixels, a part of all; 0 where these take
  // in dark ones.
  double reached_by(double part) const;

 private:
  std::vector<std::uint64_t> counts_;  // [bin], rising light; the first: none
  std::uint64_t pixels_ = 0;
};

// Puts exposure and white of `found` where `finish` leaves them open.
void take_tone(const FinishSettings& found, FinishSettings& finish);

// Whether exposure or white is left to the picture.
bool has_open_tone(const FinishSettings& finish);

// The settings with exposure and white found from light as it has been drawn:
//   - what 0.3 % of the pixels exceed that matter fills is 98 % of white, so that what is even
//     and bright is not white; matter fills the pixels with at least a thousandth of that,
//   - exposure is the least, in twentieths of a stop, that lifts a quarter of all pixels, or as
//     much as matter fills, to 3 % of white, and not below what makes white 1. Where white is
//     given, or the curve is a line, it is what lets 0.3 % of what matter fills exceed white.
// Nothing for a picture without light. The settings themselves where nothing is open.
std::optional<FinishSettings> with_tone_of(const FinishSettings& finish,
                                           const LightHistogram& light);

// As above; exposure 0 and white 1 where the picture is black.
FinishSettings with_any_tone(const FinishSettings& finish, const LightHistogram& light);

}  // namespace splotchcl
