// Where splats are, how bright, and what they leave out where they end: sums over all of them,
// from the lists that were drawn. One work-item takes all of a tile's list, in order.

// Comparisons, since min, max and clamp are calls on PoCL.
inline float smaller(float a, float b) {
  return a < b ? a : b;
}
inline float larger(float a, float b) {
  return a > b ? a : b;
}
inline float largest(__global const float* values) {
  return larger(values[0], larger(values[1], values[2]));
}

// The brightest channel at the splat's center.
inline float amplitude_of(__global const TileSplat* splat) {
#ifdef LIGHT_ORDERED
  return larger(largest(splat->emission), largest(splat->absorption));
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

inline Reach reach_of(const Grid grid, int column, int row) {
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

inline int nearest_pixel(float center, float last) {
  return (int)smaller(larger(center, 0.0f), last);
}

// What the splat leaves out, as a peak of a splat that ends where others of its octave do: what it
// has fallen to where it ends. One that is only listed stands for all that it would have added,
// which is no more than what it has fallen to at the picture's edge.
INLINED float ending_peak(__global const TileSplat* splat, const CertifyParameters* p,
                          float extent2, float peak, float width2) {
  const float most = smaller(peak, p->edge_peak);
  if (splat->radius >= 0.0f) return most;
  const float beyond = larger(-splat->radius - 1.0f, 0.0f);
  return smaller(most, peak * exp(extent2 - beyond * beyond / width2));
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

INLINED void collect_splat(__global const TileSplat* splat, const CertifyParameters* p,
                           const GridOfCells grid, __global float* cells) {
  const float sigma = fabs(splat->sigma), sigma_x = fabs(SIGMA_X(*splat));
  const int by_mean = splat->sigma < grid.mean_sigma;
  const float area = sigma * sigma_x, flux = 3.15f * area;
  // The flux, not the peak, limits what a splat below a pixel does to a pixel.
  const float peak = amplitude_of(splat) * (by_mean && flux < 1.0f ? flux : 1.0f);
  const float width2 = larger(sigma * sigma, area) + (by_mean ? p->widening : grid.blur);
  const int power = ((as_int(width2) >> 23) - 127) >> 1;
  const int octave = power < -1 ? 0 : power > WIDTH_OCTAVES - 2 ? WIDTH_OCTAVES - 1 : power + 1;
  const int in_picture =
      octave + grid.level < WIDTH_OCTAVES ? octave + grid.level : WIDTH_OCTAVES - 1;
  const int x = nearest_pixel(splat->x + 0.5f * TILE_WIDTH, (float)(TILE_WIDTH - 1));
  const int y = nearest_pixel(splat->y + 0.5f * TILE_HEIGHT, (float)(TILE_HEIGHT - 1));
  cells[cell_at(p->peaks[octave], x, y)] += smaller(peak, grid.most_peak);
  cells[cell_at(p->endings[octave], x, y)] +=
      ending_peak(splat, p, p->extent2[in_picture], peak, width2);
}

// The cells of each tile one after the other.
__kernel void collect(const CertifyParameters p, __global const Grid* grids,
                      __global const Segment* segments, __global const TileSplat* entries,
                      __global float* cells) {
  const uint id = get_global_id(0);
  if (id >= p.segment_count) return;
  const uint tile = segments[id].tile;
  if (id > 0 && segments[id - 1].tile == tile) return;
  const uint g = grid_of_tile(grids, p.grid_count, tile);
  const Grid grid = grids[g];
  const GridOfCells of_grid = grid_of_cells(&p, g, grid);
  const uint in_grid = tile - grid.first_tile;
  const Reach reach =
      reach_of(grid, (int)(in_grid % (uint)grid.tiles_x), (int)(in_grid / (uint)grid.tiles_x));
  __global float* own_cells = cells + (size_t)tile * p.cells_per_tile;
  for (uint s = id; s < p.segment_count && segments[s].tile == tile; ++s) {
    own_cells[p.listed] += (float)(segments[s].end - segments[s].begin);
    for (uint k = segments[s].begin; k < segments[s].end; ++k) {
      __global const TileSplat* splat = entries + k;
      if (splat->radius < 0.0f || (splat->x >= reach.x0 && splat->x < reach.x1 &&
                                   splat->y >= reach.y0 && splat->y < reach.y1)) {
        collect_splat(splat, &p, of_grid, own_cells);
      }
    }
  }
}
