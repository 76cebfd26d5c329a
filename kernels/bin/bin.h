// What host and kernels share of the lists: 4-byte members only (grid.h).
#include "kernels/common/ellipse.h"
#include "kernels/common/grid.h"

#pragma once

// What sums add up of a splat: A w, or E w where nothing absorbs; in slabs of an ordered plan six,
// A w and E w (composite_rows.cl).
#ifndef SUMMED
#define SUMMED 3
#endif

// A splat in the list of one tile, positions relative to the tile's middle, amplitudes at
// the splat's center.
typedef struct TileSplat {
#if EXTENDED_NUMBERS
  unsigned int slot;  // of the splat (composite_extended_rows.cl)
#else
  float x, y;
  float sigma, radius;  // sigma as in Splat
#if ELLIPSES
  struct WidthAlongX along_x;
#endif
#if FACE_OF_CUBE
  struct Tilt tilt;
#endif
#if FINE_PLACES
  float x_low, y_low;   // what x and y do not hold of the place
#endif
#if LIGHT_ORDERED
  float absorption[3];  // A w
  float emission[3];    // E w
#else
  float summed[SUMMED];
#endif
#endif
} TileSplat;

// Lists are read some entries at a time (entry_lanes.cl): so many may be looked at behind the last.
#define ENTRIES_BEHIND 7

// Tiles of a work-item that scans counts.
#define TILES_OF_SCAN 8

// Which splats a binning pass takes: work-item b walks the slots first + b * stride ...
// of at most `length` splats.
typedef struct BinParameters {
  unsigned int first, stride, length;
  unsigned int end;  // slots from here on do not exist
  unsigned int block_count;
  unsigned int has_parts;  // of some grid's tiles not all are in memory (tiles.cl, CountedTiles)
  unsigned int tile_count;
  unsigned int grid_count;
  unsigned int segment_length;        // entries of a tile's list per work-item or group
  unsigned int segment_capacity;      // segments that the buffer holds
  unsigned int first_tile, end_tile;  // lists are made of these only
  int place_bits;  // as in Grid, of all grids; and of splats whose tiles are known their own
  float mean_sigma;
  float widening;
  struct GridBlurs blurs;
} BinParameters;

// The tiles of one splat, of the shape for GPUs: so many columns and rows of them from the first
// on, in a grid of so many in a row; BEHIND_OTHERS: of the first alone, behind all others of its
// list (tiles.cl).
typedef struct SplatTiles {
  unsigned int first, columns, rows, grid_columns;
} BY_FOUR_WORDS SplatTiles;
#define BEHIND_OTHERS 0xffffffffu
// Splats of at most so many tiles are counted tile by tile.
#define FEW_TILES 4
// Each work-group counts in one of so many copies: of a crowd's splats, which lie in a few tiles,
// as many would else wait for each other.
#define COPIES_OF_COUNTS 16

// Of a band of tiles in this shape.
typedef struct GroupBinParameters {
  struct BinParameters bin;
  unsigned int entry_count;  // of the band
} GroupBinParameters;

// A stretch of one tile's list, composited by one work-item or work-group.
typedef struct Segment {
  unsigned int tile, begin, end;
  unsigned int partial;  // where the layer goes; NO_PARTIAL: into the planes
} Segment;
#define NO_PARTIAL 0xffffffffu
