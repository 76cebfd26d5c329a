// Where splats are, how bright, and what they leave out where they end: sums over all of them,
// from the lists that were drawn.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/certify/certify.h"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"

// Comparisons, since min, max and clamp are calls on PoCL.
static inline float smaller(float a, float b) {
  return a < b ? a : b;
}
static inline float larger(float a, float b) {
  return a > b ? a : b;
}
INLINED VALUE smaller_of(VALUE a, VALUE b) {
  return choose(b, a, a < b);
}
INLINED VALUE larger_of(VALUE a, VALUE b) {
  return choose(b, a, a > b);
}

// The largest of three channels of entries, with the number that lies before them.
#define WORD_OF(s, field) ((uint)((__global const float*)(s)->field - (__global const float*)(s)))
#define LARGEST_CHANNEL(s, color) largest_channel(load_fields(s, WORD_OF(s, color) - 1u))
INLINED VALUE largest_channel(const FieldLanes fields) {
  return larger_of(fields.second, larger_of(fields.third, fields.fourth));
}

// The brightest channel at the splats' centers.
INLINED VALUE amplitudes_of(__global const TileSplat* s, float light_behind) {
#if LIGHT_ORDERED
  return larger_of(LARGEST_CHANNEL(s, emission), light_behind * LARGEST_CHANNEL(s, absorption));
#else
  return LARGEST_CHANNEL(s, summed);
#endif
}

// The part of its grid in which centers count in this tile: the tile, and at the grid's edge
// all that lies beyond. So every splat in a list counts in one tile of its grid; those that are
// only listed (splat.h) are in one list.
typedef struct Reach {
  float x0, x1, y0, y1;
} Reach;

static inline Reach reach_of(const Grid grid, int column, int row) {
  Reach reach;
  reach.x0 = column == 0 ? -INFINITY : -0.5f * TILE_WIDTH;
  reach.x1 = column == grid.tiles_x - 1 ? INFINITY : 0.5f * TILE_WIDTH;
  reach.y0 = row == 0 ? -INFINITY : -0.5f * TILE_HEIGHT;
  reach.y1 = row == grid.tiles_y - 1 ? INFINITY : 0.5f * TILE_HEIGHT;
  return reach;
}

INLINED uint cell_of(const OctaveCells* cells, uint pixel) {
  return cells->first + (pixel >> cells->pixel_bits);
}

// The number of a pixel of the tile (certify.h), of columns and rows below 256.
#define PIXEL_NUMBER(T, name)               \
  INLINED T name(T column, T row) {         \
    T bits = column | row << 16;            \
    bits = (bits | bits << 4) & 0x0f0f0f0f; \
    bits = (bits | bits << 2) & 0x33333333; \
    bits = (bits | bits << 1) & 0x55555555; \
    return (bits | bits >> 15) & 0xffff;    \
  }
PIXEL_NUMBER(int, pixel_number)
PIXEL_NUMBER(INTEGER, pixel_numbers)

static inline int nearest_pixel(float center, float first, float last) {
  return (int)smaller(larger(center, first), last);
}
INLINED INTEGER pixel_of(VALUE center, int last) {
  return TO_INTEGER(smaller_of(larger_of(center, (VALUE)(0.0f)), (VALUE)((float)last)));
}

// What splats leave out where they end is added up as peaks of splats that end where others of
// their octave do (extent2). One that is only listed stands for all that it would have added, which
// is no more than what it has fallen to at the picture's edge.
INLINED float listed_ending(__global const TileSplat* splat, const CertifyParameters* p,
                            float extent2, float peak, float width2) {
  const float beyond = larger(-splat->radius - 1.0f, 0.0f);
  return smaller(smaller(peak, p->edge_peak), peak * exp(extent2 - beyond * beyond / width2));
}

// The octave whose splats end as far out as a bright one, which is drawn farther than others.
static inline int octave_of_ending(float radius, int octave, int level,
                                   const CertifyParameters* p) {
  const float radius2 = radius * radius;
  while (octave + level < WIDTH_OCTAVES - 1 &&
         p->extent2[octave + level] * (float)(1 << 2 * octave) < radius2) {
    ++octave;
  }
  return octave;
}

// What its splats share of a grid.
typedef struct GridOfCells {
  int level;
  float mean_sigma;
  float blur;       // what the square of the width drawn lacks to that of the picture
  float most_peak;  // no more than this counts of a peak
} GridOfCells;

INLINED GridOfCells grid_of_cells(const CertifyParameters* p, uint g, const Grid grid) {
  GridOfCells of;
  of.level = level_of_grid(g, &p->blurs);
  of.mean_sigma = grid.mean_sigma;
  of.blur = blur_of_grid(g, &p->blurs);
  of.most_peak = g == 0 ? p->bright_peak : INFINITY;
  return of;
}

// The part of the picture, without its guard band, in a tile, of pixels from its corner; the pixel
// next to it where there is none.
typedef struct PictureInTile {
  float x0, x1, y0, y1;
} PictureInTile;

INLINED PictureInTile picture_in_tile(__global const Grid* grid, int column, int row) {
  const int x = grid->first_x + column * TILE_WIDTH, y = grid->first_y + row * TILE_HEIGHT;
  const float last_x = TILE_WIDTH - 1, last_y = TILE_HEIGHT - 1;
  PictureInTile part;
  part.x0 = smaller(larger((float)(grid->guard - x), 0.0f), last_x);
  part.x1 = smaller(larger((float)(grid->width - grid->guard - 1 - x), 0.0f), last_x);
  part.y0 = smaller(larger((float)(grid->guard - y), 0.0f), last_y);
  part.y1 = smaller(larger((float)(grid->height - grid->guard - 1 - y), 0.0f), last_y);
  return part;
}

// Of splats: where they are in the tile, their octave of widths here, and what limits their errors.
typedef struct MeasuredLanes {
  INTEGER counts_here;
  INTEGER pixel;  // that of the center, or the tile's nearest
  INTEGER octave;
  VALUE peak, width2;
  VALUE ending;  // the peak, or 0 of a stencil, which leaves nothing out
} MeasuredLanes;

// The same of one.
typedef struct Measured {
  int pixel, octave;
  float peak, width2, ending;
} Measured;

INLINED Measured one_of(const MeasuredLanes* lanes, uint k) {
  const Measured one = {integer_of(lanes->pixel, k), integer_of(lanes->octave, k),
                        value_of(lanes->peak, k), value_of(lanes->width2, k),
                        value_of(lanes->ending, k)};
  return one;
}

// The square of the width along an axis of which means or center values were drawn.
INLINED VALUE without_widening(VALUE sigma2, INTEGER by_mean, const CertifyParameters* p) {
  return choose(larger_of(sigma2 - p->widening, (VALUE)(0.0f)), sigma2, by_mean);
}

INLINED MeasuredLanes measured(__global const TileSplat* s, const CertifyParameters* p,
                               const GridOfCells grid, const Reach reach) {
  const EntryLanes entry = load_entries(s);
  const VALUE x = entry.x, y = entry.y, drawn_sigma = entry.sigma, sigma = fabs(drawn_sigma);
  const INTEGER is_stencil = (drawn_sigma < 0.0f) & (INTEGER)(grid.blur > 0.0f ? -1 : 0);
  const INTEGER by_mean = (drawn_sigma < grid.mean_sigma) & (is_stencil == 0);
  const VALUE sigma2 = sigma * sigma;
#if ELLIPSES
  // Such pictures have no coarse grids. The octave is to be the one that the projection took.
  const VALUE drawn_x = OF_ENTRIES(s, along_x.sigma), sigma_x = fabs(drawn_x);
  const VALUE area = sigma * sigma_x;
  const VALUE of_y2 = without_widening(sigma2, by_mean, p);
  const VALUE of_x2 = without_widening(sigma_x * sigma_x, drawn_x < grid.mean_sigma, p);
  const VALUE width2 = larger_of(of_y2, sqrt(of_y2 * of_x2)) + p->widening;
#else
  const VALUE area = sigma2;
  const VALUE lacking = choose((VALUE)(grid.blur), (VALUE)(p->widening), by_mean);
  const VALUE width2 = area + choose(lacking, (VALUE)(0.0f), is_stencil);
#endif
  MeasuredLanes m;
  m.counts_here = (x >= reach.x0) & (x < reach.x1) & (y >= reach.y0) & (y < reach.y1);
  m.pixel = pixel_numbers(pixel_of(x + 0.5f * TILE_WIDTH, TILE_WIDTH - 1),
                          pixel_of(y + 0.5f * TILE_HEIGHT, TILE_HEIGHT - 1));
  // The flux, not the peak, limits what a splat below a pixel does to a pixel.
  const VALUE flux = smaller_of(3.15f * area, (VALUE)(1.0f));
  m.peak = amplitudes_of(s, p->light_behind) * choose((VALUE)(1.0f), flux, by_mean);
  m.width2 = width2;
  // On a grid that is blurred a splat is drawn narrower and brighter than it is in the picture, and
  // what it leaves out is spread as well (docs/dev/accuracy.md, "Checked after drawing").
  if (grid.blur > 0.0f) m.peak *= area / m.width2;
  m.ending = choose(m.peak, (VALUE)(0.0f), is_stencil);
  const INTEGER octave = (((AS_INTEGER(m.width2) >> 23) - 127) >> 1) + 1;
  const INTEGER at_least = octave < 0 ? (INTEGER)(0) : octave;
  m.octave = at_least >= WIDTH_OCTAVES ? (INTEGER)(WIDTH_OCTAVES - 1) : at_least;
  return m;
}

INLINED int octave_in_picture(int octave, int level) {
  return octave + level < WIDTH_OCTAVES ? octave + level : WIDTH_OCTAVES - 1;
}

// What a splat adds to two of its tile's cells.
typedef struct Contribution {
  uint peak_cell, ending_cell;
  float peak, ending;
} Contribution;

// Hardly any splats are only listed. What they leave out is left out at the picture's edge.
INLINED Contribution contribution_of_listed(__global const TileSplat* splat, const Measured m,
                                            const CertifyParameters* p, int level,
                                            __global const Grid* grid, int column, int row) {
  const PictureInTile part = picture_in_tile(grid, column, row);
  const uint pixel =
      (uint)pixel_number(nearest_pixel(splat->x + 0.5f * TILE_WIDTH, part.x0, part.x1),
                         nearest_pixel(splat->y + 0.5f * TILE_HEIGHT, part.y0, part.y1));
  Contribution added;
  added.peak_cell = cell_of(&p->peaks[m.octave], pixel);
  added.peak = smaller(m.peak, p->bright_peak);
  added.ending_cell = cell_of(&p->endings[m.octave], pixel);
  added.ending =
      listed_ending(splat, p, p->extent2[octave_in_picture(m.octave, level)], m.peak, m.width2);
  return added;
}

INLINED Contribution contribution_of_drawn(const Measured m, float most_peak,
                                           const CertifyParameters* p) {
  Contribution added;
  added.peak_cell = cell_of(&p->peaks[m.octave], (uint)m.pixel);
  added.peak = smaller(m.peak, most_peak);
  added.ending_cell = cell_of(&p->endings[m.octave], (uint)m.pixel);
  added.ending = m.ending;
  return added;
}

// Of one whose peak is above edge_peak.
INLINED Contribution contribution_of_bright(const Measured m, float radius, float most_peak,
                                            const CertifyParameters* p, int level) {
  const int as_far = octave_of_ending(radius - 0.5f, m.octave, level, p);
  const float part = as_far == m.octave ? 1.0f
                                        : exp(p->extent2[octave_in_picture(as_far, level)] -
                                              p->extent2[octave_in_picture(m.octave, level)]);
  Contribution added = contribution_of_drawn(m, most_peak, p);
  added.ending_cell = cell_of(&p->endings[as_far], (uint)m.pixel);
  added.ending = m.ending > 0.0f ? p->edge_peak * part : 0.0f;
  return added;
}
