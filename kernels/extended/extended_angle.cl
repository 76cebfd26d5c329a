// Lengths and angles of extended numbers (extended.cl), relative error 2^-42.
#include "kernels/extended/extended.cl"

#pragma OPENCL FP_CONTRACT OFF

// sqrt(a^2 + b^2); no square leaves single precision.
static inline Extended extended_hypotenuse(Extended a, Extended b) {
  const Extended first = extended_magnitude(a), second = extended_magnitude(b);
  const int swaps = extended_less(first, second);
  const Extended longer = swaps ? second : first, shorter = swaps ? first : second;
  if (!(high_part(longer) > 0.0f)) return extended_of(0.0f);
  const Extended ratio = extended_quotient(shorter, longer);
  const Extended square = extended_product(ratio, ratio);
  return extended_product(longer, extended_root(extended_sum(extended_of(1.0f), square)));
}

// Below, extended_atan2(): the angle of (x, y) from the x axis, in [-pi, pi]; 0 for (0, 0).
#if DOUBLE_NUMBERS
static inline Extended extended_atan2(Extended y, Extended x) {
  // Zeros without signs, which would turn a pole by half a turn.
  return atan2(y + 0.0, x + 0.0);
}
#else
// atan(k / 16), the floats next to it and what they leave.
__constant float arctangent_high[17] = {
    0.0f,         0.062418811f, 0.124354996f, 0.185347944f, 0.244978666f, 0.302884877f,
    0.358770669f, 0.412410438f, 0.463647604f, 0.512389481f, 0.558599293f, 0.602287352f,
    0.643501103f, 0.682316542f, 0.718829989f, 0.753151298f, 0.785398185f};
__constant float arctangent_low[17] = {0.0f,
                                       -1.02727793e-09f,
                                       -1.24038224e-09f,
                                       5.49763257e-09f,
                                       -3.17867777e-09f,
                                       -8.35308622e-9f,
                                       1.76394988e-09f,
                                       3.53662677e-09f,
                                       5.01215869e-09f,
                                       -2.07569197e-08f,
                                       2.21115979e-08f,
                                       -5.95014926e-09f,
                                       5.86893734e-09f,
                                       1.32029951e-08f,
                                       1.01883355e-08f,
                                       -1.66070802e-08f,
                                       -2.18556941e-08f};

// atan(v) for 0 <= v <= 1, as atan(k / 16) + atan(t) with |t| <= 1/32: of the series of the
// latter t^13 / 13 is below 2^-63 of it, and from t^5 on single precision serves.
static inline Extended extended_arctangent(Extended v) {
  const float k = rint(high_part(v) * 16.0f);
  const Extended step = extended_of(k * 0.0625f);
  const Extended t = extended_quotient(extended_difference(v, step),
                                       extended_sum(extended_of(1.0f), extended_product(v, step)));
  const Extended square = extended_product(t, t);
  const Extended third = extended_product(extended_product(square, t),
                                          extended_constant(-0.333333343f, 9.93410776e-09f));
  const float s = high_part(square);
  const float tail =
      high_part(t) * s * s * (0.2f + s * (-0.142857143f + s * (0.111111111f - s * 0.0909090909f)));
  const Extended series = extended_sum(t, extended_sum(third, extended_of(tail)));
  return extended_sum(extended_constant(arctangent_high[(int)k], arctangent_low[(int)k]), series);
}

static inline Extended extended_atan2(Extended y, Extended x) {
  const Extended along = extended_magnitude(x), across = extended_magnitude(y);
  const int steep = extended_less(along, across);
  const Extended longer = steep ? across : along, shorter = steep ? along : across;
  if (!(high_part(longer) > 0.0f)) return extended_of(0.0f);
  const Extended half_turn = extended_constant(3.14159274f, -8.74227766e-08f);
  Extended angle = extended_arctangent(extended_quotient(shorter, longer));
  if (steep) angle = extended_difference(extended_scaled(half_turn, 0.5f), angle);
  if (is_negative(x)) angle = extended_difference(half_turn, angle);
  return is_negative(y) ? extended_negative(angle) : angle;
}
#endif
