// Patches: rectangles of a tile that stay in registers while splats are added to them
// (waiting.cl). A splat is a bit of a word.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/composite/rows.cl"

// As wide as registers are, and with as many rows as leave some of them for a splat.
#if ROWS_OF_16
#ifdef __clang__
typedef float16 __attribute__((aligned(4))) Sixteen;
#define load_patch(p) (*(const Sixteen*)(p))
#define store_patch(v, p) (*(Sixteen*)(p) = (v))
#else
#define load_patch(p) vload16(0, p)
#define store_patch(v, p) vstore16(v, 0, p)
#endif
#define PATCH float16
#define PATCH_INTEGERS int16
#define PATCH_WIDTH 16
#define PATCH_LANES (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#else
#define PATCH float8
#define PATCH_INTEGERS int8
#define PATCH_WIDTH 8
#define PATCH_LANES (float8)(0, 1, 2, 3, 4, 5, 6, 7)
#define load_patch load_eight
#define store_patch store_eight
#endif

#define PATCH_HEIGHT (PLANES == 6 ? PATCH_WIDTH / 4 : PATCH_WIDTH / 2)
REQUIRE(whole_patches, TILE_WIDTH % PATCH_WIDTH == 0 && TILE_HEIGHT % PATCH_WIDTH == 0);

// A bit of a word for each. The more there are, the less often patches are loaded and stored, and
// loops over a patch's splats end; layers in registers of sixteen took longer with 64.
#if !LIGHT_ORDERED || !ROWS_OF_16
#define MOST_SHAPES 64
typedef ulong ShapeBits;
#else
#define MOST_SHAPES 32
typedef uint ShapeBits;
#endif

// What the shapes of splats along one axis of the tile follow from.
typedef struct AxisOfSplats {
  float place[MOST_SHAPES];  // of the center
#if FINE_PLACES
  float low[MOST_SHAPES];  // what is to be added to it
#endif
  float sigma[MOST_SHAPES], factor[MOST_SHAPES];  // as factor_of() has it
  ShapeBits means;                                // those that are taken as means over pixels
  float first[MOST_SHAPES], last[MOST_SHAPES];    // pixels that are drawn, where rows are not cut
} AxisOfSplats;

// The number of the first of `splats`, of which there are some, and those without it.
INLINED uint first_of(ShapeBits splats) {
  return (uint)popcount(~splats & (splats - 1));
}
INLINED ShapeBits without_first(ShapeBits splats) {
  return splats & (splats - 1);
}

// Of centers of pixels from that of splat k, along an axis.
#if FINE_PLACES
#define DISTANCE_ALONG(axis, k, centers) ((centers) - (axis)->place[k] - (axis)->low[k])
#else
#define DISTANCE_ALONG(axis, k, centers) ((centers) - (axis)->place[k])
#endif
