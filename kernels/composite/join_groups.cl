// Joins the layers of a tile that was cut into segments, as join.cl does, for GPUs: a work-group
// per segment, of which the first of a tile joins them all, a work-item per pixel.
#define GROUP (TILE_WIDTH * TILE_HEIGHT)

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void join(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global float* planes, __global const float* partials) {
  const uint id = p.first_segment + get_group_id(0), pixel = get_local_id(0);
  const Segment first = segments[id];
  if (first.partial == NO_PARTIAL || (id > 0 && segments[id - 1].tile == first.tile)) return;
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, first.tile)];
  const uint in_grid = first.tile - grid.first_tile;
  const uint row = in_grid / (uint)grid.tiles_x * TILE_HEIGHT + pixel / TILE_WIDTH;
  const uint column = in_grid % (uint)grid.tiles_x * TILE_WIDTH + pixel % TILE_WIDTH;
  __global float* own = planes + first_float(grid) + (size_t)row * grid.stride + column;
  for (uint s = id; s < p.end_segment && segments[s].tile == first.tile; ++s) {
    join_pixels(own, grid.plane_size, partials + (size_t)segments[s].partial * PLANES * GROUP,
                pixel);
  }
}
