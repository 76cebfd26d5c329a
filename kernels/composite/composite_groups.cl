// Compositing for GPUs: a work-group takes a segment of one tile's list, a work-item one pixel.
// The group fetches a batch of splats into local memory, works out both axes of each of them once
// for all pixels, and which of them each part of the tile needs to draw. Formulas are those of
// composite_rows.cl, on single floats.
#define GROUP (TILE_WIDTH * TILE_HEIGHT)
#define AXES (TILE_WIDTH + TILE_HEIGHT)
#define BATCH FLAGS
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
// depth in any pixel at most, emission; in sums what they add up, by threes.
#ifdef LIGHT_ORDERED
#define AMPLITUDES 2
#else
#define AMPLITUDES (SUMMED / 3)
#endif

// Which pixels a cut leaves out follows from two numbers, of the column and of the row.
#if defined(KERNEL_CUT) && !defined(FACE_OF_CUBE) && !defined(ELLIPSES)
#define CUT_BY_AXES
typedef float2 Axis;  // the shape, and cut_of_axis()
#else
typedef float Axis;
#endif

// The splats of a batch as they are listed. Two in turn: the next are fetched while slower items
// still draw.
typedef struct Listed {
  TileSplat splats[BATCH];
  float factors[2 * BATCH];  // of each splat's columns, then of each splat's rows (axis_factor)
} Listed;

// What all pixels need of them.
typedef struct Batch {
  float4 amplitudes[BATCH * AMPLITUDES];
  Axis axes[BATCH * AXES];  // of each splat, columns, then rows
  Flags touching;           // splats that reach the center of a pixel of the tile
  Flags drawn[PARTS];       // those of a part
  Flags thick;              // whose layers two terms do not serve for
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
static inline float axis_of_splat(const __local Listed* listed, uint k, int is_column, int pixel,
                                  float center, float mean_sigma TILE_STENCIL_PARAMETER) {
  const __local TileSplat* splat = listed->splats + k;
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
                        listed->factors[is_column ? k : BATCH + k], mean_sigma),
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

INLINED void fetch(__local Listed* listed, __global const TileSplat* entries, uint first,
                   uint count, float mean_sigma) {
  const uint item = get_local_id(0), k = item % BATCH;
  __global const uint* from = (__global const uint*)(entries + first);
  __local uint* to = (__local uint*)listed->splats;
  for (uint w = item; w < count * ENTRY_WORDS; w += GROUP)
    to[w] = from[w];
  if (item < 2 * BATCH && k < count) {
    const float sigma = item < BATCH ? SIGMA_X(entries[first + k]) : entries[first + k].sigma;
    listed->factors[item] = axis_factor(sigma, mean_sigma);
  }
}

#ifdef CLOUDS_IN_LISTS
#define TILE_CLOUDS_PARAMETER , const TileClouds* clouds
#define TILE_CLOUDS_ARGUMENT , &of_tile
#define TILE_CLOUDS_PASSED , clouds

// Columns of clouds are worked out where layers may be thick.
INLINED int prepare_cloud(__local float4* amplitudes, __global const CloudEntry* cloud) {
  const float4 absorption =
      (float4)(cloud->absorption[0], cloud->absorption[1], cloud->absorption[2], cloud->deepest);
  amplitudes[0] = absorption;
  amplitudes[1] = (float4)(cloud->emission[0], cloud->emission[1], cloud->emission[2], 0.0f);
  return 1;
}
#else
#define TILE_CLOUDS_PARAMETER
#define TILE_CLOUDS_ARGUMENT
#define TILE_CLOUDS_PASSED
#endif

// Returns whether two terms do not serve for the layer.
INLINED int prepare_amplitudes(__local float4* amplitudes, const __local TileSplat* splat,
                               float mean_sigma,
                               const CompositeParameters p TILE_CLOUDS_PARAMETER) {
#ifdef CLOUDS_IN_LISTS
  if (is_cloud(splat->sigma)) return prepare_cloud(amplitudes, cloud_of(splat->sigma, clouds));
#endif
#ifdef LIGHT_ORDERED
  const float4 absorption = (float4)(splat->absorption[0], splat->absorption[1],
                                     splat->absorption[2], deepest_of(splat, mean_sigma));
  amplitudes[0] = absorption;
  amplitudes[1] = (float4)(splat->emission[0], splat->emission[1], splat->emission[2], 0.0f);
  return absorption.w > p.phi_short;
#else
  for (int i = 0; i < AMPLITUDES; ++i) {
    const __local float* summed = splat->summed + 3 * i;
    amplitudes[i] = (float4)(summed[0], summed[1], summed[2], 0.0f);
  }
  return 0;
#endif
}

// Whether an entry touches the tile, or the part of it around (x, y).
INLINED int touches(const __local TileSplat* splat TILE_CLOUDS_PARAMETER) {
#ifdef CLOUDS_IN_LISTS
  if (is_cloud(splat->sigma)) return cloud_touches(cloud_of(splat->sigma, clouds), clouds);
#endif
  return reaches_tile(splat);
}

INLINED int touches_part(const __local TileSplat* splat, float x, float y,
                         float mean_sigma TILE_CLOUDS_PARAMETER) {
#ifdef CLOUDS_IN_LISTS
  if (is_cloud(splat->sigma)) return cloud_touches(cloud_of(splat->sigma, clouds), clouds);
#endif
  return reaches_part(splat, x, y, mean_sigma);
}

#ifdef CUT_BY_AXES
// The square of a column's distance from a splat, and what a row's leaves of the square of the
// cut's radius: a pixel is inside where the former is no larger. Of means the pixel that holds the
// center is inside, too: it is the one with distances above -1/2 and up to 1/2.
static inline float cut_of_axis(const __local TileSplat* splat, int is_column, float center) {
  const float d = is_column ? center - splat->x - LOW_X(*splat) : center - splat->y - LOW_Y(*splat);
  const float cut = cut_radius(splat->radius);
  const float left = cut * cut - d * d;
#ifdef SAMPLING_MEAN
  const float above_a_quarter = 0.25000003f;
  if (is_column) return d == -0.5f ? above_a_quarter : d * d;
  return d > -0.5f && d <= 0.5f ? max(left, 0.25f) : left;
#else
  return is_column ? d * d : left;
#endif
}
#endif

// What all pixels of the tile need of the batch. An item has one column or row of all splats that
// it takes, and one part: there are as many parts of all splats as items.
INLINED void prepare(__local Batch* batch, const __local Listed* listed, uint count,
                     float mean_sigma,
                     const CompositeParameters p TILE_CLOUDS_PARAMETER TILE_STENCIL_PARAMETER) {
  const uint item = get_local_id(0), axis = item % AXES;
  const int is_column = axis < TILE_WIDTH;
  const int pixel = (int)axis - (is_column ? 0 : TILE_WIDTH);
  const float center = (float)pixel + (is_column ? FIRST_X : FIRST_Y);
  for (uint k = item / AXES; k < count; k += GROUP / AXES) {
    const float shape =
        axis_of_splat(listed, k, is_column, pixel, center, mean_sigma TILE_STENCIL_ARGUMENT);
#ifdef CUT_BY_AXES
    batch->axes[k * AXES + axis] =
        (Axis)(shape, cut_of_axis(listed->splats + k, is_column, center));
#else
    batch->axes[k * AXES + axis] = shape;
#endif
  }
  const uint k = item % BATCH, part = item / BATCH;
  const __local TileSplat* splat = listed->splats + k;
  // Items of the first parts have fetched factors.
  if (part == PARTS - 1) {
    int is_thick = 0, is_touching = 0;
    if (k < count) {
      is_thick = prepare_amplitudes(batch->amplitudes + k * AMPLITUDES, splat, mean_sigma,
                                    p TILE_CLOUDS_PASSED);
      is_touching = touches(splat TILE_CLOUDS_PASSED);
    }
    store_flag(&batch->thick, k, is_thick);
    store_flag(&batch->touching, k, is_touching);
  }
  const float x = (float)(part % PARTS_ACROSS * PART_WIDTH) + 0.5f * (PART_WIDTH - TILE_WIDTH);
  const float y = (float)(part / PARTS_ACROSS * PART_HEIGHT) + 0.5f * (PART_HEIGHT - TILE_HEIGHT);
  store_flag(batch->drawn + part, k,
             k < count && touches_part(splat, x, y, mean_sigma TILE_CLOUDS_PASSED));
}

#if defined(KERNEL_CUT) && !defined(FACE_OF_CUBE) && !defined(CUT_BY_AXES)
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
                                    float shape, float half_square) {
  const float opacity = pixel[c + 3];
  const float covered = shape - half_square * absorption;
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
  const float4 absorption = amplitudes[0], emission = amplitudes[1];
  const float half_square = 0.5f * (shape * shape);
  add_thin_channel(pixel, 0, emission.x, absorption.x, shape, half_square);
  add_thin_channel(pixel, 1, emission.y, absorption.y, shape, half_square);
  add_thin_channel(pixel, 2, emission.z, absorption.z, shape, half_square);
}

INLINED void add_splat(float* pixel, const __local float4* amplitudes, float shape,
                       const CompositeParameters p) {
#ifndef KEEP_TRANSMITTANCE
  if (amplitudes[0].w <= p.phi_short) {
    add_thin_splat(pixel, amplitudes, shape);
    return;
  }
#endif
  const float4 absorption = amplitudes[0], emission = amplitudes[1];
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

#ifdef FACE_OF_CUBE
INLINED float shape_at(const __local Batch* batch, const __local Listed* listed, uint k, uint x,
                       uint y TILE_PARAMETER) {
  const float dx = batch->axes[k * AXES + x], dy = batch->axes[k * AXES + TILE_WIDTH + y];
  if (dx == NOT_DRAWN || dy == NOT_DRAWN) return 0.0f;
  return face_shape(listed->splats[k].tilt, dx, dy, (on_face->x + (float)x) * on_face->per_focal,
                    (on_face->y + (float)y) * on_face->per_focal, on_face->cut2);
}
#else
INLINED float shape_at(const __local Batch* batch, const __local Listed* listed, uint k, uint x,
                       uint y) {
  const Axis column = batch->axes[k * AXES + x], row = batch->axes[k * AXES + TILE_WIDTH + y];
#ifdef CUT_BY_AXES
  return column.y <= row.y ? column.x * row.x : 0.0f;
#else
#ifdef KERNEL_CUT
  if (!is_inside_cut(listed->splats + k, x, y)) return 0.0f;
#endif
  return column * row;
#endif
}
#endif

// The batch's splats of these bits, in order. Hardly any batch has layers that are not thin.
INLINED void draw(float* pixel, const __local Batch* batch, const __local Listed* listed, uint bits,
                  uint x, uint y,
                  const CompositeParameters p TILE_PARAMETER TILE_CLOUDS_PARAMETER) {
#ifdef LIGHT_ORDERED
#ifdef KEEP_TRANSMITTANCE
  const int all_thin = 0;
#else
  const int all_thin = (bits & bits_of_flags(&batch->thick)) == 0;
#endif
  while (!all_thin && bits != 0) {
    const uint k = take_first(&bits);
#ifdef CLOUDS_IN_LISTS
    const float sigma = listed->splats[k].sigma;
    const float shape = is_cloud(sigma)
                            ? column_of_cloud(cloud_of(sigma, clouds), clouds, (int)x, (int)y)
                            : shape_at(batch, listed, k, x, y TILE_PASSED);
#else
    const float shape = shape_at(batch, listed, k, x, y TILE_PASSED);
#endif
    if (shape > 0.0f) add_splat(pixel, batch->amplitudes + k * AMPLITUDES, shape, p);
  }
#endif
  while (bits != 0) {
    const uint k = take_first(&bits);
    add_thin_splat(pixel, batch->amplitudes + k * AMPLITUDES,
                   shape_at(batch, listed, k, x, y TILE_PASSED));
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

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void composite(
    const CompositeParameters p, __global const Grid* grids, __global const Segment* segments,
    __global const TileSplat* entries, __global float* planes,
    __global float* partials CLOUDS_PARAMETERS STENCIL_PARAMETERS) {
  __local Listed listed[2];
  __local Batch batch;
  __local uint shows;  // whether anything behind shows in any pixel
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
  if (item == 0) shows = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (shows_behind(front, p.stop)) atomic_or(&shows, 1u);
  barrier(CLK_LOCAL_MEM_FENCE);
  // Blocks are of splats that touch the tile: a crop's lists have others than those of the picture,
  // too. What decides over steps and barriers is the same for all items.
  uint in_block = 0, turn = 0, end = shows ? segment.end : segment.begin;
  for (uint first = segment.begin; first < end; first += BATCH) {
    const uint count = min((uint)BATCH, segment.end - first);
    __local Listed* own_listed = listed + turn;
    turn ^= 1u;
    fetch(own_listed, entries, first, count, grid.mean_sigma);
    barrier(CLK_LOCAL_MEM_FENCE);
    prepare(&batch, own_listed, count, grid.mean_sigma,
            p TILE_CLOUDS_ARGUMENT TILE_STENCIL_ARGUMENT);
    if (item == 0) shows = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint touching = bits_of_flags(&batch.touching);
    const uint drawn = bits_of_flags(batch.drawn + part);
    const int ends_block = in_block + popcount(touching) >= SPLATS_OF_BLOCK;
    // Splats that touch no pixel are drawn nowhere, so that all bits from there on serve.
    const uint of_next = ends_block ? bits_behind(touching, SPLATS_OF_BLOCK - in_block) : 0u;
    draw(pixel, &batch, own_listed, drawn & ~of_next, x, y, p TILE_ARGUMENT TILE_CLOUDS_ARGUMENT);
    in_block += popcount(touching);
    if (ends_block) {
      add_block(pixel, front);
      if (shows_behind(front, p.stop)) atomic_or(&shows, 1u);
      draw(pixel, &batch, own_listed, drawn & of_next, x, y, p TILE_ARGUMENT TILE_CLOUDS_ARGUMENT);
      in_block -= SPLATS_OF_BLOCK;
      barrier(CLK_LOCAL_MEM_FENCE);
      if (!shows) end = first;
    }
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
