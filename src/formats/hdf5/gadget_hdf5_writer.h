#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/particles.h"

namespace splotchcl {

struct WrittenField {
  // Of the dataset, such as Coordinates. Lengths and velocities get their units by it.
  std::string name;
  int values_per_particle = 1;  // 1 or 3
  Column values;
};

struct WrittenType {
  int type = 0;  // 0 to 5
  std::uint64_t count = 0;
  std::vector<WrittenField> fields;
  std::vector<std::uint64_t> ids;  // empty: no ParticleIDs
};

// What a snapshot holds, in kpc, km/s and no unit of mass that means anything.
struct WrittenSnapshot {
  double time = 0;
  std::vector<WrittenType> types;
};

// Gadget HDF5, 32-bit floats and 64-bit identifiers. Appears under its name only when
// complete. Throws DataError.
void write_gadget_hdf5(const std::filesystem::path& path, const WrittenSnapshot& snapshot);

}  // namespace splotchcl
