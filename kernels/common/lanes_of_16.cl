// Sixteen numbers at a time, for what wide rows take of formulas on VALUEs. What comes after
// lanes.cl takes as many as that says, with the same names.
#define VALUE float16
#define INTEGER int16
#define AS_VALUE as_float16
#define AS_INTEGER as_int16

#include "kernels/composite/gaussian.cl"
#include "kernels/composite/opacity.cl"
