// Where splats are, how bright, and what they leave out where they end: sums over all of them,
// from the lists that were drawn.

// Comparisons, since min, max and clamp are calls on PoCL.
static inline float smaller(float a, float b) {
  return a < b ? a : b;
}
static inline float larger(float a, float b) {
  return a > b ? a : b;
}
static inline float largest(__global const float* values) {
  return larger(values[0], larger(values[1], values[2]));
}

// The brightest channel at the splat's center.
static inline float amplitude_of(__global const TileSplat* splat, float light_behind) {
#ifdef LIGHT_ORDERED
  return larger(largest(splat->emission), light_behind * largest(splat->absorption));
#else
  return largest(splat->summed);
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

INLINED uint cell_at(const OctaveCells cells, int x, int y) {
  return cells.first + (uint)(y >> cells.shift) * (uint)(TILE_WIDTH >> cells.shift) +
         (uint)(x >> cells.shift);
}

static inline int nearest_pixel(float center, float first, float last) {
  return (int)smaller(larger(center, first), last);
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

// What its splats share of a grid. Blurred grids come in pairs (splat.h).
typedef struct GridOfCells {
  int level;
  float mean_sigma;
  float blur;       // what the square of the width drawn lacks to that of the picture
  float most_peak;  // no more than this counts of a peak
} GridOfCells;

INLINED GridOfCells grid_of_cells(const CertifyParameters* p, uint g, const Grid grid) {
  GridOfCells of;
  of.level = (int)(p->blur[0] > 0.0f ? (g + 1) >> 1 : g);
  of.mean_sigma = grid.mean_sigma;
  of.blur = g == 0 ? 0.0f : p->blur[(g & 1) == 0];
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

// Of a splat: its octave of widths here, and of that in the picture; what limits its errors.
typedef struct Collected {
  int octave, in_picture;
  float peak, width2;
} Collected;

INLINED Collected measured(__global const TileSplat* splat, const CertifyParameters* p,
                           const GridOfCells grid) {
  const float sigma = fabs(splat->sigma), sigma_x = fabs(SIGMA_X(*splat));
  const int by_mean = splat->sigma < grid.mean_sigma;
  const float area = sigma * sigma_x, flux = 3.15f * area;
  Collected c;
  // The flux, not the peak, limits what a splat below a pixel does to a pixel.
  c.peak = amplitude_of(splat, p->light_behind) * (by_mean && flux < 1.0f ? flux : 1.0f);
  c.width2 = larger(sigma * sigma, area) + (by_mean ? p->widening : grid.blur);
  const int power = ((as_int(c.width2) >> 23) - 127) >> 1;
  c.octave = power < -1 ? 0 : power > WIDTH_OCTAVES - 2 ? WIDTH_OCTAVES - 1 : power + 1;
  c.in_picture = c.octave + grid.level < WIDTH_OCTAVES ? c.octave + grid.level : WIDTH_OCTAVES - 1;
  return c;
}

// What a splat adds to two of its tile's cells.
typedef struct Contribution {
  uint peak_cell, ending_cell;
  float peak, ending;
} Contribution;

// Hardly any splats are only listed. What they leave out is left out at the picture's edge.
INLINED Contribution contribution_of_listed(__global const TileSplat* splat, const Collected* c,
                                            const CertifyParameters* p, __global const Grid* grid,
                                            int column, int row) {
  const PictureInTile part = picture_in_tile(grid, column, row);
  const int x = nearest_pixel(splat->x + 0.5f * TILE_WIDTH, part.x0, part.x1);
  const int y = nearest_pixel(splat->y + 0.5f * TILE_HEIGHT, part.y0, part.y1);
  Contribution added;
  added.peak_cell = cell_at(p->peaks[c->octave], x, y);
  added.peak = smaller(c->peak, p->bright_peak);
  added.ending_cell = cell_at(p->endings[c->octave], x, y);
  added.ending = listed_ending(splat, p, p->extent2[c->in_picture], c->peak, c->width2);
  return added;
}

INLINED Contribution contribution_of_drawn(__global const TileSplat* splat, const Collected c,
                                           const CertifyParameters* p, int level, float most_peak) {
  const int x = nearest_pixel(splat->x + 0.5f * TILE_WIDTH, 0.0f, (float)(TILE_WIDTH - 1));
  const int y = nearest_pixel(splat->y + 0.5f * TILE_HEIGHT, 0.0f, (float)(TILE_HEIGHT - 1));
  Contribution added;
  added.peak_cell = cell_at(p->peaks[c.octave], x, y);
  added.peak = smaller(c.peak, most_peak);
  if (c.peak <= p->edge_peak) {
    added.ending_cell = cell_at(p->endings[c.octave], x, y);
    added.ending = c.peak;
    return added;
  }
  const int as_far = octave_of_ending(splat->radius - 0.5f, c.octave, level, p);
  const int of_ending = as_far + level < WIDTH_OCTAVES ? as_far + level : WIDTH_OCTAVES - 1;
  const float part =
      as_far == c.octave ? 1.0f : exp(p->extent2[of_ending] - p->extent2[c.in_picture]);
  added.ending_cell = cell_at(p->endings[as_far], x, y);
  added.ending = p->edge_peak * part;
  return added;
}

INLINED int counts_here(__global const TileSplat* splat, const Reach reach) {
  return splat->x >= reach.x0 && splat->x < reach.x1 && splat->y >= reach.y0 && splat->y < reach.y1;
}
