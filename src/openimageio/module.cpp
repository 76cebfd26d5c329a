#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/tiffutils.h>

#include <cstdint>
#include <memory>
#include <string>

#include "openimageio/pictures.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

OIIO::ImageSpec make_spec(const StoredPicture& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  // JPEG: little loss, and none of it by halving the resolution of colour.
  spec.attribute("CompressionQuality", 95);
  spec.attribute("jpeg:subsampling", "4:4:4");
  spec.attribute("oiio:ColorSpace", "sRGB");
  constexpr int srgb = 1;
  spec.attribute("Exif:ColorSpace", srgb);
  return spec;
}

OIIO::ImageBuf wrap(Image& image) {
  return OIIO::ImageBuf(OIIO::ImageSpec(image.width, image.height, 4, OIIO::TypeDesc::FLOAT),
                        image.pixels.data());
}

class OpenImageIoLibrary : public ImageLibrary {
 public:
  std::vector<unsigned char> encode(const std::filesystem::path& path, const std::string& ending,
                                    const StoredPicture& picture) const override {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(ending);
    if (!output || !output->supports("ioproxy")) {
      (void)OIIO::geterror();
      throw UsageError(path.string() + ": this build of OpenImageIO cannot write ." + ending +
                       "; choose another ending, such as .png or .exr");
    }
    const auto require = [&](bool good) {
      if (good) return;
      throw DataError(path.string() + ": " + std::to_string(picture.width) + "x" +
                      std::to_string(picture.height) + " pixels cannot be stored as ." + ending +
                      ": " + first_line(output->geterror()));
    };
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    require(output->set_ioproxy(&memory));
    const OIIO::ImageSpec spec = make_spec(picture);
    require(output->open("picture." + ending, spec));
    require(output->write_image(spec.format, picture.pixels));
    require(output->close());
    return file;
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
    Image pixels = image;
    const OIIO::ROI part(area.left, area.left + area.width, area.top, area.top + area.height);
    const OIIO::ImageBuf source = OIIO::ImageBufAlgo::cut(wrap(pixels), part);
    Image result(width, height);
    OIIO::ImageBuf target = wrap(result);
    OIIO::ImageBufAlgo::resize(target, source, "blackman-harris");
    return result;
  }

  std::vector<float> blurred(const std::vector<float>& values, int width, int height,
                             float reach) const override {
    std::vector<float> pixels = values;
    const OIIO::ImageSpec spec(width, height, 1, OIIO::TypeDesc::FLOAT);
    const OIIO::ImageBuf source(spec, pixels.data());
    const OIIO::ImageBuf kernel = OIIO::ImageBufAlgo::make_kernel("gaussian", reach, reach);
    const OIIO::ImageBuf result = OIIO::ImageBufAlgo::convolve(source, kernel);
    result.get_pixels(OIIO::ROI(0, width, 0, height), OIIO::TypeDesc::FLOAT, pixels.data());
    return pixels;
  }
};

}  // namespace
}  // namespace splotchcl

// OpenImageIO calls this for the colour profile in a file of any format, which nothing here uses.
// Its own, in version 2.4, reads where a damaged profile says, also far outside of it. The loader
// looks into this module before the libraries that come with it.
OIIO_NAMESPACE_BEGIN

bool decode_icc_profile(cspan<std::uint8_t>, ImageSpec&, std::string&) {
  return true;
}

OIIO_NAMESPACE_END

extern "C" __attribute__((visibility("default"))) const splotchcl::ImageLibrary*
splotchcl_image_library() {
  static const splotchcl::OpenImageIoLibrary library;
  return &library;
}
