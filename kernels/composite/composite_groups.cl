// Compositing for GPUs: a work-group takes a segment of one tile's list, a work-item one pixel.
// The group fetches a batch of splats into local memory, works out both axes of each of them once
// for all pixels, and which of them each part of the tile needs to draw. Formulas are those of
// composite_rows.cl, on single floats.
#define GROUP (TILE_WIDTH * TILE_HEIGHT)
#define AXES (TILE_WIDTH + TILE_HEIGHT)
// A bit each in a word, that of the first splat the highest.
#define BATCH 32
#define BIT_OF(k) (0x80000000u >> (k))
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

// What all pixels need of a splat's light, in words of four floats: absorption with the optical
// depth in any pixel at most, half the absorption, emission; in sums what they add up, by threes.
#ifdef LIGHT_ORDERED
#define AMPLITUDES 3
#else
#define AMPLITUDES (SUMMED / 3)
#endif

typedef struct Batch {
  float4 amplitudes[BATCH * AMPLITUDES];
  TileSplat splats[BATCH];
  float factors[2 * BATCH];  // of each splat's columns, then of each splat's rows (axis_factor)
  float axes[BATCH * AXES];  // of each splat, columns, then rows
  uint touching;             // splats that reach the center of a pixel of the tile
  uint drawn[PARTS];         // those of a part
  uint thick;                // whose layers two terms do not serve for
  uint shows;                // whether anything behind shows in any pixel
} Batch;

// What axis_shape() needs of a width: divided once for all pixels.
static inline float axis_factor(float sigma, float mean_sigma) {
  return sigma >= mean_sigma ? 1.44269504f / (sigma * sigma) : 1.0f / sigma;
}

// One axis of the separable shape at distance d of a pixel's centre.
static inline float axis_shape(float d, float sigma, float factor, float mean_sigma) {
  if (sigma < 0.0f) return bright_mean(d, -sigma);
  if (sigma >= mean_sigma) return gaussian(d, factor);
  return PIXEL_MEAN_SCALE * sigma *
         (error_function((d + 0.5f) * factor) - error_function((d - 0.5f) * factor));
}

// On a face of a cube distances take the place of shapes, and this that of those that are beyond a
// splat's radius.
#define NOT_DRAWN 1e30f

#ifdef STENCILS
#define TILE_STENCIL_PARAMETER , __global const Stencil* stencil
#define TILE_STENCIL_ARGUMENT , stencil

// stencil_weights() of stencil_rows.cl, of one pixel.
static inline float weight_of_stencil(__global const Stencil* stencil, float sigma,
                                      const StencilPlaces place, int pixel) {
  const int half_of_it = STENCIL_PIXELS / 2, number = pixel - place.first;
  if (number < 0 || number >= STENCIL_PIXELS) return 0.0f;
  const int is_last = number >= half_of_it;
  const int pair = is_last ? STENCIL_PIXELS - 1 - number : number;
  const float square = place.distance * place.distance, width = stencil_widths(sigma, stencil);
  const float even = stencil_polynomials(stencil_of_width(stencil, width, pair), square);
  const float odd =
      stencil_polynomials(stencil_of_width(stencil, width, half_of_it + pair), square);
  return is_last ? even - place.distance * odd : even + place.distance * odd;
}
#else
#define TILE_STENCIL_PARAMETER
#define TILE_STENCIL_ARGUMENT
#endif

// Zero outside what the rows would draw, and where a difference of error functions errs below it.
// `center` is that of the item's column or row, whose number is `pixel`.
static inline float axis_of_splat(const __local Batch* batch, uint k, int is_column, int pixel,
                                  float center, float mean_sigma TILE_STENCIL_PARAMETER) {
  const __local TileSplat* splat = batch->splats + k;
#ifdef STENCILS
  if (stencil && splat->sigma < 0.0f) {
    const StencilPlaces place =
        is_column ? stencil_places(splat->x, FIRST_X) : stencil_places(splat->y, FIRST_Y);
    return weight_of_stencil(stencil, splat->sigma, place, pixel);
  }
#endif
  const float d = is_column ? center - splat->x - LOW_X(*splat) : center - splat->y - LOW_Y(*splat);
  const float radius = is_column ? RADIUS_X(*splat) : splat->radius;
#ifdef FACE_OF_CUBE
  return fabs(d) > radius ? NOT_DRAWN : d;
#else
  if (fabs(d) > radius) return 0.0f;
  return max(axis_shape(d, is_column ? SIGMA_X(*splat) : splat->sigma,
                        batch->factors[is_column ? k : BATCH + k], mean_sigma),
             0.0f);
#endif
}

#ifdef FACE_OF_CUBE
#define TILE_PARAMETER , const TileOnFace* on_face
#define TILE_ARGUMENT , &on_face
#define TILE_PASSED , on_face
#else
#define TILE_PARAMETER
#define TILE_ARGUMENT
#define TILE_PASSED
#endif

// Whether a splat reaches the center of a pixel of the tile.
static inline int reaches_tile(const __local TileSplat* splat) {
  return fabs(splat->x) <= 0.5f * (TILE_WIDTH - 1) + RADIUS_X(*splat) &&
         fabs(splat->y) <= 0.5f * (TILE_HEIGHT - 1) + splat->radius;
}

// ... of the part around (x, y). A splat ends at its radius all around, but for those that are
// taken as means over pixels, which have corners, or are cut, which draw the pixel that holds their
// center.
static inline int reaches_part(const __local TileSplat* splat, float x, float y, float mean_sigma) {
  const float across = fabs(splat->x - x) - 0.5f * (PART_WIDTH - 1);
  const float along = fabs(splat->y - y) - 0.5f * (PART_HEIGHT - 1);
  if (across > RADIUS_X(*splat) || along > splat->radius) return 0;
#if defined(KERNEL_CUT) || defined(FACE_OF_CUBE)
  return 1;
#else
  if (splat->sigma < mean_sigma || SIGMA_X(*splat) < mean_sigma) return 1;
  const float dx = max(across, 0.0f), dy = max(along, 0.0f);
#ifdef ELLIPSES
  const float round_dx = dx * (splat->radius / splat->along_x.radius);
#else
  const float round_dx = dx;
#endif
  return round_dx * round_dx + dy * dy <= splat->radius * splat->radius;
#endif
}

static inline float deepest_of(const __local TileSplat* splat, float mean_sigma) {
#ifdef LIGHT_ORDERED
  const float flux = 3.15f * fabs(splat->sigma * SIGMA_X(*splat));
  return max(splat->absorption[0], max(splat->absorption[1], splat->absorption[2])) *
         (splat->sigma < mean_sigma ? min(1.0f, flux) : 1.0f);
#else
  return 0.0f;
#endif
}

INLINED void fetch(__local Batch* batch, __global const TileSplat* entries, uint first, uint count,
                   float mean_sigma) {
  const uint item = get_local_id(0);
  __global const uint* from = (__global const uint*)(entries + first);
  __local uint* to = (__local uint*)batch->splats;
  for (uint w = item; w < count * ENTRY_WORDS; w += GROUP)
    to[w] = from[w];
  if (item < count) {
    batch->factors[item] = axis_factor(SIGMA_X(entries[first + item]), mean_sigma);
    batch->factors[BATCH + item] = axis_factor(entries[first + item].sigma, mean_sigma);
  }
  if (item == 0) batch->touching = batch->thick = batch->shows = 0;
  if (item < PARTS) batch->drawn[item] = 0;
}

#ifdef CLOUDS_IN_LISTS
#define TILE_CLOUDS_PARAMETER , const TileClouds* clouds
#define TILE_CLOUDS_ARGUMENT , &of_tile
#define TILE_CLOUDS_PASSED , clouds

INLINED void prepare_cloud(__local Batch* batch, uint k, __global const CloudEntry* cloud) {
  __local float4* amplitudes = batch->amplitudes + k * AMPLITUDES;
  const float4 absorption =
      (float4)(cloud->absorption[0], cloud->absorption[1], cloud->absorption[2], cloud->deepest);
  // Columns of clouds are worked out where layers may be thick.
  atomic_or(&batch->thick, BIT_OF(k));
  amplitudes[0] = absorption;
  amplitudes[1] = 0.5f * absorption;
  amplitudes[2] = (float4)(cloud->emission[0], cloud->emission[1], cloud->emission[2], 0.0f);
}
#else
#define TILE_CLOUDS_PARAMETER
#define TILE_CLOUDS_ARGUMENT
#define TILE_CLOUDS_PASSED
#endif

INLINED void prepare_amplitudes(__local Batch* batch, uint k, float mean_sigma,
                                const CompositeParameters p TILE_CLOUDS_PARAMETER) {
  const __local TileSplat* splat = batch->splats + k;
#ifdef CLOUDS_IN_LISTS
  if (is_cloud(splat->sigma)) {
    prepare_cloud(batch, k, cloud_of(splat->sigma, clouds));
    return;
  }
#endif
  __local float4* amplitudes = batch->amplitudes + k * AMPLITUDES;
#ifdef LIGHT_ORDERED
  const float4 absorption = (float4)(splat->absorption[0], splat->absorption[1],
                                     splat->absorption[2], deepest_of(splat, mean_sigma));
  if (absorption.w > p.phi_short) atomic_or(&batch->thick, BIT_OF(k));
  amplitudes[0] = absorption;
  amplitudes[1] = 0.5f * absorption;
  amplitudes[2] = (float4)(splat->emission[0], splat->emission[1], splat->emission[2], 0.0f);
#else
  for (int i = 0; i < AMPLITUDES; ++i) {
    const __local float* summed = splat->summed + 3 * i;
    amplitudes[i] = (float4)(summed[0], summed[1], summed[2], 0.0f);
  }
#endif
}

// Whether an entry touches the tile, or the part of it around (x, y).
INLINED int touches(const __local Batch* batch, uint k TILE_CLOUDS_PARAMETER) {
  const __local TileSplat* splat = batch->splats + k;
#ifdef CLOUDS_IN_LISTS
  if (is_cloud(splat->sigma)) return cloud_touches(cloud_of(splat->sigma, clouds), clouds);
#endif
  return reaches_tile(splat);
}

INLINED int touches_part(const __local Batch* batch, uint k, float x, float y,
                         float mean_sigma TILE_CLOUDS_PARAMETER) {
  const __local TileSplat* splat = batch->splats + k;
#ifdef CLOUDS_IN_LISTS
  if (is_cloud(splat->sigma)) return cloud_touches(cloud_of(splat->sigma, clouds), clouds);
#endif
  return reaches_part(splat, x, y, mean_sigma);
}

// What all pixels of the tile need of the batch. An item has one column or row of all splats that
// it takes, and one part: there are as many parts of all splats as items.
INLINED void prepare(__local Batch* batch, uint count, float mean_sigma,
                     const CompositeParameters p TILE_CLOUDS_PARAMETER TILE_STENCIL_PARAMETER) {
  const uint item = get_local_id(0), axis = item % AXES;
  const int is_column = axis < TILE_WIDTH;
  const int pixel = (int)axis - (is_column ? 0 : TILE_WIDTH);
  const float center = (float)pixel + (is_column ? FIRST_X : FIRST_Y);
  for (uint k = item / AXES; k < count; k += GROUP / AXES)
    batch->axes[k * AXES + axis] =
        axis_of_splat(batch, k, is_column, pixel, center, mean_sigma TILE_STENCIL_ARGUMENT);
  if (item < count) {
    prepare_amplitudes(batch, item, mean_sigma, p TILE_CLOUDS_PASSED);
    if (touches(batch, item TILE_CLOUDS_PASSED)) atomic_or(&batch->touching, BIT_OF(item));
  }
  const uint k = item % BATCH, part = item / BATCH;
  const float x = (float)(part % PARTS_ACROSS * PART_WIDTH) + 0.5f * (PART_WIDTH - TILE_WIDTH);
  const float y = (float)(part / PARTS_ACROSS * PART_HEIGHT) + 0.5f * (PART_HEIGHT - TILE_HEIGHT);
  if (k < count && touches_part(batch, k, x, y, mean_sigma TILE_CLOUDS_PASSED))
    atomic_or(&batch->drawn[part], BIT_OF(k));
}

#if defined(KERNEL_CUT) && !defined(FACE_OF_CUBE)
static inline int is_inside_cut(const __local TileSplat* splat, uint x, uint y) {
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
static inline void add_thin_channel(float* pixel, int c, float emission, float absorption,
                                    float half_of_it, float shape) {
  const float opacity = pixel[c + 3];
  const float covered = shape - (shape * shape) * half_of_it;
  const float u = covered - opacity * covered;
  pixel[c] += u * emission;
  pixel[c + 3] = opacity + u * absorption;
}

static inline void add_channel(float* pixel, int c, float emission, float absorption, float shape,
                               int by_series) {
  const float opacity = pixel[c + 3], depth = shape * absorption;
  const float phi = by_series ? phi_series(depth) : phi_full(depth);
  const float passed = by_series ? passed_by_series(depth, phi) : passed_in_full(depth, phi);
  const float t = transmittance_of(opacity);
  const float u = t * (shape * phi);
  pixel[c] += u * emission;
  pixel[c + 3] = carry(opacity, u * absorption, t * passed);
}

INLINED void add_thin_splat(float* pixel, const __local float4* amplitudes, float shape) {
  const float4 absorption = amplitudes[0], half_of_it = amplitudes[1], emission = amplitudes[2];
  add_thin_channel(pixel, 0, emission.x, absorption.x, half_of_it.x, shape);
  add_thin_channel(pixel, 1, emission.y, absorption.y, half_of_it.y, shape);
  add_thin_channel(pixel, 2, emission.z, absorption.z, half_of_it.z, shape);
}

INLINED void add_splat(float* pixel, const __local float4* amplitudes, float shape,
                       const CompositeParameters p) {
#ifndef KEEP_TRANSMITTANCE
  if (amplitudes[0].w <= p.phi_short) {
    add_thin_splat(pixel, amplitudes, shape);
    return;
  }
#endif
  const float4 absorption = amplitudes[0], emission = amplitudes[2];
  const int by_series = absorption.w <= p.phi_series;
  add_channel(pixel, 0, emission.x, absorption.x, shape, by_series);
  add_channel(pixel, 1, emission.y, absorption.y, shape, by_series);
  add_channel(pixel, 2, emission.z, absorption.z, shape, by_series);
}
#else
INLINED void add_thin_splat(float* pixel, const __local float4* amplitudes, float shape) {
  for (int i = 0; i < AMPLITUDES; ++i) {
    const float4 summed = amplitudes[i];
    pixel[3 * i] += shape * summed.x;
    pixel[3 * i + 1] += shape * summed.y;
    pixel[3 * i + 2] += shape * summed.z;
  }
}
#endif

// Of the batch's splats of these bits the first, whose bit is taken away.
INLINED uint take_first(uint* bits) {
  const uint k = clz(*bits);
  *bits ^= BIT_OF(k);
  return k;
}

#ifdef FACE_OF_CUBE
INLINED float shape_at(const __local Batch* batch, uint k, uint x, uint y TILE_PARAMETER) {
  const float dx = batch->axes[k * AXES + x], dy = batch->axes[k * AXES + TILE_WIDTH + y];
  if (dx == NOT_DRAWN || dy == NOT_DRAWN) return 0.0f;
  return face_shape(batch->splats[k].tilt, dx, dy, (on_face->x + (float)x) * on_face->per_focal,
                    (on_face->y + (float)y) * on_face->per_focal, on_face->cut2);
}
#else
INLINED float shape_at(const __local Batch* batch, uint k, uint x, uint y) {
#ifdef KERNEL_CUT
  if (!is_inside_cut(batch->splats + k, x, y)) return 0.0f;
#endif
  return batch->axes[k * AXES + x] * batch->axes[k * AXES + TILE_WIDTH + y];
}
#endif

// The batch's splats of these bits, in order. Hardly any batch has layers that are not thin.
INLINED void draw(float* pixel, const __local Batch* batch, uint bits, uint x, uint y,
                  const CompositeParameters p TILE_PARAMETER TILE_CLOUDS_PARAMETER) {
#ifdef LIGHT_ORDERED
#ifdef KEEP_TRANSMITTANCE
  const int all_thin = 0;
#else
  const int all_thin = (bits & batch->thick) == 0;
#endif
  while (!all_thin && bits != 0) {
    const uint k = take_first(&bits);
#ifdef CLOUDS_IN_LISTS
    const float sigma = batch->splats[k].sigma;
    const float shape = is_cloud(sigma)
                            ? column_of_cloud(cloud_of(sigma, clouds), clouds, (int)x, (int)y)
                            : shape_at(batch, k, x, y TILE_PASSED);
#else
    const float shape = shape_at(batch, k, x, y TILE_PASSED);
#endif
    if (shape > 0.0f) add_splat(pixel, batch->amplitudes + k * AMPLITUDES, shape, p);
  }
#endif
  while (bits != 0) {
    const uint k = take_first(&bits);
    add_thin_splat(pixel, batch->amplitudes + k * AMPLITUDES, shape_at(batch, k, x, y TILE_PASSED));
  }
}

// A block of splats behind what is in front of it (composite_rows.cl, SPLATS_OF_BLOCK).
static inline void add_block(float* block, float* front) {
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
static inline int shows_behind(const float* front, float stop) {
#ifdef LIGHT_ORDERED
  for (int c = 3; c < PLANES; ++c) {
    if (transmittance_of(front[c]) > stop) return 1;
  }
  return 0;
#else
  return 1;
#endif
}

// The bits behind the first n set ones of `counted`, which has as many at least: from the next set
// one on.
static inline uint bits_behind(uint counted, uint n) {
  for (uint k = 0; k < n; ++k)
    take_first(&counted);
  return counted != 0 ? 0xffffffffu >> clz(counted) : 0u;
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global const TileSplat* entries, __global float* planes,
    __global float* partials CLOUDS_PARAMETERS STENCIL_PARAMETERS) {
  __local Batch batch;
  const uint item = get_local_id(0), part = item / PART_ITEMS;
  // The launch has as many groups as there are segments.
  const Segment segment = segments[p.first_segment + get_group_id(0)];
  const uint grid_number = grid_of_tile(grids, p.grid_count, segment.tile);
  const Grid grid = grids[grid_number];
#ifdef STENCILS
  __global const Stencil* const stencil = stencil_of_grid(stencils, grid_number);
#endif
  const uint in_grid = segment.tile - grid.first_tile;
  const uint x = part % PARTS_ACROSS * PART_WIDTH + item % PART_WIDTH;
  const uint y = part / PARTS_ACROSS * PART_HEIGHT + item % PART_ITEMS / PART_WIDTH;
  __global float* own = planes + first_float(grid) +
                        ((size_t)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT + y) * grid.stride +
                        (size_t)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH + x;
#ifdef CLOUDS_IN_LISTS
  const TileClouds of_tile =
      clouds_of_tile(clouds, cloud_splats, directions, cones, grid, segment.tile);
#endif
#ifdef FACE_OF_CUBE
  const TileOnFace on_face = tile_on_face(p.face, grid, segment.tile);
#endif
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
    fetch(&batch, entries, first, count, grid.mean_sigma);
    barrier(CLK_LOCAL_MEM_FENCE);
    prepare(&batch, count, grid.mean_sigma, p TILE_CLOUDS_ARGUMENT TILE_STENCIL_ARGUMENT);
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint touching = batch.touching, drawn = batch.drawn[part];
    const int ends_block = in_block + popcount(touching) >= SPLATS_OF_BLOCK;
    // Splats that touch no pixel are drawn nowhere, so that all bits from there on serve.
    const uint of_next = ends_block ? bits_behind(touching, SPLATS_OF_BLOCK - in_block) : 0u;
    draw(pixel, &batch, drawn & ~of_next, x, y, p TILE_ARGUMENT TILE_CLOUDS_ARGUMENT);
    in_block += popcount(touching);
    if (ends_block) {
      add_block(pixel, front);
      if (shows_behind(front, p.stop)) atomic_or(&batch.shows, 1u);
      draw(pixel, &batch, drawn & of_next, x, y, p TILE_ARGUMENT TILE_CLOUDS_ARGUMENT);
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
