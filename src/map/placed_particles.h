#pragma once

#include <cstdint>
#include <vector>

#include "map/geometry.h"

namespace splotchcl {

// The particles that a map shows, with their periodic images, in pixels from its middle.
struct PlacedParticles {
  std::vector<float> position;        // three each: to the right, downwards, 0
  std::vector<float> size;            // h
  std::vector<double> in_plane;       // of slices: what the kernel has in the plane, per pixel
  std::vector<std::uint32_t> source;  // which of the matter's particles it is
  std::vector<float> share;           // how much of its kernel lies in the picture
  std::uint64_t bad = 0;              // particles without a place or a size
  // Single precision has their places to less than a pixel and their size.
  std::uint64_t rough = 0;

  std::size_t count() const { return source.size(); }
};

// Whatever has its center within the depth, or for a slice its kernel in the plane, and reaches the
// picture. `sigma` is the width of the kernel for h = 1. Throws UsageError where a kernel reaches
// over more than most_boxes.
PlacedParticles place_particles(const MapMatter& matter, const MapGeometry& geometry, double sigma,
                                bool is_slice);

}  // namespace splotchcl
