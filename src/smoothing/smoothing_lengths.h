#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "splotchcl/particles.h"
#include "splotchcl/periodic.h"

namespace splotchcl {

// Called now and then from the calling thread with the fraction done, 0 to 1.
using Progress = std::function<void(double)>;

// How many particles the sphere of a smoothing length holds, unless the scene says otherwise:
// what most codes aim at with the cubic spline.
constexpr int particles_in_sphere = 64;

// Of ranks that all have the same positions each searches for a part of the particles.
struct SearchShare {
  int rank = 0, ranks = 1;
  // Rank r has set values [begins[r], begins[r + 1]): afterwards all ranks have all of them.
  std::function<void(std::vector<float>& values, const std::vector<std::size_t>& begins)> join;
};

// Each particle's distance to its `neighbours`-th nearest other particle (or to the
// farthest, where there are fewer): a smoothing length for matter that has none.
//
// `position` holds 3 * count values. With `periodic_box`, neighbours are also looked for
// across the faces of the box, wherever its corner lies; positions must be within one
// period. A particle counts there once per image.
//
// Results are the same for any number of threads and ranks. A position that is not finite gets
// not-a-number and is nobody's neighbour. Where all those neighbours coincide with the
// particle, it gets the smallest length found for others; where there is none (or no
// neighbour at all), a thousandth of the particles' extent or of the box; where that is
// zero too, 1.
Column find_smoothing_lengths(const Column& position, std::size_t count,
                              const std::optional<BoxSides>& periodic_box = std::nullopt,
                              int neighbors = particles_in_sphere, const Progress& progress = {},
                              const SearchShare& share = {});

// The length whose sphere holds the mass of `neighbours` particles at the particle's density:
// h = (3 * neighbours m / (4 pi rho))^(1/3). Not finite or not positive where mass or density
// are. Here and below values are held in memory, or made as they are wanted. `density_unit` is the
// unit of the densities in that of masses over the cube of that of lengths.
Column smoothing_lengths_from_density(const Column& mass, const Column& density, std::size_t count,
                                      int neighbors = particles_in_sphere, bool streams = false,
                                      double density_unit = 1);

// The same for cells of a mesh: m / rho is a cell's volume, in units of `volume_unit`.
Column smoothing_lengths_from_volume(const Column& volume, std::size_t count,
                                     int neighbors = particles_in_sphere, bool streams = false,
                                     double volume_unit = 1);

// The inverse: rho = neighbours m / (4 pi h^3 / 3). Each neighbour may stand for several.
Column densities_from_smoothing_lengths(const Column& mass, const Column& smoothing_length,
                                        std::size_t count, double neighbors = particles_in_sphere,
                                        bool streams = false);

}  // namespace splotchcl
