// Clouds around the camera in tiles' lists (composite.h), for both shapes: their columns in pixels,
// on VALUEs (lanes.cl).
#include "kernels/common/common.cl"
#include "kernels/common/grid.h"
#include "kernels/common/lanes.cl"
#include "kernels/composite/composite.h"
#include "kernels/composite/gaussian.cl"
#include "kernels/composite/shape.cl"

// Of all tiles. Hardly any frame has some.
typedef struct CloudTables {
  __global const CloudEntry* entries;
  __global const CloudSplat* splats;
  __global const float* directions;
  __global const DirectionCone* cones;
} CloudTables;

#ifdef LANES_8
#define PIXEL_RAMP (float8)(0, 1, 2, 3, 4, 5, 6, 7)
#else
#define PIXEL_RAMP 0.0f
#endif

// What a tile's list needs of them.
typedef struct TileClouds {
  __global const CloudEntry* entries;
  __global const CloudSplat* splats;
  // Of the tile's first pixel; planes and rows as the picture's grid has them.
  __global const float* directions;
  size_t plane, stride;
  DirectionCone cone;
  float x, y;  // the first pixel's center, from the middle of the picture's grid
} TileClouds;

INLINED int is_cloud(float sigma) {
  return sigma <= -CLOUD_SIGMA;
}

INLINED __global const CloudEntry* cloud_of(float sigma, const TileClouds* tile) {
  return tile->entries + ((uint)(sigma * (-1.0f / CLOUD_SIGMA)) - 1u);
}

// Directions beyond a right angle find no more than exp(-D^2) / 2. With some room for roundings.
INLINED int ray_touches(__global const CloudEntry* cloud, const DirectionCone cone) {
  const float farthest2 = cloud->farthest2 + 0.2f;
  if (cloud->distance2 <= farthest2) return 1;
  const float along = cloud->center[0] * cone.direction[0] + cloud->center[1] * cone.direction[1] +
                      cloud->center[2] * cone.direction[2];
  const float beside = sqrt(max(cloud->distance2 - along * along, 0.0f));
  const float nearest_beside = beside * cone.cosine - along * cone.sine;
  const float nearest_along = along * cone.cosine + beside * cone.sine;
  return nearest_beside <= 0.0f ||
         (nearest_along > 0.0f && nearest_beside * nearest_beside <= farthest2);
}

INLINED float beyond(float first, float last, float place) {
  return max(max(first - place, place - last), 0.0f);
}

INLINED int splat_touches(__global const CloudSplat* splat, float farthest2,
                          const TileClouds* tile) {
  const float dx = beyond(tile->x, tile->x + (TILE_WIDTH - 1), splat->x) * splat->inverse_x;
  const float dy = beyond(tile->y, tile->y + (TILE_HEIGHT - 1), splat->y) * splat->inverse_y;
  return dx * dx + dy * dy <= farthest2;
}

INLINED int cloud_touches(__global const CloudEntry* cloud, const TileClouds* tile) {
  if (ray_touches(cloud, tile->cone)) return 1;
  for (uint s = cloud->first_splat; s < cloud->end_splat; ++s) {
    if (splat_touches(tile->splats + s, cloud->farthest2, tile)) return 1;
  }
  return 0;
}

// (1 + erf(t)) / 2, of which bright clouds need all digits where it is small.
INLINED VALUE part_in_front(VALUE t, int is_bright) {
  if (!is_bright) return max(0.5f + 0.5f * error_function(t), (VALUE)(0.0f));
  const VALUE half_beyond = 0.5f * complement_of_erf(fabs(t));
  return choose(half_beyond, 1.0f - half_beyond, t >= 0.0f);
}

// What rays in these directions find. Farther than four sigma before the camera all of the cloud
// is in front, to 1e-8.
INLINED VALUE column_of_ray(__global const CloudEntry* cloud, VALUE dx, VALUE dy, VALUE dz) {
  const float x = cloud->center[0], y = cloud->center[1], z = cloud->center[2];
  const VALUE t = x * dx + y * dy + z * dz;
  const VALUE bx = x - t * dx, by = y - t * dy, bz = z - t * dz;
  const VALUE beside2 = bx * bx + by * by + bz * bz;
  const INTEGER shows = beside2 <= cloud->farthest2;
  if (!ANY(shows)) return (VALUE)(0.0f);
  VALUE column = exp2_negative(beside2 * -1.44269504f);
  if (ANY(t < 4.0f)) column *= part_in_front(t, cloud->is_bright);
  return choose((VALUE)(0.0f), cloud->ray * column, shows);
}

// The mean of exp(-u^2) over a pixel, of its value at the center: from derivatives there, for
// splats of four pixels and more. The next term is below 3.8e-4 / sigma^6.
INLINED VALUE mean_of_value(VALUE u2, float inverse2) {
  const VALUE next = (u2 * (4.0f * u2 - 12.0f) + 3.0f) * (1.0f / 480.0f);
  return 1.0f + inverse2 * ((u2 - 0.5f) * (1.0f / 6.0f) + inverse2 * next);
}

// (x, y) from the middle of the picture's grid.
INLINED VALUE column_of_splat(__global const CloudSplat* splat, float farthest2, VALUE x, float y) {
  const VALUE dx = (x - splat->x) * splat->inverse_x;
  const float dy = (y - splat->y) * splat->inverse_y;
  const VALUE x2 = dx * dx;
  const float y2 = dy * dy;
  const INTEGER shows = x2 + y2 <= farthest2;
  if (!ANY(shows)) return (VALUE)(0.0f);
  const VALUE value = exp2_negative((x2 + y2) * -1.44269504f) * splat->part;
  if (splat->mean_x == 0.0f) return choose((VALUE)(0.0f), value, shows);
  const VALUE mean = mean_of_value(x2, splat->mean_x) * mean_of_value((VALUE)(y2), splat->mean_y);
  return choose((VALUE)(0.0f), value * mean, shows);
}

// Of a central column of 1, in pixels of the tile from (x, y) on.
INLINED VALUE column_of_cloud(__global const CloudEntry* cloud, const TileClouds* tile, int x,
                              int y) {
  __global const float* direction = tile->directions + (size_t)y * tile->stride + x;
  VALUE column = column_of_ray(cloud, LOAD(direction), LOAD(direction + tile->plane),
                               LOAD(direction + 2 * tile->plane));
  for (uint s = cloud->first_splat; s < cloud->end_splat; ++s) {
    column += column_of_splat(tile->splats + s, cloud->farthest2, tile->x + (float)x + PIXEL_RAMP,
                              tile->y + (float)y);
  }
  return column;
}

INLINED TileClouds clouds_of_tile(const CloudTables clouds, const Grid grid, uint tile) {
  const uint in_grid = tile - grid.first_tile;
  const int left = (int)(in_grid % (uint)grid.tiles_x) * TILE_WIDTH;
  const int top = (int)(in_grid / (uint)grid.tiles_x) * TILE_HEIGHT;
  TileClouds of;
  of.entries = clouds.entries;
  of.splats = clouds.splats;
  of.directions = clouds.directions + (size_t)top * grid.stride + left;
  of.plane = grid.plane_size;
  of.stride = grid.stride;
  of.cone = clouds.cones[in_grid];
  of.x = (float)(grid.first_x + left - grid.middle_x) + 0.5f;
  of.y = (float)(grid.first_y + top - grid.middle_y) + 0.5f;
  return of;
}
