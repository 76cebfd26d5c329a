#pragma once

#include <cstddef>

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

// New memory that will be written to from end to end: on pages of 2 MiB, where the system has such,
// it is made with a five-hundredth of the interruptions that small ones take.
void expect_all_written(void* memory, std::size_t bytes);

// The same of memory that is about to be written to by one thread: the system clears it now, on
// whatever threads call this for parts of it.
void make_pages(void* memory, std::size_t bytes);

}  // namespace splotchcl
