// The fields of LANES particles, as memory holds them.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/project.h"

// LANES values from index i on; those from `end` on repeat the last one, since a mapped
// file may end with its last value. Stride 0: one value for all.
static inline VALUE load_values(__global const float* values, uint i, uint end, int stride) {
  if (stride == 0) return (VALUE)(values[0]);
#if LANES > 1
  if (i + LANES > end) {
    float lanes[LANES];
    for (uint k = 0; k < LANES; ++k)
      lanes[k] = values[min(i + k, end - 1)];
    return LOAD(lanes);
  }
#endif
  return LOAD(values + i);
}

typedef struct Vectors {
  VALUE x, y, z;
} Vectors;

INLINED Vectors load_vectors(__global const float* vectors, uint i, uint end) {
  Vectors v;
#if LANES > 1
  if (i + LANES <= end) {
    __global const float* first = vectors + (size_t)i * 3;
#if LANES == 16
    const float16 a = vload16(0, first), b = vload16(1, first), c = vload16(2, first);
    v.x = (float16)(a.s0369, a.scf, b.s258b, b.se, c.s147a, c.sd);
    v.y = (float16)(a.s147a, a.sd, b.s0369, b.scf, c.s258b, c.se);
    v.z = (float16)(a.s258b, a.se, b.s147a, b.sd, c.s0369, c.scf);
#else
    const float8 a = vload8(0, first), b = vload8(1, first), c = vload8(2, first);
    v.x = (float8)(a.s036, b.s147, c.s25);
    v.y = (float8)(a.s147, b.s25, c.s036);
    v.z = (float8)(a.s25, b.s036, c.s147);
#endif
    return v;
  }
  float x[LANES], y[LANES], z[LANES];
  for (uint k = 0; k < LANES; ++k) {
    __global const float* vector = vectors + (size_t)min(i + k, end - 1) * 3;
    x[k] = vector[0];
    y[k] = vector[1];
    z[k] = vector[2];
  }
  v.x = LOAD(x);
  v.y = LOAD(y);
  v.z = LOAD(z);
#else
  v.x = vectors[(size_t)i * 3];
  v.y = vectors[(size_t)i * 3 + 1];
  v.z = vectors[(size_t)i * 3 + 2];
#endif
  return v;
}

INLINED Vectors load_colors(__global const float* colors, uint i, uint end, int stride) {
  if (stride != 0) return load_vectors(colors, i, end);
  Vectors same;
  same.x = same.y = same.z = (VALUE)(colors[0]);
  return same;
}

// The columns of one component.
typedef struct Columns {
  __global const float *positions, *smoothing_lengths, *weights, *colors, *intensities,
      *sort_fields, *own_colors;
} Columns;

// As kernels take them.
#define COLUMN_PARAMETERS                                                   \
  __global const float *positions, __global const float *smoothing_lengths, \
      __global const float *weights, __global const float *colors,          \
      __global const float *intensities, __global const float *sort_fields, \
      __global const float *own_colors
#define TAKEN_COLUMNS \
  { positions, smoothing_lengths, weights, colors, intensities, sort_fields, own_colors }

typedef struct ParticleLanes {
  INTEGER exists;
  Vectors position;
  VALUE h, weight, color, intensity, sort_field;
  Vectors own_color;  // of vector colors
} ParticleLanes;

#if LANES > 1
// Columns are read once, from front to back, but several of them, and hardware asks for no line
// beyond a page. So many particles ahead.
#define PARTICLES_AHEAD 256
INLINED void ask_for_particles(const Columns columns, uint i, const ProjectParameters p) {
  const uint ahead = i + PARTICLES_AHEAD;
  ask_for(columns.positions + (size_t)ahead * 3);
  ask_for(columns.positions + (size_t)ahead * 3 + 16);
#if LANES == 16
  ask_for(columns.positions + (size_t)ahead * 3 + 32);
#endif
  ask_for(columns.smoothing_lengths + (size_t)ahead * p.launch.smoothing_length_stride);
  ask_for(columns.colors + (size_t)ahead * p.launch.color_stride);
}
#endif

// Particles from i on; those at or beyond `end` do not exist.
INLINED ParticleLanes load_particles(const Columns columns, uint i, uint end,
                                     const ProjectParameters p) {
  ParticleLanes particles;
#if LANES > 1
  ask_for_particles(columns, i, p);
  particles.exists = NUMBERS_OF_LANES < (INTEGER)(int)(end - i);
#else
  particles.exists = 1;
#endif
  particles.h = load_values(columns.smoothing_lengths, i, end, p.launch.smoothing_length_stride);
  particles.weight = load_values(columns.weights, i, end, p.launch.weight_stride);
  particles.color = load_values(columns.colors, i, end, p.launch.color_stride);
  particles.intensity = load_values(columns.intensities, i, end, p.launch.intensity_stride);
  particles.sort_field = load_values(columns.sort_fields, i, end, p.launch.sort_stride);
  particles.position = load_vectors(columns.positions, i, end);
  if (VECTOR_COLORS)
    particles.own_color = load_colors(columns.own_colors, i, end, p.launch.own_color_stride);
  return particles;
}

static inline INTEGER is_finite(VALUE v) {
  return fabs(v) <= FLT_MAX;
}
static inline INTEGER is_color(VALUE v) {
  return v >= 0.0f & v <= FLT_MAX;
}

// What reference::count_bad counts is not good; `offset` is the position less the camera's. Zero
// times a number is zero, times anything else it is not: one comparison for all that are to be
// finite.
INLINED INTEGER are_good(const ParticleLanes particles, const Vectors offset) {
  const VALUE nothing = offset.x * 0.0f + offset.y * 0.0f + offset.z * 0.0f + particles.h * 0.0f +
                        particles.weight * 0.0f + particles.color * 0.0f +
                        particles.intensity * 0.0f + particles.sort_field * 0.0f;
  INTEGER good = nothing == 0.0f & particles.h > 0.0f & particles.weight >= 0.0f;
  if (!VECTOR_COLORS) return good;
  return good & is_color(particles.own_color.x) & is_color(particles.own_color.y) &
         is_color(particles.own_color.z);
}
