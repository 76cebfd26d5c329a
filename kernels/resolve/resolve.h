// What host and kernels share of the way from planes to the picture: 4-byte members only
// (grid.h).
#pragma once

// Pixels of a grid: those from right_end and bottom on are no part of it.
typedef struct GridPart {
  int left, top, right_end, bottom;
} GridPart;

// One axis of the blur of a grid: weights[half_width + k] for the pixel k beside.
#define MOST_BLUR_WEIGHTS 64
typedef struct BlurParameters {
  unsigned int source, target;  // grids of one level
  struct GridPart part;         // of the target, that is wanted
  int half_width;               // pixels
  int add;                      // to what the target holds, else instead of it
  float weights[MOST_BLUR_WEIGHTS];
} BlurParameters;

// The same of all grids of a level, in strips of columns (blur_strips.cl): weights[k] for the
// pixels k beside on either side.
#define MOST_BLURRED_GRIDS 4
#define STRIP 64  // columns
#define ROWS_OF_BAND 256
typedef struct BlurWeights {
  unsigned int source;
  int half_width;
  float weights[MOST_BLUR_WEIGHTS / 2];
} BlurWeights;
typedef struct BlurStripsParameters {
  unsigned int target;
  struct GridPart part;  // of the target, that is wanted
  int add;               // to what the target holds, else instead of it
  int source_count;
  struct BlurWeights blurs[MOST_BLURRED_GRIDS];
} BlurStripsParameters;

// Interpolation of a grid to the pixels of the next finer one (plan.h, RefinementFilter): a pixel
// is made from those up to REFINEMENT_REACH beside the one that it lies on.
#define REFINEMENT_TAPS 16
#define REFINEMENT_REACH (REFINEMENT_TAPS / 2)
typedef struct RefineParameters {
  unsigned int coarse, fine;  // grids
  struct GridPart part;       // of the finer grid, that is wanted
  int add;                    // to what the finer grid holds, else instead of it
  float weights[REFINEMENT_TAPS];
} RefineParameters;

#define ROWS_OF_BLOCK 16

typedef struct ResolveParameters {
  int width, height;   // pixels
  int crop_x, crop_y;  // in the picture
  float source[3];     // q of the proportional plan
  float background[3];
  int background_stride;  // pixels in a row of the background's picture; 0: there is none
  // Of a fisheye picture, in half pixels: twice the crop's corner less the picture's size, and
  // the diameter of the circle outside which nothing is shown. 0: the picture has no circle.
  int circle_x, circle_y, circle_diameter;
} ResolveParameters;

// Of a row, that a work-item takes.
#define PIXELS_OF_ITEM (8 * EIGHTS_OF_ITEM)
