// Compositing for GPUs: a batch of splats of a tile's list, fetched into local memory by a
// work-group. Both axes of each splat are worked out once for all pixels, and which splats each
// part of the tile needs to draw.
#include "kernels/bin/bin.h"
#include "kernels/common/common.cl"
#include "kernels/common/ellipse.h"
#include "kernels/common/flags.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/clouds.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/gaussian.cl"
#include "kernels/composite/pixel_range.cl"
#include "kernels/composite/shape.cl"
#include "kernels/composite/stencil.cl"

#define TILE_PIXELS (TILE_WIDTH * TILE_HEIGHT)
// An item has two pixels of a part below each other, which share what they read of a splat, and as
// many of another part: the larger the tile, the fewer lists a splat is in.
#define ITEM_HEIGHT 2
#define PARTS_OF_ITEM 2
#define PIXELS_OF_ITEM (ITEM_HEIGHT * PARTS_OF_ITEM)
#define GROUP (TILE_PIXELS / PIXELS_OF_ITEM)
#define AXES (TILE_WIDTH + TILE_HEIGHT)
#define BATCH FLAGS
// Parts of a tile: the pixels of 32 work-items, which many GPUs run as one.
#define PART_WIDTH 8
#define PART_HEIGHT 8
#define PART_ITEMS (PART_WIDTH * PART_HEIGHT / ITEM_HEIGHT)
#define PARTS_ACROSS (TILE_WIDTH / PART_WIDTH)
#define PARTS (TILE_PIXELS / (PART_WIDTH * PART_HEIGHT))
// An item's other part is so many further on, and so many pixels below.
#define PARTS_TO_NEXT (PARTS / PARTS_OF_ITEM)
#define ROWS_TO_NEXT (PARTS_TO_NEXT / PARTS_ACROSS * PART_HEIGHT)
REQUIRE(an_item_for_each_splat_and_two_parts,
        BATCH == PART_ITEMS && GROUP == BATCH * PARTS_TO_NEXT);
// The first pixel's center, from the tile's middle.
#define FIRST_X (0.5f - 0.5f * TILE_WIDTH)
#define FIRST_Y (0.5f - 0.5f * TILE_HEIGHT)
#define ENTRY_WORDS (sizeof(TileSplat) / sizeof(uint))

// What all pixels need of the light of a batch's splats. A warp takes four clocks for four floats
// of local memory, so that the six of a layer lie in six, and not in eight.
typedef struct BatchLight {
#if LIGHT_ORDERED
  float4 absorption_and_red[BATCH];  // absorption, and what is emitted of the first channel
  float2 green_and_blue[BATCH];      // that is emitted
  float deepest[BATCH];              // the optical depth in any pixel at most
  float second_term[BATCH];          // of phi's series: 1/2, or 0 where one term serves
#else
  float4 summed[BATCH * (SUMMED / 3)];  // by threes
#endif
} BatchLight;

// Which pixels a cut leaves out follows from two numbers, of the column and of the row.
#if KERNEL_CUT && !FACE_OF_CUBE && !ELLIPSES
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

// Cut discs of values at pixel centers need no axes where a GPU has a fast 2^t: each pixel takes
// its own distance.
#define DISCS_BY_PIXEL          \
  (NATIVE_EXP2 && KERNEL_CUT && \
   !(SAMPLING_MEAN || ELLIPSES || FACE_OF_CUBE || FINE_PLACES || STENCILS))

// What all pixels need of them.
typedef struct Batch {
  BatchLight light;
  float4 discs[DISCS_BY_PIXEL ? BATCH : 1];      // place, cut's radius squared, and axis_factor()
  Axis axes[DISCS_BY_PIXEL ? 1 : BATCH * AXES];  // else, of each splat, columns, then rows
  Flags touching;      // splats that reach the center of a pixel of the tile
  Flags drawn[PARTS];  // those of a part
  Flags of_two_terms;  // whose layers one term does not serve for,
  Flags thick;         // and two do not
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

// Zero outside what the rows would draw, and where a difference of error functions errs below it.
// `center` is that of the item's column or row, whose number is `pixel`.
static inline float axis_of_splat(const __local Listed* listed, uint k, int is_column, int pixel,
                                  float center, float mean_sigma, __global const Stencil* stencil) {
  const __local TileSplat* splat = listed->splats + k;
  if (STENCILS && stencil && splat->sigma < 0.0f) {
    const StencilPlaces place =
        is_column ? stencil_places(splat->x, FIRST_X) : stencil_places(splat->y, FIRST_Y);
    return weight_of_stencil(stencil, splat->sigma, place, pixel);
  }
  const float d = is_column ? center - splat->x - LOW_X(*splat) : center - splat->y - LOW_Y(*splat);
  const float radius = is_column ? RADIUS_X(*splat) : splat->radius;
#if FACE_OF_CUBE
  return fabs(d) > radius ? NOT_DRAWN : d;
#else
  if (fabs(d) > radius) return 0.0f;
  return max(axis_shape(d, is_column ? SIGMA_X(*splat) : splat->sigma,
                        listed->factors[is_column ? k : BATCH + k], mean_sigma),
             0.0f);
#endif
}

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
#if KERNEL_CUT || FACE_OF_CUBE
  return 1;
#else
  if (splat->sigma < mean_sigma || SIGMA_X(*splat) < mean_sigma) return 1;
  const float dx = max(across, 0.0f), dy = max(along, 0.0f);
#if ELLIPSES
  const float round_dx = dx * (splat->radius / splat->along_x.radius);
#else
  const float round_dx = dx;
#endif
  return round_dx * round_dx + dy * dy <= splat->radius * splat->radius;
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

#if LIGHT_ORDERED
static inline float deepest_of(const __local TileSplat* splat, float mean_sigma) {
  const float flux = 3.15f * fabs(splat->sigma * SIGMA_X(*splat));
  return max(splat->absorption[0], max(splat->absorption[1], splat->absorption[2])) *
         (splat->sigma < mean_sigma ? min(1.0f, flux) : 1.0f);
}

#define THREE_OF(numbers) (float3)((numbers)[0], (numbers)[1], (numbers)[2])
INLINED void put_layer(__local BatchLight* light, uint k, const float3 absorption,
                       const float3 emission, float deepest, int terms) {
  light->absorption_and_red[k] = (float4)(absorption, emission.x);
  light->green_and_blue[k] = emission.yz;
  light->deepest[k] = deepest;
  light->second_term[k] = terms > 1 ? 0.5f : 0.0f;
}

// Returns how many terms serve for the layer: one, two or, for all that need more, three. Columns
// of clouds are worked out with these.
INLINED int prepare_light(__local BatchLight* light, uint k, const __local TileSplat* splat,
                          float mean_sigma, const CompositeParameters p, const TileClouds* clouds) {
  if (CLOUDS_IN_LISTS && is_cloud(splat->sigma)) {
    __global const CloudEntry* cloud = cloud_of(splat->sigma, clouds);
    const int terms_of_cloud = 1 + (cloud->deepest > p.phi_first) + (cloud->deepest > p.phi_short);
    put_layer(light, k, THREE_OF(cloud->absorption), THREE_OF(cloud->emission), cloud->deepest,
              terms_of_cloud);
    return 3;
  }
  const float deepest = deepest_of(splat, mean_sigma);
  const int terms = 1 + (deepest > p.phi_first) + (deepest > p.phi_short);
  put_layer(light, k, THREE_OF(splat->absorption), THREE_OF(splat->emission), deepest, terms);
  return terms;
}
#else
INLINED int prepare_light(__local BatchLight* light, uint k, const __local TileSplat* splat,
                          float mean_sigma, const CompositeParameters p, const TileClouds* clouds) {
  for (int i = 0; i < SUMMED / 3; ++i) {
    const __local float* summed = splat->summed + 3 * i;
    light->summed[k * (SUMMED / 3) + i] = (float4)(summed[0], summed[1], summed[2], 0.0f);
  }
  return 1;
}
#endif

// Whether an entry touches the tile, or the part of it around (x, y).
INLINED int touches(const __local TileSplat* splat, const TileClouds* clouds) {
  if (CLOUDS_IN_LISTS && is_cloud(splat->sigma))
    return cloud_touches(cloud_of(splat->sigma, clouds), clouds);
  return reaches_tile(splat);
}

INLINED int touches_part(const __local TileSplat* splat, float x, float y, float mean_sigma,
                         const TileClouds* clouds) {
  if (CLOUDS_IN_LISTS && is_cloud(splat->sigma))
    return cloud_touches(cloud_of(splat->sigma, clouds), clouds);
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
#if SAMPLING_MEAN
  const float above_a_quarter = 0.25000003f;
  if (is_column) return d == -0.5f ? above_a_quarter : d * d;
  return d > -0.5f && d <= 0.5f ? max(left, 0.25f) : left;
#else
  return is_column ? d * d : left;
#endif
}
#endif

// What all pixels of the tile need of the batch. There are half as many items as parts of all
// splats.
INLINED void prepare(__local Batch* batch, const __local Listed* listed, uint count,
                     float mean_sigma, const CompositeParameters p, const TileClouds* clouds,
                     __global const Stencil* stencil) {
  const uint item = get_local_id(0), axis = item % AXES;
  const int is_column = axis < TILE_WIDTH;
  const int pixel = (int)axis - (is_column ? 0 : TILE_WIDTH);
  const float center = (float)pixel + (is_column ? FIRST_X : FIRST_Y);
  for (uint k = item / AXES; !DISCS_BY_PIXEL && k < count; k += GROUP / AXES) {
    const float shape = axis_of_splat(listed, k, is_column, pixel, center, mean_sigma, stencil);
#ifdef CUT_BY_AXES
    batch->axes[k * AXES + axis] =
        (Axis)(shape, cut_of_axis(listed->splats + k, is_column, center));
#else
    batch->axes[k * AXES + axis] = shape;
#endif
  }
  const uint k = item % BATCH, first_part = item / BATCH;
  const __local TileSplat* splat = listed->splats + k;
  // Items of the first parts have fetched factors.
  if (first_part == PARTS_TO_NEXT - 1) {
    int terms = 1, is_touching = 0;
    if (k < count) {
      const float cut = cut_radius(splat->radius);
      if (DISCS_BY_PIXEL)
        batch->discs[k] = (float4)(splat->x, splat->y, cut * cut, listed->factors[k]);
      terms = prepare_light(&batch->light, k, splat, mean_sigma, p, clouds);
      is_touching = touches(splat, clouds);
    }
    store_flag(&batch->of_two_terms, k, terms > 1);
    store_flag(&batch->thick, k, terms > 2);
    store_flag(&batch->touching, k, is_touching);
  }
  for (uint part = first_part; part < PARTS; part += PARTS_TO_NEXT) {
    const float x = (float)(part % PARTS_ACROSS * PART_WIDTH) + 0.5f * (PART_WIDTH - TILE_WIDTH);
    const float y = (float)(part / PARTS_ACROSS * PART_HEIGHT) + 0.5f * (PART_HEIGHT - TILE_HEIGHT);
    store_flag(batch->drawn + part, k, k < count && touches_part(splat, x, y, mean_sigma, clouds));
  }
}
