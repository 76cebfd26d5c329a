#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// A set of particles, by any of these; a particle belongs to it when all that are given
// hold. Positions and fields are those of the component's own snapshot.
struct ParticleSet {
  // Conditions such as "temperature > 1e6" or "density >= 3 or mass < 1", one of <, <=, >,
  // >=, ==, != between a field and a number. A value that is not a number fulfils none.
  std::vector<std::string> where;
  std::string id_file;  // identifiers: a text file, one on a line, or an array of NumPy
  // The number of a halo, as the snapshot's field of group ids or the catalog has it.
  std::optional<std::uint64_t> halo;
  std::string halo_catalog;  // empty: the snapshot's field, else a catalog beside it
  // Faces belong to the box, the surface to the sphere.
  std::optional<Vec3> box_minimum, box_maximum;
  std::optional<Vec3> sphere_center;
  std::optional<double> sphere_radius;  // > 0
  // The weights fall smoothly to 0 over so much within the radius; > 0 and at most the radius.
  std::optional<double> sphere_rim;

  // Whether it says anything; else no particle belongs to it.
  bool is_given() const {
    return !where.empty() || !id_file.empty() || halo || box_minimum || box_maximum ||
           sphere_center || sphere_radius;
  }
};

// How particles of a snapshot of their own are put into the scene:
//   x' = origin + scale * R (x - center)
// with R the right-handed rotation about `axis`. Lengths h become scale * h; masses,
// densities and all other fields stay as they are.
struct Placement {
  std::optional<Vec3> origin;  // in lengths of the scene; unset: the center stays where it is
  Vec3 axis = {{0, 0, 1}};     // of any length but 0
  double angle_degrees = 0;
  double scale = 1;  // > 0

  // Whether particles are elsewhere, or larger, than their snapshot has them.
  bool moves() const { return origin || angle_degrees != 0 || scale != 1; }
};

}  // namespace splotchcl
