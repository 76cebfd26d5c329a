// Splats to lists per tile, in order: count, scan, scatter. A work-item walks one block of
// splats; block and tile fix where each entry goes, so lists keep the splats' order and
// never depend on timing.

// Those of a grid's tiles that are in memory.
INLINED int4 tiles_in_memory(int4 range, const Grid grid) {
  const int column = grid.first_x / TILE_WIDTH, row = grid.first_y / TILE_HEIGHT;
  const int4 part = (int4)(max(range.x, column), min(range.y, column + grid.tiles_x - 1),
                           max(range.z, row), min(range.w, row + grid.tiles_y - 1));
  return part.z > part.w ? (int4)(0, -1, 0, -1) : part;
}

// A splat that is only listed (splat.h) is so once, in the tile next to it.
INLINED float2 nearest_in_memory(float2 center, const Grid grid) {
  const float2 first = (float2)((float)grid.first_x, (float)grid.first_y);
  const float2 size =
      (float2)((float)(grid.tiles_x * TILE_WIDTH), (float)(grid.tiles_y * TILE_HEIGHT));
  return min(max(center, first + 0.5f), first + size - 0.5f);
}

// Tiles of its grid that a splat's square touches: x range in .x .y, y range in .z .w; an
// empty x range where there is none. With room for the rounding of the center; compositing knows it
// better. First pixels are turned round, so that first and last ones are found alike: the last
// whole number below, as floor() is a call on PoCL. Clamped before the conversion: a splat close to
// the camera may lie anywhere.
INLINED int4 tile_range(const Splat splat, const Grid grid) {
  const float unit = unit_of(splat, grid);
  float2 center = (float2)((float)splat.x, (float)splat.y) * unit +
                  (float2)((float)grid.middle_x, (float)grid.middle_y);
  float2 radius = (float2)(RADIUS_X(splat), splat.radius) + grid.room;
  if (splat.radius < 0.0f) {
    center = nearest_in_memory(center, grid);
    radius = (float2)(0.5f);
  }
  const float2 size = (float2)((float)grid.width, (float)grid.height);
  const float4 ends = (float4)(0.5f - center, center - 0.5f) + radius.xyxy;
  const float4 clamped =
      min(max(ends, (float4)(-size, -1.0f, -1.0f)), (float4)(0.0f, 0.0f, size - 1.0f));
  const int4 truncated = convert_int4(clamped);
  const int4 pixels = truncated + (convert_float4(truncated) > clamped);
  const int2 first = -pixels.xy, last = pixels.zw;
  if (first.x > last.x || first.y > last.y) return (int4)(0, -1, 0, -1);
  const int4 range = (int4)((uint)first.x / TILE_WIDTH, (uint)last.x / TILE_WIDTH,
                            (uint)first.y / TILE_HEIGHT, (uint)last.y / TILE_HEIGHT);
  return grid.is_part ? tiles_in_memory(range, grid) : range;
}

inline uint slots_end(const BinParameters p, __global const BlockCounts* blocks, uint block) {
  const uint begin = p.first + block * p.stride;
#ifdef BLOCKS_OF_PROJECTION
  // Blocks are the projection's: each fills only a part of its stride.
  return min(begin + p.length, block * p.stride + blocks[block].visible);
#else
  return min(begin + p.length, p.end);
#endif
}

#ifdef LIGHT_ORDERED
// Splats that will be needed soon: asked for early, they are there when they are. OpenCL's own
// prefetch() does nothing on PoCL.
#define SPLATS_AHEAD 16
#ifdef __clang__
#define ask_for(splat) __builtin_prefetch((const void*)(size_t)(splat))
#else
#define ask_for(splat)
#endif
#endif

// counts[block * tile_count + tile]. Splats in sorted order lie all over memory: they are
// fetched once, here, and kept in order for the scatter.
__kernel void bin_count(const BinParameters p, __global const Grid* grids,
                        __global const Splat* splats, __global const uint* order,
                        __global const BlockCounts* blocks, __global uint* counts,
                        __global Splat* in_order) {
  const uint block = get_global_id(0);
  __global uint* count = counts + (size_t)block * p.tile_count;
  for (uint t = 0; t < p.tile_count; ++t)
    count[t] = 0;
  const uint end = slots_end(p, blocks, block);
  for (uint slot = p.first + block * p.stride; slot < end; ++slot) {
#ifdef LIGHT_ORDERED
    ask_for(splats + order[min(slot + SPLATS_AHEAD, end - 1)]);
    const Splat splat = splats[order[slot]];
    in_order[slot - p.first] = splat;
#else
    const Splat splat = splats[slot];
#endif
    const Grid grid = grids[grid_of(splat)];
    const int4 range = tile_range(splat, grid);
    for (int ty = range.z; ty <= range.w; ++ty) {
      for (int tx = range.x; tx <= range.y; ++tx) {
        ++count[grid.corner_tile + (uint)(ty * grid.tiles_x + tx)];
      }
    }
  }
}

// Per tile, an exclusive scan over the blocks, in place, and the list's length.
__kernel void bin_scan_blocks(const BinParameters p, __global uint* counts,
                              __global uint* lengths) {
  const uint tile = get_global_id(0);
  if (tile >= p.tile_count) return;
  uint running = 0;
  for (uint b = 0; b < p.block_count; ++b) {
    const size_t place = (size_t)b * p.tile_count + tile;
    const uint count = counts[place];
    counts[place] = running;
    running += count;
  }
  lengths[tile] = running;
}

// Starts of the lists of a band of tiles, and the segments that long ones are cut into.
__kernel void bin_scan_tiles(const BinParameters p, __global const uint* lengths,
                             __global uint* starts, __global Segment* segments) {
  if (get_global_id(0) != 0) return;
  uint running = 0, segment_count = 0, partial_count = 0;
  for (uint t = p.first_tile; t < p.end_tile; ++t) {
    const uint length = lengths[t];
    starts[t] = running;
    const uint pieces = length / p.segment_length + (length % p.segment_length != 0);
    for (uint k = 0; k < pieces && segment_count < p.segment_capacity; ++k) {
      Segment segment;
      segment.tile = t;
      segment.begin = running + k * p.segment_length;
      segment.end = running + min((k + 1) * p.segment_length, length);
      segment.partial = pieces > 1 ? partial_count++ : NO_PARTIAL;
      segments[segment_count++] = segment;
    }
    running += length;
  }
}

inline void sample_knots(__global const float* knots, uint first, uint count, float position,
                         float* color) {
  const float place = position * (float)(count - 1u);
  const uint below = min((uint)place, count - 1u);
  const uint above = min(below + 1u, count - 1u);
  const float fraction = place - (float)below;
  __global const float* a = knots + (size_t)(first + below) * 3;
  __global const float* b = knots + (size_t)(first + above) * 3;
  for (int c = 0; c < 3; ++c)
    color[c] = a[c] + fraction * (b[c] - a[c]);
}

#ifndef LIGHT_ORDERED
// E w, or A w in the proportional plan, at the cloud's centre (scene.h, Absorption). A
// component that only emits has no place in the proportional plan, and a gray one in neither.
inline void sum_amplitude(const Splat splat, const ComponentColors colors,
                          __global const float* knots, float* summed) {
#ifdef LIGHT_EMISSION
  const int own = 0;
  const float scale = splat.weight * colors.brightness;
#else
  const int own = colors.absorption_knot_count > 0;
  const float scale =
      splat.weight *
      (colors.absorption_kind == ABSORPTION_FACTOR ? colors.absorption_factor : colors.brightness);
#endif
  sample_knots(knots, own ? colors.first_absorption_knot : colors.first_knot,
               own ? colors.absorption_knot_count : colors.knot_count, splat.color, summed);
  for (int c = 0; c < 3; ++c)
    summed[c] *= scale;
#ifdef VECTOR_COLORS
  // An absorption palette of its own is not the particles' colour.
  for (int c = 0; c < 3 && !own; ++c)
    summed[c] *= splat.own_color.rgb[c];
#endif
}
#else
// E w and A w at the cloud's centre (scene.h, Absorption). As a call it would leave its results
// in memory in pieces, which a processor cannot forward to the copy of the whole entry.
INLINED void amplitudes(const Splat splat, const ComponentColors colors,
                        __global const float* knots, const BinParameters p, float* emission,
                        float* absorption) {
  float e[3], a[3];
  sample_knots(knots, colors.first_knot, colors.knot_count, splat.color, e);
#ifdef VECTOR_COLORS
  for (int c = 0; c < 3; ++c)
    e[c] *= splat.own_color.rgb[c];
#endif
  for (int c = 0; c < 3; ++c)
    a[c] = e[c];
  if (colors.absorption_knot_count > 0) {
    sample_knots(knots, colors.first_absorption_knot, colors.absorption_knot_count, splat.color, a);
  }
  for (int c = 0; c < 3; ++c) {
    emission[c] = splat.weight * colors.brightness * e[c];
    absorption[c] = splat.weight * colors.brightness * a[c];
    if (colors.absorption_kind == ABSORPTION_NONE) absorption[c] = 0.0f;
    if (colors.absorption_kind == ABSORPTION_FACTOR) {
      absorption[c] = splat.weight * colors.absorption_factor * a[c];
    }
    if (colors.absorption_kind == ABSORPTION_GRAY) {
      // The source depends on the cloud's own amplitude, before it was widened.
      const float widened2 = splat.sigma * splat.sigma;
      float restored = splat.sigma < p.mean_sigma ? 1.0f : widened2 / (widened2 - p.widening);
#ifdef ELLIPSES
      const float across2 = splat.along_x.sigma * splat.along_x.sigma;
      restored *= splat.along_x.sigma < p.mean_sigma ? 1.0f : across2 / (across2 - p.widening);
      restored = sqrt(restored);
#endif
      const float own = emission[c] * restored;
      absorption[c] = emission[c];
      emission[c] *= own > 0.0f ? own / (own + colors.absorption_factor) : 0.0f;
    }
  }
}
#endif

__kernel void bin_scatter(const BinParameters p, __global const Grid* grids,
                          __global const Splat* splats, __global const uint* order,
                          __global const BlockCounts* blocks, __global uint* counts,
                          __global const Splat* in_order, __global const uint* starts,
                          __global const ComponentColors* component_colors,
                          __global const float* knots, __global TileSplat* entries) {
  const uint block = get_global_id(0);
  __global uint* count = counts + (size_t)block * p.tile_count;
  const uint end = slots_end(p, blocks, block);
  for (uint slot = p.first + block * p.stride; slot < end; ++slot) {
#ifdef LIGHT_ORDERED
    const Splat splat = in_order[slot - p.first];
#else
    const Splat splat = splats[slot];
#endif
    const Grid grid = grids[grid_of(splat)];
    const int4 range = tile_range(splat, grid);
    if (range.x > range.y) continue;
#ifdef EXTENDED_NUMBERS
    TileSplat entry;
#ifdef LIGHT_ORDERED
    entry.slot = order[slot];
#else
    entry.slot = slot;
#endif
#else
    const int bits = place_bits_of(splat, grid);
    const float unit = unit_of(splat, grid);
    TileSplat entry;
    entry.sigma = splat.sigma;
    entry.radius = splat.radius;
#ifdef ELLIPSES
    entry.along_x = splat.along_x;
#endif
    const ComponentColors colors = component_colors[component_of(splat)];
#ifdef LIGHT_ORDERED
    amplitudes(splat, colors, knots, p, entry.emission, entry.absorption);
#else
    sum_amplitude(splat, colors, knots, entry.summed);
#endif
#endif
    // Of the band that lists are made of, the tiles of this row.
    const int first = (int)(p.first_tile - grid.corner_tile);
    const int last = (int)(p.end_tile - grid.corner_tile) - 1;
    for (int ty = range.z; ty <= range.w; ++ty) {
      const int row = ty * grid.tiles_x;
      const int end_x = min(range.y, last - row);
      for (int tx = max(range.x, first - row); tx <= end_x; ++tx) {
#ifndef EXTENDED_NUMBERS
        const int middle_x = tx * TILE_WIDTH + TILE_WIDTH / 2;
        const int middle_y = ty * TILE_HEIGHT + TILE_HEIGHT / 2;
        entry.x = from_pixel(splat.x, middle_x, grid.middle_x, bits, unit);
        entry.y = from_pixel(splat.y, middle_y, grid.middle_y, bits, unit);
#endif
        const uint tile = grid.corner_tile + (uint)(row + tx);
        entries[(size_t)starts[tile] + count[tile]++] = entry;
      }
    }
  }
}
