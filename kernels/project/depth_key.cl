// Depths as integers (src/scene/depth_key.h): they order particles, and decide on which side of a
// limit one lies. In integers alone, but for products with powers of two, so that every device has
// the reference's bits.

#define ZERO_DEPTH ((ulong)1 << 47)
// In units (src/scene/depth_key.h).
#define LEAST_PERSPECTIVE_DEPTH ((long)1 << 22)

typedef struct Depth {
  ulong key;             // 48 bits
  int is_before_camera;  // where a projection can show it at all
} Depth;

inline long wide_integer(WideInteger words) {
  return (long)((ulong)words.low | ((ulong)words.high << 32));
}

inline float power_of_two_float(int exponent) {
  return as_float((uint)(127 + exponent) << 23);
}

// The exponent of the leading bit beyond the 41st, and the leading 41 bits, as one number: it
// grows with magnitude * 2^exponent, and is that itself below 2^41.
inline ulong compressed_depth(ulong magnitude, int exponent, int largest_exponent) {
  if (magnitude == 0) return 0;
  const int beyond = max(64 - (int)clz(magnitude) + exponent - 41, 0);
  if (beyond > largest_exponent) return ((ulong)(largest_exponent + 2) << 40) - 1;
  const int down = beyond - exponent;
  const ulong leading = down >= 0 ? magnitude >> min(down, 63) : magnitude << -down;
  return ((ulong)beyond << 40) + leading;
}

// Numbers of 60 bits as two of 30, whose products are 64 bits on any device.
typedef struct Halves {
  long high, low;
} Halves;

inline Halves halves_of(long value) {
  Halves halves;
  halves.high = value >> 30;
  halves.low = value & 0x3fffffff;
  return halves;
}

// The scalar product of three numbers each / 2^60.
inline long upper_product(Halves ax, Halves bx, Halves ay, Halves by, Halves az, Halves bz) {
  const long upper = ax.high * bx.high + ay.high * by.high + az.high * bz.high;
  const long middle = ax.high * bx.low + ax.low * bx.high + ay.high * by.low + ay.low * by.high +
                      az.high * bz.low + az.low * bz.high;
  return upper + (middle >> 30);
}

#ifdef WIDE_ANGLE
// The key of a distance with these components, each below 2^60.
inline ulong distance_key(ulong x, ulong y, ulong z, int exponent) {
  const ulong all = x | y | z;
  if (all == 0) return 0;
  const int doublings = (int)clz(all) - 4;
  const Halves a = halves_of((long)(x << doublings)), b = halves_of((long)(y << doublings)),
               c = halves_of((long)(z << doublings));
  return compressed_depth((ulong)upper_product(a, a, b, b, c, c), 60 + 2 * (exponent - doublings),
                          254);
}
#endif

// From the camera.
typedef struct Place {
  long x, y, z;  // in 2^exponent finest units
  int exponent;
} Place;

// In two steps: 2^power itself may be no float.
inline float times_power_of_two(float value, int power) {
  return value * power_of_two_float(power / 2) * power_of_two_float(power - power / 2);
}

INLINED Place place_in_units(float x, float y, float z, int coarser, const DepthKeyParameters p) {
  const int power = clamp(-(p.unit + coarser), -252, 252), down = min(coarser, 63);
  Place place;
  place.x = (wide_integer(p.origin_from_camera[0]) >> down) + (long)times_power_of_two(x, power);
  place.y = (wide_integer(p.origin_from_camera[1]) >> down) + (long)times_power_of_two(y, power);
  place.z = (wide_integer(p.origin_from_camera[2]) >> down) + (long)times_power_of_two(z, power);
  place.exponent = p.unit + coarser - p.finest_unit;
  return place;
}

// Three coordinates as they are stored. Nearly all are small enough for the component's own unit,
// which needs few operations per particle.
INLINED Place place_of(__global const float* position, const DepthKeyParameters p) {
  const float x = position[0], y = position[1], z = position[2];
  const float largest = max(fabs(x), max(fabs(y), fabs(z)));
  const int coarser = (int)(as_uint(largest) >> 23) - 127 - p.unit - 58;
  if (coarser <= 0) return place_in_units(x, y, z, 0, p);
  return place_in_units(x, y, z, coarser, p);
}

INLINED Depth depth_of(__global const float* position, const DepthKeyParameters p) {
  const Place place = place_of(position, p);
  Depth depth;
#ifdef WIDE_ANGLE
  depth.key = distance_key(abs(place.x), abs(place.y), abs(place.z), place.exponent);
  depth.is_before_camera = depth.key != 0;
#else
  const long z = upper_product(halves_of(place.x), halves_of(wide_integer(p.forward[0])),
                               halves_of(place.y), halves_of(wide_integer(p.forward[1])),
                               halves_of(place.z), halves_of(wide_integer(p.forward[2])));
  const ulong magnitude = compressed_depth(abs(z), place.exponent, 126);
  depth.key = z < 0 ? ZERO_DEPTH - magnitude : ZERO_DEPTH + magnitude;
  depth.is_before_camera = !p.perspective | (z >= LEAST_PERSPECTIVE_DEPTH);
#endif
  return depth;
}

// The key of the near limit that follows from a smoothing length, as it is stored.
inline ulong near_key_of(float h, const DepthKeyParameters p) {
  const uint bits = as_uint(h), exponent_bits = bits >> 23;
  const ulong digits = (bits & 0x7fffffu) | (exponent_bits != 0 ? 0x800000u : 0u);
  const int doublings = (int)clz(digits) - 4;
  const Halves length = halves_of((long)(digits << doublings));
  const Halves factor = halves_of(wide_integer(p.near_factor)), none = halves_of(0);
  const ulong limit = (ulong)upper_product(length, factor, none, none, none, none);
  // h is digits * 2^(exponent_bits - 150).
  const int exponent =
      max((int)exponent_bits, 1) - 150 - doublings + p.near_exponent - p.finest_unit;
#ifdef WIDE_ANGLE
  return distance_key(limit, 0, 0, exponent);
#else
  return ZERO_DEPTH + compressed_depth(limit, exponent, 126);
#endif
}

inline int is_within_limits(const Depth depth, float h, const DepthKeyParameters p) {
  const ulong near_key =
      p.near_factor.high != 0 ? near_key_of(h, p) : (ulong)wide_integer(p.near_key);
  return depth.is_before_camera && depth.key >= near_key &&
         depth.key <= (ulong)wide_integer(p.far_key);
}

// Of particles from i on, those of which this is asked. A call: hardly any are.
__attribute__((noinline)) INTEGER are_within_limits(uint i, uint end, INTEGER asked,
                                                    const Columns columns,
                                                    const ProjectParameters p) {
  int within[LANES];
  STORE(asked, within);
  for (uint k = 0; k < LANES && i + k < end; ++k) {
    if (!within[k]) continue;
    const Depth depth = depth_of(columns.positions + (size_t)(i + k) * 3, p.depth_key);
    const float h = columns.smoothing_lengths[(size_t)(i + k) * p.smoothing_length_stride];
    within[k] = is_within_limits(depth, h, p.depth_key) ? -1 : 0;
  }
  return (asked == 0) | LOAD(within);
}
