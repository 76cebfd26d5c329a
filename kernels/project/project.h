// What host and kernels share of the projection: 4-byte members only (grid.h).
#include "kernels/common/grid.h"

#pragma once

#define SCALING_LINEAR 0
#define SCALING_LOG 1
#define SCALING_ASINH 2
// Taken of how far values are from the least: log1p((v - m) / m), and asinh of a difference.
#define SCALING_LOG_FROM_LEAST 3
#define SCALING_ASINH_FROM_LEAST 4

#define WEIGHT_MASS 0
#define WEIGHT_DENSITY 1
#define WEIGHT_CONSTANT 2

// Single precision ends where columns do not: a mass in a width of 1e-20 is more than it holds, and
// infinite light less infinite light, or times no width, is not a number (docs/dev/accuracy.md).
// Narrower splats are drawn so wide, in pixels, with the same light: places are not known better.
#if DOUBLE_VALUES
#define REAL double
#define NARROWEST_SIGMA 0x1p-28f
#else
#ifndef __cplusplus
#define REAL float
#endif
#define NARROWEST_SIGMA 0x1p-20f
#endif
// A constant to all digits of it.
#define REAL_OF(number) ((REAL)(number))
// The most that one splat gives a pixel, or takes from it, in units of the display's white.
#define MOST_LIGHT 0x1p60f

// What is farther than this from a cube face's axis has no light in the face
// (src/scene/projection.cpp).
#define SMALLEST_COSINE_OF_FACE 0x1p-4f

// Sort keys are counted by 16 of their bits.
#define KEY_BINS 65536

// An integer of 64 bits.
typedef struct WideInteger {
  unsigned int low, high;
} WideInteger;

// What depth keys are made from (src/scene/depth_key.h, DepthKeyScale).
typedef struct DepthKeyParameters {
  struct WideInteger origin_from_camera[3];
  struct WideInteger forward[3];
  int finest_unit, unit;
  int perspective;
  struct WideInteger near_key, far_key;
  struct WideInteger near_factor;  // 0: near_key holds
  int near_exponent;
} DepthKeyParameters;

// Of splats of an octave of widths (plan.h, WidthNeed).
typedef struct WidthNeeds {
  float light[WIDTH_OCTAVES], farther[WIDTH_OCTAVES];
} WidthNeeds;

// Which particles a launch takes, and where they go.
typedef struct ProjectLaunch {
  unsigned int first_particle, end_particle;  // of the component
  unsigned int block_particles;               // per work-item
  unsigned int first_block;                   // of the component, in offsets and counts
  unsigned int first_slot;                    // of the launch: offsets count from there
  // 0 where one value serves all particles.
  int smoothing_length_stride, weight_stride, color_stride, intensity_stride, sort_stride;
  int own_color_stride;
  int leaves_out_blocks;  // some: left_out says which
  // Sort keys of 48 bits from first to before end, those of a field with zeros below its 32; and
  // the lowest bit of what numbers the bins in which such keys are counted.
  struct WideInteger window_first, window_end;
  int bin_shift;
} ProjectLaunch;

// Constants of the projection of one component: floats, or doubles in extended precision.
#ifdef __cplusplus
template <typename REAL>
#endif
struct ProjectParameters {
  // The camera relative to the component's origin, as a sum of two.
  REAL position_high[3];
  REAL position_low[3];
  REAL forward[3];
  REAL look_at_high[3];
  REAL look_at_low[3];
  REAL far_away;  // z from which x and y are measured from the look-at point
  REAL right[3];
  REAL down[3];
  REAL pixels_per_length;  // perspective: at z = 1
  // In pixels from the picture's middle, as all places (Grid): where the view direction meets the
  // picture, what is in memory of the picture's own grid, and of which part particles are looked
  // at.
  REAL center_x, center_y;
  REAL left, right_end, top, bottom;
  REAL seen_left, seen_right_end, seen_top, seen_bottom;
  int perspective;
  REAL period;                      // pixels after which an equirectangular picture repeats itself
  struct WideInteger period_units;  // the same in units of places
  // Twice the places of its upper and its lower pole.
  REAL twice_pole[2];
  struct WideInteger twice_pole_units[2];
  REAL eye_offset;    // of an eye beside the camera, in wide angles
  REAL turn_axis[3];  // of its head: right, down, forward

  // In single precision; where that cannot tell, keys decide.
  REAL near_limit;   // z below is left out
  REAL near_factor;  // z below near_factor * h is left out
  REAL far_limit;
  REAL around_reach;    // nearer than so many h, times length_scale, clouds are around the camera
  REAL least_depth;     // in perspective all that is drawn is at least that far away
  REAL depth_rounding;  // of z, beside what follows from the particle's own place
  struct DepthKeyParameters depth_key;

  REAL size_factor;
  REAL kernel_width;     // sigma = kernel_width * h
  REAL sigma_per_h;      // and of h as it is stored, without size_factor, in one rounding
  REAL kernel_cut;       // in sigma; 0: uncut
  REAL min_radius;       // pixels
  REAL footprint_sigma;  // of kernel.footprint, sqrt(2) of it; pixels
  // Of a lens: what it adds to widths per difference from the scale in focus; 0: none.
  REAL lens_sigma, scale_in_focus;
  // Where light begins to rise with depth and ends to fall, and by which part per length; 0: not.
  REAL fade_begin, inverse_near_fade, fade_end, inverse_far_fade;
  // On a face of a cube, what a pixel adds to sigma^2, and what it makes of it at least; 0 and 0
  // where it takes the value at its center (src/scene/projection.h, FaceEllipse).
  REAL footprint, narrowest_squared;
  REAL widening;           // sigma'^2 = sigma^2 + widening, in pixels
  REAL mean_sigma;         // below: the pixel mean by erf, not the widened center value
  REAL bright_peak;        // brighter splats are taken as means up to larger widths (shape.cl),
  REAL bright_mean_sigma;  // from this one on (limits.cl)
  int octaves_in_need, has_bright_octaves;  // whose needs are not 0; whether any is of light

  // sharp_places.cl, docs/dev/accuracy.md
  REAL place_error, place_error_per_pixel;  // roundings of places in single precision
  REAL sharp_width;                         // sigma per slope and rounding below which they show
  REAL too_sharp_width;  // sigma per slope below which the integers of a splat show
  REAL most_fading;      // ln of the largest peak whose width single precision knows well enough

  int weight_model;
  REAL length_scale;  // keeps sigma^2 inside single precision in any unit
  REAL weight_scale;  // for masses its square root: it may be too small for a REAL
  REAL peak_color;    // the largest of E and A per unit weight, and of it what
  REAL peak_own;      // does not follow the particles' own colors
  // What counts of that for errors (plan.h, light_behind): this part, or with the rule of gray
  // absorption (scene.h), where it is above 0, what the rule leaves of the emission.
  REAL counted_part, gray_absorption;

  REAL least_extent;          // sigmas drawn of a faint splat
  REAL restored_light;        // part of its weight that such a splat gets back
  REAL inverse_edge;          // 1 / (value at which a splat may end)
  REAL inverse_coarse_sigma;  // 1 / (smallest sigma in pixels of a coarse grid)
  REAL coarse_peak;           // brighter splats stay on the picture's own grid
  int grid_count;
  // Of the picture, and its coarser grids' guard bands (Grid), for finding the tiles of lanes.
  int width, height, middle_x, middle_y, guard;
  unsigned int tile_count;
  int has_parts;      // of some grid not all tiles are in memory
  REAL beside;        // pixels of a coarse grid beside the picture, or the crop, that are in memory
  REAL sigmas_shown;  // no splat on a coarse grid with a peak up to 1 shows farther than that
  REAL reach;         // sigmas beyond which nothing is drawn on any grid
  struct GridBlurs blurs;

  // A field's way to [0, 1] (frame.h, ScalarMap).
  struct FieldScaling {
    int scaling;
    // After scaling; before it of what is taken FROM_LEAST, m. A pair: ranges may be far narrower
    // than their values.
    REAL minimum, minimum_low;
    REAL factor;         // FROM_LEAST: 1 / m of logarithms, sqrt(1 + m^2) of asinh
    REAL inverse_range;  // 0 where the range is empty; FROM_LEAST of natural logarithms
  } color, intensity;
  REAL brightness, absorption_factor;  // of extended precision

  int place_bits;  // as in Grid
  unsigned int component;
  int sort_by_field, sort_descending;
  struct ProjectLaunch launch;
};

// What one block of particles became.
typedef struct BlockCounts {
  unsigned int visible, bad;
  unsigned int too_sharp;  // for the frame's precision, of all in the whole picture
  unsigned int around;     // the camera: those are not drawn as splats
} BlockCounts;

// The bins of the keys of one block's splats; least > most where it has none.
typedef struct KeyBins {
  unsigned int least, most;
} KeyBins;

// What a block of particles is wherever the camera stands (boxes.cl).
typedef struct BlockBox {
  float lower[3], upper[3];  // around the good ones; lower > upper where none is
  float largest_h;
  unsigned int bad;
} BlockBox;

// What the places of sharp splats follow from in extended numbers, of one component, beside
// ProjectParameters (sharp_places.cl).
typedef struct SharpParameters {
  float position[3][3];  // of the camera, relative to the component's origin: a sum of three
  struct FloatPair right[3], down[3], forward[3];
  struct FloatPair pixels_per_length;
  struct FloatPair center_from_middle_x, center_from_middle_y;
  struct FloatPair eye_offset, turn_axis[3];  // as in ProjectParameters
} SharpParameters;

#ifndef __cplusplus
typedef struct ProjectParameters ProjectParameters;
typedef struct FieldScaling FieldScaling;
#endif
