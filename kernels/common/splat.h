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
// times as wide, with a guard band around the picture. All of this is the whole picture's, so
// that a crop has its bits; in memory are the tiles that the crop needs.
struct Grid {
  int width, height;       // pixels, with the guard band
  int guard;               // pixels
  int middle_x, middle_y;  // the pixel from whose corner places of splats count
  int place_bits;          // in units of 2^-place_bits pixels
  float mean_sigma;        // narrower splats take the pixel mean by erf; 0: none does
  float unit;              // that is, of so many pixels
  float room;              // pixels by which a place may be off where tiles are chosen
  int first_x, first_y;    // the first pixel in memory, the corner of a tile
  int tiles_x, tiles_y;    // in memory
  int is_part;             // of the grid's tiles some are not
  unsigned int first_tile;
  unsigned int corner_tile;         // the number of the tile at (0, 0), as if it were in memory
  unsigned int stride, plane_size;  // floats
  unsigned int first_float_low, first_float_high;  // 64-bit offset of the first plane
};

// Levels from first_level on (plan.h, GridPyramid) have 2^shift grids beside the picture's own,
// each blurred afterwards by one of these sigma^2, in pixels of its own; all 0 where nothing is
// blurred. As many as there may be, over and over again.
#define MOST_BLURS 4
struct GridBlurs {
  int shift, first_level;
  float sigma2[MOST_BLURS];
  // Splats up to this sigma are stencils, if they are no brighter than 1; 0: none is.
  float stencil_sigma[MOST_BLURS];
  float finer_grid;  // brighter ones need to be so many times wider for a grid; 1 without stencils
};

// What splats of a blurred grid are drawn by (plan.h, Stencil). Their sigma is that which the blur
// makes of them, with a minus.
#define STENCIL_PIXELS 8
#define STENCIL_PLACE_POWERS 3
#define STENCIL_WIDTH_POWERS 4
#define STENCIL_RADIUS 4.0f
struct Stencil {
  float middle, per_width;
  float coefficients[STENCIL_PLACE_POWERS * STENCIL_WIDTH_POWERS * STENCIL_PIXELS];
};

// Splats of equirectangular pictures are wider than high: x and y have widths of their own.
struct WidthAlongX {
  float sigma, radius;  // pixels
};

// Of a splat on a face of a cube (src/scene/projection.h, FaceEllipse).
struct Tilt {
  float squared_width, footprint;
  float inverse_secant2;  // times log2(e)
  float scale;            // squared_width over `part` of the splat
};

struct OwnColor {
  float rgb[3];
};

// A projected particle, widths in pixels of its grid. Its centre is in fixed point (Grid), so that
// it is known as well anywhere in the picture; so far beside it that the integers cannot hold it,
// in coarser units by a power of two.
struct Splat {
  int x, y;
  float sigma;                      // widened, unless pixel means are taken; negative: of a
                                    // bright splat, whose means keep more digits (shape.cl), or
                                    // on another grid of a stencil
  float radius;                     // drawn up to here; negative: only listed, so far
  float weight;                     // w' = w sigma^2 / sigma'^2
  float color;                      // palette position in [0, 1]
  unsigned int component_and_grid;  // component | grid << 16 | power of the coarser unit << 24
#ifdef ELLIPSES
  struct WidthAlongX along_x;
#endif
#ifdef FACE_OF_CUBE
  struct Tilt tilt;
  float part;  // no pixel has more of the cloud's own weight, and this part of it is the splat's
#endif
#ifdef VECTOR_COLORS
  struct OwnColor own_color;
#endif
#ifdef FINE_PLACES
  // What x and y do not hold of the place of a sharp splat, in 2^-16 of their unit, signed: that of
  // x in the lower 16 bits.
  unsigned int place_fractions;
#endif
#ifdef TILES_IN_SPLAT
  unsigned int tiles;  // of the whole picture that it touches (tiles.cl)
#endif
#ifdef WHOLE_SECTORS
  unsigned int unused;  // a GPU gathers 32 bytes at a time
#endif
};

struct ExtendedAlongX {
  struct FloatPair sigma;
  float radius;  // pixels
};

// The same, without log2(e), and of a splat that has all of its weight.
struct ExtendedTilt {
  struct FloatPair squared_width, footprint, inverse_secant2;
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
#ifdef FACE_OF_CUBE
  struct ExtendedTilt tilt;
#endif
};

#define ABSORPTION_AS_EMISSION 0
#define ABSORPTION_NONE 1
#define ABSORPTION_FACTOR 2
#define ABSORPTION_GRAY 3

// One component's colors: knots lie in a table, emission at first_knot, absorption at
// first_absorption_knot. Where the palette has none of its own, absorption_knot_count is 0. A knot
// is three floats and one of padding, which a processor fetches at once.
#define KNOT_FLOATS 4
struct ComponentColors {
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
};

#ifdef __OPENCL_VERSION__
typedef struct FloatPair FloatPair;
typedef struct Grid Grid;
typedef struct GridBlurs GridBlurs;
typedef struct Stencil Stencil;
typedef struct WidthAlongX WidthAlongX;
typedef struct Tilt Tilt;
typedef struct OwnColor OwnColor;
typedef struct Splat Splat;
typedef struct ExtendedAlongX ExtendedAlongX;
typedef struct ExtendedTilt ExtendedTilt;
typedef struct ExtendedSplat ExtendedSplat;
typedef struct ComponentColors ComponentColors;
#endif

#endif
