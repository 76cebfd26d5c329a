#pragma once

#include <cstddef>
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

// The bytes of a picture's rows, the first at the top, without gaps.
struct PngRows {
  const unsigned char* bytes;
  std::size_t row_bytes, rows;
  std::size_t pixel_bytes;
};

// The data of a PNG file's IDAT chunks, one for each strip of rows, in order: one zlib stream (RFC
// 1950) of filtered rows (PNG specification, section 9). All cores compress strips, and which rows
// a strip has depends on the picture's size alone, so files do not depend on the number of cores.
// Throws std::bad_alloc.
std::vector<std::vector<unsigned char>> png_strips(const PngRows& picture);

// The whole PNG file of a picture of 8 or 16 bits in red, green and blue, rows from the top, said
// to be sRGB. By libpng itself: it is there in a millisecond, and most pictures are PNG files.
// `path` is for messages. Throws DataError.
std::vector<unsigned char> encode_png(const std::filesystem::path& path, int width, int height,
                                      const std::vector<std::uint8_t>& rgb);
std::vector<unsigned char> encode_png(const std::filesystem::path& path, int width, int height,
                                      const std::vector<std::uint16_t>& rgb);

// 32-bit floats with premultiplied alpha, and texts.
std::vector<unsigned char> encode_exr(const std::filesystem::path& path, const Image& image,
                                      const std::map<std::string, std::string>& metadata);

// 32-bit floats with premultiplied alpha, said to be linear; deflated without a predictor: many
// readers do not know the predictor for floats.
std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, const Image& image,
                                       const std::string& description);

// Display values of 8 or 16 bits in red, green and blue, rows from the top, said to be sRGB.
std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, int width, int height,
                                       const std::vector<std::uint8_t>& rgb);
std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, int width, int height,
                                       const std::vector<std::uint16_t>& rgb);

// Three mantissas of 8 bits with one exponent per pixel, and lines that describe them. Refuses
// light that is below 0 or not finite, which the format cannot hold.
std::vector<unsigned char> encode_hdr(const std::filesystem::path& path, const Image& image,
                                      const std::string& description);

// What the numbers of a file stand for, with Rec. 709's primaries and the white of D65: display
// values as IEC 61966-2-1 has them, or linear light.
enum class ColorSpace { srgb, linear };

// An ICC profile, version 4.2 (ICC.1:2004-10), the same bytes at any time.
std::vector<unsigned char> color_profile(ColorSpace space);

// The OpenEXR library takes memory for every attribute of a header, and for the table of where the
// lines begin, as large as the header says, before it looks how long the file is: 2 GB for a file
// of 1 kB. This reads the lengths alone (OpenEXR's "File Layout"). Throws DataError when one is
// longer than the file; returns for what is no EXR file at all.
void check_exr_header(const std::filesystem::path& path);

}  // namespace splotchcl
