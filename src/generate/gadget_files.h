#pragma once

#include <cstdint>

#include "common/unfinished_file.h"
#include "splotchcl/generate.h"

namespace splotchcl {

// What a file of several says of all of them.
struct GadgetSet {
  std::uint64_t gas = 0, stars = 0;  // in all
  std::uint32_t files = 1;
  std::uint32_t first_id = 1;  // of this file
};

// One file of several, in Gadget format 2, with masses in its header. Throws DataError.
void write_gadget2_part(UnfinishedFile& file, const GeneratedSnapshot& part, const GadgetSet& set);

}  // namespace splotchcl
