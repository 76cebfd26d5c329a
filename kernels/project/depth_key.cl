// Depths as integers (src/scene/depth_key.h): they order particles, and decide on which side of a
// limit one lies. In integers alone, but for products with powers of two, so that every device has
// the reference's bits. On VALUEs (lanes.cl).
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

#define ZERO_DEPTH ((ulong)1 << 47)
// In units (src/scene/depth_key.h).
#define LEAST_PERSPECTIVE_DEPTH ((long)1 << 22)

typedef struct Depth {
  UNSIGNED_WIDE key;         // 48 bits
  INTEGER is_before_camera;  // where a projection can show it at all
} Depth;

static inline long wide_integer(WideInteger words) {
  return (long)((ulong)words.low | ((ulong)words.high << 32));
}

static inline VALUE power_of_two_float(INTEGER exponent) {
  return AS_VALUE((127 + exponent) << 23);
}

INLINED UNSIGNED_WIDE choose_wide(UNSIGNED_WIDE if_false, UNSIGNED_WIDE if_true, INTEGER mask) {
  return select(if_false, if_true, TO_WIDE(mask));
}

// How many bits a number has. Processors without registers of sixteen floats count none of vectors.
INLINED INTEGER bits_of_magnitude(UNSIGNED_WIDE magnitude) {
#if LANES == 8
  const INTEGER upper = TO_INTEGER(magnitude >> 32);
  if (!ANY(upper <= 0)) {
    // A number of which the second bit is 0 is not rounded up to more bits.
    const VALUE leading = TO_VALUE(upper & ~(upper >> 1));
    return (AS_INTEGER(leading) >> 23) - 126 + 32;
  }
#endif
  return 64 - TO_INTEGER(clz(magnitude));
}

// The exponent of the leading bit beyond the 41st, and the leading 41 bits, as one number: it
// grows with magnitude * 2^exponent, and is that itself below 2^41.
INLINED UNSIGNED_WIDE compressed_depth(UNSIGNED_WIDE magnitude, INTEGER exponent,
                                       int largest_exponent) {
  const INTEGER bits = bits_of_magnitude(magnitude);
  const INTEGER beyond = max(bits + exponent - 41, 0), down = beyond - exponent;
  const UNSIGNED_WIDE leading =
      choose_wide(magnitude << TO_UNSIGNED_WIDE(max(-down, 0)),
                  magnitude >> TO_UNSIGNED_WIDE(clamp(down, 0, 63)), down >= 0);
  const UNSIGNED_WIDE most = ((ulong)(largest_exponent + 2) << 40) - 1;
  const UNSIGNED_WIDE depth =
      choose_wide((TO_UNSIGNED_WIDE(beyond) << 40) + leading, most, beyond > largest_exponent);
  return choose_wide(depth, (UNSIGNED_WIDE)(0), bits == 0);
}

// Numbers of 60 bits as two of 30, whose products are 64 bits on any device.
typedef struct Halves {
  INTEGER high, low;
} Halves;

INLINED Halves halves_of(WIDE value) {
  Halves halves;
  halves.high = TO_INTEGER(value >> 30);
  halves.low = TO_INTEGER(value & 0x3fffffff);
  return halves;
}

INLINED WIDE product(INTEGER a, INTEGER b) {
  return TO_WIDE(a) * TO_WIDE(b);
}

// The scalar product of three numbers each / 2^60.
INLINED WIDE upper_product(Halves ax, Halves bx, Halves ay, Halves by, Halves az, Halves bz) {
  const WIDE upper =
      product(ax.high, bx.high) + product(ay.high, by.high) + product(az.high, bz.high);
  const WIDE middle = product(ax.high, bx.low) + product(ax.low, bx.high) +
                      product(ay.high, by.low) + product(ay.low, by.high) +
                      product(az.high, bz.low) + product(az.low, bz.high);
  return upper + (middle >> 30);
}

// The key of a distance with these components, each below 2^60.
INLINED UNSIGNED_WIDE distance_key(UNSIGNED_WIDE x, UNSIGNED_WIDE y, UNSIGNED_WIDE z,
                                   INTEGER exponent) {
  const UNSIGNED_WIDE all = x | y | z;
  // Of nothing at all there is nothing to double.
  const INTEGER doublings = min(TO_INTEGER(clz(all)) - 4, 59);
  const UNSIGNED_WIDE by = TO_UNSIGNED_WIDE(doublings);
  const Halves a = halves_of(TO_WIDE(x << by)), b = halves_of(TO_WIDE(y << by)),
               c = halves_of(TO_WIDE(z << by));
  return compressed_depth(TO_UNSIGNED_WIDE(upper_product(a, a, b, b, c, c)),
                          60 + 2 * (exponent - doublings), 254);
}

// From the camera.
typedef struct Place {
  WIDE x, y, z;  // in 2^exponent finest units
  INTEGER exponent;
} Place;

// Rounded to zero, of magnitudes below 2^62. The same processors would do it lane by lane.
INLINED WIDE to_wide(VALUE value) {
#if LANES == 8
  const INTEGER bits = AS_INTEGER(value), exponent = ((bits >> 23) & 0xff) - 150;
  const WIDE digits = TO_WIDE((bits & 0x7fffff) | 0x800000), sign = TO_WIDE(bits >> 31);
  WIDE magnitude = digits << TO_WIDE(max(exponent, 0));
  if (ANY(exponent < 0)) magnitude >>= TO_WIDE(clamp(-exponent, 0, 63));
  return (magnitude ^ sign) - sign;
#else
  return TO_WIDE(value);
#endif
}

// In two steps: 2^power itself may be no float.
INLINED VALUE times_power_of_two(VALUE value, INTEGER power) {
  return value * power_of_two_float(power / 2) * power_of_two_float(power - power / 2);
}

INLINED WIDE origin_from_camera(WideInteger origin, INTEGER down) {
  return (WIDE)(wide_integer(origin)) >> TO_WIDE(down);
}

INLINED Place place_in_units(const Vectors position, INTEGER coarser, const DepthKeyParameters p) {
  const INTEGER power = clamp(-(p.unit + coarser), -252, 252), down = min(coarser, 63);
  Place place;
  place.x = origin_from_camera(p.origin_from_camera[0], down) +
            to_wide(times_power_of_two(position.x, power));
  place.y = origin_from_camera(p.origin_from_camera[1], down) +
            to_wide(times_power_of_two(position.y, power));
  place.z = origin_from_camera(p.origin_from_camera[2], down) +
            to_wide(times_power_of_two(position.z, power));
  place.exponent = p.unit + coarser - p.finest_unit;
  return place;
}

// Coordinates as they are stored. Nearly all are small enough for the component's own unit,
// which needs few operations per particle.
INLINED Place place_of(const Vectors position, const DepthKeyParameters p) {
  const VALUE largest = max(fabs(position.x), max(fabs(position.y), fabs(position.z)));
  const INTEGER coarser = max((AS_INTEGER(largest) >> 23) - 127 - p.unit - 58, 0);
  if (!ANY(coarser > 0)) return place_in_units(position, (INTEGER)(0), p);
  return place_in_units(position, coarser, p);
}

INLINED Depth depth_of(const Vectors position, const DepthKeyParameters p) {
  const Place place = place_of(position, p);
  Depth depth;
  if (WIDE_ANGLE) {
    depth.key = distance_key(abs(place.x), abs(place.y), abs(place.z), place.exponent);
    depth.is_before_camera = TO_INTEGER(depth.key != 0);
    return depth;
  }
  const WIDE z = upper_product(halves_of(place.x), halves_of((WIDE)(wide_integer(p.forward[0]))),
                               halves_of(place.y), halves_of((WIDE)(wide_integer(p.forward[1]))),
                               halves_of(place.z), halves_of((WIDE)(wide_integer(p.forward[2]))));
  const UNSIGNED_WIDE magnitude = compressed_depth(abs(z), place.exponent, 126);
  depth.key = choose_wide(ZERO_DEPTH + magnitude, ZERO_DEPTH - magnitude, TO_INTEGER(z < 0));
  depth.is_before_camera =
      (INTEGER)(p.perspective ? 0 : -1) | TO_INTEGER(z >= LEAST_PERSPECTIVE_DEPTH);
  return depth;
}

// The key of the near limit that follows from a smoothing length, as it is stored.
INLINED UNSIGNED_WIDE near_key_of(VALUE h, const DepthKeyParameters p) {
  const INTEGER bits = AS_INTEGER(h), exponent_bits = (bits >> 23) & 0xff;
  const INTEGER digits =
      (bits & 0x7fffff) | select((INTEGER)(0x800000), (INTEGER)(0), exponent_bits == 0);
  const UNSIGNED_WIDE wide_digits = TO_UNSIGNED_WIDE(digits);
  const INTEGER doublings = TO_INTEGER(clz(wide_digits)) - 4;
  const Halves length = halves_of(TO_WIDE(wide_digits << TO_UNSIGNED_WIDE(doublings)));
  const Halves factor = halves_of((WIDE)(wide_integer(p.near_factor))), none = halves_of((WIDE)(0));
  const UNSIGNED_WIDE limit =
      TO_UNSIGNED_WIDE(upper_product(length, factor, none, none, none, none));
  // h is digits * 2^(exponent_bits - 150).
  const INTEGER exponent =
      max(exponent_bits, 1) - 150 - doublings + p.near_exponent - p.finest_unit;
  return WIDE_ANGLE ? distance_key(limit, (UNSIGNED_WIDE)(0), (UNSIGNED_WIDE)(0), exponent)
                    : ZERO_DEPTH + compressed_depth(limit, exponent, 126);
}

INLINED INTEGER is_within_limits(const Depth depth, VALUE h, const DepthKeyParameters p) {
  UNSIGNED_WIDE near_key = (UNSIGNED_WIDE)((ulong)wide_integer(p.near_key));
  if (p.near_factor.high != 0) near_key = near_key_of(h, p);
  return depth.is_before_camera & TO_INTEGER(depth.key >= near_key) &
         TO_INTEGER(depth.key <= (UNSIGNED_WIDE)((ulong)wide_integer(p.far_key)));
}

// Of particles from i on, those of which this is asked: hardly any.
SELDOM_CALLED INTEGER are_within_limits(uint i, uint end, INTEGER asked, const Columns columns,
                                        const ProjectParameters p) {
  const VALUE h = load_values(columns.smoothing_lengths, i, end, p.launch.smoothing_length_stride);
  const Depth depth = depth_of(load_vectors(columns.positions, i, end), p.depth_key);
  return (asked == 0) | is_within_limits(depth, h, p.depth_key);
}

// Sort keys of splats: the order of an ordered frame, and of which part of it splats are.
#define SORT_KEYS (OUTPUT_KEYS || COUNT_KEYS)

// Order-preserving: smaller floats become smaller integers, -0 and +0 the same one.
static inline INTEGER field_key(VALUE value) {
  const INTEGER bits = AS_INTEGER(choose(value, (VALUE)(0.0f), value == 0.0f));
  return bits ^ ((bits >> 31) | (INTEGER)(int)0x80000000u);
}

// Of particles from i on, whose sort fields are `values`: 48 bits, ascending with the order.
INLINED UNSIGNED_WIDE sort_keys_of(const Columns columns, uint i, uint end, VALUE values,
                                   const ProjectParameters p) {
  if (p.sort_by_field) {
    const INTEGER key = field_key(values);
    return (TO_UNSIGNED_WIDE(p.sort_descending ? ~key : key) & 0xffffffffUL) << 16;
  }
  const UNSIGNED_WIDE key = depth_of(load_vectors(columns.positions, i, end), p.depth_key).key;
  return p.sort_descending ? key ^ 0xffffffffffffUL : key;
}

static inline int is_in_window(ulong key, const ProjectParameters p) {
  return key >= (ulong)wide_integer(p.launch.window_first) &&
         key < (ulong)wide_integer(p.launch.window_end);
}

static inline uint bin_of(ulong key, const ProjectParameters p) {
  return (uint)(key >> p.launch.bin_shift) & (KEY_BINS - 1u);
}
