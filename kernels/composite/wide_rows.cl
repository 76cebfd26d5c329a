// Rows of sixteen pixels, for processors whose registers hold as many: a splat that is wider than
// eight pixels takes half as many steps. For what most of them are, sums and thin layers, and to
// the same bits as rows of eight (composite_rows.cl).
#ifdef ROWS_OF_16
#ifdef __clang__
typedef float16 __attribute__((aligned(4))) Sixteen;
#define load_sixteen(p) (*(const Sixteen*)(p))
#define store_sixteen(v, p) (*(Sixteen*)(p) = (v))
#else
#define load_sixteen(p) vload16(0, p)
#define store_sixteen(v, p) vstore16(v, 0, p)
#endif

#ifdef CUT_BY_ROWS
DEFINE_CUT_SHAPE(cut_shape_of_16, float16, int16)
#else
#define cut_shape_of_16(shape, dx, dy, limit, squeeze) (shape)
#endif

#define LAYER_ROWS_OF_16(COVERED)                                                                  \
  for (int k = 0; k < rows; ++k, pixel += ROW) {                                                   \
    const float16 product = NOT_NEGATIVE(across * along[k]);                                       \
    const float16 shape = cut_shape_of_16(product, dx, dy + (float)k, along[LIMITS + k], squeeze); \
    THIN_LAYER(COVERED, float16, load_sixteen, store_sixteen)                                      \
  }

// update_window() (rows.cl) of a window that is sixteen pixels wide.
INLINED void update_rows_of_16(float* tile, const Window* window, float16 across,
                               const float* along, __global const TileSplat* splat, int form) {
#ifdef CUT_BY_ROWS
  const float16 dx = (float)window->x + FIRST_X - splat->x +
                     (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15) -
                     LOW_X(*splat);
  const float dy = (float)window->y + FIRST_Y - splat->y - LOW_Y(*splat);
  const float squeeze = cut_radius(splat->radius) / cut_radius(RADIUS_X(*splat));
#endif
  const int rows = window->rows;
  float* pixel = tile + window->y * ROW + window->x;
#ifdef LIGHT_ORDERED
  const float16 absorption0 = splat->absorption[0], emission0 = splat->emission[0];
  const float16 absorption1 = splat->absorption[1], emission1 = splat->emission[1];
  const float16 absorption2 = splat->absorption[2], emission2 = splat->emission[2];
  if (form == BY_ONE_TERM) {
    LAYER_ROWS_OF_16(COVERED_BY_ONE_TERM)
  } else if (form == BY_TWO_TERMS) {
    LAYER_ROWS_OF_16(COVERED_BY_TWO_TERMS)
  } else {
    LAYER_ROWS_OF_16(COVERED_BY_THREE_TERMS)
  }
#else
  SUMMED_CHANNELS(float16)
  for (int k = 0; k < rows; ++k, pixel += ROW) {
    const float16 shape =
        cut_shape_of_16((float16)(along[k]), dx, dy + (float)k, along[LIMITS + k], squeeze);
    ADD_CHANNELS(load_sixteen, store_sixteen)
  }
#endif
}

// A call, and its argument tells the compiler that it may use registers of sixteen floats, from
// which it keeps away otherwise.
__attribute__((noinline)) static void update_window_of_16(float* tile, const Window* window,
                                                          float16 across, const float* along,
                                                          __global const TileSplat* splat,
                                                          int form) {
  update_rows_of_16(tile, window, across, along, splat, form);
}

// Whether rows of sixteen serve for a splat's layer.
static inline int takes_rows_of_16(int form) {
#ifdef LIGHT_ORDERED
  return form <= BY_THREE_TERMS;
#else
  return 1;
#endif
}
#endif
