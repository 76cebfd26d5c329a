#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_file.h"

namespace splotchcl {

// A dataset of a particle type that can be a field, or one of its columns.
struct Hdf5Field {
  std::string label;  // the dataset's name in its group
  int values_per_particle = 1;
  Hdf5Dataset dataset;
};

// The fields of group PartType<type>, which has so many particles, and of groups in it
// (ElementAbundance.Oxygen). Of datasets of several columns each is a field, by the name that it
// has in the file or its code, or by its number from 1; the first of GIZMO's Metallicity, which is
// the whole, has the dataset's name. Datasets that are no numbers, or have not a row for each
// particle, are left out and named in `notes`.
std::vector<Hdf5Field> find_hdf5_fields(const Hdf5File& file, std::uint64_t count, int type,
                                        std::vector<std::string>& notes);

}  // namespace splotchcl
