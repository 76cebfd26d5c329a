#pragma once

#include <cstdint>
#include <vector>

#include "splotchcl/light_model.h"
#include "splotchcl/particles.h"

namespace splotchcl::view {

// How many particles have which values. Bins are equally wide after scaling.
struct FieldHistogram {
  double minimum = 0, maximum = 0;    // of the values, before scaling
  std::vector<std::uint64_t> counts;  // empty: no value can be scaled
};

// Of at most 2 million values, evenly spaced in the column. `bins` > 0.
FieldHistogram field_histogram(const Column& column, Scaling scaling, std::size_t bins);

}  // namespace splotchcl::view
