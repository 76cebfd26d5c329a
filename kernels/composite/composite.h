// What host and kernels share of compositing: 4-byte members only (splat.h).
#ifndef SPLOTCHCL_COMPOSITE_H
#define SPLOTCHCL_COMPOSITE_H

struct CompositeParameters {
  unsigned int grid_count;
  unsigned int first_segment, end_segment;
  float phi_short;   // optical depth up to which two terms of phi's series serve,
  float phi_third;   // three,
  float phi_series;  // and four
  float stop;        // where every pixel's transmittance is at most this; below 0: never
};

// Of a layer that is put behind the planes of the picture's own grid (behind.cl).
struct BehindParameters {
  int width, height;   // of the crop
  int crop_x, crop_y;  // in the picture
};

// Of planes that are added to others (add_light.cl).
struct AddLightParameters {
  unsigned int first_low, first_high;  // float of the first plane, 64 bits
  unsigned int plane_floats;           // of each
};

#ifdef __OPENCL_VERSION__
typedef struct AddLightParameters AddLightParameters;
typedef struct CompositeParameters CompositeParameters;
typedef struct BehindParameters BehindParameters;
#endif

#endif
