// Narrow splats, most of a large snapshot: what does not differ from pixel to pixel is worked out
// for eight entries at once, and no loop over columns is left.
#include "kernels/bin/bin.h"
#include "kernels/bin/entry_lanes.cl"
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/composite/entry_windows.cl"
#include "kernels/composite/gaussian.cl"
#include "kernels/composite/patch.cl"
#include "kernels/composite/rows.cl"
#include "kernels/composite/shape.cl"
#include "kernels/composite/waiting.cl"
#if !FACE_OF_CUBE
#include "kernels/composite/splat_rows.cl"
#endif

#if !KERNEL_CUT && !ELLIPSES && !FACE_OF_CUBE && !FINE_PLACES && SUMMED == 3
#define NARROW_SPLATS

// Pixels along both axes of those that are taken as means over pixels, of which an eight of edges
// has seven, and two have fifteen. Both axes of a grain have eight edges together.
#define GRAIN 3
#define SEVEN 7
#define FIFTEEN 15
// Of those that are taken at pixels' centers, two eights of these.
#define SIXTEEN 16
// Where WIDEST_ALONE is less, all beyond seven pixels wait (waiting.cl).
#define MIDDLE_SPLATS (WIDEST_ALONE == SIXTEEN)

// Of windows up to so many pixels all rows are drawn, whether a splat touches them or not.
#if LIGHT_ORDERED
#define WHOLE_WINDOW GRAIN
#else
#define WHOLE_WINDOW SEVEN
#endif

// Kinds of a group (summed_list.cl), by their pixels.
#define SMALLEST GRAIN
#define SMALL SEVEN
typedef struct NarrowSplats {
  int pixels[ROOM_OF_ENTRIES];                          // of the window along both axes, or 0
  int x[ROOM_OF_ENTRIES], y[ROOM_OF_ENTRIES];           // its first pixel
  int columns[ROOM_OF_ENTRIES], rows[ROOM_OF_ENTRIES];  // that the splat touches from there on
  // Its first edges, or centers, from the splat's center, in pixels: widths divide them when an
  // edge may be at the center, which is to stay there.
  float across[ROOM_OF_ENTRIES], along[ROOM_OF_ENTRIES], per_sigma[ROOM_OF_ENTRIES];
  float scale[ROOM_OF_ENTRIES];  // of the product of both axes
} NarrowSplats;

INLINED INTEGER narrow_windows(VALUE sigma, INTEGER pixels, float mean_sigma) {
  const INTEGER of_means = select((INTEGER)(SEVEN), (INTEGER)(GRAIN), pixels <= GRAIN);
#if MIDDLE_SPLATS
  const INTEGER wider = select((INTEGER)(SIXTEEN), (INTEGER)(FIFTEEN), sigma < mean_sigma);
  const INTEGER found = select(wider, of_means, pixels <= SEVEN & sigma < mean_sigma);
  return found & (sigma > 0.0f) & (pixels <= wider);
#else
  return of_means & (sigma > 0.0f) & (pixels <= SEVEN) & (sigma < mean_sigma);
#endif
}

// Of eight entries, numbers `at` and on; returns their pixels.
INLINED INTEGER find_narrow_splats(const EntryLanes lanes, uint at, float mean_sigma,
                                   const EntryWindows* windows, NarrowSplats* narrow) {
  const VALUE sigma = lanes.sigma;
  const INTEGER first_column = load_eight_integers(windows->first_column + at);
  const INTEGER first_row = load_eight_integers(windows->first_row + at);
  const INTEGER last_row = load_eight_integers(windows->last_row + at);
  const INTEGER last_column = load_eight_integers(windows->last_column + at);
  const INTEGER touched = max(last_column - first_column, last_row - first_row) + 1;
  const INTEGER pixels = narrow_windows(sigma, touched, mean_sigma);
  const INTEGER x = min(first_column, TILE_WIDTH - pixels);
  const INTEGER y =
      select(min(first_row, TILE_HEIGHT - pixels), first_row, pixels > (INTEGER)(WHOLE_WINDOW));
  STORE(pixels, narrow->pixels + at);
  STORE(x, narrow->x + at);
  STORE(y, narrow->y + at);
  STORE(last_column - x + 1, narrow->columns + at);
  STORE(last_row - y + 1, narrow->rows + at);
  const VALUE to_first = choose((VALUE)(-0.5f), (VALUE)(0.0f), pixels == SIXTEEN);
  STORE(TO_VALUE(x) + FIRST_X + to_first - lanes.x, narrow->across + at);
  STORE(TO_VALUE(y) + FIRST_Y + to_first - lanes.y, narrow->along + at);
  STORE(1.0f / sigma, narrow->per_sigma + at);
  const VALUE of_means = sigma * sigma * (PIXEL_MEAN_SCALE * PIXEL_MEAN_SCALE);
  STORE(choose(of_means, (VALUE)(1.0f), pixels == SIXTEEN), narrow->scale + at);
  return pixels;
}

typedef struct TwoEights {
  float8 first, second;
} TwoEights;

// Of a grain's three pixels along both axes: the edges of both fit one call.
INLINED TwoEights grain_means(float across, float along, float per_sigma) {
  const float8 first = (float8)((float4)(across), (float4)(along));
  const float8 within = error_function((first + (float8)(0, 1, 2, 3, 0, 1, 2, 3)) * per_sigma);
  const float8 means = within.s12345677 - within;
  TwoEights of_axes;
  of_axes.first = (float8)(means.s012, 0.0f, (float4)(0.0f));
  of_axes.second = (float8)(means.hi, (float4)(0.0f));
  return of_axes;
}

// Means between the edges of seven pixels along both axes, the first of which are so many pixels
// from the center; the eighths are 0.
#if ROWS_OF_16
INLINED TwoEights halves_of(float16 numbers) {
  TwoEights halves;
  halves.first = numbers.lo;
  halves.second = numbers.hi;
  return halves;
}
INLINED TwoEights seven_means_of_axes(float across, float along, float per_sigma) {
  const float16 first = (float16)((float8)(across), (float8)(along));
  const float16 edges = first + (float16)(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
  const float16 within = error_function(edges * per_sigma);
  return halves_of(within.s123456779abcdeff - within);
}
#else
INLINED float8 seven_means_from(float first, float per_sigma) {
  const float8 within = error_function((first + (float8)(0, 1, 2, 3, 4, 5, 6, 7)) * per_sigma);
  return within.s12345677 - within;
}
INLINED TwoEights seven_means_of_axes(float across, float along, float per_sigma) {
  TwoEights of_axes;
  of_axes.first = seven_means_from(across, per_sigma);
  of_axes.second = seven_means_from(along, per_sigma);
  return of_axes;
}
#endif

#if MIDDLE_SPLATS
// The same between fifteen along one axis, the sixteenth of which is 0, and values at sixteen
// centers.
#if ROWS_OF_16
INLINED TwoEights fifteen_means(float first, float per_sigma) {
  const float16 within = error_function((first + PATCH_LANES) * per_sigma);
  return halves_of(within.s123456789abcdeff - within);
}
INLINED TwoEights sixteen_values(float first, float inverse) {
  return halves_of(gaussian(first + PATCH_LANES, inverse));
}
#else
INLINED TwoEights fifteen_means(float first, float per_sigma) {
  const float8 ramp = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  const float8 a = error_function((first + ramp) * per_sigma);
  const float8 b = error_function((first + (ramp + 8.0f)) * per_sigma);
  TwoEights means;
  means.first = (float8)(a.s1234, a.s567, b.s0) - a;
  means.second = b.s12345677 - b;
  return means;
}
INLINED TwoEights sixteen_values(float first, float inverse) {
  const float8 ramp = (float8)(0, 1, 2, 3, 4, 5, 6, 7);
  TwoEights values;
  values.first = gaussian(first + ramp, inverse);
  values.second = gaussian(first + (ramp + 8.0f), inverse);
  return values;
}
#endif

// Both axes of a splat of up to sixteen pixels.
INLINED void fill_middle(const NarrowSplats* narrow, int i, TwoEights* across, TwoEights* along) {
  const float per_sigma = narrow->per_sigma[i];
  if (narrow->pixels[i] == FIFTEEN) {
    *across = fifteen_means(narrow->across[i], per_sigma);
    *along = fifteen_means(narrow->along[i], per_sigma);
  } else {
    const float inverse = 1.44269504f * (per_sigma * per_sigma);
    *across = sixteen_values(narrow->across[i], inverse);
    *along = sixteen_values(narrow->along[i], inverse);
  }
  across->first *= narrow->scale[i];
  across->second *= narrow->scale[i];
}
#endif

#if LIGHT_ORDERED
// Draws it in one window of eight columns, or two.
INLINED void add_narrow_splat(float* tile, const NarrowSplats* narrow, int i,
                              __global const TileSplat* splat, int form) {
  const int pixels = narrow->pixels[i];
  TwoEights across, along;
  across.second = along.second = (float8)(0.0f);
  if (pixels == GRAIN) {
    const TwoEights axes = grain_means(narrow->across[i], narrow->along[i], narrow->per_sigma[i]);
    across.first = axes.first * narrow->scale[i];
    along.first = axes.second;
  }
#if MIDDLE_SPLATS
  else if (pixels > SEVEN) {
    fill_middle(narrow, i, &across, &along);
  }
#endif
  else {
    const TwoEights axes =
        seven_means_of_axes(narrow->across[i], narrow->along[i], narrow->per_sigma[i]);
    across.first = axes.first * narrow->scale[i];
    along.first = axes.second;
  }
  float of_rows[16];
  store_eight(along.first, of_rows);
  store_eight(along.second, of_rows + 8);
  Window window;
  window.x = narrow->x[i];
  window.y = narrow->y[i];
  window.rows = pixels == GRAIN ? GRAIN : narrow->rows[i];
  update_window(tile, &window, across.first, of_rows, splat, form);
#if MIDDLE_SPLATS
  if (pixels <= SEVEN || narrow->columns[i] <= 8) return;
  window.x += 8;
  update_window(tile, &window, across.second, of_rows, splat, form);
#endif
}
#else
#define ADD_ROW                            \
  {                                        \
    const float8 shape = (float8)(*along); \
    ADD_CHANNELS                           \
  }

INLINED void add_grain(float* tile, const NarrowSplats* narrow, int i,
                       __global const TileSplat* splat) {
  float* pixel = tile + narrow->y[i] * ROW + narrow->x[i];
  const TwoEights axes = grain_means(narrow->across[i], narrow->along[i], narrow->per_sigma[i]);
  float of_rows[8];
  store_eight(axes.second, of_rows);
  const float8 across = axes.first * narrow->scale[i];
  const float* along = of_rows;
  SUMMED_CHANNELS
#pragma unroll
  for (int k = 0; k < GRAIN; ++k, ++along, pixel += ROW)
    ADD_ROW
}

// Of at most seven pixels along both axes.
INLINED void add_seven(float* tile, const NarrowSplats* narrow, int i,
                       __global const TileSplat* splat) {
  float* pixel = tile + narrow->y[i] * ROW + narrow->x[i];
  const TwoEights axes =
      seven_means_of_axes(narrow->across[i], narrow->along[i], narrow->per_sigma[i]);
  float of_rows[8];
  store_eight(axes.second, of_rows);
  const float8 across = axes.first * narrow->scale[i];
  // Four rows or seven, without a loop that ends elsewhere for each splat.
  const float* along = of_rows;
  SUMMED_CHANNELS
#pragma unroll
  for (int k = 0; k < FEW_ROWS; ++k, ++along, pixel += ROW)
    ADD_ROW
  if (narrow->rows[i] <= FEW_ROWS) return;
#pragma unroll
  for (int k = FEW_ROWS; k < SEVEN; ++k, ++along, pixel += ROW)
    ADD_ROW
}

#if MIDDLE_SPLATS
#if ROWS_OF_16
#define MIDDLE_CHANNEL(c) const float16 light##c = sixteen * splat->summed[c]
#define ADD_MIDDLE(c)                                     \
  {                                                       \
    float* const to = pixel + c * TILE_PIXELS;            \
    store_patch(load_patch(to) + rows[k] * light##c, to); \
  }
#else
#define MIDDLE_CHANNEL(c)                                 \
  const float8 left##c = across.first * splat->summed[c], \
               right##c = across.second * splat->summed[c]
#define ADD_MIDDLE(c)                                             \
  {                                                               \
    float* const to = pixel + c * TILE_PIXELS;                    \
    store_eight(load_eight(to) + rows[k] * left##c, to);          \
    store_eight(load_eight(to + 8) + rows[k] * right##c, to + 8); \
  }
#endif

// Of up to sixteen pixels along both axes.
INLINED void add_middle_splat(float* tile, const NarrowSplats* narrow, int i,
                              __global const TileSplat* splat) {
  TwoEights across, along;
  fill_middle(narrow, i, &across, &along);
  float rows[16];
  store_eight(along.first, rows);
  store_eight(along.second, rows + 8);
#if ROWS_OF_16
  const float16 sixteen = (float16)(across.first, across.second);
#endif
  MIDDLE_CHANNEL(0);
  MIDDLE_CHANNEL(1);
  MIDDLE_CHANNEL(2);
  float* pixel = tile + narrow->y[i] * ROW + narrow->x[i];
  const int count = narrow->rows[i];
  for (int k = 0; k < count; ++k, pixel += ROW) {
    ADD_MIDDLE(0) ADD_MIDDLE(1) ADD_MIDDLE(2)
  }
}
#endif
#endif
#endif
