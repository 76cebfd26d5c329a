// How a cloud lies on a face of a cube, on VALUEs (lanes.cl): face_ellipse() of
// src/scene/projection.cpp.
#include "kernels/common/common.cl"
#include "kernels/common/lanes.cl"
#include "kernels/project/project.h"

#pragma OPENCL FP_CONTRACT OFF

typedef struct FaceEllipse {
  VALUE squared_width, footprint, secant2;
  VALUE sigma_x, sigma_y;  // of its light along x and y, in pixels
  VALUE narrow, wide;      // of its narrower and its wider side
} FaceEllipse;

INLINED VALUE face_footprint(VALUE squared_width, const ProjectParameters p) {
  const VALUE angle = sqrt(squared_width) / p.pixels_per_length;
  const VALUE u = clamp(24.0f * angle - 1.0f, (VALUE)(0.0f), (VALUE)(1.0f));
  const VALUE of_pixel = max((VALUE)(p.footprint), p.narrowest_squared - squared_width);
  return choose((VALUE)(0.0f), of_pixel * (1.0f - u * u * (3.0f - 2.0f * u)), u < 1.0f);
}

// Of a cloud at these tangents from the face's axis; `sigma` as project_wide_angle() has it.
INLINED FaceEllipse face_ellipse(VALUE sigma, VALUE x, VALUE y, const ProjectParameters p) {
  const VALUE x2 = x * x, y2 = y * y, squared = sigma * sigma;
  FaceEllipse ellipse;
  ellipse.secant2 = 1.0f + (x2 + y2);
  ellipse.squared_width = squared / ellipse.secant2;
  ellipse.footprint = face_footprint(ellipse.squared_width, p);
  const VALUE across = squared + ellipse.footprint;
  ellipse.sigma_x = sqrt(across * (1.0f + x2));
  ellipse.sigma_y = sqrt(across * (1.0f + y2));
  ellipse.narrow = sqrt(across);
  ellipse.wide = sqrt(across * ellipse.secant2);
  return ellipse;
}

// The largest squared secant of a pixel that a splat of this extent, in sigma, reaches: no more
// than that of the corners, nor than the cloud's own and the way there.
INLINED VALUE face_secant2(const FaceEllipse ellipse, VALUE extent, const ProjectParameters p) {
  const VALUE way = extent * ellipse.wide / (p.pixels_per_length * sqrt(ellipse.secant2));
  const VALUE to_here = 1.0f - min(way, (VALUE)(0.999f));
  return min(ellipse.secant2 / (to_here * to_here), (VALUE)(3.0f));
}

// The exponent of the shape is divided by a squared width that grows with the pixel's secant: it
// reaches so many times as far as the ellipse at the cloud's own.
INLINED VALUE face_reach(const FaceEllipse ellipse, VALUE extent, const ProjectParameters p) {
  return sqrt((ellipse.squared_width * face_secant2(ellipse, extent, p) + ellipse.footprint) /
              (ellipse.squared_width * ellipse.secant2 + ellipse.footprint));
}

// What a pixel shows of the cloud's own peak, at most: the footprint leaves the more the farther
// from the face's middle a pixel is.
INLINED VALUE face_part(const FaceEllipse ellipse, VALUE extent, const ProjectParameters p) {
  const VALUE of_cloud = ellipse.squared_width * face_secant2(ellipse, extent, p);
  return of_cloud / (of_cloud + ellipse.footprint);
}
