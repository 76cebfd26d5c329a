// What several stages share: numbers, grids, splats and the colors of components. Structures
// lie in memory alike for host and kernels: only 4-byte members, and arrays of them, so that
// no compiler pads them differently.
#ifndef SPLOTCHCL_SPLAT_H
#define SPLOTCHCL_SPLAT_H

// Splats are told apart by the octave of their width in pixels (plan.h, width_octaves).
#define WIDTH_OCTAVES 16

// A number as the sum of two floats (extended.cl).
struct FloatPair {
  float high, low;
};

// One grid of the picture: grid 0 has the picture's own pixels, those of level l pixels 2^l
// times as wide, with a guard band around the picture. Planes are padded to whole tiles.
struct Grid {
  int width, height;  // pixels, with the guard band
  int guard;          // pixels
  float mean_sigma;   // narrower splats take the pixel mean by erf; 0: none does
  int tiles_x, tiles_y;
  unsigned int first_tile;
  unsigned int stride, plane_size;                 // floats
  unsigned int first_float_low, first_float_high;  // 64-bit offset of the first plane
};

// Splats of equirectangular pictures are wider than high: x and y have widths of their own.
struct WidthAlongX {
  float sigma, radius;  // pixels
};

struct OwnColor {
  float rgb[3];
};

// A projected particle, positions and widths in pixels of its grid.
struct Splat {
  float x, y;
  float sigma;                      // widened, unless pixel means are taken; negative: of a
                                    // bright splat, whose means keep more digits (shape.cl)
  float radius;                     // drawn up to here
  float weight;                     // w' = w sigma^2 / sigma'^2
  float color;                      // palette position in [0, 1]
  unsigned int component_and_grid;  // component | grid << 16
#ifdef ELLIPSES
  struct WidthAlongX along_x;
#endif
#ifdef VECTOR_COLORS
  struct OwnColor own_color;
#endif
};

struct ExtendedAlongX {
  struct FloatPair sigma;
  float radius;  // pixels
};

// A splat of extended precision, with its amplitudes at the center. In pixels of the whole
// picture, so that a crop has the same bits.
struct ExtendedSplat {
  struct FloatPair x, y, sigma;
  struct FloatPair summed[3];    // A w, optical depth; where nothing absorbs, E w
  struct FloatPair emission[3];  // E w
  struct FloatPair cut;          // radius of the cut disc
  float radius;                  // drawn up to here
#ifdef ELLIPSES
  struct ExtendedAlongX along_x;
#endif
};

#define ABSORPTION_AS_EMISSION 0
#define ABSORPTION_NONE 1
#define ABSORPTION_FACTOR 2
#define ABSORPTION_GRAY 3

// One component's colors: knots of three floats lie in a table, emission at first_knot,
// absorption at first_absorption_knot. Where the palette has none of its own,
// absorption_knot_count is 0.
struct ComponentColors {
  unsigned int first_knot, knot_count;
  unsigned int first_absorption_knot, absorption_knot_count;
  float brightness;
  int absorption_kind;
  float absorption_factor;
};

#ifdef __OPENCL_VERSION__
typedef struct FloatPair FloatPair;
typedef struct Grid Grid;
typedef struct WidthAlongX WidthAlongX;
typedef struct OwnColor OwnColor;
typedef struct Splat Splat;
typedef struct ExtendedAlongX ExtendedAlongX;
typedef struct ExtendedSplat ExtendedSplat;
typedef struct ComponentColors ComponentColors;
#endif

#endif
