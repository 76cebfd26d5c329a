// Compositing for processors with wide registers: a work-item takes a segment of one
// tile's list and updates rows of eight pixels in a private copy of the tile.

// Sums of light, of which there are three, begin with nothing in every list and are added to what
// is there when they are stored: however many splats there are, those of one list only are added to
// a sum that is much larger than they are.
#ifdef LIGHT_ORDERED
#define SUMS 3
#else
#define SUMS PLANES
#endif

static inline void clear_planes(float* tile) {
#pragma unroll 8
  for (int i = 0; i < PLANES * TILE_PIXELS; i += PATCH_WIDTH)
    store_patch((PATCH)(0.0f), tile + i);
}

// Where a row of a tile with this corner begins.
static inline size_t row_of_tile(const Grid grid, size_t corner, int plane, int y) {
  return corner + (size_t)plane * grid.plane_size + (size_t)y * grid.stride;
}

#ifdef LIGHT_ORDERED
static inline void load_opacities(float* tile, __global const float* planes, const Grid grid,
                                  size_t corner) {
  for (int c = SUMS; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global const float* row = planes + row_of_tile(grid, corner, c, y);
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        store_eight(load_global_eight(row + x), tile + c * TILE_PIXELS + y * ROW + x);
      }
    }
  }
}
#endif

// A tile's rows lie all over the planes: what is stored at the end is asked for while its splats
// are drawn, so many rows with each of them that no more are under way at a time than a processor
// keeps track of.
#define ROWS_OF_TILE (PLANES * TILE_HEIGHT)
static inline void ask_for_rows(__global float* planes, const Grid grid, size_t corner, int first,
                                int count) {
  for (int row = first; row < min(first + count, ROWS_OF_TILE); ++row) {
    __global const float* begin =
        planes + row_of_tile(grid, corner, row / TILE_HEIGHT, row % TILE_HEIGHT);
    for (int x = 0; x < TILE_WIDTH; x += NUMBERS_OF_LINE)
      ask_to_write(begin + x);
  }
}

static inline void store_tile(const float* tile, __global float* planes, const Grid grid,
                              size_t corner) {
  for (int c = 0; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global float* row = planes + row_of_tile(grid, corner, c, y);
#pragma unroll
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        const float8 drawn = load_eight(tile + c * TILE_PIXELS + y * ROW + x);
        store_global_eight(c < SUMS ? load_global_eight(row + x) + drawn : drawn, row + x);
      }
    }
  }
}

#ifdef SPLATS_OF_BLOCK
// Equal splats err by equal roundings, up to half of one each, and a layer that is thinner than
// half a rounding of the opacity in front of it adds light, but no opacity. Drawn by themselves in
// blocks of so many, n of them err by as many roundings and one for each block, not by n. Leaves
// nothing in the block.
#ifdef LIGHT_ORDERED
static inline void add_block(float* block, float* front) {
  for (int i = 0; i < SUMS * TILE_PIXELS; i += PATCH_WIDTH) {
    const PATCH opacity = load_patch(front + SUMS * TILE_PIXELS + i);
    const PATCH behind = load_patch(block + SUMS * TILE_PIXELS + i);
    const PATCH t = transmittance_of(opacity);
    store_patch(load_patch(front + i) + t * load_patch(block + i), front + i);
    store_patch(carry_behind(opacity, t, behind), front + SUMS * TILE_PIXELS + i);
    store_patch((PATCH)(0.0f), block + i);
    store_patch((PATCH)(0.0f), block + SUMS * TILE_PIXELS + i);
  }
}

// The same of a list's only block, whose front is what is in the planes.
static inline void add_block_to_planes(const float* block, __global float* planes, const Grid grid,
                                       size_t corner) {
  for (int c = 0; c < SUMS; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      __global float* light = planes + row_of_tile(grid, corner, c, y);
      __global float* opacities = planes + row_of_tile(grid, corner, SUMS + c, y);
      const float* drawn = block + c * TILE_PIXELS + y * ROW;
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        const float8 opacity = load_global_eight(opacities + x);
        const float8 behind = load_eight(drawn + SUMS * TILE_PIXELS + x);
        const float8 t = transmittance_of(opacity);
        store_global_eight(load_global_eight(light + x) + t * load_eight(drawn + x), light + x);
        store_global_eight(carry_behind(opacity, t, behind), opacities + x);
      }
    }
  }
}
#else
static inline void add_block(float* block, float* front) {
  for (int i = 0; i < SUMS * TILE_PIXELS; i += PATCH_WIDTH) {
    store_patch(load_patch(front + i) + load_patch(block + i), front + i);
    store_patch((PATCH)(0.0f), block + i);
  }
}
#endif
#endif

static inline void store_partial(const float* tile, __global float* partial) {
  for (int c = 0; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        store_global_eight(load_eight(tile + c * TILE_PIXELS + y * ROW + x),
                           partial + (c * TILE_HEIGHT + y) * TILE_WIDTH + x);
      }
    }
  }
}

INLINED void store_segment(const float* drawn, const Segment segment, __global float* planes,
                           __global float* partials, const Grid grid, size_t corner) {
  if (segment.partial == NO_PARTIAL) {
    store_tile(drawn, planes, grid, corner);
  } else {
    store_partial(drawn, partials + (size_t)segment.partial * PLANES * TILE_WIDTH * TILE_HEIGHT);
  }
}

#ifdef CLOUDS_IN_LISTS
#define CLOUD_ROWS(CHANNELS)                                     \
  for (int y = 0; y < TILE_HEIGHT; ++y) {                        \
    for (int x = 0; x < TILE_WIDTH; x += 8) {                    \
      const float8 shape = column_of_cloud(cloud, clouds, x, y); \
      if (!any(shape > 0.0f)) continue;                          \
      float* pixel = tile + y * ROW + x;                         \
      CHANNELS                                                   \
    }                                                            \
  }

// A call: hardly any entries are clouds. Whether it touches the tile.
__attribute__((noinline)) static int add_cloud(float* tile, __global const CloudEntry* cloud,
                                               const TileClouds* clouds, float* depth_of_block,
                                               const CompositeParameters* p) {
  if (!cloud_touches(cloud, clouds)) return 0;
  const float8 absorption0 = cloud->absorption[0], emission0 = cloud->emission[0];
  const float8 absorption1 = cloud->absorption[1], emission1 = cloud->emission[1];
  const float8 absorption2 = cloud->absorption[2], emission2 = cloud->emission[2];
  *depth_of_block += cloud->deepest;
  const int form = form_of_layer(cloud->deepest, *depth_of_block, p);
  if (form <= BY_THREE_TERMS) {
    CLOUD_ROWS(THIN_LAYER(COVERED_BY_THREE_TERMS))
  } else if (form == BY_SERIES) {
    CLOUD_ROWS(LAYER_CHANNELS(phi_series, passed_by_series))
  } else {
    CLOUD_ROWS(LAYER_CHANNELS(phi_full, passed_in_full))
  }
  return 1;
}
#endif

#ifdef LIGHT_ORDERED
// Nothing behind shows any more: every channel of every pixel of the block behind the front is
// opaque enough. The front is what is in the planes where it is null. The first row that is not
// opaque says so of the tile.
static inline int is_opaque(const float* front, __global const float* planes, const Grid grid,
                            size_t corner, const float* block, float stop) {
  for (int c = SUMS; c < PLANES; ++c) {
    for (int y = 0; y < TILE_HEIGHT; ++y) {
      const int row = c * TILE_PIXELS + y * ROW;
      __global const float* row_of_planes = planes + row_of_tile(grid, corner, c, y);
      float8 most = (float8)(0.0f);
      for (int x = 0; x < TILE_WIDTH; x += 8) {
        const float8 opacity =
            front ? load_eight(front + row + x) : load_global_eight(row_of_planes + x);
        most = max(most, transmittance_of(opacity) * transmittance_of(load_eight(block + row + x)));
      }
      const float4 four = max(most.lo, most.hi);
      const float2 two = max(four.lo, four.hi);
      if (!(max(two.x, two.y) <= stop)) return 0;
    }
  }
  return 1;
}
#endif

#ifdef STENCILS
#define STENCIL_BATCH_PARAMETERS , __global const Stencil *stencil, StencilBatch *batch
#define STENCIL_BATCH_ARGUMENTS , stencil, &stencil_batch
#else
#define STENCIL_BATCH_PARAMETERS
#define STENCIL_BATCH_ARGUMENTS
#endif

// Adds the entry if it is one whose window was found with those of its batch.
INLINED int add_small_splat(float* tile, __global const TileSplat* entry, int in_batch,
                            const EntryWindows* windows STENCIL_BATCH_PARAMETERS) {
#ifdef NARROW_SPLATS
  if (windows->pixels[in_batch] != 0) {
    add_narrow_splat(tile, windows, in_batch, entry);
    return 1;
  }
#endif
#ifdef STENCILS
  if (stencil && entry->sigma < 0.0f) {
    add_stencil(tile, batch, in_batch, entry, stencil);
    return 1;
  }
#endif
  return 0;
}

#define ENTRIES_AHEAD 32

// A call: of a kernel itself PoCL makes three copies. Its last argument tells the compiler that it
// may use registers of sixteen floats (lanes.cl).
__attribute__((noinline)) static void composite_segment(
    const Segment segment, const CompositeParameters* parameters, __global const Grid* grids,
    __global const TileSplat* entries, __global float* planes,
    __global float* partials CLOUDS_PARAMETERS STENCIL_PARAMETERS, PATCH lanes) {
  const CompositeParameters p = *parameters;
  const uint grid_number = grid_of_tile(grids, p.grid_count, segment.tile);
  const Grid grid = grids[grid_number];
  const uint in_grid = segment.tile - grid.first_tile;
  const size_t corner = first_float(grid) +
                        (size_t)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT * grid.stride +
                        (size_t)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH;
  float memory_of_tile[BEFORE_TILE + PLANES * TILE_PIXELS] __attribute__((aligned(64)));
  float* const tile = memory_of_tile + BEFORE_TILE;
  clear_planes(tile);
#ifdef SPLATS_OF_BLOCK
  float front[PLANES * TILE_PIXELS];
#endif
#ifdef LIGHT_ORDERED
  // Most lists of a large frame's many chunks: they need no front of their own.
  const int is_one_block =
      segment.partial == NO_PARTIAL && segment.end - segment.begin < SPLATS_OF_BLOCK;
  if (!is_one_block) clear_planes(front);
#elif defined(SPLATS_OF_BLOCK)
  clear_planes(front);
#endif
#ifdef CLOUDS_IN_LISTS
  const TileClouds of_tile =
      clouds_of_tile(clouds, cloud_splats, directions, cones, grid, segment.tile);
#endif
  const int rows_at_a_time = ROWS_OF_TILE / (int)(segment.end - segment.begin) + 1;
  int asked = segment.partial == NO_PARTIAL ? 0 : ROWS_OF_TILE;
  const SplatTile tile_of_splats = splat_tile(grid, segment.tile, &p);
  uint drawn = 0, end = segment.end;
  float depth_of_block = 0.0f;
#ifdef LIGHT_ORDERED
  if (segment.partial == NO_PARTIAL && !is_one_block) load_opacities(front, planes, grid, corner);
  const float* const own_front = is_one_block ? 0 : front;
  if (is_opaque(own_front, planes, grid, corner, tile, p.stop)) end = segment.begin;
#endif
#ifdef STENCILS
  __global const Stencil* const stencil = stencil_of_grid(stencils, grid_number);
  StencilBatch stencil_batch;
  clear_stencils(&stencil_batch);
#endif
  WaitingSplats waiting;
  clear_waiting(&waiting);
  EntryWindows windows;
  for (uint k = segment.begin; k < end; ++k) {
    const int in_batch = (int)((k - segment.begin) % LANES);
    if (in_batch == 0) ask_for_entries(entries + k + ENTRIES_AHEAD);
#ifdef STENCILS
    if (in_batch == 0 && stencil) {
      find_stencils(entries + k, stencil, &stencil_batch);
      if (k + LANES <= end && are_all_stencils(entries + k)) {
        ask_for_rows(planes, grid, corner, asked, LANES * rows_at_a_time);
        asked += LANES * rows_at_a_time;
        for (int i = 0; i < LANES; ++i)
          add_stencil(tile, &stencil_batch, i, entries + k + i, stencil);
        k += LANES - 1;
        continue;
      }
    }
#endif
    if (in_batch == 0) {
      find_windows(entries + k, &windows);
#ifdef NARROW_SPLATS
      find_narrow_splats(entries + k, grid.mean_sigma, &windows);
#endif
    }
    const int2 rows = rows_of_entry(&windows, in_batch);
    const int2 columns = columns_of_entry(&windows, in_batch);
    if (asked < ROWS_OF_TILE) {
      ask_for_rows(planes, grid, corner, asked, rows_at_a_time);
      asked += rows_at_a_time;
    }
#ifdef CLOUDS_IN_LISTS
    const float sigma = entries[k].sigma;
    if (is_cloud(sigma)) {
      add_waiting(tile, &waiting, grid.mean_sigma);
      if (!add_cloud(tile, cloud_of(sigma, &of_tile), &of_tile, &depth_of_block, &p)) continue;
    } else
#endif
    {
      // Lists have splats that do not touch the tile, too (splat.h), and those of a crop other
      // ones.
      if (rows.x > rows.y || columns.x > columns.y) continue;
      if (!add_small_splat(tile, entries + k, in_batch, &windows STENCIL_BATCH_ARGUMENTS)) {
        const int form = form_of_splat(entries + k, &tile_of_splats, &depth_of_block, &p);
        if (!let_wait(tile, &waiting, rows, columns, entries + k, grid.mean_sigma, form))
          add_splat(tile, entries + k, rows, columns, &tile_of_splats, form);
      }
    }
    ++drawn;
#ifdef LIGHT_ORDERED
    if (drawn % 256u == 0u) {
      add_waiting(tile, &waiting, grid.mean_sigma);
      if (is_opaque(own_front, planes, grid, corner, tile, p.stop)) break;
    }
#endif
#ifdef SPLATS_OF_BLOCK
    if (drawn % SPLATS_OF_BLOCK == 0u) {
      add_waiting(tile, &waiting, grid.mean_sigma);
      add_block(tile, front);
      depth_of_block = 0.0f;
    }
#endif
  }
  add_waiting(tile, &waiting, grid.mean_sigma);
#ifdef LIGHT_ORDERED
  if (is_one_block) {
    add_block_to_planes(tile, planes, grid, corner);
    return;
  }
#endif
#ifdef SPLATS_OF_BLOCK
  add_block(tile, front);
  store_segment(front, segment, planes, partials, grid, corner);
#else
  store_segment(tile, segment, planes, partials, grid, corner);
#endif
}

__kernel void composite(const CompositeParameters p, __global const Grid* grids,
                        __global const Segment* segments, __global const TileSplat* entries,
                        __global float* planes,
                        __global float* partials CLOUDS_PARAMETERS STENCIL_PARAMETERS) {
  const uint piece = piece_of_item(p.end_segment - p.first_segment);
  if (piece == NO_PIECE) return;
  composite_segment(segments[p.first_segment + piece], &p, grids, entries, planes,
                    partials CLOUDS_ARGUMENTS STENCIL_ARGUMENTS, PATCH_LANES);
}
