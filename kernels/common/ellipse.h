// What splats have beside a width where they are no discs: 4-byte members only (grid.h).
#pragma once

// Splats of equirectangular pictures are wider than high: x and y have widths of their own.
typedef struct WidthAlongX {
  float sigma, radius;  // pixels
} WidthAlongX;

// Of a splat on a face of a cube (src/scene/projection.h, FaceEllipse).
typedef struct Tilt {
  float squared_width, footprint;
  float inverse_secant2;  // times log2(e)
  float scale;            // squared_width over `part` of the splat
} Tilt;

#if ELLIPSES
#define SIGMA_X(splat) ((splat).along_x.sigma)
#define RADIUS_X(splat) ((splat).along_x.radius)
#else
#define SIGMA_X(splat) ((splat).sigma)
#define RADIUS_X(splat) ((splat).radius)
#endif
