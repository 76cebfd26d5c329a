#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace splotchcl {

// Consecutive particles of a type, by their places among all that a snapshot's files have of it.
struct PlaceRange {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

// The particles of one type in a halo: by their places in increasing order, or by identifiers in
// increasing order, whichever the catalog has.
struct HaloMembers {
  std::vector<PlaceRange> places;
  std::optional<std::vector<std::uint64_t>> ids;

  bool has_place(std::uint64_t place) const;
};

// Reads halo `number` of a catalog: in HDF5 SUBFIND's or FOF's of Gadget-4 and AREPO (counted from
// 0; the snapshot has its particles in the order of haloes), a membership file of SOAP
// (GroupNr_bound of each particle) or its halo_properties with that beside it, or VELOCIraptor's
// catalog_groups with the catalog_particles beside it (counted from 1); as text AHF's or Rockstar's
// (halo_lists.h). `path` is any file of a catalog in several. Throws DataError.
HaloMembers read_halo(const std::filesystem::path& path, std::uint64_t number, int type);

// The catalog of a snapshot by its usual name and place: SUBFIND's or FOF's beside the snapshot or
// in a folder groups_NNN, SOAP's membership file, AHF's particles. None where there is none.
std::optional<std::filesystem::path> find_halo_catalog(const std::filesystem::path& snapshot);

}  // namespace splotchcl
