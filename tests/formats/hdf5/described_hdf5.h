#pragma once

#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {

// An HDF5 file as a text of parts between " | " or in lines of their own: datasets "PATH: VALUES",
// with "x3" and the type in the file behind the path where rows have three values or are no doubles
// ("pos x3 f32: 1 2 3"); records "PATH of x, y: VALUES"; one number "PATH scalar: VALUE"; lines of
// text "PATH lines: A, B"; attributes "OBJECT@NAME: VALUES", "OBJECT@NAME: "TEXT" or
// "OBJECT@NAME: true", whose group is made where there is none; and groups, of which there is the
// name alone. "gadget COUNTS" is a header that counts so many particles of each type, of which the
// two of type 0 have positions.
void write_described_hdf5(const std::filesystem::path& path, const std::string& description);

// Rows are its parameters in whatever file of tests; contents are such descriptions.
class DescribedHdf5 : public ::testing::TestWithParam<SnapshotRow> {};

}  // namespace splotchcl::test
