#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "formats/halo_catalog.h"

namespace splotchcl {

// Where a halo is and how far it reaches, by its identifier in lists of haloes that do not say
// which particles they have: Rockstar's out_*.list and .ascii, AHF's AHF_halos. None where the list
// has no such halo, or is another text. Throws DataError for damaged ones.
std::optional<HaloSphere> read_halo_sphere(const std::filesystem::path& path, std::uint64_t number);

}  // namespace splotchcl
