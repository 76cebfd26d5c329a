// The sums of collected.cl: one work-item takes all of a tile's list, in order.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/certify/certify.h"
#include "kernels/certify/collected.cl"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"

// What work-items know of their tile.
typedef struct TileOfCells {
  __global const Grid* grid;
  int column, row;
  GridOfCells of_grid;
  Reach reach;
  __global float* cells;
} TileOfCells;

INLINED void add(const Contribution added, __global float* cells) {
  cells[added.peak_cell] += added.peak;
  cells[added.ending_cell] += added.ending;
}

// A call: of most batches no splat is bright or only listed.
__attribute__((noinline)) static void add_one_by_one(__global const TileSplat* entries,
                                                     const MeasuredLanes* batch, int count,
                                                     const TileOfCells* tile,
                                                     const CertifyParameters* p) {
  const GridOfCells of_grid = tile->of_grid;
  for (int i = 0; i < count; ++i) {
    __global const TileSplat* splat = entries + i;
    const Measured m = one_of(batch, i);
    if (splat->radius < 0.0f) {
      add(contribution_of_listed(splat, m, p, of_grid.level, tile->grid, tile->column, tile->row),
          tile->cells);
    } else if (integer_of(batch->counts_here, i) && m.peak > p->edge_peak) {
      add(contribution_of_bright(m, splat->radius, of_grid.most_peak, p, of_grid.level),
          tile->cells);
    } else if (integer_of(batch->counts_here, i)) {
      add(contribution_of_drawn(m, of_grid.most_peak, p), tile->cells);
    }
  }
}

// A batch takes less than memory does to answer.
#define ENTRIES_AHEAD 64

INLINED void collect_batch(__global const TileSplat* entries, int count, const TileOfCells* tile,
                           const CertifyParameters* p) {
  MeasuredLanes m = measured(entries, p, tile->of_grid, tile->reach);
  const INTEGER is_there = NUMBERS_OF_LANES < count;
  const INTEGER is_listed = (OF_ENTRIES(entries, radius) < 0.0f) & is_there;
  m.counts_here &= is_there;
  if (ANY(is_listed | (m.counts_here & (m.peak > p->edge_peak)))) {
    add_one_by_one(entries, &m, count, tile, p);
    return;
  }
  // Those that do not count add nothing, which takes less than to leave them out.
  const VALUE peak = smaller_of(m.peak, (VALUE)(tile->of_grid.most_peak));
  m.peak = choose((VALUE)(0.0f), peak, m.counts_here);
  m.ending = choose((VALUE)(0.0f), m.ending, m.counts_here);
  for (int i = 0; i < LANES; ++i)
    add(contribution_of_drawn(one_of(&m, i), INFINITY, p), tile->cells);
}

// The entries of a tile whose first segment is `id`.
KERNEL_BODY void collect_tile(const CertifyParameters* of_frame, __global const Grid* grids,
                              __global const Segment* segments, __global const TileSplat* entries,
                              __global float* cells, uint id) {
  const CertifyParameters p = *of_frame;
  const uint number = segments[id].tile;
  const uint g = grid_of_tile(grids, p.grid_count, number);
  const Grid grid = grids[g];
  const uint in_grid = number - grid.first_tile;
  TileOfCells tile;
  tile.grid = grids + g;
  tile.column = (int)(in_grid % (uint)grid.tiles_x);
  tile.row = (int)(in_grid / (uint)grid.tiles_x);
  tile.of_grid = grid_of_cells(&p, g, grid);
  tile.reach = reach_of(grid, tile.column, tile.row);
  tile.cells = cells + (size_t)number * p.cells_per_tile;
  for (uint i = 0; i < p.cells_per_tile; i += NUMBERS_OF_LINE)
    ask_to_write(tile.cells + i);
  for (uint s = id; s < p.segment_count && segments[s].tile == number; ++s) {
    const uint end = segments[s].end;
    tile.cells[p.listed] += (float)(end - segments[s].begin);
    for (uint k = segments[s].begin; k < end; k += LANES) {
      ask_for_entries(entries + k + ENTRIES_AHEAD);
      collect_batch(entries + k, end - k < LANES ? (int)(end - k) : LANES, &tile, &p);
    }
  }
}

// The cells of each tile one after the other.
__kernel void collect(const CertifyParameters p, __global const Grid* grids,
                      __global const Segment* segments, __global const TileSplat* entries,
                      __global float* cells) {
  const uint id = piece_of_item(p.segment_count);
  if (id == NO_PIECE) return;
  if (id > 0 && segments[id - 1].tile == segments[id].tile) return;
  collect_tile(&p, grids, segments, entries, cells, id);
}
