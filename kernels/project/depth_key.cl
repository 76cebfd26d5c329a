// Depths as integers (src/scene/depth_key.h): they order particles, and decide on which side of a
// limit one lies. In integers alone, but for products with powers of two, so that every device has
// the reference's bits.

#define ZERO_DEPTH ((ulong)1 << 47)
// In 4 units (src/scene/depth_key.h).
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

#ifdef WIDE_ANGLE
// The key of a distance whose components these are, each below 2^62.
inline ulong distance_key(ulong x, ulong y, ulong z, int exponent) {
  const ulong all = x | y | z;
  if (all == 0) return 0;
  const int doublings = (int)clz(all) - 2;
  x <<= doublings;
  y <<= doublings;
  z <<= doublings;
  const ulong squared = mul_hi(x, x) + mul_hi(y, y) + mul_hi(z, z);
  return compressed_depth(squared, 64 + 2 * (exponent - doublings), 254);
}
#endif

// Three coordinates as they are stored. Powers of two in two steps: the product of both may leave
// single precision where the coordinate times it does not.
INLINED Depth depth_of(__global const float* position, const DepthKeyParameters p) {
  const float x = position[0], y = position[1], z = position[2];
  const float largest = max(fabs(x), max(fabs(y), fabs(z)));
  const int largest_exponent = (int)(as_uint(largest) >> 23) - 127;
  const int coarser = max(largest_exponent - p.unit - 60, 0);
  const int power = clamp(-(p.unit + coarser), -252, 252);
  const float first = power_of_two_float(power / 2);
  const float second = power_of_two_float(power - power / 2);
  const int down = min(coarser, 63);
  const long dx = (wide_integer(p.origin_from_camera[0]) >> down) + (long)(x * first * second);
  const long dy = (wide_integer(p.origin_from_camera[1]) >> down) + (long)(y * first * second);
  const long dz = (wide_integer(p.origin_from_camera[2]) >> down) + (long)(z * first * second);
  const int exponent = p.unit + coarser - p.finest_unit;
  Depth depth;
#ifdef WIDE_ANGLE
  depth.key = distance_key(abs(dx), abs(dy), abs(dz), exponent);
  depth.is_before_camera = (dx | dy | dz) != 0;
#else
  const long along_view = mul_hi(dx, wide_integer(p.forward[0])) +
                          mul_hi(dy, wide_integer(p.forward[1])) +
                          mul_hi(dz, wide_integer(p.forward[2]));
  const ulong magnitude = compressed_depth(abs(along_view), exponent + 2, 126);
  depth.key = along_view < 0 ? ZERO_DEPTH - magnitude : ZERO_DEPTH + magnitude;
  depth.is_before_camera = !p.perspective | (along_view >= LEAST_PERSPECTIVE_DEPTH);
#endif
  return depth;
}

// The key of the near limit that follows from a smoothing length, as it is stored.
inline ulong near_key_of(float h, const DepthKeyParameters p) {
  const uint bits = as_uint(h), exponent_bits = bits >> 23;
  const ulong digits = (bits & 0x7fffffu) | (exponent_bits != 0 ? 0x800000u : 0u);
  const int doublings = (int)clz(digits) - 2;
  const ulong limit = mul_hi(digits << doublings, (ulong)wide_integer(p.near_factor));
  // h is digits * 2^(exponent_bits - 150); the factor counts 2^-62, and mul_hi gives 2^64 less.
  const int exponent =
      max((int)exponent_bits, 1) - 150 - doublings + p.near_exponent + 2 - p.finest_unit;
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
