#pragma once

#include <filesystem>
#include <memory>

#include "splotchcl/image.h"

namespace splotchcl {

// A picture as light behind everything (Frame::background_image): scaled to fill width x
// height pixels, what overhangs is cut off. Whole numbers in the file are display values
// and become value^gamma, floats are linear light. Throws DataError when the file cannot
// be read or holds light that is negative or not finite.
std::shared_ptr<const Image> load_background_image(const std::filesystem::path& path, int width,
                                                   int height, double gamma);

// The picture scaled to fill width x height pixels; what overhangs is cut off. The same
// picture where it has that size.
Image scaled_to_fill(const Image& image, int width, int height);

}  // namespace splotchcl
