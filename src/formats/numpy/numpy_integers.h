#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace splotchcl {

// Whether a file is an array of NumPy (.npy), by its first bytes. Throws DataError.
bool is_numpy_file(const std::filesystem::path& path);

// The whole numbers of an array of one dimension, in a file of its own. Throws DataError for any
// other.
std::vector<std::uint64_t> read_numpy_integers(const std::filesystem::path& path);

}  // namespace splotchcl
