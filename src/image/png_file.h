#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

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

}  // namespace splotchcl
