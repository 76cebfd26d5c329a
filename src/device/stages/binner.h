#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/stages/sorter.h"

namespace splotchcl {

// How many splats are in each tile, from what bin_find_tiles counted (kernels/bin/bin_groups.cl).
std::vector<std::uint32_t> lengths_of_lists(const std::vector<std::uint32_t>& counts,
                                            const PictureLayout& layout);

// The lists of a band of tiles one after the other, cut into segments of at most this length.
std::vector<shared::Segment> cut_in_segments(const std::vector<std::uint32_t>& lengths,
                                             const TileBand& band, std::uint32_t segment_length);

// A chunk of splats whose entries in each tile have been counted. It looks into the splats,
// which outlive it.
struct CountedSplats {
  shared::BinParameters parameters{};
  const Buffer<std::byte>* splats = nullptr;
  const Buffer<std::uint32_t>* order = nullptr;         // of sorted splats; for GPUs of all
  const Buffer<shared::BlockCounts>* blocks = nullptr;  // of a projection's
  Buffer<std::byte> in_order;                           // copies of sorted splats
  Buffer<std::uint32_t> tiles;                          // per splat (tiles.cl)
  Buffer<shared::SplatTiles> tiles_of_splats;           // the same in the shape for GPUs
  Buffer<std::uint32_t> tile_counts;                    // per block and tile; in that, per tile
  Buffer<std::uint32_t> tile_lengths;                   // not in that
  std::vector<std::uint32_t> lengths;                   // the same on the host
  // Each band's lists fit into memory. One, where the whole picture's do.
  std::vector<TileBand> bands;
};

// The fewest bands of tiles whose lists of these lengths have no more than `capacity` entries
// each, as long as no tile alone has.
std::vector<TileBand> cut_in_bands(const std::vector<std::uint32_t>& lengths,
                                   std::uint64_t capacity);

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

// Splats to lists per tile, in order: the stage `bin`.
class Binner {
 public:
  explicit Binner(const StageContext& context);

  // Takes what the projection counted: once for each projection.
  CountedSplats count(SplatBlocks& blocks) const;
  CountedSplats count(const SortedSplats& sorted, const SplatChunk& chunk) const;
  // Call once for each band.
  TileLists make_lists(const CountedSplats& counted, const TileBand& band) const;

 private:
  CountedSplats start(const Buffer<std::byte>& splats) const;
  void cut_in_blocks(CountedSplats& counted) const;
  void count_tiles(CountedSplats& counted) const;
  void scan_blocks(CountedSplats& counted) const;
  void fill_lists(const CountedSplats& counted, const TileBand& band, TileLists& lists) const;
  TileLists measure_lists(const std::vector<std::uint32_t>& lengths, const TileBand& band) const;

  const StageContext& context_;
  shared::BinParameters parameters_{};
  Program program_;
  std::optional<GroupBinner> groups_;  // does the work in its shape
  std::uint64_t entry_capacity_ = 0;
  Buffer<std::uint32_t> no_order_;         // stand for what a variant of the kernels
  Buffer<shared::BlockCounts> no_blocks_;  // does not read
};

}  // namespace splotchcl
