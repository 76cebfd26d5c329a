// Where splats lie on their grid, as integers (splat.h).
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/common/splat.h"
#include "kernels/project/limits.cl"
#include "kernels/project/project.h"
#include "kernels/project/wide_angle.cl"

#pragma OPENCL FP_CONTRACT OFF

// In units of 2^coarser of the grid's.
typedef struct PlaceLanes {
  INTEGER x, y, coarser;
  INTEGER fractions;  // as in Splat, of fine places
} PlaceLanes;

// To the nearest unit; `fraction` takes 2^16 of what is left of the sum of `high` and `low`.
INLINED INTEGER in_fine_units(VALUE high, VALUE low, VALUE units_per_pixel, INTEGER* fraction) {
  const VALUE units = high * units_per_pixel;
  const INTEGER whole = TO_INTEGER(units);
  const VALUE rest = (units - TO_VALUE(whole)) + low * units_per_pixel;
  const INTEGER nearest = TO_INTEGER(rest + choose((VALUE)(-0.5f), (VALUE)(0.5f), rest > 0.0f));
  *fraction = TO_INTEGER((rest - TO_VALUE(nearest)) * 65534.0f);
  return whole + nearest;
}

// To less than a unit, and to half of one where `low` is known, what the last digit of `high`
// leaves.
INLINED INTEGER in_units(VALUE high, VALUE low, VALUE units_per_pixel) {
  const VALUE units = high * units_per_pixel;
  const INTEGER whole = TO_INTEGER(units);
  if (!ANY(low != 0.0f)) return whole;
  const VALUE rest = (units - TO_VALUE(whole)) + low * units_per_pixel;
  const VALUE to_nearest = choose((VALUE)(-0.5f), (VALUE)(0.5f), rest > 0.0f);
  return whole + select((INTEGER)(0), TO_INTEGER(rest + to_nearest), low != 0.0f);
}

// From pixels of the grid from its middle. The units hold `farthest`, within which the splat lies
// and all copies of it that are drawn.
INLINED PlaceLanes splat_place(VALUE x, VALUE x_low, VALUE y, VALUE y_low, VALUE farthest,
                               const ProjectParameters p) {
  const INTEGER exponent = power_of_two(farthest);
  const INTEGER beyond = exponent + (p.place_bits - 29);
  PlaceLanes place;
  place.coarser = max(beyond, (INTEGER)(0));
  const VALUE units_per_pixel = AS_VALUE((127 + p.place_bits - place.coarser) << 23);
  if (FINE_PLACES) {
    INTEGER fraction_x, fraction_y;
    place.x = in_fine_units(x, x_low, units_per_pixel, &fraction_x);
    place.y = in_fine_units(y, y_low, units_per_pixel, &fraction_y);
    place.fractions = (fraction_x & 0xffff) | (fraction_y << 16);
  } else {
    place.x = in_units(x, x_low, units_per_pixel);
    place.y = in_units(y, y_low, units_per_pixel);
  }
  return place;
}
