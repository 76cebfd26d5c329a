#include "scene/memory_advice.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <utility>

#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"

namespace splotchcl {
namespace {

std::uintptr_t page_bytes() {
  return static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
}

// Advice may be refused, and nobody need know.
void advise(const Column& column, std::size_t begin, std::size_t end, int advice) {
  // What is made is not mapped, and need not be made for this.
  if (!column.is_array() || column.source() != nullptr || begin >= end) return;
  const std::uintptr_t page = page_bytes();
  const auto first = reinterpret_cast<std::uintptr_t>(column.data() + begin) / page * page;
  const auto last = reinterpret_cast<std::uintptr_t>(column.data() + end);
  ::posix_madvise(reinterpret_cast<void*>(first), last - first, advice);
}

// Of new memory, of which the first and the last page may be others', too.
[[maybe_unused]] void advise_whole_pages(void* memory, std::size_t bytes, int advice) {
  const std::uintptr_t page = page_bytes(), begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = ceil_divide(begin, page) * page,
                       last = (begin + bytes) / page * page;
  if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, advice);
}

}  // namespace

void expect_few_values(const Column& column) {
  advise(column, 0, column.size(), POSIX_MADV_RANDOM);
}

void read_ahead(const Column& column, std::size_t begin, std::size_t end) {
  advise(column, begin, end, POSIX_MADV_WILLNEED);
}

void expect_all_written(void* memory, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  advise_whole_pages(memory, bytes, MADV_HUGEPAGE);
#endif
}

void make_pages(void* memory, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  advise_whole_pages(memory, bytes, MADV_POPULATE_WRITE);
#endif
}

Column owning_column(LargeVector<float> values) {
  auto owner = std::make_shared<const LargeVector<float>>(std::move(values));
  const float* const data = owner->data();
  const std::size_t size = owner->size();
  return Column(std::move(owner), data, size);
}

}  // namespace splotchcl
