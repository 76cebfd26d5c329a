#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/image_library.h"

namespace splotchcl {

// Reading, as ImageLibrary has it (image/image_library.h says what each does).
Image read_stored(const std::filesystem::path& path);
Image read_linear(const std::filesystem::path& path, const LinearImageOptions& options);
ImageFileInfo read_info(const std::filesystem::path& path);

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
