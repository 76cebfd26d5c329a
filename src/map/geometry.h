#pragma once

#include <optional>

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
  Vec3 right, up, forward;      // unit vectors
  std::optional<double> depth;  // no limit where unset
  double box = 0;               // 0: not periodic
};

// The side of the periodic box that the map's component lies in; 0: none. Throws UsageError where
// there has to be one and is none.
double side_of_box(const Scene& scene, const Component& component, const SnapshotInfo& snapshot);

// `box` as side_of_box() has it. Throws UsageError for what cannot be: a camera that is missing, a
// center or a width that does not follow.
MapGeometry decide_geometry(const Scene& scene, const Snapshot& snapshot, const MapMatter& matter,
                            double box);

}  // namespace splotchcl
