// Places of splats so sharp, or so bright, that single precision would show: in extended numbers.
#include "kernels/common/common.cl"
#include "kernels/project/project.h"
#if DOUBLE_NUMBERS
#include "kernels/project/exact_point.cl"
#endif
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/project/load.cl"
#include "kernels/project/view.cl"

#pragma OPENCL FP_CONTRACT OFF

// Numbers of at least 43 bits, as many at a time as a VALUE (lanes.cl) has: a processor's
// doubles, else sums of two VALUEs. The doubles of many GPUs are far slower than their floats.
#if DOUBLE_NUMBERS && LANES > 1
#if LANES == 16
typedef double16 ExtendedValue;
#define TO_EXTENDED convert_double16
#else
typedef double8 ExtendedValue;
#define TO_EXTENDED convert_double8
#endif

static inline ExtendedValue extended_value(FloatPair a) {
  return (ExtendedValue)((double)a.high + (double)a.low);
}
INLINED VALUE high_value(ExtendedValue a) {
  return TO_VALUE(a);
}
INLINED VALUE low_value(ExtendedValue a) {
  return TO_VALUE(a - TO_EXTENDED(TO_VALUE(a)));
}
INLINED ExtendedValue exact_sum(VALUE a, float b) {
  return TO_EXTENDED(a) + (double)b;
}
INLINED ExtendedValue sum_of_extended(ExtendedValue a, ExtendedValue b) {
  return a + b;
}
INLINED ExtendedValue product_of_extended(ExtendedValue a, ExtendedValue b) {
  return a * b;
}
// a b + c.
INLINED ExtendedValue product_plus(ExtendedValue a, ExtendedValue b, ExtendedValue c) {
  return fma(a, b, c);
}
// By the inverse in single precision and one step whose error is the third power of that: to the
// last bit but one or two, in a fraction of the time of a quotient. Of numbers that floats hold.
INLINED ExtendedValue quotient_of_extended(ExtendedValue a, ExtendedValue b) {
  const ExtendedValue about = TO_EXTENDED(1.0f / TO_VALUE(b)), error = fma(-about, b, 1.0);
  return a * fma(about * error, 1.0 + error, about);
}
INLINED ExtendedValue not_below(ExtendedValue a, float least) {
  return max(a, (double)least);
}
#else
typedef struct ExtendedValue {
  VALUE high, low;
} ExtendedValue;

static inline ExtendedValue extended_value(FloatPair a) {
  ExtendedValue pair;
  pair.high = (VALUE)(a.high);
  pair.low = (VALUE)(a.low);
  return pair;
}
static inline VALUE high_value(ExtendedValue a) {
  return a.high;
}
static inline VALUE low_value(ExtendedValue a) {
  return a.low;
}

// a + b where |a| >= |b| or nearly.
INLINED ExtendedValue renormalized_value(VALUE a, VALUE b) {
  ExtendedValue sum;
  sum.high = a + b;
  sum.low = b - (sum.high - a);
  return sum;
}
INLINED ExtendedValue exact_sum_of_values(VALUE a, VALUE b) {
  ExtendedValue sum;
  sum.high = a + b;
  const VALUE back = sum.high - a;
  sum.low = (a - (sum.high - back)) + (b - back);
  return sum;
}
INLINED ExtendedValue exact_sum(VALUE a, float b) {
  return exact_sum_of_values(a, (VALUE)(b));
}
INLINED ExtendedValue sum_of_extended(ExtendedValue a, ExtendedValue b) {
  const ExtendedValue sum = exact_sum_of_values(a.high, b.high);
  return renormalized_value(sum.high, sum.low + (a.low + b.low));
}
INLINED ExtendedValue product_of_extended(ExtendedValue a, ExtendedValue b) {
  const VALUE high = a.high * b.high;
  const VALUE low = fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high);
  return renormalized_value(high, low);
}
INLINED ExtendedValue product_plus(ExtendedValue a, ExtendedValue b, ExtendedValue c) {
  return sum_of_extended(product_of_extended(a, b), c);
}
INLINED ExtendedValue quotient_of_extended(ExtendedValue a, ExtendedValue b) {
  const VALUE first = a.high / b.high;
  const VALUE rest = fma(-first, b.high, a.high) + (a.low - first * b.low);
  return renormalized_value(first, rest / b.high);
}
INLINED ExtendedValue not_below(ExtendedValue a, float least) {
  a.high = max(a.high, (VALUE)(least));
  return a;
}
#endif

// What a pixel by which its centre is off does to a splat, at most, per sigma
// (docs/dev/accuracy.md).
static inline VALUE slope_of_peak(VALUE peak) {
  return 0.86f * min(peak, (VALUE)(20.0f));
}

// Faint ones may be a crowd at one place, whose places err alike; its light is allowed for where it
// is above 1 (docs/dev/accuracy.md, "Single precision").
#define LEAST_PEAK_OF_CROWD 0.015f

INLINED INTEGER are_sharp(const ViewLanes view, VALUE sigma, VALUE peak,
                          const ProjectParameters p) {
  const VALUE of_crowd = max(peak, (VALUE)(LEAST_PEAK_OF_CROWD));
  return sigma < p.sharp_width * view.place_error * slope_of_peak(of_crowd);
}

// So many particles may be copies of one.
#define MOST_COPIES 400.0f

#if DOUBLE_NUMBERS
static inline double in_double(FloatPair a) {
  return (double)a.high + (double)a.low;
}
static inline double along_in_double(const double* d, const FloatPair* axis) {
  return d[0] * in_double(axis[0]) + d[1] * in_double(axis[1]) + d[2] * in_double(axis[2]);
}

static inline ExactPoint exact_point(__global const float* position, const SharpParameters e) {
  double d[3], turn_axis[3];
  for (int axis = 0; axis < 3; ++axis) {
    const float* camera = e.position[axis];
    d[axis] = (double)position[axis] - ((double)camera[0] + (double)camera[1] + (double)camera[2]);
    turn_axis[axis] = in_double(e.turn_axis[axis]);
  }
  const double distance = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  return project_exactly(along_in_double(d, e.right), along_in_double(d, e.down),
                         along_in_double(d, e.forward), distance, in_double(e.pixels_per_length),
                         in_double(e.eye_offset), turn_axis);
}

INLINED void set_lane(VALUE* values, uint k, double value) {
  ((float*)values)[k] = (float)value;
}

// The view of these lanes as well as extended numbers know it. Hardly any splats need it.
SELDOM_CALLED void find_sharp_places(uint i, uint end, INTEGER sharp, const Columns columns,
                                     const SharpParameters e, ViewLanes* view) {
  for (uint k = 0; k < LANES && i + k < end; ++k) {
    if (!integer_of(sharp, k)) continue;
    const ExactPoint point = exact_point(columns.positions + (size_t)(i + k) * 3, e);
    if (!point.seen) continue;
    const double x = in_double(e.center_from_middle_x) + point.x;
    const double y = in_double(e.center_from_middle_y) + point.y;
    set_lane(&view->x, k, x);
    set_lane(&view->x_low, k, x - (double)(float)x);
    set_lane(&view->y, k, y);
    set_lane(&view->y_low, k, y - (double)(float)y);
    set_lane(&view->scale, k, point.scale);
    set_lane(&view->cos_latitude, k, point.cos_latitude);
    set_lane(&view->sine_latitude, k, point.sine_latitude);
  }
}
#else
// Without double precision they count as too sharp.
INLINED void find_sharp_places(uint i, uint end, INTEGER sharp, const Columns columns,
                               const SharpParameters e, ViewLanes* view) {}
#endif

INLINED ExtendedValue offset_in_extended(VALUE position, const float* camera) {
  FloatPair rest;
  rest.high = -camera[1];
  rest.low = -camera[2];
  return sum_of_extended(exact_sum(position, -camera[0]), extended_value(rest));
}

INLINED ExtendedValue along_in_extended(const ExtendedValue* d, const FloatPair* axis) {
  const ExtendedValue x = product_of_extended(d[0], extended_value(axis[0]));
  return product_plus(d[2], extended_value(axis[2]),
                      product_plus(d[1], extended_value(axis[1]), x));
}

// The view of these lanes as well as extended numbers know it.
INLINED ViewLanes sharp_view_in_plane(ViewLanes view, INTEGER sharp, const Vectors position,
                                      const ProjectParameters p, const SharpParameters e) {
  ExtendedValue d[3];
  d[0] = offset_in_extended(position.x, e.position[0]);
  d[1] = offset_in_extended(position.y, e.position[1]);
  d[2] = offset_in_extended(position.z, e.position[2]);
  ExtendedValue scale = extended_value(e.pixels_per_length);
  if (p.perspective) {
    scale = quotient_of_extended(scale, not_below(along_in_extended(d, e.forward), p.least_depth));
  }
  const ExtendedValue x =
      product_plus(along_in_extended(d, e.right), scale, extended_value(e.center_from_middle_x));
  const ExtendedValue y =
      product_plus(along_in_extended(d, e.down), scale, extended_value(e.center_from_middle_y));
  view.x = choose(view.x, high_value(x), sharp);
  view.x_low = choose(view.x_low, low_value(x), sharp);
  view.y = choose(view.y, high_value(y), sharp);
  view.y_low = choose(view.y_low, low_value(y), sharp);
  view.scale = choose(view.scale, high_value(scale), sharp);
  return view;
}

// Of sharp splats, those that even the integers of splats' places would move too far, or that are
// so bright that single precision of their widths would show where they have faded. Of all in the
// picture: a crop is drawn as it is.
INLINED INTEGER are_too_sharp(const ViewLanes view, VALUE sigma, VALUE own_peak, VALUE crowd_peak,
                              const ProjectParameters p) {
  const VALUE reach = 7.0f * sigma + 2.0f;
  INTEGER in_picture = view.y + reach >= p.seen_top & view.y - reach <= p.seen_bottom;
  if (!COPIES) in_picture &= view.x + reach >= p.seen_left & view.x - reach <= p.seen_right_end;
  // Copies of one may lie upon one another, up to a light of 1 or to what turned out to lie in one
  // place, and are misplaced alike.
  const VALUE all = max(crowd_peak, (VALUE)(1.0f));
  const VALUE of_copies = max(own_peak, min(MOST_COPIES * own_peak, all));
  VALUE fading = (VALUE)(0.0f), slope = 0.86f * of_copies;
  if (ANY(of_copies > 1.0f)) {
    fading = 0.693147181f * log2_positive(max(of_copies, (VALUE)(1.0f)));
    slope = choose(slope, 2.0f * sqrt(fading), of_copies > 2.0f);
  }
  return in_picture & ((sigma < p.too_sharp_width * slope) | (fading > p.most_fading));
}
