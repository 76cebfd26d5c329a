// Which patches of a tile its splats reach into.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/rows.cl"

#define PATCH_COLUMNS (TILE_WIDTH / PATCH_WIDTH)
#define PATCH_ROWS (TILE_HEIGHT / PATCH_HEIGHT)

// Only a part of the patches of a disc's square are the disc's.
#if CUT_BY_ROWS
// Columns of patches and words of splats are taken in eights and whole words.
REQUIRE(columns_in_eights, PATCH_COLUMNS <= 8 && MOST_SHAPES % 32 == 0);

// Bits of 32 splats in each word; words of eight rows are together.
#define WORDS_OF_SPLATS (MOST_SHAPES / 32)
#define ROWS_OF_WORDS ((PATCH_ROWS + 7) / 8 * 8)
typedef struct PatchReach {
  uint touched[WORDS_OF_SPLATS][PATCH_COLUMNS][ROWS_OF_WORDS] __attribute__((aligned(64)));
} PatchReach;

static inline void clear_reach(PatchReach* reach) {
  uint8* const words = (uint8*)reach;
  for (uint i = 0; i < sizeof(PatchReach) / sizeof(uint8); ++i)
    words[i] = (uint8)(0u);
}

// The pixel that holds the center of a splat keeps its light, however far its own center is.
#if SAMPLING_MEAN
#define BESIDE_PIXEL 0.5f
#else
#define BESIDE_PIXEL 0.0f
#endif

// How near the nearest of some pixels is to a splat's center, from how far the first and the last
// of them are.
#define NEAREST_OF(first, last) max(max(first, -(last)) - BESIDE_PIXEL, 0.0f)

// Sets the bit of splat `number` of these axes, cut at this radius, squared. Squares of distances
// are tested as those of pixels are, so that no pixel that is drawn is missed.
INLINED void put_reach(PatchReach* reach, uint number, const AxisOfSplats* x, const AxisOfSplats* y,
                       float cut2, float squeeze) {
  const float8 each = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  const float8 left = each * (float)PATCH_WIDTH + FIRST_X;
  const float8 near_x = NEAREST_OF(DISTANCE_ALONG(x, number, left),
                                   DISTANCE_ALONG(x, number, left + (float)(PATCH_WIDTH - 1)));
  float squares[8];
  store_eight(SQUEEZED(near_x) * SQUEEZED(near_x), squares);
  const uint word = number / 32;
  const uint8 bit = (uint8)(1u << number % 32);
  for (int row = 0; row < ROWS_OF_WORDS; row += 8) {
    const float8 top = (each + (float)row) * (float)PATCH_HEIGHT + FIRST_Y;
    const float8 near_y = NEAREST_OF(DISTANCE_ALONG(y, number, top),
                                     DISTANCE_ALONG(y, number, top + (float)(PATCH_HEIGHT - 1)));
    const float8 limits = cut2 - near_y * near_y;
#pragma unroll
    for (int column = 0; column < PATCH_COLUMNS; ++column)
      *(uint8*)(reach->touched[word][column] + row) |= as_uint8(squares[column] <= limits) & bit;
  }
}

// Those that touch a patch.
INLINED ShapeBits splats_of_patch(const PatchReach* reach, int column, int row) {
  const ShapeBits first = reach->touched[0][column][row];
  if (WORDS_OF_SPLATS == 1) return first;
  const int last = WORDS_OF_SPLATS - 1;
  return first | (ShapeBits)reach->touched[last][column][row] << 32 * last;
}

INLINED ShapeBits splats_of_column(const PatchReach* reach, int column) {
  ShapeBits splats = 0;
  for (int row = 0; row < PATCH_ROWS; ++row)
    splats |= splats_of_patch(reach, column, row);
  return splats;
}
INLINED ShapeBits splats_of_row(const PatchReach* reach, int row) {
  ShapeBits splats = 0;
  for (int column = 0; column < PATCH_COLUMNS; ++column)
    splats |= splats_of_patch(reach, column, row);
  return splats;
}
#else
typedef struct PatchReach {
  ShapeBits of_columns[PATCH_COLUMNS], of_rows[PATCH_ROWS];
} PatchReach;

static inline void clear_reach(PatchReach* reach) {
  for (int i = 0; i < PATCH_COLUMNS; ++i)
    reach->of_columns[i] = 0;
  for (int i = 0; i < PATCH_ROWS; ++i)
    reach->of_rows[i] = 0;
}

// Sets a splat's bit in the words of those of `count` patches that show some of its pixels.
INLINED void set_bits(ShapeBits* words, int count, int2 pixels, int pixels_of_patch,
                      ShapeBits bit) {
  for (int i = 0; i < count; ++i) {
    const int begin = i * pixels_of_patch;
    words[i] |= pixels.y >= begin && pixels.x < begin + pixels_of_patch ? bit : (ShapeBits)0;
  }
}

INLINED ShapeBits splats_of_patch(const PatchReach* reach, int column, int row) {
  return reach->of_columns[column] & reach->of_rows[row];
}
INLINED ShapeBits splats_of_column(const PatchReach* reach, int column) {
  return reach->of_columns[column];
}
INLINED ShapeBits splats_of_row(const PatchReach* reach, int row) {
  return reach->of_rows[row];
}
#endif
