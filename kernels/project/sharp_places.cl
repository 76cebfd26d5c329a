// Places of splats so sharp, or so bright, that single precision would show: in extended numbers.

// What a pixel by which its centre is off does to a splat, at most, per sigma (docs/accuracy.md).
static inline VALUE slope_of_peak(VALUE peak) {
  return 0.86f * min(peak, (VALUE)(20.0f));
}

// Faint ones may be a crowd at one place, whose places err alike; its light is allowed for where it
// is above 1 (docs/accuracy.md, "Single precision").
#define LEAST_PEAK_OF_CROWD 0.015f

INLINED INTEGER are_sharp(const ViewLanes view, VALUE sigma, VALUE peak,
                          const ProjectParameters p) {
  const VALUE of_crowd = max(peak, (VALUE)(LEAST_PEAK_OF_CROWD));
  return sigma < p.sharp_width * view.place_error * slope_of_peak(of_crowd);
}

// So many particles may be copies of one.
#define MOST_COPIES 400.0f

#ifdef WIDE_ANGLE
// Of the lanes that are asked for: places, and what widths follow from.
typedef struct PlaceArrays {
  int asked[LANES];
  float x[LANES], x_low[LANES], y[LANES], y_low[LANES], scale[LANES];
#ifdef WIDE_ANGLE
  float cos_latitude[LANES], sine_latitude[LANES];
#endif
} PlaceArrays;

// Hardly any splats are.
SELDOM_CALLED void find_sharp_places(uint i, uint end, const Columns columns,
                                     const ProjectParameters p, const ExtendedParameters e,
                                     PlaceArrays* places) {
  for (uint k = 0; k < LANES && i + k < end; ++k) {
    if (!places->asked[k]) continue;
    const ExtendedPlace place = extended_place(columns.positions + (size_t)(i + k) * 3, p, e);
    if (!place.seen) continue;
    const Extended x = extended_difference(place.x, extended_of(e.middle_x));
    const Extended y = extended_difference(place.y, extended_of(e.middle_y));
    places->x[k] = high_part(x);
    places->x_low[k] = low_part(x);
    places->y[k] = high_part(y);
    places->y_low[k] = low_part(y);
    places->scale[k] = high_part(place.scale);
#ifdef COPIES
    places->cos_latitude[k] = high_part(place.cos_latitude);
    places->sine_latitude[k] = high_part(place.sine_latitude);
#endif
  }
}

// The view of these lanes as well as extended numbers know it.
INLINED ViewLanes sharp_view(ViewLanes view, INTEGER sharp, uint i, uint end, const Columns columns,
                             const ProjectParameters p, const ExtendedParameters e) {
  PlaceArrays places;
  STORE(sharp, places.asked);
  STORE(view.x, places.x);
  STORE(view.x_low, places.x_low);
  STORE(view.y, places.y);
  STORE(view.y_low, places.y_low);
  STORE(view.scale, places.scale);
#ifdef WIDE_ANGLE
  STORE(view.cos_latitude, places.cos_latitude);
  STORE(view.sine_latitude, places.sine_latitude);
#endif
  find_sharp_places(i, end, columns, p, e, &places);
  view.x = LOAD(places.x);
  view.x_low = LOAD(places.x_low);
  view.y = LOAD(places.y);
  view.y_low = LOAD(places.y_low);
  view.scale = LOAD(places.scale);
#ifdef WIDE_ANGLE
  view.cos_latitude = LOAD(places.cos_latitude);
  view.sine_latitude = LOAD(places.sine_latitude);
#endif
  return view;
}
#else
INLINED PairLanes pair_offset(VALUE position, const float* camera) {
  PairLanes rest;
  rest.high = (VALUE)(-camera[1]);
  rest.low = (VALUE)(-camera[2]);
  return sum_of_pairs(exact_sum(position, (VALUE)(-camera[0])), rest);
}

INLINED PairLanes pair_along(const PairLanes* d, const FloatPair* axis) {
  return sum_of_pairs(sum_of_pairs(product_of_pairs(d[0], pair_lanes(axis[0])),
                                   product_of_pairs(d[1], pair_lanes(axis[1]))),
                      product_of_pairs(d[2], pair_lanes(axis[2])));
}

// The view of these lanes as well as pairs know it.
INLINED ViewLanes sharp_view(ViewLanes view, INTEGER sharp, const Vectors position,
                             const ProjectParameters p, const ExtendedParameters e) {
  PairLanes d[3];
  d[0] = pair_offset(position.x, e.position[0]);
  d[1] = pair_offset(position.y, e.position[1]);
  d[2] = pair_offset(position.z, e.position[2]);
  PairLanes scale = pair_lanes(e.pixels_per_length);
  if (p.perspective) {
    PairLanes depth = pair_along(d, e.forward);
    depth.high = max(depth.high, (VALUE)(p.least_depth));
    scale = quotient_of_pairs(scale, depth);
  }
  const PairLanes x = sum_of_pairs(product_of_pairs(pair_along(d, e.right), scale),
                                   pair_lanes(e.center_from_middle_x));
  const PairLanes y = sum_of_pairs(product_of_pairs(pair_along(d, e.down), scale),
                                   pair_lanes(e.center_from_middle_y));
  view.x = choose(view.x, x.high, sharp);
  view.x_low = choose(view.x_low, x.low, sharp);
  view.y = choose(view.y, y.high, sharp);
  view.y_low = choose(view.y_low, y.low, sharp);
  view.scale = choose(view.scale, scale.high, sharp);
  return view;
}
#endif

// Of sharp splats, those that even the integers of splats' places would move too far, or that are
// so bright that single precision of their widths would show where they have faded. Of all in the
// picture: a crop is drawn as it is.
INLINED INTEGER are_too_sharp(const ViewLanes view, VALUE sigma, VALUE own_peak, VALUE crowd_peak,
                              const ProjectParameters p) {
  const VALUE reach = 7.0f * sigma + 2.0f;
  INTEGER in_picture = view.y + reach >= p.seen_top & view.y - reach <= p.seen_bottom;
#ifndef COPIES
  in_picture &= view.x + reach >= p.seen_left & view.x - reach <= p.seen_right_end;
#endif
  // Copies of one may lie upon one another, up to a light of 1 or to what turned out to lie in one
  // place, and are misplaced alike.
  const VALUE all = max(crowd_peak, (VALUE)(1.0f));
  const VALUE of_copies = max(own_peak, min(MOST_COPIES * own_peak, all));
  const VALUE fading = 0.693147181f * log2_positive(max(of_copies, (VALUE)(1.0f)));
  const VALUE slope = choose(0.86f * of_copies, 2.0f * sqrt(fading), of_copies > 2.0f);
  return in_picture & ((sigma < p.too_sharp_width * slope) | (fading > p.most_fading));
}
