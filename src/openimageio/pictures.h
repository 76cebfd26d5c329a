#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/image_library.h"

namespace splotchcl {

// What ImageLibrary is made of (image/image_library.h says what each does).
std::vector<unsigned char> encode(const std::filesystem::path& path, const std::string& ending,
                                  const StoredPicture& picture);
Image read_stored(const std::filesystem::path& path);
Image read_linear(const std::filesystem::path& path, const LinearImageOptions& options);
ImageFileInfo read_info(const std::filesystem::path& path);
Image scaled(const Image& image, const PictureArea& area, int width, int height);
std::vector<float> blurred(const std::vector<float>& values, int width, int height, float reach);

}  // namespace splotchcl
