// Where splats lie on their grid, as integers (splat.h).
#pragma OPENCL FP_CONTRACT OFF

// In units of 2^coarser of the grid's.
typedef struct PlaceLanes {
  INTEGER x, y, coarser;
} PlaceLanes;

// To less than a unit. `low` is what the last digit of `high` leaves, where it is known. With a
// dither from 0 to 1, below 0 without, the unit above is taken as often as it is near.
INLINED INTEGER in_units(VALUE high, VALUE low, VALUE dither, VALUE units_per_pixel) {
  const VALUE units = high * units_per_pixel;
  const INTEGER whole = TO_INTEGER(units);
  const INTEGER dithered = dither >= 0.0f;
  if (!ANY((low != 0.0f) | dithered)) return whole;
  const VALUE rest = (units - TO_VALUE(whole)) + low * units_per_pixel;
  // The rest lies between -1 and 1: what is rounded down is made positive.
  const INTEGER down = TO_INTEGER(rest + dither + 2.0f) - 2;
  return whole + select(TO_INTEGER(rest), down, dithered);
}

// Numbers from 0 to 1 that follow from the numbers of the particles from i on, for two axes; below
// 0 where a lane is not sharp.
typedef struct DitherLanes {
  VALUE x, y;
} DitherLanes;

// Copies of one particle would otherwise be misplaced alike, and all splats towards the middle.
INLINED DitherLanes dither_of(uint i, INTEGER sharp) {
  DitherLanes d;
  d.x = d.y = (VALUE)(-1.0f);
  if (!ANY(sharp)) return d;
  UNSIGNED bits = (UNSIGNED)(i) + LANE_NUMBERS;
  bits *= (UNSIGNED)(0x9E3779B1u);
  bits ^= bits >> 15;
  bits *= (UNSIGNED)(0x85EBCA77u);
  bits ^= bits >> 13;
  const UNSIGNED other = bits * (UNSIGNED)(0xC2B2AE3Du);
  d.x = choose(d.x, TO_VALUE(bits >> 8) * 0x1p-24f, sharp);
  d.y = choose(d.y, TO_VALUE(other >> 8) * 0x1p-24f, sharp);
  return d;
}

// From pixels of the grid from its middle. The units hold `farthest`, within which the splat lies
// and all copies of it that are drawn.
INLINED PlaceLanes splat_place(VALUE x, VALUE x_low, VALUE y, VALUE y_low, DitherLanes dither,
                               VALUE farthest, const ProjectParameters p) {
  const INTEGER exponent = power_of_two(farthest);
  const INTEGER beyond = exponent + (p.place_bits - 29);
  PlaceLanes place;
  place.coarser = max(beyond, (INTEGER)(0));
  const VALUE units_per_pixel = AS_VALUE((127 + p.place_bits - place.coarser) << 23);
  place.x = in_units(x, x_low, dither.x, units_per_pixel);
  place.y = in_units(y, y_low, dither.y, units_per_pixel);
  return place;
}

#ifdef ELLIPSES
// Of the copy so many periods to the right, along x in the splat's units.
inline int steps_to_copy(const Splat splat, int copy, const ProjectParameters p) {
  const long period = (long)((ulong)p.period_units.low | ((ulong)p.period_units.high << 32));
  return (int)((copy * period) >> (splat.component_and_grid >> 24));
}
#endif

#ifdef EXTENDED_NUMBERS
inline float pixels_from_middle(int place, const Splat splat, const ProjectParameters p) {
  const int bits = p.place_bits - (int)(splat.component_and_grid >> 24);
  return (float)place * as_float((127 - bits) << 23);
}
#endif
