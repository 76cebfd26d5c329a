#pragma once

#include <cstdint>

#include "splotchcl/communicator.h"

namespace splotchcl {

// What one rank has done for a frame.
struct RankWork {
  std::uint64_t particles = 0;   // that it has projected
  std::uint64_t splats = 0;      // that it has composited
  std::uint64_t sent_bytes = 0;  // of splats and planes, to others
};

// The ranks that draw a frame together.
struct FrameRanks {
  Communicator& all;
  RankWork work;

  int rank() const { return all.rank(); }
  int size() const { return all.size(); }
};

}  // namespace splotchcl
