// Memory set to 0 by all threads of a processor. Work-item: CLEARED_WORDS of it.
#include "kernels/common/grid.h"

__kernel void clear(const MemoryRange p, __global float* memory) {
  const size_t first = (size_t)p.first_low | ((size_t)p.first_high << 32);
  const size_t begin = get_global_id(0) * CLEARED_WORDS;
  const size_t end = min(begin + CLEARED_WORDS, (size_t)p.words);
  size_t i = begin;
  for (; i + 8 <= end; i += 8)
    vstore8((float8)(0.0f), 0, memory + first + i);
  for (; i < end; ++i)
    memory[first + i] = 0.0f;
}
