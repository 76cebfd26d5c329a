// Entries of tiles' lists (bin.h), in either shape.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"
#include "kernels/project/amplitudes.cl"

// The colors of splats: what they emit and absorb at the center.
INLINED float3 own_color_of(const Splat splat) {
#if VECTOR_COLORS
  return (float3)(splat.own_color.rgb[0], splat.own_color.rgb[1], splat.own_color.rgb[2]);
#else
  return (float3)(1.0f);
#endif
}

#if !LIGHT_ORDERED
// E w, or A w in the proportional plan, at the cloud's centre.
INLINED float3 summed_amplitude(const Splat splat, const ComponentColors colors,
                                __global const float* knots) {
  float3 summed =
      splat.weight * colors.summed_scale *
      sample_knots(knots, colors.first_summed_knot, colors.last_summed_knot, splat.color);
  // An absorption palette of its own is not the particles' colour.
  const int is_own = VECTOR_COLORS && colors.first_summed_knot == colors.first_knot;
  return is_own ? summed * own_color_of(splat) : summed;
}
#else
// A cloud's own amplitude over that of its splat, which is widened where center values are taken,
// and narrower on a coarse grid that is blurred afterwards.
INLINED float own_part(const Splat splat, const BinParameters p) {
#if FACE_OF_CUBE
  return 1.0f / splat.part;
#elif ELLIPSES
  const float drawn2 = splat.sigma * splat.sigma;
  const float across2 = splat.along_x.sigma * splat.along_x.sigma;
  float restored = splat.sigma < p.mean_sigma ? 1.0f : drawn2 / (drawn2 - p.widening);
  restored *= splat.along_x.sigma < p.mean_sigma ? 1.0f : across2 / (across2 - p.widening);
  return sqrt(restored);
#else
  const float drawn2 = splat.sigma * splat.sigma;
  const uint grid = grid_of(splat);
  if (grid == 0) return splat.sigma < p.mean_sigma ? 1.0f : drawn2 / (drawn2 - p.widening);
  const float wide2 = drawn2 + blur_of_grid(grid, &p.blurs);
  const float in_picture2 = wide2 * as_float((127 + 2 * level_of_grid(grid, &p.blurs)) << 23);
  return drawn2 / wide2 * (in_picture2 / (in_picture2 - p.widening));
#endif
}

// E w and A w at the cloud's centre.
INLINED Amplitudes amplitudes_of_splat(const Splat splat, const ComponentColors colors,
                                       __global const float* knots, const BinParameters p) {
  const Paint paint = {splat.color, splat.weight, colors.brightness, colors.absorption_factor,
                       own_color_of(splat)};
  Amplitudes found = amplitudes_of(paint, colors, knots);
  if (colors.absorption_kind == ABSORPTION_GRAY)
    absorb_gray(&found, found.emission * own_part(splat, p), colors.absorption_factor);
  return found;
}
#endif

#if EXTENDED_NUMBERS
INLINED TileSplat entry_without_place(const Splat splat, uint slot, const ComponentColors colors,
                                      __global const float* knots, const BinParameters p) {
  TileSplat entry;
  entry.slot = slot;
  return entry;
}

INLINED void set_units(TileSplat* entry, const Splat splat, int2 units, float unit) {}
INLINED void set_place(TileSplat* entry, const Splat splat, const Grid grid, int2 tile_middle) {}
#else
// All but the place, which differs from tile to tile, of the splat in this slot.
INLINED TileSplat entry_without_place(const Splat splat, uint slot, const ComponentColors colors,
                                      __global const float* knots, const BinParameters p) {
  TileSplat entry;
  entry.sigma = splat.sigma;
  entry.radius = splat.radius;
#if ELLIPSES
  entry.along_x = splat.along_x;
#endif
#if FACE_OF_CUBE
  entry.tilt = splat.tilt;
#endif
#if LIGHT_ORDERED
  const Amplitudes found = amplitudes_of_splat(splat, colors, knots, p);
  entry.emission[0] = found.emission.x;
  entry.emission[1] = found.emission.y;
  entry.emission[2] = found.emission.z;
  entry.absorption[0] = found.absorption.x;
  entry.absorption[1] = found.absorption.y;
  entry.absorption[2] = found.absorption.z;
#else
  const float3 summed = summed_amplitude(splat, colors, knots);
  entry.summed[0] = summed.x;
  entry.summed[1] = summed.y;
  entry.summed[2] = summed.z;
#endif
  return entry;
}

// The place in so many units from the middle of the tile: exact in integers, so that near by no
// digit is lost.
INLINED void set_units(TileSplat* entry, const Splat splat, int2 units, float unit) {
  const float2 place = convert_float2(units) * unit;
  entry->x = place.x;
  entry->y = place.y;
#if FINE_PLACES
  entry->x_low = rest_of_units(units.x, fraction_of_x(splat), unit);
  entry->y_low = rest_of_units(units.y, fraction_of_y(splat), unit);
#endif
}

// From the middle of the tile at this pixel of the grid.
INLINED void set_place(TileSplat* entry, const Splat splat, const Grid grid, int2 tile_middle) {
  const int2 place = (int2)(splat.x, splat.y);
  const int2 from_middle = tile_middle - (int2)(grid.middle_x, grid.middle_y);
  const int bits = place_bits_of(splat, grid);
  const float unit = unit_of(splat, grid);
  if (bits > 0) {
    set_units(entry, splat, place - (from_middle << bits), unit);
    return;
  }
  // A splat of units of a pixel and more is wider than they are by far.
  entry->x = (float)place.x * unit - (float)from_middle.x;
  entry->y = (float)place.y * unit - (float)from_middle.y;
#if FINE_PLACES
  entry->x_low = entry->y_low = 0.0f;
#endif
}
#endif
