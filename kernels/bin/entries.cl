// Entries of tiles' lists (bin.h), in either shape.
#ifndef EXTENDED_NUMBERS
// All but the place, which differs from tile to tile.
INLINED TileSplat entry_without_place(const Splat splat, const ComponentColors colors,
                                      __global const float* knots, const BinParameters p) {
  TileSplat entry;
  entry.sigma = splat.sigma;
  entry.radius = splat.radius;
#ifdef ELLIPSES
  entry.along_x = splat.along_x;
#endif
#ifdef FACE_OF_CUBE
  entry.tilt = splat.tilt;
#endif
#ifdef LIGHT_ORDERED
  const Amplitudes found = amplitudes_of(splat, colors, knots, p);
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

// From the middle of the tile at these pixels of the grid.
INLINED void set_place(TileSplat* entry, const Splat splat, const Grid grid, int middle_x,
                       int middle_y, int bits, float unit) {
  entry->x = from_pixel(splat.x, middle_x, grid.middle_x, bits, unit);
  entry->y = from_pixel(splat.y, middle_y, grid.middle_y, bits, unit);
#ifdef FINE_PLACES
  entry->x_low =
      rest_from_pixel(splat.x, fraction_of_x(splat), middle_x, grid.middle_x, bits, unit);
  entry->y_low =
      rest_from_pixel(splat.y, fraction_of_y(splat), middle_y, grid.middle_y, bits, unit);
#endif
}

// The same where the place is known in so many units from the middle of the tile.
INLINED void set_units(TileSplat* entry, const Splat splat, int2 units, float unit) {
  const float2 place = convert_float2(units) * unit;
  entry->x = place.x;
  entry->y = place.y;
#ifdef FINE_PLACES
  entry->x_low = rest_of_units(units.x, fraction_of_x(splat), unit);
  entry->y_low = rest_of_units(units.y, fraction_of_y(splat), unit);
#endif
}
#endif
