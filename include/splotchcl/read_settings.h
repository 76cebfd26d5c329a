#pragma once

#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

// How a snapshot is read for a scene: the keys of [read].
struct ReadSettings {
  // Names for the columns of a text table or a plain NumPy array, in their order; "-" for one
  // that is not needed. Or NAME=COLUMN for each that the file calls by another name: in HDF5 the
  // path of a dataset. Empty: the file's own.
  std::vector<std::string> columns;
  // FIELD=UNIT for each field whose unit the file does not say, or says wrongly. Numbers stay.
  std::vector<std::string> units;
  // Lines at the beginning of a text table that are no part of it; >= 0.
  int skip_lines = 0;

  // Parts of the particles, for a quick look: every N-th, or at most so many, chosen at random
  // by the seed. What is left is made brighter by as much as was left out.
  int every = 1;                     // >= 1
  std::optional<int> max_particles;  // >= 1
  int seed = 1;                      // >= 0

  // How many particles the sphere of a smoothing length holds that the file does not have; 1 to
  // 4096.
  int neighbors = 64;
  // Whether smoothing lengths that were found are kept in a file beside the snapshot.
  bool cache_smoothing_lengths = false;
};

}  // namespace splotchcl
