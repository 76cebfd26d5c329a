#include "finish/tone.h"

#include <algorithm>
#include <array>
#include <boost/qvm/mat.hpp>
#include <boost/qvm/mat_operations.hpp>
#include <boost/qvm/vec_mat_operations.hpp>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "splotchcl/vector.h"

namespace splotchcl {
namespace {

using ColorMatrix = boost::qvm::mat<double, 3, 3>;

// Rec. 709's primaries with D65 to CIE XYZ.
constexpr ColorMatrix rgb_to_xyz = {{{0.4123908, 0.3575843, 0.1804808},
                                     {0.2126390, 0.7151687, 0.0721923},
                                     {0.0193308, 0.1191948, 0.9505322}}};
// To the responses of cones, as Bradford's adaptation sharpens them.
constexpr ColorMatrix xyz_to_cones = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

// CIE XYZ with Y = 1 of a black body: cubics to the Planckian locus (B. Kim et al. 2002, Journal of
// the Korean Physical Society 41, 865).
Vec3 black_body(double kelvin) {
  const double t = 1000 / kelvin;
  const double x = kelvin < 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                 : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  std::array<double, 4> cubic = {3.0817580, -5.87338670, 3.75112997, -0.37001483};
  if (kelvin < 2222) {
    cubic = {-1.1063814, -1.34811020, 2.18555832, -0.20219683};
  } else if (kelvin < 4000) {
    cubic = {-0.9549476, -1.37418593, 2.09137015, -0.16748867};
  }
  const double y = ((cubic[0] * x + cubic[1]) * x + cubic[2]) * x + cubic[3];
  return {{x / y, 1, (1 - x - y) / y}};
}

ColorMatrix adaptation(double kelvin) {
  using namespace boost::qvm;
  const Vec3 white = xyz_to_cones * (rgb_to_xyz * Vec3{{1, 1, 1}});
  const Vec3 body = xyz_to_cones * black_body(kelvin);
  ColorMatrix gains = {};
  for (std::size_t i = 0; i < 3; ++i)
    gains.a[i][i] = white.a[i] / body.a[i];
  const ColorMatrix to_cones = xyz_to_cones * rgb_to_xyz;
  return inverse(to_cones) * gains * to_cones;
}

}  // namespace

void balance_white(Image& image, double kelvin) {
  const ColorMatrix change = adaptation(kelvin);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    float* const pixel = &image.pixels[i];
    const Vec3 light = {{pixel[0], pixel[1], pixel[2]}};
    const Vec3 balanced = boost::qvm::operator*(change, light);
    for (std::size_t c = 0; c < 3; ++c)
      pixel[c] = static_cast<float>(std::max(0.0, balanced.a[c]));
  }
}

namespace {

// Light from which on the asinh is more of a logarithm than a line.
constexpr double asinh_slope = 10;

// Hable's curve, with its value at 0 taken off exactly: x (x A (F - E) + B (C F - E)) over
// F (x (A x + B) + D F), which does not cancel for small x.
double film(double x) {
  constexpr double a = 0.22, b = 0.30, c = 0.10, d = 0.20, e = 0.01, f = 0.30;
  return x * (a * (f - e) * x + b * (c * f - e)) / (f * (x * (a * x + b) + d * f));
}

double curve_of(ToneCurve curve, double light) {
  switch (curve) {
    case ToneCurve::linear:
      break;
    case ToneCurve::asinh:
      return std::asinh(asinh_slope * light);
    case ToneCurve::filmic:
      return film(light);
  }
  return light;
}

}  // namespace

double tone(ToneCurve curve, double light, double white) {
  const double shown = curve_of(curve, light) / curve_of(curve, white);
  return curve == ToneCurve::linear ? shown : std::min(shown, 1.0);
}

// Of film() it lies in the toe: below it the curve bends up, above it down.
double steepest_slope(ToneCurve curve, double white) {
  constexpr double steepest_film_at = 0.1621, step = 1e-4;
  const double at = std::min(steepest_film_at, white);
  switch (curve) {
    case ToneCurve::linear:
      break;
    case ToneCurve::asinh:
      return asinh_slope / std::asinh(asinh_slope * white);
    case ToneCurve::filmic:
      return (film(at + step) - film(at)) / (step * film(white));
  }
  return 1 / white;
}

void apply_tone(Image& image, ToneCurve curve, double white, double highlights) {
  if (curve == ToneCurve::linear && white == 1 && highlights == 0) return;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    float* const pixel = &image.pixels[i];
    const double brightest = std::max({pixel[0], pixel[1], pixel[2]});
    if (!(brightest > 0) || !std::isfinite(brightest)) continue;
    const double shown = tone(curve, brightest, white);
    const double factor = shown / brightest;
    const double whiteness = highlights * std::pow(std::min(1.0, shown), 4);
    for (int c = 0; c < 3; ++c) {
      const double in_hue = factor * pixel[c];
      pixel[c] = static_cast<float>(in_hue + whiteness * (shown - in_hue));
    }
  }
}

namespace {

constexpr double bright_part = 0.003;  // of what matter fills
constexpr double bright_light = 0.98;  // of white, or a little more, in what that part exceeds
constexpr double even_part = 0.1;      // of what matter fills
constexpr double even_light = 0.5;     // of what is bright, at most, in what that part exceeds
constexpr double filled_light = 1e-3;  // of white
constexpr double seen_part = 0.25;     // of all pixels
constexpr double most_filled = 0.9;    // of those that matter fills: the rest are its edges
constexpr double seen_light = 0.04;    // of white, as it is shown
constexpr double ground_light = 0.03;  // that half of all pixels reach, where white may be below 1
constexpr double least_light = 1e-9;   // that is promised to be right, whatever lifts it
constexpr double lowest_white = 0.2;   // below it curves are nearly lines
constexpr double steps_per_stop = 20;
constexpr double most_stops = 30;  // that exposure lifts more than what makes white 1

// The upper bits of a float >= 0 rise with it: eight of the fraction are left.
constexpr int dropped_bits = 15;
constexpr std::size_t bins = (std::size_t{0x7f800000U} >> dropped_bits) + 1;

std::size_t bin_of(float light) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &light, sizeof bits);
  return bits >> dropped_bits;
}

double lower_edge(std::size_t bin) {
  const auto bits = static_cast<std::uint32_t>(bin << dropped_bits);
  float light = 0;
  std::memcpy(&light, &bits, sizeof light);
  return light;
}

// What is bright, of all that is at least `lowest`: what few pixels exceed, and more where many are
// as bright, which white would show as a flat disc.
double bright_light_from(const LightHistogram& light, double lowest) {
  return std::max(light.exceeded_by(bright_part, lowest),
                  light.exceeded_by(even_part, lowest) / even_light);
}

// What exceeds this is at most a part of what matter fills, which depends on it in turn: found from
// below, so that bright pixels that are few do not hide the others. What is fainter than pictures
// are promised to be right (the default tolerance), or a thousandth of all that is there, does not
// count: clouds fade without an end.
double light_of_bright(const LightHistogram& light) {
  constexpr double promised = 1e-3;
  double lowest = std::min(promised, filled_light * light.exceeded_by(0, 0));
  for (;;) {
    const double bright = bright_light_from(light, lowest);
    if (!(filled_light * bright > lowest)) return bright;
    lowest = filled_light * bright;
  }
}

// What a picture's light is judged by.
struct LightLevels {
  double faint, middle, bright;
};

LightLevels levels_of(const LightHistogram& light, double bright) {
  const double least = filled_light * bright, filled = light.part_from(least);
  const double faint = light.reached_by(std::min(seen_part, most_filled * filled));
  return {std::max({faint, least, least_light}), light.reached_by(0.5), bright};
}

double rounded_up(double stops) {
  return std::ceil(stops * steps_per_stop - 1e-6) / steps_per_stop;
}

double rounded_down(double stops) {
  return std::floor(stops * steps_per_stop + 1e-6) / steps_per_stop;
}

// What contrast makes of gray light.
double with_contrast(double light, const FinishSettings& finish, double gamma) {
  const double pivot = std::pow(finish.contrast_pivot, gamma);
  return pivot * std::pow(light / pivot, finish.contrast);
}

// The least exposure from one on up to another that shows light so bright.
std::optional<double> exposure_showing(double wanted, double light, double bright,
                                       const FinishSettings& finish, double gamma, double from,
                                       double to) {
  for (double stops = from; stops < to; stops += 1 / steps_per_stop) {
    const double factor = std::exp2(stops);
    const double toned = tone(finish.tone, factor * light, factor * bright);
    if (with_contrast(toned, finish, gamma) >= wanted) return stops;
  }
  return std::nullopt;
}

// Three digits, and not less.
double rounded_white(double white) {
  const double unit = std::pow(10, std::floor(std::log10(white)) - 2);
  return std::ceil(white / unit * (1 - 1e-12)) * unit;
}

// What shows faint light as it should be seen, and the middle of the picture, if it is not black.
double lifting_exposure(const LightLevels& light, const FinishSettings& finish, double gamma,
                        double lowest, double usual) {
  const auto showing = [&](double wanted, double faint, double from, double to) {
    return exposure_showing(wanted, faint, light.bright, finish, gamma, from, to);
  };
  const double least = showing(ground_light, light.middle, lowest, usual).value_or(usual);
  return showing(seen_light, light.faint, least, least + most_stops).value_or(least);
}

// Within what a scene file may say, as is white.
double find_exposure(const FinishSettings& finish, double gamma, const LightLevels& light) {
  constexpr double most = 100;
  if (finish.white)
    return std::clamp(rounded_down(std::log2(*finish.white / light.bright)), -most, most);
  const auto making_it = [&](double white) {
    return std::clamp(rounded_up(std::log2(white / light.bright)), -most, most - most_stops);
  };
  // A line shows as much at any exposure.
  if (finish.tone == ToneCurve::linear) return making_it(1);
  return lifting_exposure(light, finish, gamma, making_it(lowest_white), making_it(1));
}

// What is even and bright stays below white, also where a curve is flat there.
double find_white(ToneCurve curve, double exposed) {
  double white = exposed;
  for (int i = 0; i < 50 && tone(curve, exposed, white) > bright_light; ++i)
    white *= 1.02;
  return std::clamp(rounded_white(white), 1e-30, 1e30);
}

}  // namespace

LightHistogram::LightHistogram() : counts_(bins) {}

void LightHistogram::add(const Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    const float* const pixel = &image.pixels[i];
    const float brightest = std::max({pixel[0], pixel[1], pixel[2]});
    const bool is_light = brightest > 0 && std::isfinite(brightest);
    ++counts_[is_light ? bin_of(brightest) : 0];
  }
  pixels_ += image.pixels.size() / 4;
}

double LightHistogram::exceeded_by(double part, double lowest) const {
  const std::size_t first = std::max<std::size_t>(1, bin_of(static_cast<float>(lowest)));
  std::uint64_t all = 0;
  for (std::size_t bin = first; bin < bins; ++bin)
    all += counts_[bin];
  const auto most = static_cast<std::uint64_t>(part * static_cast<double>(all));
  std::uint64_t above = 0;
  for (std::size_t bin = bins; bin-- > first;) {
    above += counts_[bin];
    if (above > most) return lower_edge(bin + 1);
  }
  return 0;
}

double LightHistogram::part_from(double lowest) const {
  const std::size_t first = std::max<std::size_t>(1, bin_of(static_cast<float>(lowest)));
  std::uint64_t count = 0;
  for (std::size_t bin = first; bin < bins; ++bin)
    count += counts_[bin];
  return pixels_ == 0 ? 0 : static_cast<double>(count) / static_cast<double>(pixels_);
}

double LightHistogram::reached_by(double part) const {
  const double wanted = part * static_cast<double>(pixels_);
  std::uint64_t count = 0;
  for (std::size_t bin = bins; bin-- > 1;) {
    count += counts_[bin];
    if (static_cast<double>(count) >= wanted) return lower_edge(bin);
  }
  return 0;
}

bool has_open_tone(const FinishSettings& finish) {
  return !finish.exposure || !finish.white;
}

void take_tone(const FinishSettings& found, FinishSettings& finish) {
  if (!finish.exposure) finish.exposure = found.exposure;
  if (!finish.white) finish.white = found.white;
}

std::optional<FinishSettings> with_tone_of(const FinishSettings& finish, double gamma,
                                           const LightHistogram& light) {
  if (!has_open_tone(finish)) return finish;
  const double bright = light_of_bright(light);
  if (!(bright > least_light)) return std::nullopt;
  FinishSettings found = finish;
  if (!finish.exposure) found.exposure = find_exposure(finish, gamma, levels_of(light, bright));
  if (!finish.white) found.white = find_white(finish.tone, std::exp2(*found.exposure) * bright);
  return found;
}

FinishSettings with_any_tone(const FinishSettings& finish, double gamma,
                             const LightHistogram& light) {
  if (const std::optional<FinishSettings> found = with_tone_of(finish, gamma, light)) return *found;
  FinishSettings settings = finish;
  settings.exposure = finish.exposure.value_or(0);
  settings.white = finish.white.value_or(1);
  return settings;
}

namespace {

void expose(Image& image, double stops) {
  if (stops == 0) return;
  const auto factor = static_cast<float>(std::exp2(stops));
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i + c] *= factor;
  }
}

void saturate(Image& image, double saturation) {
  if (saturation == 1) return;
  const auto part = static_cast<float>(saturation);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    float* const pixel = &image.pixels[i];
    // Rec. 709's weights.
    const float luminance = 0.2126F * pixel[0] + 0.7152F * pixel[1] + 0.0722F * pixel[2];
    for (int c = 0; c < 3; ++c)
      pixel[c] = std::max(0.0F, luminance + part * (pixel[c] - luminance));
  }
}

void change_contrast(Image& image, double contrast, double pivot) {
  if (contrast == 1) return;
  const auto exponent = static_cast<float>(contrast);
  const auto fixed = static_cast<float>(pivot);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = image.pixels[i + c];
      value = fixed * std::pow(std::max(0.0F, value / fixed), exponent);
    }
  }
}

}  // namespace

void adjust_light(Image& image, const FinishSettings& finish, double gamma) {
  expose(image, finish.exposure.value());
  if (finish.white_balance) balance_white(image, *finish.white_balance);
  apply_tone(image, finish.tone, finish.white.value(), finish.highlights);
  saturate(image, finish.saturation);
  change_contrast(image, finish.contrast, std::pow(finish.contrast_pivot, gamma));
}

std::array<float, 3> light_of(const DisplayColor& color, double gamma) {
  std::array<float, 3> light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = static_cast<float>(std::pow(color[c], gamma));
  return light;
}

}  // namespace splotchcl
