// Splats of extended precision: 4-byte members only (grid.h).
#include "kernels/common/grid.h"

#pragma once

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
#if ELLIPSES
  struct ExtendedAlongX along_x;
#endif
#if FACE_OF_CUBE
  struct ExtendedTilt tilt;
#endif
};

typedef struct ExtendedAlongX ExtendedAlongX;
typedef struct ExtendedTilt ExtendedTilt;
typedef struct ExtendedSplat ExtendedSplat;
