// What host and kernels share of the sort.
#include "kernels/common/group.h"

#ifndef SPLOTCHCL_SORT_H
#define SPLOTCHCL_SORT_H

#define SORT_DIGIT_BITS 8
#define SORT_DIGITS (1 << SORT_DIGIT_BITS)

// Runs of equal keys up to this length are ordered by comparing.
#define SORT_SHORT_RUN 32

// One pass over one digit.
struct SortParameters {
  unsigned int count;         // pairs
  unsigned int block_length;  // pairs per work-item
  unsigned int block_count;
  unsigned int shift;  // of the digit, in bits; of the ends' bits that a key takes in
};

// Splats whose sort keys lie in one part of all keys are sorted by two digits of so many bits, and
// those that agree in them by all bits. A core's nearest cache has a line for each value of a
// digit.
#define PART_DIGIT_BITS 9
#define PART_DIGITS (1 << PART_DIGIT_BITS)

struct PartOfKeys {
  // Upper 32 bits of keys of 48: from the first to the last of these they are told apart, by 32
  // bits of the difference, as many zeros as it has from its 48 left out.
  unsigned int first_key, last_key, zeros;
  unsigned int first_place;    // of its splats among all sorted ones
  unsigned int first_scratch;  // of its room in each half of the scratch memory
};

// One launch of several parts.
struct PartSortParameters {
  unsigned int first_part, sorted_parts;
  unsigned int part_count, block_count;  // of all
  unsigned int scratch_half;             // splats
  unsigned int has_ends;
};

// The bits that are set in some keys of a block, and in all of them.
struct KeyBits {
  unsigned int some, all;
};

// Of the shape for GPUs: a group takes so many pairs.
#define SORT_PAIRS_OF_ITEM 8
#define SORT_STRETCH (GROUP_ITEMS * SORT_PAIRS_OF_ITEM)

// One pass of it.
struct GroupSortParameters {
  unsigned int count;        // pairs
  unsigned int group_count;  // of SORT_STRETCH pairs, the last one of fewer
  unsigned int smallest;     // subtracted from all keys
  unsigned int shift, bits;  // of the digit, at most SORT_DIGIT_BITS
};

// Of all keys together.
struct KeyRange {
  unsigned int smallest, largest;
  struct KeyBits bits;
};

#ifdef __OPENCL_VERSION__
typedef struct GroupSortParameters GroupSortParameters;
typedef struct KeyRange KeyRange;
typedef struct PartOfKeys PartOfKeys;
typedef struct PartSortParameters PartSortParameters;
typedef struct SortParameters SortParameters;
typedef struct KeyBits KeyBits;
#endif

#endif
