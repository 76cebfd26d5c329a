#pragma once

#include <string>
#include <vector>

#include "formats/gadget/gadget_block_layout.h"

namespace splotchcl {

// A record that has been understood as a field of some particle types.
struct GadgetBlock {
  std::string label;
  std::uint64_t offset = 0;
  BlockLayout layout;
};

// Where the header counts no particles at all, takes their number from the block of positions,
// with a note.
void count_by_blocks(GadgetBinaryFile& file, std::vector<std::string>& notes);

// What the records of a file hold. Records that fit no particle types are left out and
// named in `notes`. Throws DataError when there are no positions, or when the length of a
// standard block contradicts the header.
std::vector<GadgetBlock> understand_records(const GadgetBinaryFile& file,
                                            std::vector<std::string>& notes);

}  // namespace splotchcl
