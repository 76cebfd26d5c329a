#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "formats/gadget/gadget_blocks.h"

namespace splotchcl {

// The records of format 1, which has no labels, told apart by the usual order of blocks.
struct OrderedBlocks {
  std::vector<GadgetBlock> standard;
  std::vector<std::size_t> others;   // records that are none of the standard blocks
  std::vector<std::string> skipped;  // expected, but the next record is something else
  std::vector<std::string> missing;  // expected after the last record
};

OrderedBlocks order_blocks(const GadgetBinaryFile& file, const BlockLayouts& layouts);

// What was assumed or found missing; empty where nothing was.
std::string describe_order(const OrderedBlocks& blocks, const BlockLayouts& layouts);

}  // namespace splotchcl
