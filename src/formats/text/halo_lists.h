#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "formats/halo_catalog.h"

namespace splotchcl {

// Whether read_halo_list() knows the text, by its name and what lies beside it.
bool has_halo_list(const std::filesystem::path& path);

// The identifiers of a halo's particles, in increasing order, from lists of text: AHF's
// AHF_particles (also by the name of the AHF_halos beside it), where a halo is known by its own
// identifier, or by its place from 0 where these files have none below 2^31; Rockstar's .particles,
// all of a catalog in several, by external_haloid. Throws DataError.
std::vector<std::uint64_t> read_halo_list(const std::filesystem::path& path, std::uint64_t number);

// Where a halo is and how far it reaches, by its identifier in lists of haloes that do not say
// which particles they have: Rockstar's out_*.list and .ascii, AHF's AHF_halos. None where the list
// has no such halo, or is another text. Throws DataError for damaged ones.
std::optional<HaloSphere> read_halo_sphere(const std::filesystem::path& path, std::uint64_t number);

}  // namespace splotchcl
