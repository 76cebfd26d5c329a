// How much of what lies behind a pixel's layers they take away, as planes carry it, on VALUEs
// (lanes.cl, lanes_of_16.cl, extended_layers.cl): the opacity 1 - exp(-depth), which keeps depths
// of 1e-8. With KEEP_TRANSMITTANCE, where sources may be so bright that they show through an
// opacity close to 1, minus the transmittance from an opacity of one half on: it keeps its own
// digits.
#include "kernels/common/common.cl"

#if KEEP_TRANSMITTANCE
OVERLOADED static inline VALUE opacity_of(VALUE carried) {
  return carried + (carried < 0.0f ? (VALUE)(1.0f) : (VALUE)(0.0f));
}

OVERLOADED static inline VALUE transmittance_of(VALUE carried) {
  return carried < 0.0f ? -carried : 1.0f - carried;
}

// What is carried behind one more layer, which takes `taken` of all light away and leaves
// `left` of it: either may be rounded where the other counts. The smallest float stands for
// nothing at all, which has no sign.
OVERLOADED static inline VALUE carry(VALUE carried, VALUE taken, VALUE left) {
  // Differences of the error function may be negative by their error: the sign is taken.
  const VALUE opacity = max(carried + taken, (VALUE)(0.0f));
  return (carried >= 0.0f & opacity < 0.5f) ? opacity : -max(left, (VALUE)(1.17549435e-38f));
}
#else
OVERLOADED static inline VALUE opacity_of(VALUE carried) {
  return carried;
}
OVERLOADED static inline VALUE transmittance_of(VALUE carried) {
  return 1.0f - carried;
}
OVERLOADED static inline VALUE carry(VALUE carried, VALUE taken, VALUE left) {
  return carried + taken;
}
#endif

// What is carried when layers that were put together by themselves come behind others, of which
// `transmittance` is let through.
OVERLOADED static inline VALUE carry_behind(VALUE carried, VALUE transmittance, VALUE behind) {
  return carry(carried, transmittance * opacity_of(behind),
               transmittance * transmittance_of(behind));
}
