// wide_angle_point.cl in double precision, for sharp splats (sharp_places.cl). What comes after
// lanes.cl has VALUE as that says.
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define VALUE double
#define INTEGER int
#define choose(if_false, if_true, mask) ((mask) ? (if_true) : (if_false))
#define WideAnglePoint ExactPoint
#define turn turn_exactly
#define project_wide_angle project_exactly
#undef REAL
#define REAL double

#include "kernels/project/wide_angle_point.cl"

#undef choose
#undef WideAnglePoint
#undef turn
#undef project_wide_angle
#undef REAL
#define REAL float
