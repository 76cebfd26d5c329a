// What host and kernels share of clearing memory: 4-byte members only (grid.h).
#pragma once

// Words of four bytes that a work-item clears: enough to be worth a thread's turn.
#define CLEARED_WORDS 16384

typedef struct ClearParameters {
  unsigned int first_low, first_high;  // the first word
  unsigned int words;
} ClearParameters;
