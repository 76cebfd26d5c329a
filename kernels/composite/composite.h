// What host and kernels share of compositing: 4-byte members only (grid.h).
#include "kernels/common/grid.h"

#pragma once

// The face of a cube that the picture is: its middle, in pixels of the whole picture, and 1 / the
// pixels of a tangent of 1.
typedef struct CubeFace {
  struct FloatPair middle_x, middle_y, inverse_focal;
  float cut2;  // of the exponent of 2 of a shape; its values beyond are cut away
} CubeFace;

typedef struct CompositeParameters {
  unsigned int grid_count;
  unsigned int first_segment, end_segment;
  float phi_first;             // optical depth up to which one term of phi's series serves,
  float phi_short;             // two,
  float phi_third;             // three,
  float phi_series;            // and four
  float stop;                  // where every pixel's transmittance is at most this; below 0: never
  unsigned int most_in_block;  // splats put together before they come behind the others
  struct CubeFace face;
} CompositeParameters;

// Clouds around the camera (docs/projections.md) in the lists of an ordered frame. Their entries
// have a sigma of -CLOUD_SIGMA times one more than the cloud's number, where no splat has one.
#define CLOUD_SIGMA 1048576.0f

typedef struct CloudEntry {
  float center[3];  // from the camera along right, down and forward, in sigma
  float distance2;  // the square of its length
  float ray;        // the part that rays find
  float farthest2;  // nothing of it shows farther from its center, in sigma, squared
  float absorption[3], emission[3];     // A w, E w
  float deepest;                        // no pixel's optical depth is more
  unsigned int is_bright;               // well above 1
  unsigned int first_splat, end_splat;  // the part that splats show: copies of one
} CloudEntry;

typedef struct CloudSplat {
  float x, y;                  // pixels from the middle of the picture's grid
  float inverse_x, inverse_y;  // 1 / sigma
  float mean_x, mean_y;        // 1 / sigma^2; 0 where the value at a pixel's center serves
  float part;
} CloudSplat;

// Pixels of a tile look in directions that are no farther from this one than an angle.
typedef struct DirectionCone {
  float direction[3];
  float sine, cosine;  // of the angle
} DirectionCone;

// Of a layer that is put behind the planes of the picture's own grid (behind.cl).
typedef struct BehindParameters {
  int width, height;   // of the crop
  int crop_x, crop_y;  // in the picture
} BehindParameters;
