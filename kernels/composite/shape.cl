// The cloud's shape and its layer, for compositing and resolving, on VALUEs (lanes.cl).

// 2^t for t <= 0. The polynomial on [-1/2, 1/2] has a relative error of 2.7e-6 (degree 4)
// or 7.5e-8 (degree 6 within single precision). 12582912 = 1.5 * 2^23 rounds t to an
// integer and leaves it in the low bits, where it becomes the exponent.
inline VALUE exp2_negative(VALUE t) {
  t = max(t, (VALUE)(-126.0f));
  const VALUE shifted = t + 12582912.0f;
  const VALUE f = t - (shifted - 12582912.0f);
#ifdef FULL_PRECISION
  VALUE p = f * 1.53458118e-4f + 1.33999314e-3f;
  p = p * f + 9.61848896e-3f;
  p = p * f + 5.55032878e-2f;
  p = p * f + 0.240226469f;
  p = p * f + 0.693147206f;
  p = p * f + 1.0f;
#else
  VALUE p = f * 9.57010165e-3f + 5.59178621e-2f;
  p = p * f + 0.240247448f;
  p = p * f + 0.693121815f;
  p = p * f + 0.999999261f;
#endif
  return AS_VALUE(AS_INTEGER(p) + (AS_INTEGER(shifted) << 23));
}

// exp(-d^2 / sigma^2) with inverse = log2(e) / sigma^2.
inline VALUE gaussian(VALUE d, float inverse) {
  return exp2_negative(d * d * -inverse);
}

#ifdef DEVICE_ERF
#define error_function erf
#else
// erf, absolute error 2.3e-7, as x p(x^2); constant beyond its range, where 1 - erf is below
// 1.6e-8.
inline VALUE error_function(VALUE x) {
  x = clamp(x, (VALUE)(-4.0f), (VALUE)(4.0f));
  const VALUE u = x * x * 0.125f - 1.0f;
  VALUE p = u * -0.00112648448f + 0.00287871086f;
  p = p * u - 0.00193891837f;
  p = p * u + 0.0021022954f;
  p = p * u - 0.00888558477f;
  p = p * u + 0.0166786499f;
  p = p * u - 0.022508679f;
  p = p * u + 0.0319979824f;
  p = p * u - 0.0456971191f;
  p = p * u + 0.0601460151f;
  p = p * u - 0.0747480616f;
  p = p * u + 0.0901783258f;
  p = p * u - 0.10770832f;
  p = p * u + 0.13167648f;
  p = p * u - 0.176576287f;
  p = p * u + 0.353530973f;
  return x * p;
}
#endif

// The mean of exp(-x^2 / sigma^2) over a pixel is pixel_mean_scale * sigma times the
// difference of the error function at its two edges, in units of sigma.
#define PIXEL_MEAN_SCALE 0.88622693f

// Splats whose light or depth is well above 1 carry their sigma with a minus where they are
// taken as means. What errors of their peak would show beside them, so that these means are
// differences of 1 - erf, which keep their digits far out.
inline VALUE bright_mean(VALUE d, float sigma) {
  const VALUE far = (fabs(d) + 0.5f) / sigma, near = (fabs(d) - 0.5f) / sigma;
  const VALUE beyond = erfc(far), short_of = erfc(fabs(near));
  return PIXEL_MEAN_SCALE * sigma * (choose(short_of, 2.0f - short_of, near < 0.0f) - beyond);
}

// phi(y) = (1 - exp(-y)) / y by two terms of its series (error y^2 / 6) ...
inline VALUE phi_short(VALUE y) {
  return 1.0f - 0.5f * y;
}

// ... by four (error y^4 / 120) ...
inline VALUE phi_series(VALUE y) {
  return 1.0f - y * (0.5f - y * (0.166666667f - y * 0.0416666667f));
}

// exp(-y) = 1 - y phi(y), where phi is taken by its series.
inline VALUE passed_by_series(VALUE y, VALUE phi) {
  return 1.0f - y * phi;
}

// ... and for any y >= 0: the series below 0.1, where 1 - exp(-y) would cancel.
inline VALUE phi_full(VALUE y) {
  const VALUE direct = (1.0f - exp2_negative(y * -1.44269504f)) / max(y, (VALUE)(0.1f));
  return select(direct, phi_series(y), y < 0.1f);
}

// Below 0.1 by phi, too: what the polynomial errs by there would be taken away by each of thousands
// of thin layers.
inline VALUE passed_in_full(VALUE y, VALUE phi) {
  return select(exp2_negative(y * -1.44269504f), passed_by_series(y, phi), y < 0.1f);
}
