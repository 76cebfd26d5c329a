#pragma once

#include <cstdint>
#include <vector>

namespace splotchcl::view {

// A JPEG file of red, green and blue of each pixel, rows from the top: previews, where time counts
// more than the last digit. Throws DataError.
std::vector<unsigned char> encode_jpeg(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace splotchcl::view
