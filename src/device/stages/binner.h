#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/stages/group_binner.h"

namespace splotchcl {

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
