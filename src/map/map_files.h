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
void write_hdf5(const std::filesystem::path& temporary, const std::filesystem::path& path,
                const Map& map, const SnapshotInfo& snapshot, const MapMetadata& metadata);
// Red: the map. Green: the effective number of particles, or 0.
Image numbers_as_image(const Map& map);

}  // namespace splotchcl
