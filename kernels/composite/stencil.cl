// Stencils (grid.h), of which the host made the polynomials (src/scene/plan/stencil.h), on VALUEs
// (lanes.cl).
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"

#if !STENCILS
#define STENCILS 0
#endif

// Those of a grid's blur; null for the picture's own grid.
INLINED __global const Stencil* stencil_of_grid(__global const Stencil* stencils, uint grid) {
  return grid == 0 ? 0 : stencils + ((grid - 1u) & (MOST_BLURS - 1u));
}

// Where stencils lie along an axis: the first pixel, from the tile's first one, and the distance of
// the splat's center from the middle between the two pixels beside it.
typedef struct StencilPlaces {
  INTEGER first;
  VALUE distance;
} StencilPlaces;

INLINED StencilPlaces stencil_places(VALUE center, float first_center) {
  const VALUE place = center - first_center;
  const INTEGER truncated = TO_INTEGER(place);
  const INTEGER below =
      truncated + select((INTEGER)(0), (INTEGER)(-1), TO_VALUE(truncated) > place);
  StencilPlaces places;
  places.first = below - (STENCIL_PIXELS / 2 - 1);
  places.distance = (place - TO_VALUE(below)) - 0.5f;
  return places;
}

// Of their widths, what the polynomials take.
INLINED VALUE stencil_widths(VALUE sigma, __global const Stencil* stencil) {
  return (sigma * sigma - stencil->middle) * stencil->per_width;
}

// Polynomials in the square of the distance, of LANES pixels, for a splat of one width.
typedef struct StencilOfWidth {
  VALUE of_power[STENCIL_PLACE_POWERS];
} StencilOfWidth;

// Of the eight pixels' polynomials those from `first` on.
INLINED StencilOfWidth stencil_of_width(__global const Stencil* stencil, float width, int first) {
  StencilOfWidth of_width;
#pragma unroll
  for (int i = 0; i < STENCIL_PLACE_POWERS; ++i) {
    __global const float* from =
        stencil->coefficients + i * STENCIL_WIDTH_POWERS * STENCIL_PIXELS + first;
    VALUE sum = LOAD(from + (STENCIL_WIDTH_POWERS - 1) * STENCIL_PIXELS);
#pragma unroll
    for (int j = STENCIL_WIDTH_POWERS - 2; j >= 0; --j)
      sum = sum * width + LOAD(from + j * STENCIL_PIXELS);
    of_width.of_power[i] = sum;
  }
  return of_width;
}

INLINED VALUE stencil_polynomials(const StencilOfWidth of_width, float square) {
  VALUE sum = of_width.of_power[STENCIL_PLACE_POWERS - 1];
#pragma unroll
  for (int i = STENCIL_PLACE_POWERS - 2; i >= 0; --i)
    sum = sum * square + of_width.of_power[i];
  return sum;
}
