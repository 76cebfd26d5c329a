// The colors of splats: what they emit and absorb at the center.

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
// A cloud's own amplitude over that of its splat, which is widened where center values are taken,
// and narrower on a coarse grid that is blurred afterwards.
INLINED float own_part(const Splat splat, const BinParameters p) {
#ifdef FACE_OF_CUBE
  return 1.0f / splat.part;
#elif defined(ELLIPSES)
  const float drawn2 = splat.sigma * splat.sigma;
  const float across2 = splat.along_x.sigma * splat.along_x.sigma;
  float restored = splat.sigma < p.mean_sigma ? 1.0f : drawn2 / (drawn2 - p.widening);
  restored *= splat.along_x.sigma < p.mean_sigma ? 1.0f : across2 / (across2 - p.widening);
  return sqrt(restored);
#else
  const float drawn2 = splat.sigma * splat.sigma;
  const uint grid = grid_of(splat);
  if (grid == 0) return splat.sigma < p.mean_sigma ? 1.0f : drawn2 / (drawn2 - p.widening);
  const uint level = p.blur[0] > 0.0f ? (grid + 1) >> 1 : grid;
  const float wide2 = drawn2 + p.blur[(grid & 1) == 0];
  const float in_picture2 = wide2 * as_float((127u + 2u * level) << 23);
  return drawn2 / wide2 * (in_picture2 / (in_picture2 - p.widening));
#endif
}

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
      const float own = emission[c] * own_part(splat, p);
      absorption[c] = emission[c];
      emission[c] *= own > 0.0f ? own / (own + colors.absorption_factor) : 0.0f;
    }
  }
}
#endif
