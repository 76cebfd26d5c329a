#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>

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

}  // namespace

std::vector<unsigned char> encode(const std::filesystem::path& path, const std::string& ending,
                                  const StoredPicture& picture) {
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

}  // namespace splotchcl
