// What host and kernels share of clearing memory: 4-byte members only (grid.h).
#ifndef SPLOTCHCL_CLEAR_H
#define SPLOTCHCL_CLEAR_H

// Words of four bytes that a work-item clears: enough to be worth a thread's turn.
#define CLEARED_WORDS 16384

struct ClearParameters {
  unsigned int first_low, first_high;  // the first word
  unsigned int words;
};

#ifdef __OPENCL_VERSION__
typedef struct ClearParameters ClearParameters;
#endif

#endif
