// The cloud's shape and its layer, for compositing and resolving, on VALUEs (lanes.cl).
#include "kernels/common/lanes.cl"
#include "kernels/composite/gaussian.cl"

// What a place holds below its single precision (bin.h). It is subtracted from distances to pixels,
// which are exact where they count: near the splat.
#if FINE_PLACES
#define LOW_X(splat) ((splat).x_low)
#define LOW_Y(splat) ((splat).y_low)
#else
#define LOW_X(splat) 0.0f
#define LOW_Y(splat) 0.0f
#endif

// The mean of exp(-x^2 / sigma^2) over a pixel is pixel_mean_scale * sigma times the
// difference of the error function at its two edges, in units of sigma.
#define PIXEL_MEAN_SCALE 0.88622693f

// exp(-x^2) for 0 <= x <= 9.2, relative error 3e-7: the square is taken apart, since a rounding of
// it would count as often as it is large.
static inline VALUE exp_of_minus_square(VALUE x) {
  const VALUE high = AS_VALUE(AS_INTEGER(x) & (INTEGER)(~0xfff));
  const VALUE square = high * high, rest = (x - high) * (x + high);
  const VALUE shifted = square * -1.44269504f + TO_LOW_BITS;
  const VALUE whole = shifted - TO_LOW_BITS;
  // ln 2 in two parts: the first has so few bits that its multiples are exact.
  const VALUE left = (-square - whole * 0.693145752f) - whole * 1.42860677e-6f - rest;
  return times_power_of_two(exp2_to_all_digits(left * 1.44269504f), shifted);
}

// 1 - erf(x) for x >= 0, relative error 5e-7, constant beyond 9.19, where it is 1e-38: exp(-x^2)
// times t p(t), t = 1 / (1 + x / 2).
static inline VALUE complement_of_erf(VALUE x) {
  x = min(x, (VALUE)(9.19f));
  const VALUE t = 1.0f / (0.5f * x + 1.0f);
  const VALUE u = t * 2.43243241f - 1.43243241f;
  VALUE p = u * -4.79595801e-05f + 1.23814325e-05f;
  p = p * u + 0.000541826827f;
  p = p * u - 0.000545477204f;
  p = p * u - 0.00586756831f;
  p = p * u + 0.00541404821f;
  p = p * u + 0.0995526835f;
  p = p * u + 0.324560255f;
  p = p * u + 0.576379776f;
  return t * p * exp_of_minus_square(x);
}

// The mean over a pixel, over PIXEL_MEAN_SCALE * sigma, from 1 - erf of the distances of its edges:
// of differences of small numbers, so that far out it keeps its digits.
static inline VALUE mean_of_complements(VALUE left, VALUE of_left, VALUE right, VALUE of_right) {
  const VALUE beside = choose(of_right - of_left, of_left - of_right, left >= 0.0f);
  return choose(beside, 2.0f - of_left - of_right, left<0.0f & right> 0.0f);
}

// The same mean for a splat wider than WIDE_MEAN, where that difference would lose digits: the
// value at the center times the mean of exp(-(2 d t + t^2) / sigma^2) over -1/2 < t < 1/2, by its
// series up to the sixth derivative of a Gaussian; the next is (2 d / sigma^2)^8 / 9e7.
#define WIDE_MEAN 3.9f
static inline VALUE wide_bright_mean(VALUE d, float sigma) {
  const VALUE x = min(fabs(d) / sigma, (VALUE)(9.19f)), slope = x * (2.0f / sigma);
  const VALUE s = slope * slope;
  const float b = -1.0f / (sigma * sigma);
  const VALUE second = s + 2.0f * b;
  const VALUE fourth = (s + 12.0f * b) * s + 12.0f * b * b;
  const VALUE sixth = ((s + 30.0f * b) * s + 180.0f * b * b) * s + 120.0f * b * b * b;
  return exp_of_minus_square(x) * (1.0f + (second * (1.0f / 24.0f) + fourth * (1.0f / 1920.0f) +
                                           sixth * (1.0f / 322560.0f)));
}

// Splats whose light or depth is well above 1 carry their sigma with a minus where they are
// taken as means. What errors of their peak would show beside them, so that these means are
// differences of 1 - erf.
static inline VALUE bright_mean(VALUE d, float sigma) {
  if (sigma >= WIDE_MEAN) return wide_bright_mean(d, sigma);
  const VALUE left = (d - 0.5f) / sigma, right = (d + 0.5f) / sigma;
  return PIXEL_MEAN_SCALE * sigma *
         mean_of_complements(left, complement_of_erf(fabs(left)), right,
                             complement_of_erf(fabs(right)));
}

// phi(y) = (1 - exp(-y)) / y by two terms of its series (error y^2 / 6) ...
static inline VALUE phi_short(VALUE y) {
  return 1.0f - 0.5f * y;
}

// ... by four (error y^4 / 120) ...
static inline VALUE phi_series(VALUE y) {
  return 1.0f - y * (0.5f - y * (0.166666667f - y * 0.0416666667f));
}

// exp(-y) = 1 - y phi(y), where phi is taken by its series.
static inline VALUE passed_by_series(VALUE y, VALUE phi) {
  return 1.0f - y * phi;
}

// ... and for any y >= 0: the series below 0.1, where 1 - exp(-y) would cancel.
static inline VALUE phi_full(VALUE y) {
  const VALUE direct = (1.0f - exp2_negative(y * -1.44269504f)) / max(y, (VALUE)(0.1f));
  return select(direct, phi_series(y), y < 0.1f);
}

// Below 0.1 by phi, too: what the polynomial errs by there would be taken away by each of thousands
// of thin layers.
static inline VALUE passed_in_full(VALUE y, VALUE phi) {
  return select(exp2_negative(y * -1.44269504f), passed_by_series(y, phi), y < 0.1f);
}
