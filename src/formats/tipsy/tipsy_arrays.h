#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/mapped_file.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// An auxiliary array beside a Tipsy file: FILE.NAME holds the number of particles and then a
// value for each, as text or as four-byte numbers.
struct TipsyArray {
  std::string name;
  std::shared_ptr<const MappedFile> file;
  bool is_text = false;
  bool is_swapped = false;
};

// Those beside `path` that have `particles` values, by name. Others with that number in front
// are told in `notes`; files of other kinds are not.
std::vector<TipsyArray> find_tipsy_arrays(const std::filesystem::path& path,
                                          std::uint64_t particles, bool is_swapped,
                                          std::vector<std::string>& notes);

// The values of `count` particles from `first` on, times `factor`. Throws DataError.
Column read_tipsy_array(const TipsyArray& array, std::uint64_t first, std::uint64_t count,
                        double factor);
// As whole numbers; none where they are others.
std::optional<std::vector<std::uint64_t>> read_tipsy_integers(const TipsyArray& array,
                                                              std::uint64_t first,
                                                              std::uint64_t count);

}  // namespace splotchcl
