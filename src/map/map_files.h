#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "splotchcl/image.h"
#include "splotchcl/map.h"

// A map as files of numbers and as a figure. Arrays have the lowest row first: y grows with the
// row.
namespace splotchcl {

using MapMetadata = std::map<std::string, std::string>;

// Rows in the opposite order, in each plane of so many pixels.
std::vector<float> upside_down(const std::vector<float>& values, int width, int height);

std::vector<unsigned char> encode_fits(const std::filesystem::path& path, const Map& map,
                                       const SnapshotInfo& snapshot, const MapMetadata& metadata);
std::vector<unsigned char> encode_npy(const Map& map);
// A line for each shell: its inner and outer radius, and the value; with astropy's header that says
// names, types and units, or names and units alone.
std::string profile_as_text(const Map& map, bool with_header, const MapMetadata& metadata);
void write_hdf5(const std::filesystem::path& temporary, const std::filesystem::path& path,
                const Map& map, const SnapshotInfo& snapshot, const MapMetadata& metadata);
// Red: the map. Green: the effective number of particles, or 0.
Image numbers_as_image(const Map& map);

// A unit as the FITS standard (4.0, section 4.3) writes it: "1e10 M_sun/kpc^2" as
// "10**10 solMass/kpc**2". There "a" is a year and "h" an hour: the scale factor and the Hubble
// parameter become "scale_factor" and "little_h", which readers take for unknown units, not for
// wrong ones.
std::string fits_unit(const std::string& unit);

// A unit that other programs can read, and what numbers have to be multiplied by to be in it.
struct FitsUnit {
  std::string text;
  double factor = 1;
};

// fits_unit(), but where the standard has no numbers, products or names like those of this unit
// and its size is known: powers of g, cm, s and K with a power of ten, so that the factor is
// between 1 and 10.
FitsUnit readable_fits_unit(const std::string& unit);

}  // namespace splotchcl
