// Entries of tiles' lists (bin.h), in either shape.
#include "kernels/bin/amplitudes.cl"
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/splat.cl"
#include "kernels/common/splat.h"

#if !EXTENDED_NUMBERS
// All but the place, which differs from tile to tile.
INLINED TileSplat entry_without_place(const Splat splat, const ComponentColors colors,
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
