#include "tree/pixel_response.h"

#include "scene/constants.h"

namespace splotchcl {

PixelResponse pixel_response(double deviation_pixels) {
  const double w2 = deviation_pixels * deviation_pixels + 1.0 / 12;
  PixelResponse response;
  response.value = 1 / (4 * pi * w2);
  response.first = response.value / w2;
  response.second = 2 * response.first / w2;
  response.third = 3 * response.second / w2;
  response.fourth = 4 * response.third / w2;
  response.area = pi * w2;
  return response;
}

}  // namespace splotchcl
