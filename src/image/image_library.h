#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/image.h"
#include "splotchcl/image_file.h"

namespace splotchcl {

// A picture of 8 bits in red, green and blue as a file shall hold it, rows from the top.
struct StoredPicture {
  int width = 0, height = 0;
  const unsigned char* pixels = nullptr;
};

// Part of a picture, in pixels.
struct PictureArea {
  int left = 0, top = 0, width = 0, height = 0;
};

// All that is done by OpenImageIO. It brings some 250 shared libraries with it, which take a
// quarter of a second to load: as long as a frame of millions of particles. So it lies in a
// module of its own (src/openimageio) that is loaded when the first picture needs it: one that is
// read, or written in a format that picture_encoders.h does not know.
class ImageLibrary {
 public:
  virtual ~ImageLibrary() = default;

  // A whole file of the format with that ending. `path` is for messages. Throws UsageError
  // where OpenImageIO was built without the format, DataError where it cannot hold the picture.
  virtual std::vector<unsigned char> encode(const std::filesystem::path& path,
                                            const std::string& ending,
                                            const StoredPicture& picture) const = 0;
  // As in image_file.h.
  virtual Image read(const std::filesystem::path& path) const = 0;
  virtual Image read_linear(const std::filesystem::path& path,
                            const LinearImageOptions& options) const = 0;
  virtual ImageFileInfo read_info(const std::filesystem::path& path) const = 0;

  // Filtered without negative weights: light stays >= 0.
  virtual Image scaled(const Image& image, const PictureArea& area, int width,
                       int height) const = 0;
  // One value per pixel, blurred by a Gaussian that ends `reach` pixels across.
  virtual std::vector<float> blurred(const std::vector<float>& values, int width, int height,
                                     float reach) const = 0;
};

// Loads the module when first called. Throws DataError where it is missing.
const ImageLibrary& image_library();

// What the module exports.
using ImageLibraryEntry = const ImageLibrary*();
inline constexpr char image_library_entry[] = "splotchcl_image_library";

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
