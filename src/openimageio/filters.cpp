#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include "openimageio/pictures.h"

namespace splotchcl {
namespace {

OIIO::ImageBuf wrap(Image& image) {
  return OIIO::ImageBuf(OIIO::ImageSpec(image.width, image.height, 4, OIIO::TypeDesc::FLOAT),
                        image.pixels.data());
}

}  // namespace

Image scaled(const Image& image, const PictureArea& area, int width, int height) {
  Image pixels = image;
  const OIIO::ROI part(area.left, area.left + area.width, area.top, area.top + area.height);
  const OIIO::ImageBuf source = OIIO::ImageBufAlgo::cut(wrap(pixels), part);
  Image result(width, height);
  OIIO::ImageBuf target = wrap(result);
  OIIO::ImageBufAlgo::resize(target, source, "blackman-harris");
  return result;
}

std::vector<float> blurred(const std::vector<float>& values, int width, int height, float reach) {
  std::vector<float> pixels = values;
  const OIIO::ImageSpec spec(width, height, 1, OIIO::TypeDesc::FLOAT);
  const OIIO::ImageBuf source(spec, pixels.data());
  const OIIO::ImageBuf kernel = OIIO::ImageBufAlgo::make_kernel("gaussian", reach, reach);
  const OIIO::ImageBuf result = OIIO::ImageBufAlgo::convolve(source, kernel);
  result.get_pixels(OIIO::ROI(0, width, 0, height), OIIO::TypeDesc::FLOAT, pixels.data());
  return pixels;
}

}  // namespace splotchcl
