// LANES splats, to be written one by one, and where they are written to.
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/common/splat.h"
#include "kernels/common/words.cl"
#include "kernels/extended/extended_splat.h"
#include "kernels/project/project.h"
#include "kernels/project/sort_keys.cl"
#include "kernels/project/splat_widths.cl"

#pragma OPENCL FP_CONTRACT OFF

#if defined(TILES_IN_SPLAT) && defined(OUTPUT_SPLATS)
#define TILES_OF_LANES
#if LANES > 1 && !defined(ELLIPSES) && !defined(VECTOR_COLORS) && !defined(FINE_PLACES)
#define SPLATS_OF_EIGHT_WORDS  // as many as lanes
#endif
#endif

// Blocks of eight lanes have room for all their particles (projector.cpp): a splat that is not
// visible is written, too, and the next one over it. Which these are no processor foresees.
#if defined(SPLATS_OF_EIGHT_WORDS) && !defined(EXTENDED_NUMBERS)
#define WRITES_ALL_LANES
#endif

// Where grids are in memory as a whole, and no splat has to have its tiles found again, all lanes
// are counted in tiles that are known already.
#if defined(WRITES_ALL_LANES) && defined(COUNT_TILES)
#define COUNTS_ALL_LANES
#endif

// SplatLanes as arrays, to be written one by one.
typedef struct SplatArrays {
  int visible[LANES];
#ifdef SPLATS_OF_EIGHT_WORDS
  Splat splats[LANES];
#else
  int x[LANES], y[LANES], component_and_grid[LANES];
  float sigma[LANES], radius[LANES], weight[LANES], color[LANES];
#ifdef ELLIPSES
  float pixel_x[LANES], pixel_y[LANES], sigma_x[LANES], radius_x[LANES];
#endif
#ifdef FACE_OF_CUBE
  float squared_width[LANES], footprint[LANES], secant2[LANES], part[LANES];
#endif
#ifdef VECTOR_COLORS
  float red[LANES], green[LANES], blue[LANES];
#endif
#ifdef FINE_PLACES
  int place_fractions[LANES];
#endif
#ifdef TILES_OF_LANES
  int tiles[LANES];
#endif
#endif
#ifdef COUNTS_ALL_LANES
  int grid[LANES];
  int from_corner[LANES], tiles_x[LANES];  // TileLanes
  uint have_several;                       // a bit for each that touches several tiles
  int has_known_tiles;
#endif
#ifdef SORT_KEYS
  long sort_keys[LANES];
#endif
} SplatArrays;

#ifdef SPLATS_OF_EIGHT_WORDS
// Word by word of eight splats to splat by splat, in three steps of neighbors.
INLINED void store_eight_splats(float8 x, float8 y, float8 sigma, float8 radius, float8 weight,
                                float8 color, float8 grid, float8 touched, Splat* splats) {
  const float8 xy0 = first_words(x, y), xy2 = last_words(x, y);
  const float8 widths0 = first_words(sigma, radius), widths2 = last_words(sigma, radius);
  const float8 light0 = first_words(weight, color), light2 = last_words(weight, color);
  const float8 lists0 = first_words(grid, touched), lists2 = last_words(grid, touched);
  // Of splats 0 and 4, 1 and 5 ...: their first four words, and their last.
  const float8 first04 = first_pairs(xy0, widths0), first15 = last_pairs(xy0, widths0);
  const float8 first26 = first_pairs(xy2, widths2), first37 = last_pairs(xy2, widths2);
  const float8 last04 = first_pairs(light0, lists0), last15 = last_pairs(light0, lists0);
  const float8 last26 = first_pairs(light2, lists2), last37 = last_pairs(light2, lists2);
  // Without a loop, which compilers leave, and then put pieces of these in memory.
  float* words = (float*)splats;
  store_eight((float8)(first04.lo, last04.lo), words + 0);
  store_eight((float8)(first15.lo, last15.lo), words + 8);
  store_eight((float8)(first26.lo, last26.lo), words + 16);
  store_eight((float8)(first37.lo, last37.lo), words + 24);
  store_eight((float8)(first04.hi, last04.hi), words + 32);
  store_eight((float8)(first15.hi, last15.hi), words + 40);
  store_eight((float8)(first26.hi, last26.hi), words + 48);
  store_eight((float8)(first37.hi, last37.hi), words + 56);
}

INLINED void store_splats(const SplatLanes s, INTEGER tiles, Splat* splats) {
  const VALUE x = AS_VALUE(s.place.x), y = AS_VALUE(s.place.y);
  const VALUE grid = AS_VALUE(s.component_and_grid), touched = AS_VALUE(tiles);
#if LANES == 16
  store_eight_splats(x.lo, y.lo, s.sigma.lo, s.radius.lo, s.weight.lo, s.color.lo, grid.lo,
                     touched.lo, splats);
  store_eight_splats(x.hi, y.hi, s.sigma.hi, s.radius.hi, s.weight.hi, s.color.hi, grid.hi,
                     touched.hi, splats + 8);
#else
  store_eight_splats(x, y, s.sigma, s.radius, s.weight, s.color, grid, touched, splats);
#endif
}
#endif

// `tiles` are TileLanes, packed, where there are any.
INLINED void spread(const SplatLanes s, INTEGER tiles, SplatArrays* a) {
  STORE(s.visible, a->visible);
#ifndef EXTENDED_NUMBERS
#ifdef ELLIPSES
  STORE(s.x, a->pixel_x);
  STORE(s.y, a->pixel_y);
  STORE(s.radius, a->radius);
  STORE(s.radius_x, a->radius_x);
#endif
#ifdef SPLATS_OF_EIGHT_WORDS
  store_splats(s, tiles, a->splats);
#elif defined(OUTPUT_SPLATS)
#ifdef TILES_OF_LANES
  STORE(tiles, a->tiles);
#endif
  STORE(s.place.x, a->x);
  STORE(s.place.y, a->y);
  STORE(s.component_and_grid, a->component_and_grid);
  STORE(s.sigma, a->sigma);
  STORE(s.radius, a->radius);
  STORE(s.weight, a->weight);
  STORE(s.color, a->color);
#ifdef ELLIPSES
  STORE(s.sigma_x, a->sigma_x);
#endif
#ifdef FACE_OF_CUBE
  STORE(s.face.squared_width, a->squared_width);
  STORE(s.face.footprint, a->footprint);
  STORE(s.face.secant2, a->secant2);
  STORE(s.part, a->part);
#endif
#ifdef VECTOR_COLORS
  STORE(s.own_color.x, a->red);
  STORE(s.own_color.y, a->green);
  STORE(s.own_color.z, a->blue);
#endif
#ifdef FINE_PLACES
  STORE(s.place.fractions, a->place_fractions);
#endif
#endif
#endif
}

#ifdef SPLATS_OF_EIGHT_WORDS
// In one piece: a structure is copied in pieces.
#define STORE_SPLAT(found, k, splat, to) \
  store_global_eight(load_eight((const float*)((found).splats + (k))), (__global float*)(to))
#else
#define STORE_SPLAT(found, k, splat, to) *(to) = splat
#endif

#if defined(OUTPUT_SPLATS) && !defined(EXTENDED_NUMBERS)
INLINED Splat splat_of(const SplatArrays* a, uint k) {
#ifdef SPLATS_OF_EIGHT_WORDS
  return a->splats[k];
#else
  Splat splat;
  splat.x = a->x[k];
  splat.y = a->y[k];
  splat.component_and_grid = (uint)a->component_and_grid[k];
  splat.sigma = a->sigma[k];
  splat.radius = a->radius[k];
  splat.weight = a->weight[k];
  splat.color = a->color[k];
#ifdef ELLIPSES
  splat.along_x.sigma = a->sigma_x[k];
  splat.along_x.radius = a->radius_x[k];
#endif
#ifdef FACE_OF_CUBE
  splat.tilt.squared_width = a->squared_width[k];
  splat.tilt.footprint = a->footprint[k];
  splat.tilt.inverse_secant2 = 1.44269504f / a->secant2[k];
  splat.tilt.scale = a->squared_width[k] / a->part[k];
  splat.part = a->part[k];
#endif
#ifdef VECTOR_COLORS
  splat.own_color.rgb[0] = a->red[k];
  splat.own_color.rgb[1] = a->green[k];
  splat.own_color.rgb[2] = a->blue[k];
#endif
#ifdef FINE_PLACES
  splat.place_fractions = (uint)a->place_fractions[k];
#endif
#ifdef TILES_IN_SPLAT
  splat.tiles = (uint)a->tiles[k];
#endif
  return splat;
#endif
}
#endif

static inline uint count_true(INTEGER mask) {
  int lanes[LANES];
  STORE(mask, lanes);
  uint count = 0;
  for (uint k = 0; k < LANES; ++k)
    count += lanes[k] != 0;
  return count;
}

// Where a program writes: to one word each what it does not write.
typedef struct ProjectTargets {
  __global BlockCounts* counts;
  __global Splat* splats;
  __global uint* keys;        // the upper 32 bits of sort keys
  __global ushort* key_ends;  // the 16 bits below, of depths
  __global ExtendedSplat* extended_splats;
  __global uint* key_counts;   // of each bin (sort_keys.cl)
  __global KeyBins* key_bins;  // of each block
  __global uint* tile_counts;  // of each block: how many of its splats touch a tile
  __global uint* tiles;        // of each splat, where it does not hold them
} ProjectTargets;
