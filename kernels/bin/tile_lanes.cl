// The tiles of LANES splats at a time, as tiles.cl packs them; FOUND_AGAIN where that is left to
// find_lists().
#include "kernels/bin/tiles.cl"
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/limits.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_widths.cl"

#pragma OPENCL FP_CONTRACT OFF

#define LOG2_OF(power_of_two) (31 - (int)clz((uint)(power_of_two)))

// The last whole number below, as floor() is a call on PoCL.
INLINED INTEGER whole_below(VALUE value) {
  const INTEGER truncated = TO_INTEGER(value);
  return truncated + select((INTEGER)(0), (INTEGER)(-1), TO_VALUE(truncated) > value);
}

// Along one axis of grids that are 2^level times as coarse as the picture.
typedef struct AxisLanes {
  VALUE middle, last;  // the pixel from whose corner places count, and the last one
} AxisLanes;

INLINED AxisLanes axis_of(int middle, int size, INTEGER level, INTEGER guard) {
  AxisLanes axis;
  axis.middle = TO_VALUE(((INTEGER)(middle) >> level) + guard);
  axis.last = TO_VALUE((((INTEGER)(size - 1) + ((INTEGER)(1) << level)) >> level) + 2 * guard - 1);
  return axis;
}

// First and last pixel whose centers lie within `radius`.
INLINED INTEGER first_pixel(VALUE place, VALUE radius, const AxisLanes axis) {
  const VALUE turned_round = 0.5f - (place + axis.middle) + radius;
  return -whole_below(min(max(turned_round, -axis.last - 1.0f), (VALUE)(0.0f)));
}
INLINED INTEGER last_pixel(VALUE place, VALUE radius, const AxisLanes axis) {
  return whole_below(min(max(place + axis.middle - 0.5f + radius, (VALUE)(-1.0f)), axis.last));
}

// A splat's first tile is so many behind the first of its grid, of which so many are in a row: in
// grids that are in memory as a whole.
typedef struct TileLanes {
  INTEGER packed;
  INTEGER from_corner, tiles_x;
  INTEGER has_several;  // 1 where it touches more than that one
} TileLanes;

// One that is not visible is in the first tile of its grid.
INLINED TileLanes tiles_of_lanes(const SplatLanes s, const ProjectParameters p) {
  const INTEGER level = level_of(s.grid, p);
  const INTEGER guard = select((INTEGER)(0), (INTEGER)(p.guard), s.grid > 0);
  const AxisLanes across = axis_of(p.middle_x, p.width, level, guard);
  const AxisLanes along = axis_of(p.middle_y, p.height, level, guard);
  // Places are rounded to floats here, twice (Grid::room).
  const VALUE room = (max(across.last, along.last) + 1.0f) * 0x1p-22f;
  const VALUE radius = s.radius + room;
  const INTEGER first_x = first_pixel(s.x, radius, across);
  const INTEGER last_x = last_pixel(s.x, radius, across);
  const INTEGER first_y = first_pixel(s.y, radius, along);
  const INTEGER last_y = last_pixel(s.y, radius, along);

  const int shift_x = LOG2_OF(TILE_WIDTH), shift_y = LOG2_OF(TILE_HEIGHT);
  const INTEGER column = first_x >> shift_x, row = first_y >> shift_y;
  const INTEGER columns = (last_x >> shift_x) - column + 1, rows = (last_y >> shift_y) - row + 1;
  const INTEGER packed = column | row << FIRST_TILE_BITS | columns << 2 * FIRST_TILE_BITS |
                         rows << (2 * FIRST_TILE_BITS + TILE_COUNT_BITS);
  const INTEGER fits = (max(column, row) < 1 << FIRST_TILE_BITS) &
                       (max(columns, rows) < (1 << TILE_COUNT_BITS) - 1) & (s.radius >= 0.0f) &
                       (first_x <= last_x) & (first_y <= last_y) & (s.place.coarser == 0) &
                       (INTEGER)(p.place_bits > 0 ? -1 : 0);
  TileLanes tiles;
  tiles.packed = select((INTEGER)((int)ONE_TILE), select((INTEGER)((int)FOUND_AGAIN), packed, fits),
                        s.visible);
  tiles.tiles_x = (TO_INTEGER(across.last) >> shift_x) + 1;
  tiles.from_corner = (row * tiles.tiles_x + column) & s.visible;
  tiles.has_several = (columns + rows > 2) & s.visible & (INTEGER)(1);
  return tiles;
}
