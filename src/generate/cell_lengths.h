#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/morton_keys.h"

namespace splotchcl {

// Smoothing lengths for particles of which no machine holds all: of a cube of the octree that would
// hold as many particles as the sphere of a smoothing length does. Neighbors take ten times as long
// to find. Lengths are in units of the box.
class CellLengths {
 public:
  // The particles in each cell of a level, in Morton order.
  CellLengths(const std::vector<std::uint64_t>& counts, int level);

  // Of particles in Morton order that are all of some cells, in that order.
  std::vector<float> find(const std::vector<KeyedParticle>& particles) const;

 private:
  class Finder;

  int level_;
  std::vector<std::vector<std::uint64_t>> counts_;  // of each level from 0 on
};

}  // namespace splotchcl
