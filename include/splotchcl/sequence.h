#pragma once

#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

// Between two snapshots (docs/time.md):
//   none     the earlier of the two as it is
//   linear   positions on straight lines, fields linear or logarithmic
//   hermite  positions on the cubic that has both snapshots' velocities at its ends
enum class Interpolation { none, linear, hermite };

// Snapshots that follow each other, and the moment between them that is drawn.
struct SequenceSettings {
  // One of the two; both empty: the scene has a single snapshot.
  std::vector<std::string> snapshots;  // index 0, 1, 2, ...
  std::string pattern;                 // "snapshot_%03d": the index is the number in the name
  std::optional<int> first, last;      // of a pattern's numbers; unset: all that exist
  // Which is drawn; with a fraction: between two. Unset: the first.
  std::optional<double> index;
  Interpolation interpolation = Interpolation::linear;
  // Instead of what the snapshots say of their cosmology. hubble_rate is H0 in their unit of
  // velocity over their unit of length: 0.1 for km/s and kpc/h.
  std::optional<double> omega_matter, omega_lambda, hubble_rate;

  bool is_set() const { return !snapshots.empty() || !pattern.empty(); }
};

}  // namespace splotchcl
