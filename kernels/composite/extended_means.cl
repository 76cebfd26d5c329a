// Means over the pixels along an axis, in double precision, eight at a time: of the pixels from
// `begin` to `end` of a tile, of which pixel 0 has its center at distance `first`.
#include "kernels/common/double_lanes.cl"

#pragma OPENCL FP_CONTRACT ON

// 1 - erf(x) for x >= 0, relative error 2e-13, constant beyond 10, where it is 2e-45: exp(-x^2)
// times t p(t), t = 1 / (1 + 0.3 x).
static inline double8 complement_of_erf(double8 x) {
  x = select(x, (double8)(10.0), x > 10.0);
  const double8 t = 1.0 / (x * 0.3 + 1.0);
  const double8 u = t * 2.6633499170812605 - 1.6633499170812602;
  double8 p = u * 1.3713151503225163e-08 - 8.77463435244863e-09;
  p = p * u - 2.462352296506154e-07;
  p = p * u + 1.0819245677140543e-07;
  p = p * u + 3.7965347814972183e-06;
  p = p * u + 2.01333015250639e-06;
  p = p * u - 5.942947643920726e-05;
  p = p * u - 0.00017468308762321827;
  p = p * u + 0.0005556065304134251;
  p = p * u + 0.006260002068530397;
  p = p * u + 0.02740483063072595;
  p = p * u + 0.0802093028859574;
  p = p * u + 0.17598545081592057;
  p = p * u + 0.3015555022098291;
  p = p * u + 0.40825774066188303;
  return t * p * exp_of_minus(x * x);
}

// The mean of exp(-d^2 / sigma^2) over pixels from 1 - erf of the distances of their edges.
static inline double8 mean_of_complements(double8 left, double8 of_left, double8 right,
                                          double8 of_right) {
  const double8 beside = select(of_right - of_left, of_left - of_right, left >= 0.0);
  return select(beside, 2.0 - of_left - of_right, (left < 0.0) & (right > 0.0));
}

static inline void fill_means(double* values, double first, int begin, int end, double sigma) {
  double beyond[TILE_WIDTH + 16];
  const double per_sigma = 1.0 / sigma;
  for (int k = begin; k <= end; k += 8) {
    const double8 edge = (first - 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    vstore8(complement_of_erf(fabs(edge)), 0, beyond + k);
  }
  for (int k = begin; k < end; k += 8) {
    const double8 left = (first - 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    const double8 right = (first + 0.5 + (double)k + ramp_of_eight()) * per_sigma;
    const double8 mean =
        mean_of_complements(left, vload8(0, beyond + k), right, vload8(0, beyond + k + 1));
    vstore8(mean * (0.88622692545275805 * sigma), 0, values + k);
  }
}

// The same of a wide splat, without 1 - erf: its value at the pixel's center times the mean of
// exp(-s t - t^2 / sigma^2) over -1/2 < t < 1/2, s = 2 d / sigma^2, by the series of both factors:
// the mean of t^n is 2^-n / (n + 1). What is left out is s^14 / 2e16, 2e-9 with s up to 3.5. From
// eight pixels to the next the value at the center changes by a factor, and that by another one.
static inline int are_wide_means(double sigma, double farthest) {
  const double least_sigma = 3.3, most_s = 3.5, most_sigmas = 25.0;  // exp(-25^2) is a double
  return sigma >= least_sigma && 2.0 * farthest <= most_s * sigma * sigma &&
         farthest <= most_sigmas * sigma;
}

static inline void fill_wide_means(double* values, double first, int begin, int end, double sigma) {
  const double per_sigma2 = 1.0 / (sigma * sigma), q = 0.25 * per_sigma2;
  // Of even powers of s: (2^-n / n!) (1 / (n + 1) - q / (n + 3) + q^2 / (2 (n + 5)) - ...).
  const double8 n = (double8)(0, 2, 4, 6, 8, 10, 12, 14);
  const double8 factors =
      1.0 / (n + 1.0) -
      q * (1.0 / (n + 3.0) -
           q * (0.5 / (n + 5.0) - q * ((1.0 / 6.0) / (n + 7.0) - q * (1.0 / 24.0) / (n + 9.0))));
  const double8 even = factors * (double8)(1.0, 1.0 / 8, 1.0 / 384, 1.0 / 46080, 1.0 / 10321920,
                                           1.0 / 3715891200.0, 1.0 / 1961990553600.0, 0.0);
  const double8 left = first + (double)begin + ramp_of_eight();
  double8 center = exp_of_minus(left * left * per_sigma2);
  double8 change = exp_of_minus((16.0 * left + 64.0) * per_sigma2);
  const double8 change_of_change = exp_of_minus((double8)(128.0 * per_sigma2));
  for (int k = begin; k < end; k += 8) {
    const double8 s = (first + (double)k + ramp_of_eight()) * (2.0 * per_sigma2), s2 = s * s;
    double8 mean = s2 * even.s6 + even.s5;
    mean = mean * s2 + even.s4;
    mean = mean * s2 + even.s3;
    mean = mean * s2 + even.s2;
    mean = mean * s2 + even.s1;
    mean = mean * s2 + even.s0;
    vstore8(center * mean, 0, values + k);
    center *= change;
    change *= change_of_change;
  }
}
