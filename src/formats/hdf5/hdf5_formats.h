#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_file.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Dialects of HDF5; which one a file speaks is decided in hdf5_formats.cpp.
std::unique_ptr<Snapshot> open_gadget_hdf5(const std::filesystem::path& path);

// Datasets of positions without a header that counts particles.
bool is_plain_hdf5(const Hdf5File& file);
// `wanted_group`: the only group of particles that is read; empty: those that belong together.
std::unique_ptr<Snapshot> open_plain_hdf5(const std::filesystem::path& path,
                                          const std::string& wanted_group = "");

// The columns that read.columns names, whatever else the file holds. `group`: that of the path, in
// which their names are looked for; empty: the root.
std::unique_ptr<Snapshot> open_named_columns(const std::filesystem::path& path,
                                             const std::string& group,
                                             const std::vector<std::string>& columns);

bool is_phantom_hdf5(const Hdf5File& file);
std::unique_ptr<Snapshot> open_phantom_hdf5(const std::filesystem::path& path);

}  // namespace splotchcl
