#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "formats/hdf5/hdf5_file.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// A dataset in one file of a snapshot.
struct Hdf5Values {
  std::filesystem::path file;
  Hdf5Dataset dataset;
};

// The parts one after the other, in single precision, read in large pieces. A single part
// that lies in the file as native floats is not copied. `origin` is taken from 3-vectors
// in double; all values are multiplied by `factor`. What would be too large to copy is read as it
// is wanted.
Column read_column(const std::vector<Hdf5Values>& parts, const Vec3& origin = {{0, 0, 0}},
                   double factor = 1);
// The same, read as it is wanted unless it lies in the file as it is needed.
Column read_streamed_column(const std::vector<Hdf5Values>& parts, const Vec3& origin = {{0, 0, 0}},
                            double factor = 1);

// Whole numbers, exact; empty when a part holds none.
std::optional<std::vector<std::uint64_t>> read_integers(const std::vector<Hdf5Values>& parts);

// The origin for positions stored in double precision; zero where none is.
Vec3 find_position_origin(const std::vector<Hdf5Values>& positions);

}  // namespace splotchcl
