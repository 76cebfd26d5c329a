#pragma once

#include <filesystem>

namespace splotchcl {

// The OpenEXR library takes memory for every attribute of a header, and for the table of where the
// lines begin, as large as the header says, before it looks how long the file is: 2 GB for a file
// of 1 kB. This reads the lengths alone (OpenEXR's "File Layout"). Throws DataError when one is
// longer than the file; returns for what is no EXR file at all.
void check_exr_header(const std::filesystem::path& path);

}  // namespace splotchcl
