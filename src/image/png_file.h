#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace splotchcl {

// The whole PNG file of a picture of 8 or 16 bits in red, green and blue, rows from the top, said
// to be sRGB. By libpng itself: it is there in a millisecond, and most pictures are PNG files.
// `path` is for messages. Throws DataError.
std::vector<unsigned char> encode_png(const std::filesystem::path& path, int width, int height,
                                      const std::vector<std::uint8_t>& rgb);
std::vector<unsigned char> encode_png(const std::filesystem::path& path, int width, int height,
                                      const std::vector<std::uint16_t>& rgb);

}  // namespace splotchcl
