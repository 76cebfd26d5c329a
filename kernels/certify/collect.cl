// The sums of collected.cl: one work-item takes all of a tile's list, in order.

INLINED void add(const Contribution added, __global float* cells) {
  cells[added.peak_cell] += added.peak;
  cells[added.ending_cell] += added.ending;
}

// A call: hardly any splats are only listed.
__attribute__((noinline)) static void collect_listed(__global const TileSplat* splat,
                                                     const Collected* c, const CertifyParameters* p,
                                                     __global const Grid* grid, int column, int row,
                                                     __global float* cells) {
  add(contribution_of_listed(splat, c, p, grid, column, row), cells);
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
  const uint in_grid = tile - grid.first_tile;
  const int column = (int)(in_grid % (uint)grid.tiles_x), row = (int)(in_grid / (uint)grid.tiles_x);
  const Reach reach = reach_of(grid, column, row);
  const GridOfCells of_grid = grid_of_cells(&p, g, grid);
  __global float* own_cells = cells + (size_t)tile * p.cells_per_tile;
  for (uint s = id; s < p.segment_count && segments[s].tile == tile; ++s) {
    own_cells[p.listed] += (float)(segments[s].end - segments[s].begin);
    for (uint k = segments[s].begin; k < segments[s].end; ++k) {
      __global const TileSplat* splat = entries + k;
      if (splat->radius < 0.0f) {
        const Collected listed = measured(splat, &p, of_grid);
        collect_listed(splat, &listed, &p, grids + g, column, row, own_cells);
      } else if (counts_here(splat, reach)) {
        const Collected drawn = measured(splat, &p, of_grid);
        add(contribution_of_drawn(splat, drawn, &p, of_grid.level, of_grid.most_peak), own_cells);
      }
    }
  }
}
