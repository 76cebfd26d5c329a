// How far LANES splats reach, and which of them are left out for it.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/face_ellipse.cl"
#include "kernels/project/limits.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_widths.cl"
#include "kernels/project/view.cl"

#pragma OPENCL FP_CONTRACT OFF

// How far the center lies beyond a rectangle of the picture, along the axis where it is farthest,
// in pixels of its grid; below 0: within. Along x a wide splat counts as if it were as wide as it
// is high.
INLINED VALUE distance_beyond(const SplatLanes s, REAL left, REAL right_end, REAL top, REAL bottom,
                              const ProjectParameters p) {
  const INTEGER level = level_of(s.grid, p);
  const VALUE shrink = AS_VALUE((127 - level) << 23);
  VALUE beyond = max(top * shrink - s.y, s.y - bottom * shrink);
  if (COPIES) return beyond;
  VALUE beyond_x = max(left * shrink - s.x, s.x - right_end * shrink);
  // With the half pixel that the first center lies within: it reaches just where one as wide as it
  // is high does.
  if (ELLIPSES) beyond_x = min(beyond_x, (beyond_x + 0.5f) * (s.radius / s.radius_x) - 0.5f);
  return max(beyond, beyond_x);
}

// How much farther than their radius splats may be from what is in memory of a coarse grid; from
// the whole picture a grid's guard.
INLINED VALUE room_beside(const SplatLanes s, REAL beside) {
  return choose((VALUE)(0.0f), (VALUE)(beside), s.grid > 0);
}

// Whether something of it shows in the whole picture, of splats on grids beside the picture's own.
// A crop, in which they may be farther from what is in memory, has no other splats than the
// picture.
INLINED INTEGER shows_in_picture(const SplatLanes s, const ProjectParameters p) {
  const float left = (float)-p.middle_x, top = (float)-p.middle_y;
  const VALUE beyond =
      distance_beyond(s, left, left + (float)p.width, top, top + (float)p.height, p);
  const INTEGER shows = (s.grid == 0) | (beyond <= s.farthest_shown);
  if (!p.has_parts) return shows;
  const VALUE room = room_beside(s, (float)(p.guard + 1));
  return shows & ((beyond + 0.5f <= s.radius + room) | (beyond <= 2.0f * s.radius));
}

// By the sign that place_on_grid() gives them.
INLINED INTEGER are_placed_as_stencils(const SplatLanes s) {
  return (s.grid > 0) & (s.sigma < 0.0f);
}

// Splats in memory are rounded to floats, by which their tiles are chosen, and copies lie up to
// four periods farther, or three and as far over a pole.
INLINED void make_room_for_roundings(SplatLanes* s, const ProjectParameters p) {
  const VALUE far = fabs(s->x) + fabs(s->y) + (COPIES ? 4.0f * p.period : 0.0f);
  s->radius = s->radius * 1.000001f + 2e-7f * far;
  if (ELLIPSES) s->radius_x = s->radius_x * 1.000001f + 2e-7f * far;
}

// Leaves out splats whose squares do not reach what is in memory of their grid, or nearly. Those
// that end short of it by no more than their own radius leave something out, though: they are
// listed, with a minus before a radius that reaches, so that the check after drawing knows them,
// and not drawn. Guard bands, from which pixels of the picture are interpolated or blurred, need
// nothing of what shows nowhere in it.
INLINED void keep_those_that_reach(SplatLanes* s, const ProjectParameters p) {
  const VALUE beyond = distance_beyond(*s, p.left, p.right_end, p.top, p.bottom, p);
  const VALUE room = room_beside(*s, p.beside);
  // Lists of the whole picture have room for roundings (Grid::room), and a crop no less.
  const float rounding = p.has_parts ? (float)max(p.width, p.height) * 0x1p-20f : 0.0f;
  // The first pixel's center lies half a pixel within.
  const INTEGER reaches = (beyond + 0.5f <= s->radius + room + rounding) & shows_in_picture(*s, p);
  if (COPIES || EXTENDED_NUMBERS) {
    s->visible &= reaches;
    return;
  }
  // Stencils leave nothing out.
  const INTEGER ends_short = (reaches == 0) & (beyond <= 2.0f * s->radius) &
                             (are_placed_as_stencils(*s) == 0) &
                             (INTEGER)(p.kernel_cut > 0.0f ? 0 : -1);
  s->visible &= reaches | ends_short;
  const VALUE in_widths = FACE_OF_CUBE ? beyond / max(s->farther, (VALUE)(1.0f)) : beyond;
  s->radius = choose(s->radius, -(in_widths + 1.0f), ends_short);
}

// Half of the light beyond the square goes back into it: the sum of many errs by as much
// above as below. Means are drawn in all pixels that the square touches, half a pixel more
// on average and for a splat below a pixel nearly everything: with t / sigma more, erfc(k)
// falls as exp(-2 k t / sigma), whose mean over t from 0 to 1 is close to
// sigma / (sigma + 2 k).
INLINED VALUE restored_weight(VALUE weight, VALUE sigma, VALUE extent, INTEGER by_mean,
                              INTEGER stencil, const ProjectParameters p) {
  const INTEGER faint = (extent <= p.least_extent * 1.00001f) & (stencil == 0);
  const VALUE cut_off = choose((VALUE)(1.0f), sigma / (sigma + 2.0f * extent), by_mean);
  return choose(weight, weight * (1.0f + p.restored_light * cut_off), faint);
}
