// What clouds emit and absorb, in single precision or, in extended, double (project.h).
#include "kernels/common/common.cl"
#include "kernels/common/splat.h"
#include "kernels/project/project.h"

#if DOUBLE_VALUES
#define REAL3 double3
#define REAL4 double4
#define TO_REAL4 convert_double4
#else
#define REAL3 float3
#define REAL4 float4
#define TO_REAL4(color) (color)
#endif

// A position is in [0, 1], so that the knot below is one of them. Behind the last there is one more
// in memory, of which nothing is taken. Vectors, since what a loop writes to an array goes through
// memory in pieces, which a processor cannot forward to the copy of the whole entry.
INLINED REAL3 sample_knots(__global const float* knots, uint first, REAL last, REAL position) {
  const REAL place = position * last;
  const int below = (int)place;
  __global const float* at = knots + (size_t)(first + (uint)below) * KNOT_FLOATS;
  const REAL4 color = TO_REAL4(vload4(0, at)), above = TO_REAL4(vload4(1, at));
  return (color + (place - (REAL)below) * (above - color)).xyz;
}

// Numbers are converted as signed ones, which most processors do in one step.
INLINED REAL last_of(uint knots) {
  return (REAL)(int)(knots - 1u);
}

typedef struct Amplitudes {
  REAL3 emission, absorption;
} Amplitudes;

// What they follow from, beside a component's palettes.
typedef struct Paint {
  REAL position, weight, brightness, absorption_factor;
  REAL3 own_color;
} Paint;

// E w and A w at the cloud's centre (scene.h, Absorption), where gray absorption has taken nothing
// yet.
INLINED Amplitudes amplitudes_of(const Paint paint, const ComponentColors colors,
                                 __global const float* knots) {
  REAL3 emitted =
      sample_knots(knots, colors.first_knot, last_of(colors.knot_count), paint.position);
  if (VECTOR_COLORS) emitted *= paint.own_color;
  REAL3 absorbed = emitted;
  if (colors.absorption_knot_count > 0) {
    absorbed = sample_knots(knots, colors.first_absorption_knot,
                            last_of(colors.absorption_knot_count), paint.position);
  }
  Amplitudes found;
  found.emission = paint.weight * paint.brightness * emitted;
  found.absorption = paint.weight * paint.brightness * absorbed;
  if (colors.absorption_kind == ABSORPTION_NONE) found.absorption = (REAL3)(0.0f);
  if (colors.absorption_kind == ABSORPTION_FACTOR)
    found.absorption = paint.weight * paint.absorption_factor * absorbed;
  if (colors.absorption_kind == ABSORPTION_GRAY) found.absorption = found.emission;
  return found;
}

// What gray absorption leaves of the emission; `own` is the cloud's own.
INLINED void absorb_gray(Amplitudes* found, REAL3 own, REAL factor) {
  const REAL3 emitted_part = own / (own + factor);
  found->emission = own > 0.0f ? found->emission * emitted_part : (REAL3)(0.0f);
}
