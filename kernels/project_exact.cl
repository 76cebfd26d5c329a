// The projection of one particle in exact numbers (exact.cl), for tolerance 0. Fields are
// those of project.cl, which finds the bad particles and the sort keys.

typedef struct ExactView {
  Exact x, y, z;
} ExactView;

inline Exact exact_dot(const Exact* d, const FloatPair* axis) {
  return exact_sum(
      exact_sum(exact_product(d[0], exact_pair(axis[0])), exact_product(d[1], exact_pair(axis[1]))),
      exact_product(d[2], exact_pair(axis[2])));
}

inline ExactView exact_view(__global const float* position, const ExactParameters e) {
  Exact d[3];
  for (int axis = 0; axis < 3; ++axis) {
    d[axis] = exact_difference(exact_of(position[axis]), exact_of(e.position[axis][0]));
    d[axis] = exact_difference(d[axis], exact_of(e.position[axis][1]));
    d[axis] = exact_difference(d[axis], exact_of(e.position[axis][2]));
  }
  ExactView view;
  view.x = exact_dot(d, e.right);
  view.y = exact_dot(d, e.down);
  view.z = exact_dot(d, e.forward);
  return view;
}

inline int is_within_limits(Exact z, Exact h, const ProjectParameters p, const ExactParameters e) {
  if (p.perspective && !(high_part(z) > 0.0f)) return 0;
  if (e.has_near_limit) {
    if (exact_less(z, exact_pair(e.near_limit))) return 0;
  } else if (exact_less(z, p.perspective ? exact_product(exact_pair(e.near_factor), h)
                                         : exact_of(0.0f))) {
    return 0;
  }
  return !e.has_far_limit || !exact_less(exact_pair(e.far_limit), z);
}

// In [0, 1] (frame.h, ScalarMap).
inline Exact exact_normalized(float value, int scaling, FloatPair minimum,
                              FloatPair inverse_range) {
  Exact scaled = exact_of(value);
  if (scaling == SCALING_LOG) {
    if (!(value > 0.0f)) return exact_of(0.0f);
    const Exact per_ln10 = exact_constant(4.342944920e-01f, -1.010304995e-08f);
    scaled = exact_product(exact_log(scaled), per_ln10);
  }
  if (scaling == SCALING_ASINH) scaled = exact_asinh(value);
  const Exact place =
      exact_product(exact_difference(scaled, exact_pair(minimum)), exact_pair(inverse_range));
  if (!(high_part(place) > 0.0f)) return exact_of(0.0f);
  return high_part(place) >= 1.0f ? exact_of(1.0f) : place;
}

// w (scene.h, WeightModel), with sigma in world units; weight_scale as in project.cl.
inline Exact exact_column(float raw, Exact h, const ProjectParameters p, const ExactParameters e) {
  const Exact scale = exact_pair(e.weight_scale);
  const Exact length_scale = exact_of(p.length_scale);
  const Exact sigma_scaled =
      exact_product(exact_product(exact_pair(e.kernel_width), h), length_scale);
  if (p.weight_model == WEIGHT_MASS) {
    const Exact once = exact_quotient(exact_product(exact_of(raw), scale), sigma_scaled);
    return exact_quotient(exact_product(once, scale), sigma_scaled);
  }
  if (p.weight_model == WEIGHT_DENSITY) {
    return exact_product(exact_product(exact_of(raw), scale), sigma_scaled);
  }
  return exact_quotient(scale, exact_product(h, length_scale));
}

inline void exact_knots(__global const float* knots, uint first, uint count, Exact position,
                        Exact* color) {
  const Exact place = exact_product(position, exact_of((float)(count - 1u)));
  uint below = min((uint)high_part(place), count - 1u);
  // The high part alone may have been rounded up to the next knot.
  if (below > 0u && exact_less(place, exact_of((float)below))) --below;
  const uint above = min(below + 1u, count - 1u);
  const Exact fraction = exact_difference(place, exact_of((float)below));
  __global const float* a = knots + (size_t)(first + below) * 3;
  __global const float* b = knots + (size_t)(first + above) * 3;
  for (int c = 0; c < 3; ++c) {
    const Exact step = exact_difference(exact_of(b[c]), exact_of(a[c]));
    color[c] = exact_sum(exact_of(a[c]), exact_product(fraction, step));
  }
}

// E w and A w (scene.h, Absorption) at palette position `position`; emission comes with the
// particle's own colour in it.
inline void exact_amplitudes(Exact position, Exact weight, const Exact* own,
                             const ComponentColors colors, __global const float* knots,
                             const ExactParameters e, Exact* emission, Exact* absorption) {
  const Exact bright = exact_product(weight, exact_pair(e.brightness));
  const Exact factor = exact_pair(e.absorption_factor);
  Exact emitted[3], absorbed[3];
  exact_knots(knots, colors.first_knot, colors.knot_count, position, emitted);
  for (int c = 0; c < 3; ++c) absorbed[c] = emitted[c] = exact_product(emitted[c], own[c]);
  if (colors.absorption_knot_count > 0) {
    exact_knots(knots, colors.first_absorption_knot, colors.absorption_knot_count, position,
                absorbed);
  }
  for (int c = 0; c < 3; ++c) {
    emission[c] = exact_product(bright, emitted[c]);
    absorption[c] = exact_product(bright, absorbed[c]);
    if (colors.absorption_kind == ABSORPTION_NONE) absorption[c] = exact_of(0.0f);
    if (colors.absorption_kind == ABSORPTION_FACTOR) {
      absorption[c] = exact_product(exact_product(weight, factor), absorbed[c]);
    }
    if (colors.absorption_kind == ABSORPTION_GRAY) {
      absorption[c] = emission[c];
      if (high_part(emission[c]) > 0.0f) {
        const Exact share = exact_quotient(emission[c], exact_sum(emission[c], factor));
        emission[c] = exact_product(emission[c], share);
      }
    }
  }
}

// How many sigma are drawn so that no sum of all of the frame's splats leaves out more than
// the truncation's share.
inline float exact_extent(float peak, const ExactParameters e) {
  return sqrt(log(max(peak * e.inverse_share, 1.0f))) + 1e-3f;
}

// False if the particle is not in the picture.
inline int exact_splat(uint i, const ProjectParameters p, const ExactParameters e,
                       __global const Grid* grids, __global const float* positions,
                       __global const float* smoothing_lengths, __global const float* weights,
                       __global const float* colors, __global const float* intensities,
                       __global const float* color_vectors,
                       __global const ComponentColors* component_colors,
                       __global const float* knots, Splat* splat, ExactSplat* exact) {
  const ExactView view = exact_view(positions + (size_t)i * 3, e);
  const Exact raw_h = exact_of(smoothing_lengths[(size_t)i * p.smoothing_length_stride]);
  const Exact h = exact_product(raw_h, exact_pair(e.size_factor));
  if (!is_within_limits(view.z, h, p, e)) return 0;

  Exact scale = exact_pair(e.pixels_per_length);
  if (p.perspective) scale = exact_quotient(scale, view.z);
  const Exact x = exact_sum(exact_pair(e.center_x), exact_product(view.x, scale));
  const Exact y = exact_sum(exact_pair(e.center_y), exact_product(view.y, scale));
  const Exact width = exact_pair(e.kernel_width);
  const Exact h_pixels = exact_product(h, scale);
  Exact h_drawn = h_pixels;
  Exact weight =
      exact_column(weights[(size_t)i * p.weight_stride], h, p, e);
  if (p.min_radius > 0.0f) {
    const Exact least = exact_pair(e.min_radius);
    h_drawn = exact_root(exact_sum(exact_product(h_pixels, h_pixels), exact_product(least, least)));
    weight = exact_product(weight, exact_quotient(h_pixels, h_drawn));
  }
  const Exact sigma = exact_product(width, h_drawn);
  weight = exact_product(
      weight, exact_normalized(intensities[(size_t)i * p.intensity_stride], p.intensity.scaling,
                               e.intensity_minimum, e.intensity_inverse_range));

  Exact own[3];
  for (int c = 0; c < 3; ++c) {
#ifdef VECTOR_COLORS
    own[c] = exact_of(color_vectors[p.color_vector_stride == 0 ? 0 : (size_t)i * 3 + c]);
#else
    own[c] = exact_of(1.0f);
#endif
  }
  Exact emission[3], absorption[3];
  const Exact position = exact_normalized(colors[(size_t)i * p.color_stride], p.color.scaling,
                                          e.color_minimum, e.color_inverse_range);
  exact_amplitudes(position, weight, own, component_colors[p.component], knots, e, emission,
                   absorption);

  float peak = 0.0f;
  for (int c = 0; c < 3; ++c) {
    peak = max(peak, max(high_part(emission[c]), high_part(absorption[c])));
#ifdef LIGHT_EMISSION
    exact->light[c] = pair_of(emission[c]);
#else
    exact->light[c] = pair_of(absorption[c]);
#endif
    exact->emission[c] = pair_of(emission[c]);
  }
  const float sigma_high = high_part(sigma);
  // The flux, not the peak, limits what a grain below a pixel can do to a pixel.
  const float extent = exact_extent(peak * min(1.0f, 3.2f * sigma_high * sigma_high), e);
#ifdef KERNEL_CUT
  const Exact cut = exact_product(exact_pair(e.kernel_cut), sigma);
  exact->cut = pair_of(cut);
  exact->radius = min(extent * sigma_high, high_part(cut) * 1.000001f);
#else
  exact->cut = pair_of(exact_of(0.0f));
  exact->radius = extent * sigma_high;
#endif
#ifdef SAMPLING_MEAN
  exact->radius += 0.5f;
#endif
  exact->x = pair_of(x);
  exact->y = pair_of(y);
  exact->sigma = pair_of(sigma);

  splat->weight = high_part(weight);
  splat->color = high_part(position);
  splat->x = high_part(x);
  splat->y = high_part(y);
  splat->sigma = sigma_high;
  // Tiles are chosen by rounded numbers: with room for that.
  splat->radius = exact->radius * 1.000001f + 2e-7f * (fabs(splat->x) + fabs(splat->y));
  const float picture_width = (float)grids[0].width, picture_height = (float)grids[0].height;
  return splat->x + splat->radius >= 0.0f && splat->x - splat->radius <= picture_width &&
         splat->y + splat->radius >= 0.0f && splat->y - splat->radius <= picture_height;
}
