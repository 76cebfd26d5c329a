#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <filesystem>
#include <memory>
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

// OpenImageIO may report a line for each part that failed, or none; ours are one line.
std::string first_line(const std::string& text);

// `hints` tell the reader of the format what is wanted. Throws DataError for what is no flat
// picture.
std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path,
                                             const OIIO::ImageSpec* hints = nullptr);

// Where a picture's red, green, blue and alpha are among the channels of its file.
struct ChannelPlaces {
  std::array<int, 3> color = {0, 0, 0};
  int alpha = -1;
};
ChannelPlaces find_channels(const OIIO::ImageSpec& spec);

}  // namespace splotchcl
