// What host and kernels share of the sort.
#include "kernels/common/group.h"

#pragma once

#define SORT_DIGIT_BITS 8
#define SORT_DIGITS (1 << SORT_DIGIT_BITS)

// Runs of equal keys up to this length are ordered by comparing.
#define SORT_SHORT_RUN 32

// One pass over one digit.
typedef struct SortParameters {
  unsigned int count;         // pairs
  unsigned int block_length;  // pairs per work-item
  unsigned int block_count;
  unsigned int shift;  // of the digit, in bits; of the ends' bits that a key takes in
} SortParameters;

// The bits that are set in some keys of a block, and in all of them.
typedef struct KeyBits {
  unsigned int some, all;
} KeyBits;

// Of the shape for GPUs: a group takes so many pairs.
#define SORT_PAIRS_OF_ITEM 8
#define SORT_STRETCH (GROUP_ITEMS * SORT_PAIRS_OF_ITEM)

// One pass of it.
typedef struct GroupSortParameters {
  unsigned int count;        // pairs
  unsigned int group_count;  // of SORT_STRETCH pairs, the last one of fewer
  unsigned int smallest;     // subtracted from all keys
  unsigned int shift, bits;  // of the digit, at most SORT_DIGIT_BITS
} GroupSortParameters;

// Of all keys together.
typedef struct KeyRange {
  unsigned int smallest, largest;
  struct KeyBits bits;
} KeyRange;
