// What is known of a block of particles wherever the camera stands: the box around the good ones,
// and how many are bad. A work-item walks one block.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/load.cl"
#include "kernels/project/project.h"

typedef struct BoxLanes {
  Vectors lower, upper;
  VALUE largest_h;
} BoxLanes;

INLINED void take_in(VALUE value, INTEGER good, VALUE* lower, VALUE* upper) {
  *lower = choose(*lower, min(*lower, value), good);
  *upper = choose(*upper, max(*upper, value), good);
}

static inline float least_of(VALUE values) {
  float lanes[LANES];
  STORE(values, lanes);
  float least = lanes[0];
  for (uint k = 1; k < LANES; ++k)
    least = min(least, lanes[k]);
  return least;
}

__kernel void find_boxes(const ProjectParameters p, COLUMN_PARAMETERS, __global BlockBox* boxes) {
  const Columns columns = TAKEN_COLUMNS;
  const uint block = get_global_id(0);
  const uint begin = p.launch.first_particle + block * p.launch.block_particles;
  const uint end = min(begin + p.launch.block_particles, p.launch.end_particle);
  if (begin >= end) return;
  BoxLanes box;
  box.lower.x = box.lower.y = box.lower.z = (VALUE)(INFINITY);
  box.upper.x = box.upper.y = box.upper.z = (VALUE)(-INFINITY);
  box.largest_h = (VALUE)(0.0f);
  uint bad = 0;
  for (uint i = begin; i < end; i += LANES) {
    const ParticleLanes particles = load_particles(columns, i, end, p);
    const INTEGER good = particles.exists & are_good(particles, particles.position);
    take_in(particles.position.x, good, &box.lower.x, &box.upper.x);
    take_in(particles.position.y, good, &box.lower.y, &box.upper.y);
    take_in(particles.position.z, good, &box.lower.z, &box.upper.z);
    box.largest_h = choose(box.largest_h, max(box.largest_h, particles.h), good);
    int is_good[LANES];
    STORE(good, is_good);
    for (uint k = 0; k < LANES; ++k)
      bad += i + k < end && is_good[k] == 0 ? 1 : 0;
  }
  BlockBox found;
  found.lower[0] = least_of(box.lower.x);
  found.lower[1] = least_of(box.lower.y);
  found.lower[2] = least_of(box.lower.z);
  found.upper[0] = -least_of(-box.upper.x);
  found.upper[1] = -least_of(-box.upper.y);
  found.upper[2] = -least_of(-box.upper.z);
  found.largest_h = -least_of(-box.largest_h);
  found.bad = bad;
  boxes[block] = found;
}
