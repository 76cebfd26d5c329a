// LANES splats, to be written one by one, and where they are written to.
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/common/splat.h"
#include "kernels/project/depth_key.cl"
#include "kernels/project/extended_splat.cl"
#include "kernels/project/project.h"
#include "kernels/project/splat_place.cl"
#include "kernels/project/splat_widths.cl"
#include "kernels/project/wide_angle.cl"

#pragma OPENCL FP_CONTRACT OFF

#define TILES_OF_LANES (TILES_IN_SPLAT && OUTPUT_SPLATS)
// As many words as lanes.
#define SPLATS_OF_EIGHT_WORDS \
  (TILES_OF_LANES && LANES > 1 && !ELLIPSES && !VECTOR_COLORS && !FINE_PLACES)
// Blocks have room for all their particles (projector.cpp): a splat that is not visible is written,
// too, and the next one over it. Which these are no processor foresees.
#define WRITES_ALL_LANES SPLATS_OF_EIGHT_WORDS
// Where grids are in memory as a whole, and no splat has to have its tiles found again, all lanes
// are counted in tiles that are known already.
#define COUNTS_ALL_LANES (WRITES_ALL_LANES && COUNT_TILES)

// LANES splats, to be written one by one.
typedef struct SplatArrays {
  int visible[LANES];
  Splat splats[LANES];  // of eight words; others are in `lanes`
  SplatLanes lanes;
  int tiles[LANES];  // TileLanes, packed, where there are any
  long sort_keys[LANES];
  // Where all lanes are counted.
  int grid[LANES];
  int from_corner[LANES], tiles_x[LANES];  // TileLanes
  uint have_several;                       // a bit for each that touches several tiles
  int has_known_tiles;
} SplatArrays;

#if LANES > 1
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
#else
INLINED void store_splats(const SplatLanes s, INTEGER tiles, Splat* splats) {}
#endif

INLINED void spread(const SplatLanes s, INTEGER tiles, SplatArrays* a) {
  STORE(s.visible, a->visible);
  if (SPLATS_OF_EIGHT_WORDS) {
    store_splats(s, tiles, a->splats);
  } else {
    a->lanes = s;
    if (TILES_OF_LANES) STORE(tiles, a->tiles);
  }
}

// In one piece: a structure is copied in pieces.
INLINED void store_splat(const SplatArrays* found, uint k, const Splat splat, __global Splat* to) {
  if (SPLATS_OF_EIGHT_WORDS)
    store_global_eight(load_eight((const float*)(found->splats + k)), (__global float*)to);
  else
    *to = splat;
}

INLINED Splat splat_of(const SplatArrays* a, uint k,
                       __global const ComponentColors* component_colors,
                       __global const float* knots, const ProjectParameters p) {
  if (SPLATS_OF_EIGHT_WORDS) return a->splats[k];
  const SplatLanes* const s = &a->lanes;
  Splat splat;
  splat.x = integer_of(s->place.x, k);
  splat.y = integer_of(s->place.y, k);
  splat.component_and_grid = (uint)integer_of(s->component_and_grid, k);
  splat.sigma = value_of(s->sigma, k);
  splat.radius = value_of(s->radius, k);
  splat.weight = value_of(s->weight, k);
  splat.color = value_of(s->color, k);
#if ELLIPSES
  splat.along_x.sigma = value_of(s->sigma_x, k);
  splat.along_x.radius = value_of(s->radius_x, k);
#endif
#if FACE_OF_CUBE
  splat.part = value_of(s->part, k);
  splat.tilt.squared_width = value_of(s->face.squared_width, k);
  splat.tilt.footprint = value_of(s->face.footprint, k);
  splat.tilt.inverse_secant2 = 1.44269504f / value_of(s->face.secant2, k);
  splat.tilt.scale = splat.tilt.squared_width / splat.part;
#endif
#if VECTOR_COLORS
  splat.own_color.rgb[0] = value_of(s->own_color.x, k);
  splat.own_color.rgb[1] = value_of(s->own_color.y, k);
  splat.own_color.rgb[2] = value_of(s->own_color.z, k);
#endif
#if FINE_PLACES
  splat.place_fractions = (uint)integer_of(s->place.fractions, k);
#endif
#if TILES_IN_SPLAT
  splat.tiles = (uint)a->tiles[k];
#endif
#if EXTENDED_NUMBERS
  splat.extended = extended_splat(s, k, component_colors, knots, p);
#endif
#if WHOLE_SECTORS
  splat.unused = 0;
#endif
  return splat;
}

// Of a panorama, in which a splat may show several times.
INLINED Copies copies_of(const SplatArrays* found, uint k, const ProjectParameters p) {
  if (!COPIES) return one_copy();
  const SplatLanes* const s = &found->lanes;
  return copies_in_picture(value_of(s->x, k), value_of(s->y, k), value_of(s->radius_x, k),
                           value_of(s->radius, k), p);
}

// Puts a splat where its copy is.
static inline void put_copy(Splat* splat, const Copy copy, const ProjectParameters p) {
  const uint coarser = splat->component_and_grid >> 24;
  splat->x += (int)((copy.half_periods * wide_integer(p.period_units)) >> (coarser + 1));
#if EXTENDED_NUMBERS
  splat->extended = copy_of(copy, splat->extended, p);
#endif
  if ((copy.half_periods & 1) == 0) return;
  splat->y = (int)(wide_integer(OF_POLE(p.twice_pole_units, copy.pole)) >> coarser) - splat->y;
#if FINE_PLACES
  const int fraction_y = -((int)splat->place_fractions >> 16);
  splat->place_fractions = (splat->place_fractions & 0xffffu) | ((uint)fraction_y << 16);
#endif
}

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
  __global uint* keys;         // the upper 32 bits of sort keys
  __global ushort* key_ends;   // the 16 bits below, of depths
  __global uint* key_counts;   // of each bin (depth_key.cl)
  __global KeyBins* key_bins;  // of each block
  __global uint* tile_counts;  // of each block: how many of its splats touch a tile
  __global uint* tiles;        // of each splat, where it does not hold them
} ProjectTargets;

// What the kernel `project` takes, in both shapes: counts[b] takes the block's numbers of visible
// and bad particles. With OUTPUT_SPLATS the splats are written from offsets[b] on; with OUTPUT_KEYS
// the upper 32 bits of their sort keys, and the 16 bits below them where depths are keys, too; with
// COUNT_TILES tile_counts[b * tile_count + t] takes how many of the block's splats touch tile t,
// and tiles[slot] which they are; with COUNT_KEYS key_counts[bin] grows by the splats of each bin,
// and key_bins[b] takes the block's. Where there are keys, only splats in the window of keys are
// there. Of a block that no part of the picture shows, left_out[b] is the number of its bad
// particles and 1 more, else 0.
#define PROJECT_PARAMETERS                                                                    \
  const ProjectParameters p, const SharpParameters e, COLUMN_PARAMETERS,                      \
      __global const uint *offsets, __global BlockCounts *counts, __global Splat *splats,     \
      __global uint *keys, __global ushort *key_ends, __global const WidthNeeds *width_needs, \
      __global const uint *left_out, __global const ComponentColors *component_colors,        \
      __global const float *knots, __global uint *key_counts, __global KeyBins *key_bins,     \
      __global const Grid *grids, __global uint *tile_counts, __global uint *tiles
