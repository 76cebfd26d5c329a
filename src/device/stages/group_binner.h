#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/stages/group_sorter.h"

namespace splotchcl {

struct CountedSplats;

// Binner's work in the shape for GPUs: pairs of tile and splat are written in the splats' order and
// sorted by tile. The lengths of all lists are read back once for each chunk.
class GroupBinner {
 public:
  explicit GroupBinner(const StageContext& context);

  // Finds the tiles of the splats, and how many each tile has: of `counted` the parameters, the
  // splats and their order or blocks are there already.
  void count(CountedSplats& counted) const;
  // What `lists` say of themselves is there already; adds their entries and segments.
  void make_lists(const CountedSplats& counted, const TileBand& band, TileLists& lists) const;

 private:
  Buffer<std::uint32_t> find_entries(const CountedSplats& counted,
                                     const shared::GroupBinParameters& parameters) const;
  KeyedValues emit(const CountedSplats& counted,
                   const shared::GroupBinParameters& parameters) const;

  const StageContext& context_;
  Program program_;
  GroupScan scan_;
  GroupSorter sorter_;
};

// How many splats are in each tile, from what bin_find_tiles counted (kernels/bin/bin_groups.cl).
std::vector<std::uint32_t> lengths_of_lists(const std::vector<std::uint32_t>& counts,
                                            const PictureLayout& layout);

// The lists of a band of tiles one after the other, cut into segments of at most this length.
std::vector<shared::Segment> cut_in_segments(const std::vector<std::uint32_t>& lengths,
                                             const TileBand& band, std::uint32_t segment_length);

}  // namespace splotchcl
