// The sums of collected.cl for GPUs: a work-group takes a segment of a tile's list. For a batch of
// splats at a time each work-item works out what one of them adds, and leaves a bit with the cells
// that it adds to; then each adds up some cells, in the order of the list. Segments of cut lists
// have cells of their own, which are joined in order.
#include "kernels/bin/bin.h"
#include "kernels/certify/certify.h"
#include "kernels/certify/collected.cl"
#include "kernels/common/common.cl"
#include "kernels/common/grid.cl"
#include "kernels/common/grid.h"
#include "kernels/common/group_sums.cl"

#define NO_CELL 0xffffffffu

// A word has so many bits.
#define SPLATS_OF_WORD 32
#define WORDS (GROUP_ITEMS / SPLATS_OF_WORD)

// Those of a tile (lay_out_cells) are no more than 3.5 bytes of floats for each pixel and one.
#define CELLS (TILE_WIDTH * TILE_HEIGHT * 7 / 8 + 1)
#define CELLS_OF_ITEM ((CELLS - 1) / GROUP_ITEMS + 1)

// What splats add to cells of peaks, and to cells of endings; for each cell the splats that add to
// it, a bit each.
typedef struct Contributions {
  float values[2][GROUP_ITEMS];
  uint of_cells[WORDS][CELLS];
} Contributions;

INLINED void leave_bit(__local Contributions* batch, uint item, uint cell) {
  if (cell < CELLS)
    atomic_or(&batch->of_cells[item / SPLATS_OF_WORD][cell], 1u << item % SPLATS_OF_WORD);
}

// What the batch adds to this cell after those before; its bits are 0 again afterwards.
INLINED float with_batch(float sum, __local Contributions* batch, uint kind, uint cell) {
  for (uint w = 0; w < WORDS; ++w) {
    uint bits = batch->of_cells[w][cell];
    if (bits != 0) batch->of_cells[w][cell] = 0;
    while (bits != 0) {
      sum += batch->values[kind][w * SPLATS_OF_WORD + 31u - clz(bits & -bits)];
      bits &= bits - 1u;
    }
  }
  return sum;
}

KERNEL_BODY Contribution contribution_of(__global const TileSplat* splat,
                                         const CertifyParameters* p, __global const Grid* grids,
                                         uint g, uint tile) {
  const Grid grid = grids[g];
  const uint in_grid = tile - grid.first_tile;
  const int column = (int)(in_grid % (uint)grid.tiles_x), row = (int)(in_grid / (uint)grid.tiles_x);
  const GridOfCells of_grid = grid_of_cells(p, g, grid);
  const MeasuredLanes lane = measured(splat, p, of_grid, reach_of(grid, column, row));
  const Measured m = one_of(&lane, 0);
  if (splat->radius < 0.0f)
    return contribution_of_listed(splat, m, p, of_grid.level, grids + g, column, row);
  if (lane.counts_here) {
    return m.peak > p->edge_peak
               ? contribution_of_bright(m, splat->radius, of_grid.most_peak, p, of_grid.level)
               : contribution_of_drawn(m, of_grid.most_peak, p);
  }
  Contribution none;
  none.peak_cell = none.ending_cell = NO_CELL;
  none.peak = none.ending = 0.0f;
  return none;
}

// Cells of peaks come first, then those of endings, then the one that counts the list.
__kernel OF_GROUPS void collect(const CertifyParameters p, __global const Grid* grids,
                                __global const Segment* segments, __global const TileSplat* entries,
                                __global float* cells, __global float* partial_cells) {
  __local Contributions batch;
  const uint item = get_local_id(0);
  const Segment segment = segments[get_group_id(0)];
  const uint g = grid_of_tile(grids, p.grid_count, segment.tile);
  const int is_cut = segment.partial != NO_PARTIAL;
  __global float* own = is_cut ? partial_cells + (size_t)segment.partial * p.cells_per_tile
                               : cells + (size_t)segment.tile * p.cells_per_tile;
  float sums[CELLS_OF_ITEM];
  for (uint i = 0; i < CELLS_OF_ITEM; ++i) {
    const uint cell = i * GROUP_ITEMS + item;
    sums[i] = cell < p.cells_per_tile && !is_cut ? own[cell] : 0.0f;
    if (cell == p.listed) sums[i] += (float)(segment.end - segment.begin);
    for (uint w = 0; w < WORDS && cell < CELLS; ++w)
      batch.of_cells[w][cell] = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint first = segment.begin; first < segment.end; first += GROUP_ITEMS) {
    const uint count = min((uint)GROUP_ITEMS, segment.end - first);
    if (item < count) {
      const Contribution added =
          contribution_of(entries + first + item, &p, grids, g, segment.tile);
      batch.values[0][item] = added.peak;
      batch.values[1][item] = added.ending;
      leave_bit(&batch, item, added.peak_cell);
      leave_bit(&batch, item, added.ending_cell);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = 0; i < CELLS_OF_ITEM; ++i) {
      const uint cell = i * GROUP_ITEMS + item;
      if (cell < CELLS)
        sums[i] = with_batch(sums[i], &batch, cell < p.endings[0].first ? 0 : 1, cell);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  for (uint i = 0; i < CELLS_OF_ITEM; ++i) {
    const uint cell = i * GROUP_ITEMS + item;
    if (cell < p.cells_per_tile) own[cell] = sums[i];
  }
}

__kernel OF_GROUPS void collect_segments(const CertifyParameters p,
                                         __global const Segment* segments, __global float* cells,
                                         __global const float* partial_cells) {
  const uint id = get_group_id(0);
  const Segment first = segments[id];
  if (first.partial == NO_PARTIAL || (id > 0 && segments[id - 1].tile == first.tile)) return;
  for (uint cell = get_local_id(0); cell < p.cells_per_tile; cell += GROUP_ITEMS) {
    __global float* own = cells + (size_t)first.tile * p.cells_per_tile + cell;
    float sum = *own;
    for (uint s = id; s < p.segment_count && segments[s].tile == first.tile; ++s)
      sum += partial_cells[(size_t)segments[s].partial * p.cells_per_tile + cell];
    *own = sum;
  }
}
