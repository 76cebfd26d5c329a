#pragma once

#include <cstddef>

#include "splotchcl/particles.h"

// What the system is told of columns that lie in mapped files, so that it reads no more of these
// than is wanted. For other columns this does nothing.
namespace splotchcl {

// Single values will be asked for, here and there: reads nothing beside them.
void expect_few_values(const Column& column);

// Values [begin, end) will be asked for soon: begins to read them.
void read_ahead(const Column& column, std::size_t begin, std::size_t end);

}  // namespace splotchcl
