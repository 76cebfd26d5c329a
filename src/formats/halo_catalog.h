#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// Consecutive particles of a type, by their places among all that a snapshot's files have of it.
struct PlaceRange {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

// Where a halo is and how far it reaches, in a unit that may have the factors a and h.
struct HaloSphere {
  Vec3 center = {{0, 0, 0}};
  double radius = 0;
  std::string unit;
};

// The particles of one type in a halo: by their places in increasing order, by identifiers in
// increasing order, or all within a sphere, whichever the catalog has.
struct HaloMembers {
  std::vector<PlaceRange> places;
  std::optional<std::vector<std::uint64_t>> ids;
  std::optional<HaloSphere> sphere;

  bool has_place(std::uint64_t place) const;
};

// Reads halo `number` of a catalog: in HDF5 SUBFIND's or FOF's of Gadget-4 and AREPO (counted from
// 0; the snapshot has its particles in the order of haloes), a membership file of SOAP
// (GroupNr_bound of each particle) or its halo_properties with that beside it, or VELOCIraptor's
// catalog_groups with the catalog_particles beside it (counted from 1); as text AHF's or Rockstar's
// (read_halo_list). `path` is any file of a catalog in several; CATALOG/Subhalo
// counts the subhaloes of SUBFIND from 0. Throws DataError.
HaloMembers read_halo(const std::filesystem::path& path, std::uint64_t number, int type);

// The catalog of a snapshot by its usual name and place: SUBFIND's or FOF's beside the snapshot or
// in a folder groups_NNN, SOAP's membership file, AHF's, Rockstar's. None where there is none.
std::optional<std::filesystem::path> find_halo_catalog(const std::filesystem::path& snapshot);

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
