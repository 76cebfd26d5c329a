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
  amplitudes(splat, colors, knots, p, entry.emission, entry.absorption);
#else
  sum_amplitude(splat, colors, knots, entry.summed);
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
#endif
