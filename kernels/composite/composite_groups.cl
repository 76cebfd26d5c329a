// Compositing for GPUs: a work-group takes a segment of one tile's list, a work-item one pixel.
// The group fetches a batch of splats into local memory, works out both axes of each of them once
// for all pixels, and which of them each part of the tile needs to draw. Formulas are those of
// composite_rows.cl, on single floats.
#define GROUP (TILE_WIDTH * TILE_HEIGHT)
#define AXES (TILE_WIDTH + TILE_HEIGHT)
// A bit each in a word.
#define BATCH 32
// Parts of a tile: the pixels of 32 work-items, which many GPUs run as one.
#define PART_WIDTH 8
#define PART_HEIGHT 4
#define PART_ITEMS (PART_WIDTH * PART_HEIGHT)
#define PARTS_ACROSS (TILE_WIDTH / PART_WIDTH)
#define PARTS (GROUP / PART_ITEMS)
// The first pixel's center, from the tile's middle.
#define FIRST_X (0.5f - 0.5f * TILE_WIDTH)
#define FIRST_Y (0.5f - 0.5f * TILE_HEIGHT)
#define ENTRY_WORDS (sizeof(TileSplat) / sizeof(uint))

typedef struct Batch {
  TileSplat splats[BATCH];
  float axes[BATCH * AXES];  // of each splat, columns, then rows
  float deepest[BATCH];      // optical depth in any pixel at most
  uint touching;             // bit k: splat k reaches the center of a pixel of the tile
  uint drawn[PARTS];         // of that part
  uint shows;                // whether anything behind shows in any pixel
} Batch;

// One axis of the separable shape at distance d of a pixel's centre.
inline float axis_shape(float d, float sigma, float mean_sigma) {
  if (sigma < 0.0f) return bright_mean(d, -sigma);
  if (sigma >= mean_sigma) return gaussian(d, 1.44269504f / (sigma * sigma));
  const float per_sigma = 1.0f / sigma;
  return PIXEL_MEAN_SCALE * sigma *
         (error_function((d + 0.5f) * per_sigma) - error_function((d - 0.5f) * per_sigma));
}

// Zero outside what the rows would draw.
inline float axis_of_splat(const __local TileSplat* splat, uint axis, float mean_sigma) {
  const int is_column = axis < TILE_WIDTH;
  const float d = is_column ? (float)axis + FIRST_X - splat->x - LOW_X(*splat)
                            : (float)(axis - TILE_WIDTH) + FIRST_Y - splat->y - LOW_Y(*splat);
  const float radius = is_column ? RADIUS_X(*splat) : splat->radius;
  if (fabs(d) > radius) return 0.0f;
  return axis_shape(d, is_column ? SIGMA_X(*splat) : splat->sigma, mean_sigma);
}

// Whether a splat reaches the center of a pixel among so many of each axis around (x, y).
inline int reaches(const __local TileSplat* splat, float x, float y, int width, int height) {
  return fabs(splat->x - x) <= 0.5f * (float)(width - 1) + RADIUS_X(*splat) &&
         fabs(splat->y - y) <= 0.5f * (float)(height - 1) + splat->radius;
}

inline float deepest_of(const __local TileSplat* splat, float mean_sigma) {
#ifdef LIGHT_ORDERED
  const float flux = 3.15f * fabs(splat->sigma * SIGMA_X(*splat));
  return max(splat->absorption[0], max(splat->absorption[1], splat->absorption[2])) *
         (splat->sigma < mean_sigma ? min(1.0f, flux) : 1.0f);
#else
  return 0.0f;
#endif
}

INLINED void fetch(__local Batch* batch, __global const TileSplat* entries, uint first,
                   uint count) {
  const uint item = get_local_id(0);
  __global const uint* from = (__global const uint*)(entries + first);
  __local uint* to = (__local uint*)batch->splats;
  for (uint w = item; w < count * ENTRY_WORDS; w += GROUP)
    to[w] = from[w];
  if (item == 0) batch->touching = batch->shows = 0;
  if (item < PARTS) batch->drawn[item] = 0;
}

// What all pixels of the tile need of the batch.
INLINED void prepare(__local Batch* batch, uint count, float mean_sigma) {
  const uint item = get_local_id(0);
  for (uint place = item; place < count * AXES; place += GROUP)
    batch->axes[place] = axis_of_splat(batch->splats + place / AXES, place % AXES, mean_sigma);
  if (item < count) {
    batch->deepest[item] = deepest_of(batch->splats + item, mean_sigma);
    if (reaches(batch->splats + item, 0.0f, 0.0f, TILE_WIDTH, TILE_HEIGHT))
      atomic_or(&batch->touching, 1u << item);
  }
  for (uint i = item; i < PARTS * BATCH; i += GROUP) {
    const uint k = i % BATCH, part = i / BATCH;
    const float x = (float)(part % PARTS_ACROSS * PART_WIDTH) + 0.5f * (PART_WIDTH - TILE_WIDTH);
    const float y = (float)(part / PARTS_ACROSS * PART_HEIGHT) + 0.5f * (PART_HEIGHT - TILE_HEIGHT);
    if (k < count && reaches(batch->splats + k, x, y, PART_WIDTH, PART_HEIGHT))
      atomic_or(&batch->drawn[part], 1u << k);
  }
}

#ifdef KERNEL_CUT
inline int is_inside_cut(const __local TileSplat* splat, uint x, uint y) {
  const float dx = (float)x + FIRST_X - splat->x - LOW_X(*splat);
  const float dy = (float)y + FIRST_Y - splat->y - LOW_Y(*splat);
  const float cut = cut_radius(splat->radius);
#ifdef ELLIPSES
  const float round_dx = dx * (cut / cut_radius(splat->along_x.radius));
#else
  const float round_dx = dx;
#endif
  int inside = round_dx * round_dx + dy * dy <= cut * cut;
#ifdef SAMPLING_MEAN
  inside |= dx > -0.5f && dx <= 0.5f && dy > -0.5f && dy <= 0.5f;
#endif
  return inside;
}
#endif

#ifdef LIGHT_ORDERED
// As THIN_CHANNEL and LAYER_CHANNEL of composite_rows.cl.
inline void add_channel(float* pixel, int c, float emission, float absorption, float shape,
                        float deepest, const CompositeParameters p) {
  const float opacity = pixel[c + 3];
#ifndef KEEP_TRANSMITTANCE
  if (deepest <= p.phi_short) {
    const float covered = shape - (shape * shape) * (0.5f * absorption);
    const float u = covered - opacity * covered;
    pixel[c] += u * emission;
    pixel[c + 3] = opacity + u * absorption;
    return;
  }
#endif
  const float depth = shape * absorption;
  const int by_series = deepest <= p.phi_series;
  const float phi = by_series ? phi_series(depth) : phi_full(depth);
  const float passed = by_series ? passed_by_series(depth, phi) : passed_in_full(depth, phi);
  const float t = transmittance_of(opacity);
  const float u = t * (shape * phi);
  pixel[c] += u * emission;
  pixel[c + 3] = carry(opacity, u * absorption, t * passed);
}
#endif

// The batch's splats of these bits, in order.
INLINED void draw(float* pixel, const __local Batch* batch, uint bits, uint x, uint y,
                  const CompositeParameters p) {
  while (bits != 0) {
    const uint k = 31u - clz(bits & -bits);
    bits &= bits - 1u;
    const float shape = batch->axes[k * AXES + x] * batch->axes[k * AXES + TILE_WIDTH + y];
    const __local TileSplat* splat = batch->splats + k;
    if (!(shape > 0.0f)) continue;
#ifdef KERNEL_CUT
    if (!is_inside_cut(splat, x, y)) continue;
#endif
#ifdef LIGHT_ORDERED
    for (int c = 0; c < 3; ++c)
      add_channel(pixel, c, splat->emission[c], splat->absorption[c], shape, batch->deepest[k], p);
#else
    for (int c = 0; c < SUMMED; ++c)
      pixel[c] += shape * splat->summed[c];
#endif
  }
}

// A block of splats behind what is in front of it (composite_rows.cl, SPLATS_OF_BLOCK).
inline void add_block(float* block, float* front) {
#ifdef LIGHT_ORDERED
  for (int c = 0; c < 3; ++c) {
    const float t = transmittance_of(front[c + 3]);
    front[c] += t * block[c];
    front[c + 3] = carry_behind(front[c + 3], t, block[c + 3]);
  }
#else
  for (int c = 0; c < PLANES; ++c)
    front[c] += block[c];
#endif
  for (int c = 0; c < PLANES; ++c)
    block[c] = 0.0f;
}

// Whether a pixel lets anything through from behind: of a tile in which none does, the rest of the
// list is not drawn.
inline int shows_behind(const float* front, float stop) {
#ifdef LIGHT_ORDERED
  for (int c = 3; c < PLANES; ++c) {
    if (transmittance_of(front[c]) > stop) return 1;
  }
  return 0;
#else
  return 1;
#endif
}

// The bits of `bits` from the n-th set one of `counted` on, which has as many.
inline uint behind_bit(uint counted, uint n) {
  for (uint k = 0; k < n; ++k)
    counted &= counted - 1u;
  return counted;
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global const TileSplat* entries, __global float* planes, __global float* partials) {
  __local Batch batch;
  const uint item = get_local_id(0), part = item / PART_ITEMS;
  // The launch has as many groups as there are segments.
  const Segment segment = segments[p.first_segment + get_group_id(0)];
  const Grid grid = grids[grid_of_tile(grids, p.grid_count, segment.tile)];
  const uint in_grid = segment.tile - grid.first_tile;
  const uint x = part % PARTS_ACROSS * PART_WIDTH + item % PART_WIDTH;
  const uint y = part / PARTS_ACROSS * PART_HEIGHT + item % PART_ITEMS / PART_WIDTH;
  __global float* own = planes + first_float(grid) +
                        ((size_t)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT + y) * grid.stride +
                        (size_t)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH + x;
  float front[PLANES], pixel[PLANES];
  for (int c = 0; c < PLANES; ++c) {
    front[c] = segment.partial == NO_PARTIAL ? own[(size_t)c * grid.plane_size] : 0.0f;
    pixel[c] = 0.0f;
  }
  if (item == 0) batch.shows = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (shows_behind(front, p.stop)) atomic_or(&batch.shows, 1u);
  barrier(CLK_LOCAL_MEM_FENCE);
  // Blocks are of splats that touch the tile: a crop's lists have others than those of the picture,
  // too. What decides over steps and barriers is the same for all items.
  uint in_block = 0, end = batch.shows ? segment.end : segment.begin;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint first = segment.begin; first < end; first += BATCH) {
    const uint count = min((uint)BATCH, segment.end - first);
    fetch(&batch, entries, first, count);
    barrier(CLK_LOCAL_MEM_FENCE);
    prepare(&batch, count, grid.mean_sigma);
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint touching = batch.touching, drawn = batch.drawn[part];
    const int ends_block = in_block + popcount(touching) >= SPLATS_OF_BLOCK;
    const uint next_block = ends_block ? behind_bit(touching, SPLATS_OF_BLOCK - in_block) : 0u;
    // Splats that touch no pixel are drawn nowhere, so that bits below serve.
    const uint of_next = next_block != 0 ? ~((next_block & -next_block) - 1u) : 0u;
    draw(pixel, &batch, drawn & ~of_next, x, y, p);
    in_block += popcount(touching);
    if (ends_block) {
      add_block(pixel, front);
      if (shows_behind(front, p.stop)) atomic_or(&batch.shows, 1u);
      draw(pixel, &batch, drawn & of_next, x, y, p);
      in_block -= SPLATS_OF_BLOCK;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (ends_block && !batch.shows) end = first;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  add_block(pixel, front);
  for (int c = 0; c < PLANES; ++c) {
    if (segment.partial == NO_PARTIAL) {
      own[(size_t)c * grid.plane_size] = front[c];
    } else {
      partials[((size_t)segment.partial * PLANES + c) * GROUP + y * TILE_WIDTH + x] = front[c];
    }
  }
}
