#pragma once

#include <filesystem>

#include "formats/snapshot_writer.h"

namespace splotchcl::test {

// How a code writes its HDF5 files.
struct Hdf5Style {
  bool is_compressed = false;         // in chunks of 8 rows
  bool has_array_scalars = false;     // single numbers of the header as arrays of length 1
  bool has_double_counts = false;     // numbers of particles as doubles
  bool has_parameters_group = false;  // cosmology and units in Parameters (Gadget-4)
  std::size_t types_in_header = 6;
};

// With the names of Gadget's HDF5 files.
void write_hdf5(const std::filesystem::path& path, const TestSnapshot& snapshot,
                const Hdf5Style& style = {});

}  // namespace splotchcl::test
