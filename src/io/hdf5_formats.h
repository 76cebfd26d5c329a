#pragma once

#include <filesystem>
#include <memory>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// Dialects of HDF5; which one a file speaks is decided in hdf5_formats.cpp.
std::unique_ptr<Snapshot> open_gadget_hdf5(const std::filesystem::path& path);

}  // namespace splotchcl
