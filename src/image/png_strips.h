#pragma once

#include <cstddef>
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

}  // namespace splotchcl
