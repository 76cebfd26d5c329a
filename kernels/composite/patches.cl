// Splats added to a tile patch by patch: a patch stays in registers while all of them are added to
// it, one after the other. Row by row each splat would load and store pixels that the one before
// has just stored, and a processor waits for that.
#include "kernels/common/common.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/patch_reach.cl"
#include "kernels/composite/patch_shapes.cl"
#include "kernels/composite/rows.cl"

#if !FACE_OF_CUBE

// Bits of the splats whose layers take more than one term, and of those that take three.
typedef struct LayerForms {
  ShapeBits more_terms, three_terms;
} LayerForms;

// Light, and behind it opacities in order.
typedef struct PatchRow {
  PATCH plane0, plane1, plane2;
#if PLANES == 6
  PATCH plane3, plane4, plane5;
#endif
} PatchRow;

INLINED PatchRow load_patch_row(const float* pixel) {
  PatchRow row;
  row.plane0 = load_patch(pixel);
  row.plane1 = load_patch(pixel + TILE_PIXELS);
  row.plane2 = load_patch(pixel + 2 * TILE_PIXELS);
#if PLANES == 6
  row.plane3 = load_patch(pixel + 3 * TILE_PIXELS);
  row.plane4 = load_patch(pixel + 4 * TILE_PIXELS);
  row.plane5 = load_patch(pixel + 5 * TILE_PIXELS);
#endif
  return row;
}

INLINED void store_patch_row(const PatchRow row, float* pixel) {
  store_patch(row.plane0, pixel);
  store_patch(row.plane1, pixel + TILE_PIXELS);
  store_patch(row.plane2, pixel + 2 * TILE_PIXELS);
#if PLANES == 6
  store_patch(row.plane3, pixel + 3 * TILE_PIXELS);
  store_patch(row.plane4, pixel + 4 * TILE_PIXELS);
  store_patch(row.plane5, pixel + 5 * TILE_PIXELS);
#endif
}

// A splat in the columns of a patch.
typedef struct PatchSplat {
#if LIGHT_ORDERED
  PATCH across;
  const float* light;
#else
  PATCH light0, light1, light2;
#if PLANES == 6
  PATCH light3, light4, light5;
#endif
#endif
  const float* along;
#ifdef CUT_BY_ROWS
  PATCH square;
  const float* limits;
#if SAMPLING_MEAN
  PATCH dx;
  float dy;  // of the first row
#endif
#endif
} PatchSplat;

INLINED PatchSplat splat_of_patch(const PatchShapes* shapes, const PatchValues* values, uint k,
                                  int x, int y, PATCH lanes) {
  PatchSplat splat;
  const PATCH across = load_patch(values->across + k * PATCH_WIDTH);
  splat.along = values->along + (size_t)k * TILE_HEIGHT + y;
#if LIGHT_ORDERED
  splat.across = across;
  splat.light = shapes->light + k * PLANES;
#else
  splat.light0 = across * shapes->light[k * PLANES];
  splat.light1 = across * shapes->light[k * PLANES + 1];
  splat.light2 = across * shapes->light[k * PLANES + 2];
#if PLANES == 6
  splat.light3 = across * shapes->light[k * PLANES + 3];
  splat.light4 = across * shapes->light[k * PLANES + 4];
  splat.light5 = across * shapes->light[k * PLANES + 5];
#endif
#endif
#ifdef CUT_BY_ROWS
  splat.square = load_patch(values->squares + k * PATCH_WIDTH);
  splat.limits = values->limits + (size_t)k * TILE_HEIGHT + y;
#if SAMPLING_MEAN
  splat.dx = DISTANCE_ALONG(&shapes->x, k, ((float)x + FIRST_X) + lanes);
  splat.dy = (float)y + FIRST_Y - shapes->y.place[k];
#endif
#endif
  return splat;
}

// Of the pixels of row k, those that the kernel is not cut at.
#ifndef CUT_BY_ROWS
#define WHERE_DRAWN(splat, k, drawn, otherwise) (drawn)
#else
#if SAMPLING_MEAN
// The pixel that holds the center keeps its light.
#define OR_HOLDS_CENTER(splat, k)                                                             \
  | (((splat).dx > -0.5f) & ((splat).dx <= 0.5f) &                                            \
     (PATCH_INTEGERS)((splat).dy + (float)(k) > -0.5f && (splat).dy + (float)(k) <= 0.5f ? -1 \
                                                                                         : 0))
#else
#define OR_HOLDS_CENTER(splat, k)
#endif
#define WHERE_DRAWN(splat, k, drawn, otherwise) \
  select(otherwise, drawn, ((splat).square <= (splat).limits[k]) OR_HOLDS_CENTER(splat, k))
#endif

#if LIGHT_ORDERED
INLINED PATCH shape_in_row(const PatchSplat splat, int k) {
  return WHERE_DRAWN(splat, k, NOT_NEGATIVE(splat.across * splat.along[k]), (PATCH)(0.0f));
}

// A layer as THIN_LAYER() (rows.cl) has it: channel c's light and opacity are planes c and `o`.
#define PATCH_CHANNEL(c, o, COVERED)                  \
  {                                                   \
    const float absorption##c = splat.light[o];       \
    const PATCH covered = COVERED(c);                 \
    const PATCH u = covered - row.plane##o * covered; \
    row.plane##c += u * splat.light[c];               \
    row.plane##o += u * absorption##c;                \
  }
#define PATCH_CHANNELS(COVERED) \
  PATCH_CHANNEL(0, 3, COVERED) PATCH_CHANNEL(1, 4, COVERED) PATCH_CHANNEL(2, 5, COVERED)
INLINED PatchRow add_one_term(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = shape_in_row(splat, k);
  PATCH_CHANNELS(COVERED_BY_ONE_TERM)
  return row;
}
INLINED PatchRow add_two_terms(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = shape_in_row(splat, k);
  PATCH_CHANNELS(COVERED_BY_TWO_TERMS)
  return row;
}
INLINED PatchRow add_three_terms(PatchRow row, const PatchSplat splat, int k) {
  const PATCH shape = shape_in_row(splat, k);
  PATCH_CHANNELS(COVERED_BY_THREE_TERMS)
  return row;
}
#else
#if PLANES == 6
#define EACH_PLANE(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5)
#else
#define EACH_PLANE(DO) DO(0) DO(1) DO(2)
#endif
#define ADD_TO_PLANE(c) row.plane##c += splat.light##c * along;
// Additions take a mask where registers of sixteen are; elsewhere one mask serves all planes.
#ifdef ROWS_OF_16
#define ADD_TO_PLANE_WHERE_DRAWN(c) \
  row.plane##c = WHERE_DRAWN(splat, k, row.plane##c + splat.light##c * along, row.plane##c);
INLINED PatchRow add_to_sums(PatchRow row, const PatchSplat splat, int k) {
  const PATCH along = splat.along[k];
  EACH_PLANE(ADD_TO_PLANE_WHERE_DRAWN)
  return row;
}
#else
INLINED PatchRow add_to_sums(PatchRow row, const PatchSplat splat, int k) {
  const PATCH along = WHERE_DRAWN(splat, k, (PATCH)(splat.along[k]), (PATCH)(0.0f));
  EACH_PLANE(ADD_TO_PLANE)
  return row;
}
#endif
#endif

// The rows of a patch, written out, since compilers keep arrays in memory.
#if PATCH_HEIGHT == 8
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#elif PATCH_HEIGHT == 4
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3)
#else
#define EACH_ROW(DO) DO(0) DO(1)
#endif
#define LOAD_ROW_OF_PATCH(k) PatchRow row##k = load_patch_row(pixel + k * ROW);
#define STORE_ROW_OF_PATCH(k) store_patch_row(row##k, pixel + k * ROW);
#define ADD_TO_SUMS(k) row##k = add_to_sums(row##k, splat, k);
#define ADD_ONE_TERM(k) row##k = add_one_term(row##k, splat, k);
#define ADD_TWO_TERMS(k) row##k = add_two_terms(row##k, splat, k);
#define ADD_THREE_TERMS(k) row##k = add_three_terms(row##k, splat, k);
#define ADD_AS_FORMS_ARE                   \
  if (!(forms.more_terms >> k & 1)) {      \
    EACH_ROW(ADD_ONE_TERM)                 \
  } else if (forms.three_terms >> k & 1) { \
    EACH_ROW(ADD_THREE_TERMS)              \
  } else {                                 \
    EACH_ROW(ADD_TWO_TERMS)                \
  }

// Those of `splats`, of which there are some, to the patch from (x, y) on.
#define ADD_EACH_SPLAT(ROWS)                                                 \
  for (; splats != 0; splats = without_first(splats)) {                      \
    const uint k = first_of(splats);                                         \
    const PatchSplat splat = splat_of_patch(shapes, values, k, x, y, lanes); \
    ROWS                                                                     \
  }
INLINED void add_to_patch(float* tile, int x, int y, const PatchShapes* shapes,
                          const PatchValues* values, LayerForms forms, PATCH lanes) {
  ShapeBits splats = splats_of_patch(&shapes->reach, x / PATCH_WIDTH, y / PATCH_HEIGHT);
  if (splats == 0) return;
  float* pixel = tile + y * ROW + x;
  EACH_ROW(LOAD_ROW_OF_PATCH)
#if LIGHT_ORDERED
  if ((splats & forms.more_terms) == 0) {
    ADD_EACH_SPLAT(EACH_ROW(ADD_ONE_TERM))
  } else {
    ADD_EACH_SPLAT(ADD_AS_FORMS_ARE)
  }
#else
  ADD_EACH_SPLAT(EACH_ROW(ADD_TO_SUMS))
#endif
  EACH_ROW(STORE_ROW_OF_PATCH)
}

// Those in the rows from y on that a register holds.
INLINED ShapeBits splats_of_rows(const PatchReach* reach, int y) {
  ShapeBits splats = 0;
  for (int row = y; row < y + PATCH_WIDTH; row += PATCH_HEIGHT)
    splats |= splats_of_row(reach, row / PATCH_HEIGHT);
  return splats;
}

// Adds the splats of these shapes to the tile. A call whose argument tells the compiler that it may
// use registers of sixteen floats (lanes.cl).
__attribute__((noinline)) static void add_to_patches(float* tile, const PatchShapes* shapes,
                                                     LayerForms forms, PATCH lanes) {
  PatchValues values;
  const PatchReach* const reach = &shapes->reach;
  for (int y = 0; y < TILE_HEIGHT; y += PATCH_WIDTH)
    fill_along(shapes, splats_of_rows(reach, y), y, lanes, &values);
  for (int x = 0; x < TILE_WIDTH; x += PATCH_WIDTH) {
    const ShapeBits of_column = splats_of_column(reach, x / PATCH_WIDTH);
    if (of_column == 0) continue;
    fill_across(shapes, of_column, x, lanes, &values);
    for (int y = 0; y < TILE_HEIGHT; y += PATCH_HEIGHT)
      add_to_patch(tile, x, y, shapes, &values, forms, lanes);
  }
}
#endif
