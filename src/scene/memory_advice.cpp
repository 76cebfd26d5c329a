#include "scene/memory_advice.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

#include "scene/streamed_column.h"

namespace splotchcl {
namespace {

// Advice may be refused, and changes nothing but time: nobody need know.
void advise(const Column& column, std::size_t begin, std::size_t end, int advice) {
  // What is made is not mapped, and need not be made for this.
  if (!column.is_array() || column.source() != nullptr || begin >= end) return;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto first = reinterpret_cast<std::uintptr_t>(column.data() + begin) / page * page;
  const auto last = reinterpret_cast<std::uintptr_t>(column.data() + end);
  ::posix_madvise(reinterpret_cast<void*>(first), last - first, advice);
}

}  // namespace

void expect_few_values(const Column& column) {
  advise(column, 0, column.size(), POSIX_MADV_RANDOM);
}

void read_ahead(const Column& column, std::size_t begin, std::size_t end) {
  advise(column, begin, end, POSIX_MADV_WILLNEED);
}

}  // namespace splotchcl
