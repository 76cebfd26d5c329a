#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace splotchcl {

// The identifiers of a text file, one on a line, in increasing order and each once. Blank
// lines, and what follows a '#', do not count. Throws DataError for a file that cannot be
// read, a line that is not a whole number from 0 to 2^64 - 1, and a file without any. Numbers as
// NumPy's savetxt writes them, 1.2e+01, are taken as far as they are exact.
std::vector<std::uint64_t> read_id_list(const std::filesystem::path& path);

// Throws DataError for what is no list of identifiers but says of each particle whether it is
// wanted: nothing but 0 and 1, several times.
void refuse_mask(const std::vector<std::uint64_t>& ids, const std::filesystem::path& path);

}  // namespace splotchcl
