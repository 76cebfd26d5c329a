// Structures that host and kernels share, byte for byte. Only 4-byte members (and arrays
// of them), so that no compiler pads them differently.
#ifndef SPLOTCHCL_PARAMETERS_H
#define SPLOTCHCL_PARAMETERS_H

#define SCALING_LINEAR 0
#define SCALING_LOG 1
#define SCALING_ASINH 2

#define WEIGHT_MASS 0
#define WEIGHT_DENSITY 1
#define WEIGHT_CONSTANT 2

#define ABSORPTION_AS_EMISSION 0
#define ABSORPTION_NONE 1
#define ABSORPTION_FACTOR 2
#define ABSORPTION_GRAY 3

// A field's way to [0, 1] (frame.h, ScalarMap).
struct FieldScaling {
  int scaling;
  float minimum, minimum_low;  // a pair: ranges may be far narrower than their values
  float inverse_range;         // 0 where the range is empty
};

// Constants of the projection of one component.
struct ProjectParameters {
  // The depth chain (frame.h).
  float position_high[3];
  float position_low[3];
  float forward[3];
  float look_at_high[3];
  float look_at_low[3];
  float far_away;  // z from which x and y are measured from the look-at point
  float right[3];
  float down[3];
  float pixels_per_length;   // perspective: at z = 1
  float center_x, center_y;  // of the whole picture, relative to the crop's corner
  int perspective;
  float period;        // pixels after which an equirectangular picture repeats itself
  float eye_offset;    // of an eye beside the camera, in wide angles
  float turn_axis[3];  // of its head: right, down, forward

  float near_limit;   // z below is left out
  float near_factor;  // z below near_factor * h is left out
  float far_limit;

  float size_factor;
  float kernel_width;  // sigma = kernel_width * h
  float kernel_cut;    // in sigma; 0: uncut
  float min_radius;    // pixels
  float widening;      // sigma'^2 = sigma^2 + widening, in pixels
  float mean_sigma;    // below: the pixel mean by erf, not the widened centre value
  float bright_peak;   // brighter splats are taken as means up to larger widths (shape.cl)
  float crowd_light;   // what splats that lie upon one another add up to; 0: there are none
  float crowd_bright;  // the same where it makes them bright splats
  float crowd_extent;  // sigmas drawn of them at least
  float crowd_narrowest, crowd_widest;  // of sigmas in this range, in pixels

  int weight_model;
  float length_scale;  // keeps sigma^2 inside single precision in any unit
  float weight_scale;  // for masses its square root: it may be too small for a float
  float peak_color;   // the largest of E and A per unit weight, and of it what
  float peak_own;      // does not follow the particles' own colour vectors

  float least_extent;    // sigmas drawn of a faint splat
  float restored_light;  // part of its weight that such a splat gets back
  float inverse_edge;    // 1 / (value at which a splat may end)
  float coarse_sigma;    // smallest sigma in pixels of a coarse grid
  float coarse_peak;     // brighter splats stay on the picture's own grid
  int grid_count;
  float guard;  // of the coarse grids
  // With bands, grids 2 l - 1 and 2 l are those of level l > 0, blurred afterwards by these
  // sigma^2 in pixels of their own. Without, grid g is level g.
  int bands;
  float blur[2];

  struct FieldScaling color;
  struct FieldScaling intensity;

  unsigned int component;
  unsigned int first_particle, end_particle;  // of the component, this launch
  unsigned int block_particles;               // per work-item
  unsigned int first_block;                   // of the component, in offsets and visible
  // 0 where one value serves all particles.
  int smoothing_length_stride, weight_stride, color_stride, intensity_stride, sort_stride;
  int color_vector_stride;
  int sort_by_field, sort_descending;
};

// A projected particle, positions and widths in pixels of its grid.
struct Splat {
  float x, y;
  float sigma;                      // widened, unless pixel means are taken; negative: of a
                                    // bright splat, whose means keep more digits (shape.cl)
  float radius;                     // drawn up to here
  float weight;                     // w' = w sigma^2 / sigma'^2
  float color;                      // palette position in [0, 1]
  unsigned int component_and_grid;  // component | grid << 16
#ifdef ELLIPSES
  float sigma_x, radius_x;  // along x, where the others are along y
#endif
#ifdef VECTOR_COLORS
  float vector[3];  // the particle's own colour
#endif
};

// One component's colours: knots of three floats lie in a table, emission at first_knot,
// absorption at first_absorption_knot. Where the palette has none of its own,
// absorption_knot_count is 0.
struct ComponentColors {
  unsigned int first_knot, knot_count;
  unsigned int first_absorption_knot, absorption_knot_count;
  float brightness;
  int absorption_kind;
  float absorption_factor;
};

// One grid of the picture: grid 0 has the picture's own pixels, those of level l pixels 2^l
// times as wide, with a guard band around the picture. Planes are padded to whole tiles.
struct Grid {
  int width, height;  // with the guard band
  int guard;
  float mean_sigma;  // narrower splats take the pixel mean by erf; 0: none does
  int tiles_x, tiles_y;
  unsigned int first_tile;
  unsigned int stride, plane_size;                 // floats
  unsigned int first_float_low, first_float_high;  // 64-bit offset of the first plane
};

// Which splats a binning pass takes: work-item b walks the slots first + b * stride ...
// of at most `length` splats.
struct BinParameters {
  unsigned int first, stride, length;
  unsigned int end;  // slots from here on do not exist
  unsigned int block_count;
  unsigned int tile_count;
  unsigned int grid_count;
  unsigned int segment_length;
  float mean_sigma;
  float widening;
};

// A number as the sum of two floats, for the most exact mode (exact.cl).
struct FloatPair {
  float high, low;
};

// Constants of the exact projection of one component, beside ProjectParameters.
struct ExactParameters {
  float position[3][3];  // of the camera, relative to the component's origin: a sum of three
  struct FloatPair right[3], down[3], forward[3];
  struct FloatPair pixels_per_length, center_x, center_y;
  struct FloatPair near_limit, far_limit, near_factor;
  int has_near_limit, has_far_limit;
  struct FloatPair size_factor, kernel_width, kernel_cut, min_radius;
  struct FloatPair weight_scale;  // as in ProjectParameters
  struct FloatPair color_minimum, color_inverse_range;
  struct FloatPair intensity_minimum, intensity_inverse_range;
  struct FloatPair brightness, absorption_factor;
  float inverse_share;  // 1 / (light that one splat may leave out)
};

// A splat of the exact mode, in pixels of the crop, with its amplitudes at the centre.
struct ExactSplat {
  struct FloatPair x, y, sigma;
  struct FloatPair light[3];     // A w; where nothing absorbs, E w
  struct FloatPair emission[3];  // E w
  struct FloatPair cut;          // radius of the cut disc
  float radius;                  // drawn up to here
};

// A stretch of one tile's list, composited by one work-item or work-group.
struct Segment {
  unsigned int tile, begin, end;
  unsigned int partial;  // where the layer goes; NO_PARTIAL: into the planes
};
#define NO_PARTIAL 0xffffffffu

// Totals of a binning pass, read back by the host.
struct BinTotals {
  unsigned int entries_low, entries_high;
  unsigned int segment_count, partial_count;
  unsigned int used_grids;  // bit g: grid g has entries
};

// One axis of the blur of a grid: weights[half_width + k] for the pixel k beside.
#define MOST_BLUR_WEIGHTS 64
struct BlurParameters {
  unsigned int source, target;  // grids of one level
  int half_width;
  int add;  // to what the target holds, else instead of it
  float weights[MOST_BLUR_WEIGHTS];
};

struct CompositeParameters {
  unsigned int grid_count;
  float phi_short;   // optical depth up to which two terms of phi's series serve
  float phi_series;  // and four
  float opaque;      // stop where every pixel's opacity is at least this; > 1: never
};

struct ResolveParameters {
  int width, height;
  float source[3];
  float background[3];
  int background_stride;  // pixels in a row of the background's picture; 0: there is none
  // Of a fisheye picture, in half pixels: twice the crop's corner less the picture's size, and
  // the diameter of the circle outside which nothing is shown.
  int circle_x, circle_y, circle_diameter;
};

#endif
