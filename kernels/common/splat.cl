// What a splat in memory says of its component, its grid and its place.
#include "kernels/common/common.cl"
#include "kernels/common/splat.h"

#pragma OPENCL FP_CONTRACT ON

INLINED uint component_of(const Splat splat) {
  return splat.component_and_grid & 0xffffu;
}
INLINED uint grid_of(const Splat splat) {
  return (splat.component_and_grid >> 16) & 0xffu;
}
// The power of two by which its units are coarser than its grid's.
INLINED uint coarser_of(const Splat splat) {
  return splat.component_and_grid >> 24;
}
// The splat's units are 2^-place_bits pixels.
INLINED int place_bits_of(const Splat splat, const Grid grid) {
  return grid.place_bits - (int)coarser_of(splat);
}

// In pixels of the grid: a power of two.
INLINED float unit_of(const Splat splat, const Grid grid) {
  return as_float(as_uint(grid.unit) + (coarser_of(splat) << 23));
}

#if FINE_PLACES
INLINED float fraction_of_x(const Splat splat) {
  return (float)((int)(splat.place_fractions << 16) >> 16) * 0x1p-16f;
}
INLINED float fraction_of_y(const Splat splat) {
  return (float)((int)splat.place_fractions >> 16) * 0x1p-16f;
}

// What a float of so many units does not hold of them, and the fraction of a unit.
INLINED float rest_of_units(int units, float fraction, float unit) {
  return ((float)(units - convert_int_sat((float)units)) + fraction) * unit;
}
#endif
