#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "splotchcl/particles.h"

// What the system is told of memory beforehand. Advice: where it is refused nothing but time
// changes.
namespace splotchcl {

// Of columns that lie in mapped files, so that it reads no more of these than is wanted. For other
// columns this does nothing.

// Single values will be asked for, here and there: reads nothing beside them.
void expect_few_values(const Column& column);

// Values [begin, end) will be asked for soon: begins to read them.
void read_ahead(const Column& column, std::size_t begin, std::size_t end);

constexpr std::size_t large_page_bytes = std::size_t{2} << 20;

// New memory that will be written to from end to end: on pages of 2 MiB, where the system has such,
// it is made with a five-hundredth of the interruptions that small ones take.
void expect_all_written(void* memory, std::size_t bytes);

// The same of memory that is about to be written to by one thread: the system clears it now, on
// whatever threads call this for parts of it.
void make_pages(void* memory, std::size_t bytes);

// For arrays that are written whole: what they grow by is not written beforehand, and long ones lie
// on pages of 2 MiB.
template <class T>
struct LargePageAllocator {
  using value_type = T;

  LargePageAllocator() = default;
  template <class U>
  LargePageAllocator(const LargePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (!is_long(count)) return static_cast<T*>(::operator new(bytes));
    void* const memory = ::operator new (bytes, std::align_val_t{large_page_bytes});
    expect_all_written(memory, bytes);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (is_long(count)) {
      ::operator delete (memory, std::align_val_t{large_page_bytes});
    } else {
      ::operator delete(memory);
    }
  }
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  friend bool operator==(const LargePageAllocator&, const LargePageAllocator&) { return true; }
  friend bool operator!=(const LargePageAllocator&, const LargePageAllocator&) { return false; }

 private:
  static bool is_long(std::size_t count) { return count * sizeof(T) >= 2 * large_page_bytes; }
};
template <class T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;
// Of particles in columns.
using Places = LargeVector<std::uint64_t>;

// These values, one after the other.
Column owning_column(LargeVector<float> values);

}  // namespace splotchcl
