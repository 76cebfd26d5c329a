#pragma once

#include <optional>
#include <string>
#include <vector>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A place that the data say: "box", "mass", "densest", or "halo=5", by its number as select.halo
// has it. As maps have them (map.center_at); a halo's is its center of mass, of all types that the
// scene's components draw. Throws UsageError, which `what` begins, for other words.
Vec3 find_named_place(const std::string& words, const Scene& scene, const Snapshot& snapshot,
                      const std::string& what, std::vector<std::string>& notes);

// Where X,Y,Z lies, each a length as read_map_length() has it, in the unit that the last has.
Vec3 read_place(const std::string& text, const Scene& scene, const Snapshot& snapshot,
                const std::string& what);

// "Mpc" of "25,25,25 Mpc" or of "4Mpc"; nothing of numbers alone.
std::string unit_of_lengths(const std::string& lengths);

// The scene with map.width, depth, center and shell as numbers, where they are written with units;
// an angle as what is seen under it from map.distance, or in degrees for a map of the sky. Throws
// UsageError.
Scene with_lengths_as_numbers(const Scene& scene, const Snapshot& snapshot);

}  // namespace splotchcl
