// Columns between two snapshots, bit for bit as src/between/interpolation.cpp has them: one
// operation after the other, and none that devices round in their own ways. LANES particles at a
// time.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/interpolate/interpolate.h"

#pragma OPENCL FP_CONTRACT OFF

#define NOBODY 0xffffffffu

// Once for all frames of a pair: a column of the second snapshot in the order of the particles
// between the two. Frames then read memory one after the other.
__kernel void order_second(const InterpolateParameters p, __global const float* second,
                           __global const uint* place_in_second, __global const uint* appearing,
                           __global float* ordered) {
  const size_t begin = get_global_id(0) * (size_t)p.particles_of_item;
  const uint end = (uint)min(begin + p.particles_of_item, (size_t)p.particles);
  for (uint i = (uint)min(begin, (size_t)p.particles); i < end; ++i) {
    const uint place = i < p.in_first ? place_in_second[i] : appearing[i - p.in_first];
    for (uint k = 0; k < p.width; ++k) {
      ordered[(size_t)i * p.width + k] =
          place == NOBODY ? 0.0f : second[(size_t)place * p.width + k];
    }
  }
}

// In which of the snapshots LANES particles are.
typedef struct MemberLanes {
  INTEGER in_first, in_second;
} MemberLanes;

INLINED MemberLanes find_members(uint begin, const InterpolateParameters p,
                                 __global const uint* place_in_second) {
  MemberLanes of;
  if (begin + LANES <= p.in_first) {
    of.in_first = (INTEGER)(-1);
    of.in_second = select((INTEGER)(-1), (INTEGER)(0),
                          LOAD((__global const int*)place_in_second + begin) == (int)NOBODY);
    return of;
  }
  int in_first[LANES], in_second[LANES];
  for (uint k = 0; k < LANES; ++k) {
    const uint i = begin + k;
    in_first[k] = i < p.in_first ? -1 : 0;
    in_second[k] = i >= p.in_first || place_in_second[i] != NOBODY ? -1 : 0;
  }
  of.in_first = LOAD(in_first);
  of.in_second = LOAD(in_second);
  return of;
}

// Values of LANES particles as memory holds them, in as many parts of LANES as a particle has
// values, one or three: lane l of part k is value (k LANES + l) % width of particle (k LANES + l) /
// width.
#define PLACE_IN_PARTS(part, lane) ((part)*LANES + (lane))

// Masks of particles for their values in a part.
INLINED INTEGER particles_in_part(INTEGER mask, uint width, uint part) {
#ifdef LANES_8
  if (width == 1) return mask;
  if (part == 0) return mask.s00011122;
  return part == 1 ? mask.s23334445 : mask.s55666777;
#else
  return mask;
#endif
}

INLINED MemberLanes members_in_part(const MemberLanes of, uint width, uint part) {
  MemberLanes in_part;
  in_part.in_first = particles_in_part(of.in_first, width, part);
  in_part.in_second = particles_in_part(of.in_second, width, part);
  return in_part;
}

// Those of particles from `begin` on; at or beyond `end` they are the last one's.
INLINED VALUE load_part(__global const float* values, uint begin, uint end, uint width, uint part,
                        int stride) {
  if (stride == 0 || end == 0) return (VALUE)(values[0]);
  if (begin + LANES <= end) return LOAD(values + ((size_t)begin * width + part * LANES));
  float found[LANES];
  for (uint l = 0; l < LANES; ++l) {
    const uint place = PLACE_IN_PARTS(part, l);
    found[l] = values[(size_t)min(begin + place / width, end - 1) * width + place % width];
  }
  return LOAD(found);
}

INLINED void write_part(VALUE between, uint begin, uint width, uint particles, uint part,
                        __global float* values) {
  __global float* to = values + ((size_t)begin * width + part * LANES);
  if (begin + LANES <= particles) {
    STORE(between, to);
    return;
  }
  float found[LANES];
  STORE(between, found);
  for (uint l = 0; l < LANES; ++l) {
    if (begin + PLACE_IN_PARTS(part, l) / width < particles) to[l] = found[l];
  }
}

// floor() is a call on PoCL.
static inline VALUE floor_of(VALUE value) {
  const VALUE least_without_fraction = (VALUE)(8388608.0f);
  const INTEGER has_fraction = fabs(value) < least_without_fraction;
  const VALUE truncated = TO_VALUE(TO_INTEGER(choose((VALUE)(0.0f), value, has_fraction)));
  const VALUE below = truncated - choose((VALUE)(0.0f), (VALUE)(1.0f), truncated > value);
  return choose(value, below, has_fraction);
}

static inline VALUE mean_of(VALUE a, VALUE b, float fraction) {
  return choose(a + fraction * (b - a), a, a == b);
}

static inline VALUE log2_of_mantissa(VALUE m) {
  const VALUE x = m - 1.0f;
  VALUE p = 0.1292618f;
  p = p * x - 0.20893268f;
  p = p * x + 0.21521264f;
  p = p * x - 0.23867586f;
  p = p * x + 0.28793907f;
  p = p * x - 0.36071625f;
  p = p * x + 0.48091027f;
  p = p * x - 0.7213472f;
  p = p * x + 1.442695f;
  return p * x;
}

static inline VALUE exp2_of_rest(VALUE x) {
  VALUE p = 0.00015469728f;
  p = p * x + 0.0013390867f;
  p = p * x + 0.009618031f;
  p = p * x + 0.05550357f;
  p = p * x + 0.2402265f;
  p = p * x + 0.6931472f;
  return p * x + 1.0f;
}

// Of a normal number > 0, as m 2^e with m from sqrt(1/2) to sqrt(2).
static inline INTEGER exponent_of(VALUE value) {
  return (AS_INTEGER(value) - 0x3f3504f3) >> 23;
}
static inline VALUE mantissa_of(VALUE value) {
  return AS_VALUE(((AS_INTEGER(value) - 0x3f3504f3) & 0x007fffff) + 0x3f3504f3);
}

static inline VALUE exact_power_of_two(INTEGER exponent) {
  return AS_VALUE((exponent + 127) << 23);
}

static inline INTEGER is_normal_and_positive(VALUE value) {
  return value >= FLT_MIN & value <= FLT_MAX;
}

INLINED VALUE geometric_mean_of(VALUE any_a, VALUE any_b, float fraction) {
  const INTEGER has_logarithms = is_normal_and_positive(any_a) & is_normal_and_positive(any_b);
  const VALUE a = choose((VALUE)(1.0f), any_a, has_logarithms);
  const VALUE b = choose((VALUE)(1.0f), any_b, has_logarithms);
  const VALUE octaves =
      fraction * TO_VALUE(exponent_of(b) - exponent_of(a)) +
      fraction * (log2_of_mantissa(mantissa_of(b)) - log2_of_mantissa(mantissa_of(a)));
  const VALUE whole = floor_of(octaves + 0.5f);
  const INTEGER steps = TO_INTEGER(whole), part = steps >> 1;
  const VALUE mean = (a * exp2_of_rest(octaves - whole)) * exact_power_of_two(part) *
                     exact_power_of_two(steps - part);
  const VALUE inside = min(max(mean, min(a, b)), max(a, b));
  return choose(mean_of(any_a, any_b, fraction), inside, has_logarithms);
}

// Those that vanish and appear have their own.
static inline VALUE of_members(VALUE both, VALUE vanishing, VALUE appearing, const MemberLanes of) {
  return choose(appearing, choose(vanishing, both, of.in_second), of.in_first);
}

INLINED VALUE value_between(uint i, const InterpolateParameters p, const MemberLanes of, uint part,
                            __global const float* first, __global const float* second) {
  const VALUE a = load_part(first, i, p.in_first, p.width, part, p.first_stride);
  const VALUE b = load_part(second, i, p.particles, p.width, part, p.second_stride);
  const VALUE both =
      p.logarithmic ? geometric_mean_of(a, b, p.fraction) : mean_of(a, b, p.fraction);
  return of_members(both, a * p.vanishing, b * p.appearing, members_in_part(of, p.width, part));
}

// `second` as order_second() has it.
__kernel void interpolate_values(const InterpolateParameters p, __global const float* first,
                                 __global const float* second, __global const uint* place_in_second,
                                 __global float* values) {
  const size_t begin = get_global_id(0) * (size_t)p.particles_of_item;
  const uint end = (uint)min(begin + p.particles_of_item, (size_t)p.particles);
  for (uint i = (uint)min(begin, (size_t)p.particles); i < end; i += LANES) {
    const MemberLanes of = find_members(i, p, place_in_second);
    for (uint part = 0; part < p.width; ++part)
      write_part(value_between(i, p, of, part, first, second), i, p.width, p.particles, part,
                 values);
  }
}

// What holds for an axis, in the lanes of a part.
typedef struct PathAxes {
  VALUE shift_high, shift_low, size_high, size_low, inverse_size, lower, upper;
} PathAxes;

INLINED VALUE axes_in_part(const float* of_axes, uint part) {
  float found[LANES];
  for (uint l = 0; l < LANES; ++l)
    found[l] = of_axes[PLACE_IN_PARTS(part, l) % 3];
  return LOAD(found);
}

INLINED PathAxes axes_of_part(const PathParameters path, uint part) {
  PathAxes axes;
  axes.shift_high = axes_in_part(path.shift_high, part);
  axes.shift_low = axes_in_part(path.shift_low, part);
  axes.size_high = axes_in_part(path.size_high, part);
  axes.size_low = axes_in_part(path.size_low, part);
  axes.inverse_size = axes_in_part(path.inverse_size, part);
  axes.lower = axes_in_part(path.lower, part);
  axes.upper = axes_in_part(path.upper, part);
  return axes;
}

static inline VALUE less_periods(VALUE x, VALUE periods, const PathAxes axes) {
  return (x - periods * axes.size_high) - periods * axes.size_low;
}

static inline VALUE wrapped(VALUE x, const PathAxes axes, const PathParameters path) {
  if (!path.is_periodic) return x;
  const INTEGER is_inside = x >= axes.lower & x < axes.upper;
  if (!ANY(is_inside == 0)) return x;
  const VALUE moved = less_periods(x, floor_of((x - axes.lower) * axes.inverse_size), axes);
  return choose(moved, x, is_inside);
}

// The columns that paths follow from; those of the second as order_second() has them.
typedef struct PathColumns {
  __global const float *first, *second, *first_velocity, *second_velocity;
} PathColumns;

// A part of the positions of particles from i on.
INLINED VALUE positions_between(uint i, const InterpolateParameters p, const PathParameters path,
                                const MemberLanes particles, uint part, const PathAxes axes,
                                const PathColumns columns) {
  const MemberLanes of = members_in_part(particles, 3, part);
  const VALUE x = load_part(columns.first, i, p.in_first, 3, part, p.first_stride);
  const VALUE y = load_part(columns.second, i, p.particles, 3, part, p.second_stride);
  // Without velocities their columns hold one 0.
  const VALUE m =
      load_part(columns.first_velocity, i, p.in_first, 3, part, path.first_velocity_stride) *
      path.first_rate;
  const VALUE n =
      load_part(columns.second_velocity, i, p.particles, 3, part, path.second_velocity_stride) *
      path.second_rate;
  VALUE way = ((y - x) + axes.shift_high) + axes.shift_low;
  if (path.is_periodic) {
    way = less_periods(way, floor_of(way * axes.inverse_size + 0.5f), axes);
  }
  const VALUE moved = path.is_straight ? p.fraction * way
                                       : (path.of_way * way + path.of_first_tangent * m) +
                                             path.of_second_tangent * n;
  const VALUE appeared = (y + axes.shift_high) + axes.shift_low;
  return wrapped(
      of_members(x + moved, x + path.from_first * m, appeared + path.from_second * n, of), axes,
      path);
}

__kernel void interpolate_positions(const InterpolateParameters p, const PathParameters path,
                                    __global const float* first, __global const float* second,
                                    __global const float* first_velocity,
                                    __global const float* second_velocity,
                                    __global const uint* place_in_second, __global float* values) {
  PathColumns columns;
  columns.first = first;
  columns.second = second;
  columns.first_velocity = first_velocity;
  columns.second_velocity = second_velocity;
  const size_t begin = get_global_id(0) * (size_t)p.particles_of_item;
  const uint end = (uint)min(begin + p.particles_of_item, (size_t)p.particles);
  const PathAxes first_part = axes_of_part(path, 0), second_part = axes_of_part(path, 1),
                 third_part = axes_of_part(path, 2);
  for (uint i = (uint)min(begin, (size_t)p.particles); i < end; i += LANES) {
    const MemberLanes of = find_members(i, p, place_in_second);
    write_part(positions_between(i, p, path, of, 0, first_part, columns), i, 3, p.particles, 0,
               values);
    write_part(positions_between(i, p, path, of, 1, second_part, columns), i, 3, p.particles, 1,
               values);
    write_part(positions_between(i, p, path, of, 2, third_part, columns), i, 3, p.particles, 2,
               values);
  }
}
