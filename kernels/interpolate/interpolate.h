// What host and kernels share of columns between two snapshots: 4-byte members only (grid.h).
#pragma once

// src/between/interpolation.h, ColumnBetween.
typedef struct InterpolateParameters {
  unsigned int in_first;            // particles of the first snapshot
  unsigned int particles;           // those and the ones that appear
  unsigned int particles_of_item;   // per work-item
  unsigned int width;               // values per particle, 1 or 3
  int first_stride, second_stride;  // 0 where one value serves all
  int logarithmic;
  float fraction;
  float vanishing, appearing;  // factors on particles that fade
} InterpolateParameters;

// Of positions, PathNumbers. Strides are 0 where there are no velocities.
typedef struct PathParameters {
  float shift_high[3], shift_low[3];
  float size_high[3], size_low[3], inverse_size[3];
  float lower[3], upper[3];
  float first_rate, second_rate;
  float of_way, of_first_tangent, of_second_tangent;
  float from_first, from_second;
  int is_periodic, is_straight;
  int first_velocity_stride, second_velocity_stride;
} PathParameters;
