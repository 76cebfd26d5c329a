#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace splotchcl {

// The identifiers of a text file, one on a line, in increasing order and each once. Blank
// lines, and what follows a '#', do not count. Throws DataError for a file that cannot be
// read, a line that is not a whole number from 0 to 2^64 - 1, and a file without any.
std::vector<std::uint64_t> read_id_list(const std::filesystem::path& path);

}  // namespace splotchcl
