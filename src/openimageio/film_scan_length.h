#pragma once

#include <filesystem>

namespace splotchcl {

// Of DPX and Cineon files, whose readers take what is missing at the end of one for black, or for
// what was in memory. Throws DataError for a file that is shorter than its header says.
void check_length_of_film_scan(const std::filesystem::path& path);

}  // namespace splotchcl
