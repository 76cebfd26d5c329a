#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "splotchcl/image.h"

// Whole files, most of linear light, by each format's own library: together these are there in
// three milliseconds, where OpenImageIO takes a quarter of a second. `path` is for messages. All
// throw DataError.
namespace splotchcl {

// 32-bit floats with premultiplied alpha, and texts.
std::vector<unsigned char> encode_exr(const std::filesystem::path& path, const Image& image,
                                      const std::map<std::string, std::string>& metadata);

// 32-bit floats with premultiplied alpha, said to be linear; deflated without a predictor: many
// readers do not know the predictor for floats.
std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, const Image& image);

// Display values of 8 or 16 bits in red, green and blue, rows from the top, said to be sRGB.
std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, int width, int height,
                                       const std::vector<std::uint8_t>& rgb);
std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, int width, int height,
                                       const std::vector<std::uint16_t>& rgb);

// Three mantissas of 8 bits with one exponent per pixel. Refuses light that is below 0 or not
// finite, which the format cannot hold.
std::vector<unsigned char> encode_hdr(const std::filesystem::path& path, const Image& image);

}  // namespace splotchcl
