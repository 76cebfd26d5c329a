// What host and kernels share of the check after drawing: 4-byte members only (grid.h).
#include "kernels/common/grid.h"

#pragma once

// Square cells of one octave of widths in a tile, in the order of its pixels' numbers, of which the
// bits of column and row follow each other in turn (Morton's order): those of a cell are one run.
typedef struct OctaveCells {
  unsigned int first;  // of the tile's
  int pixel_bits;      // a cell has 2^pixel_bits pixels
} OctaveCells;

// Splats of one octave of widths are collected in cells about as wide as they are.
typedef struct CertifyParameters {
  unsigned int grid_count, segment_count;
  unsigned int cells_per_tile;  // of all octaves, peaks and endings, and
  unsigned int listed;          // the one that counts the splats of a tile's list
  struct OctaveCells peaks[WIDTH_OCTAVES], endings[WIDTH_OCTAVES];
  // Splats of peaks up to edge_peak end at the roots of these, in sigma: of octaves in the picture.
  float extent2[WIDTH_OCTAVES];
  float widening;  // as in ProjectParameters
  struct GridBlurs blurs;
  float edge_peak;     // brighter splats are drawn until they have fallen as far as this one
  float bright_peak;   // no more than this counts of a peak on the picture's own grid
  float light_behind;  // an error of absorption counts as so much of one of emission (plan.h)
} CertifyParameters;
