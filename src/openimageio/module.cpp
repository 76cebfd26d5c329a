#include "openimageio/pictures.h"

namespace splotchcl {
namespace {

class OpenImageIoLibrary : public ImageLibrary {
 public:
  std::vector<unsigned char> encode(const std::filesystem::path& path, const std::string& ending,
                                    const StoredPicture& picture) const override {
    return splotchcl::encode(path, ending, picture);
  }
  Image read(const std::filesystem::path& path) const override { return read_stored(path); }
  Image read_linear(const std::filesystem::path& path,
                    const LinearImageOptions& options) const override {
    return splotchcl::read_linear(path, options);
  }
  ImageFileInfo read_info(const std::filesystem::path& path) const override {
    return splotchcl::read_info(path);
  }
  Image scaled(const Image& image, const PictureArea& area, int width, int height) const override {
    return splotchcl::scaled(image, area, width, height);
  }
  std::vector<float> blurred(const std::vector<float>& values, int width, int height,
                             float reach) const override {
    return splotchcl::blurred(values, width, height, reach);
  }
};

}  // namespace
}  // namespace splotchcl

extern "C" __attribute__((visibility("default"))) const splotchcl::ImageLibrary*
splotchcl_image_library() {
  static const splotchcl::OpenImageIoLibrary library;
  return &library;
}
