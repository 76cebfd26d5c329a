#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "splotchcl/particles.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Smoothing lengths that were found, kept in a file beside the snapshot: for the first of its
// files, snapshot_006.type1.smoothing_lengths. It is used only where everything that they follow
// from is the same: positions, box and number of neighbours.
class SmoothingLengthCache {
 public:
  // `key` stands for all that lengths of `count` particles follow from.
  SmoothingLengthCache(const SnapshotInfo& info, int type, std::size_t count, std::uint64_t key);
  static std::uint64_t key_of(const Column& position, const std::optional<BoxSides>& periodic_box,
                              int neighbors);

  const std::filesystem::path& path() const { return path_; }

  // None where there is no such file, or it is of other positions or damaged.
  std::optional<Column> read() const;

  // Whether a file of this name is anything else, which is not overwritten.
  bool is_in_the_way() const;

  // Throws DataError when the file cannot be written.
  void write(const Column& lengths) const;

 private:
  std::filesystem::path path_;
  std::uint64_t key_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace splotchcl
