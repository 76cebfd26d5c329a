// What several stages share: numbers, grids and the stencils of splats. Structures lie in memory
// alike for host and kernels: only 4-byte members, and arrays of them, so that no compiler pads
// them differently.
#pragma once

// Of a structure of so many words: a kernel loads and stores them by fours. To the host it is an
// array of words.
#ifdef __OPENCL_C_VERSION__
#define BY_FOUR_WORDS __attribute__((aligned(16)))
#else
#define BY_FOUR_WORDS
#endif

// Splats are told apart by the octave of their width in pixels (plan.h, width_octaves).
#define WIDTH_OCTAVES 16

// A number as the sum of two floats.
typedef struct FloatPair {
  float high, low;
} FloatPair;

// One grid of the picture: grid 0 has the picture's own pixels, those of level l pixels 2^l
// times as wide, with a guard band around the picture. All of this is the whole picture's, so
// that a crop has its bits; in memory are the tiles that the crop needs.
typedef struct Grid {
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
} Grid;

// Levels from first_level on (plan.h, GridPyramid) have 2^shift grids beside the picture's own,
// each blurred afterwards by one of these sigma^2, in pixels of its own; all 0 where nothing is
// blurred. As many as there may be, over and over again.
#define MOST_BLURS 4
typedef struct GridBlurs {
  int shift, first_level;
  float sigma2[MOST_BLURS];
  // Splats up to this sigma are stencils, if they are no brighter than 1; 0: none is.
  float stencil_sigma[MOST_BLURS];
  float finer_grid;  // brighter ones need to be so many times wider for a grid; 1 without stencils
} GridBlurs;

// What splats of a blurred grid are drawn by (plan.h, Stencil). Their sigma is that which the blur
// makes of them, with a minus.
#define STENCIL_PIXELS 8
#define STENCIL_PLACE_POWERS 3
#define STENCIL_WIDTH_POWERS 4
#define STENCIL_RADIUS 4.0f
typedef struct Stencil {
  float middle, per_width;
  float coefficients[STENCIL_PLACE_POWERS * STENCIL_WIDTH_POWERS * STENCIL_PIXELS];
} Stencil;

// Words of four bytes in memory, the first by its number of 64 bits.
typedef struct MemoryRange {
  unsigned int first_low, first_high;
  unsigned int words;
} MemoryRange;
// That a work-item clears: enough to be worth a thread's turn.
#define CLEARED_WORDS 16384
