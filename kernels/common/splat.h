// Splats and the colors of components, for host and kernels: 4-byte members only (grid.h).
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"

#pragma once

typedef struct OwnColor {
  float rgb[3];
} OwnColor;

// Tilt of extended precision, without log2(e), of a splat that has all of its weight.
typedef struct ExtendedTilt {
  struct FloatPair squared_width, footprint, inverse_secant2;
} ExtendedTilt;

// What extended precision knows of a splat, with its amplitudes at the center. In pixels of the
// whole picture, so that a crop has the same bits.
typedef struct ExtendedSplat {
  struct FloatPair x, y, sigma;
  struct FloatPair summed[3];    // A w, optical depth; where nothing absorbs, E w
  struct FloatPair emission[3];  // E w
  struct FloatPair cut;          // radius of the cut disc
#if ELLIPSES
  struct FloatPair sigma_x;
#endif
#if FACE_OF_CUBE
  struct ExtendedTilt tilt;
#endif
} ExtendedSplat;

// A projected particle, widths in pixels of its grid. Its centre is in fixed point (Grid), so that
// it is known as well anywhere in the picture; so far beside it that the integers cannot hold it,
// in coarser units by a power of two.
typedef struct Splat {
  int x, y;
  float sigma;                      // widened, unless pixel means are taken; negative: of a
                                    // bright splat, whose means keep more digits (shape.cl), or
                                    // on another grid of a stencil
  float radius;                     // drawn up to here; negative: only listed, so far
  float weight;                     // w' = w sigma^2 / sigma'^2
  float color;                      // palette position in [0, 1]
  unsigned int component_and_grid;  // component | grid << 16 | power of the coarser unit << 24
#if ELLIPSES
  struct WidthAlongX along_x;
#endif
#if FACE_OF_CUBE
  struct Tilt tilt;
  float part;  // no pixel has more of the cloud's own weight, and this part of it is the splat's
#endif
#if VECTOR_COLORS
  struct OwnColor own_color;
#endif
#if FINE_PLACES
  // What x and y do not hold of the place of a sharp splat, in 2^-16 of their unit, signed: that of
  // x in the lower 16 bits.
  unsigned int place_fractions;
#endif
#if TILES_IN_SPLAT
  unsigned int tiles;  // of the whole picture that it touches (tiles.cl)
#endif
#if EXTENDED_NUMBERS
  struct ExtendedSplat extended;
#endif
#if WHOLE_SECTORS
  unsigned int unused;  // a GPU gathers 32 bytes at a time
} BY_FOUR_WORDS Splat;
#else
} Splat;
#endif

#define ABSORPTION_AS_EMISSION 0
#define ABSORPTION_NONE 1
#define ABSORPTION_FACTOR 2
#define ABSORPTION_GRAY 3

// One component's colors: knots lie in a table, emission at first_knot, absorption at
// first_absorption_knot. Where the palette has none of its own, absorption_knot_count is 0. A knot
// is three floats and one of padding, which a processor fetches at once.
#define KNOT_FLOATS 4
typedef struct ComponentColors {
  unsigned int first_knot, knot_count;
  unsigned int first_absorption_knot, absorption_knot_count;
  float brightness;
  int absorption_kind;
  float absorption_factor;
  // Of what sums add up: the palette's first knot and the number of its last one, and what the
  // color of a splat of weight 1 is multiplied by.
  unsigned int first_summed_knot;
  float last_summed_knot;
  float summed_scale;
} ComponentColors;
