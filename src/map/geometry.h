#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "load/placement.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The positions, sizes, masses and densities that a map's place may follow from. The last two may
// be absent.
struct MapMatter {
  std::size_t count = 0;
  std::size_t before_selecting = 0;
  Vec3 origin = {{0, 0, 0}};
  Column position, smoothing_length, mass, density;
  double size_factor = 1;

  Vec3 position_of(std::size_t i) const;
  double size_of(std::size_t i) const {
    return size_factor * static_cast<double>(smoothing_length[i]);
  }
  // Whether a particle has a place and a size.
  bool is_good(std::size_t i) const;
};

// Boxes side by side that a map may show, and one kernel may reach over.
constexpr double most_boxes = 64;

// The map's place in the data.
struct MapGeometry {
  int width = 0, height = 0;  // pixels
  double pixel = 0;           // its side, in lengths
  Vec3 center;
  Vec3 right, up, forward;        // unit vectors
  std::optional<double> depth;    // no limit where unset
  std::optional<BoxSides> box;    // unset: not periodic
  bool is_around_center = false;  // lines of sight begin there
};

// The periodic box that the map's component lies in. A box that the header alone says is believed
// where all particles lie in one period of it; a note says where they do not. Throws UsageError
// where there has to be one and is none.
PeriodicRegion find_region(const Scene& scene, const Component& component, const Snapshot& snapshot,
                           std::vector<std::string>& notes);

// All images of an offset that lie within `reach` of 0, and perhaps others; without a box itself.
std::vector<Vec3> images_within(const Vec3& offset, double reach,
                                const std::optional<BoxSides>& box);
// Throws UsageError, which `what` begins, where too many boxes lie side by side within `reach`.
void check_images(double reach, const std::optional<BoxSides>& box, const std::string& what);

// Throws UsageError for what cannot be: a camera that is missing, a center or a width that does not
// follow.
MapGeometry decide_geometry(const Scene& scene, const MapMatter& matter,
                            const PeriodicRegion& region);

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
