// What host and kernels share of compositing: 4-byte members only (splat.h).
#ifndef SPLOTCHCL_COMPOSITE_H
#define SPLOTCHCL_COMPOSITE_H

struct CompositeParameters {
  unsigned int grid_count;
  unsigned int first_segment, end_segment;
  float phi_short;   // optical depth up to which two terms of phi's series serve
  float phi_series;  // and four
  float stop;        // where every pixel's transmittance is at most this; below 0: never
};

#ifdef __OPENCL_VERSION__
typedef struct CompositeParameters CompositeParameters;
#endif

#endif
