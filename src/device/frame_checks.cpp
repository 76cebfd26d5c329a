#include "device/frame_checks.h"

#include <string>

#include "ranks/spread_particles.h"
#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {

void check_frame(const Frame& frame) {
  const Rectangle& crop = frame.crop;
  if (crop.width < 1 || crop.height < 1 || crop.x < 0 || crop.y < 0 ||
      crop.x > frame.width - crop.width || crop.y > frame.height - crop.height) {
    throw UsageError("crop: found " + std::to_string(crop.x) + "," + std::to_string(crop.y) + "," +
                     std::to_string(crop.width) + "," + std::to_string(crop.height) +
                     ", expected a part of the picture, which is " + std::to_string(frame.width) +
                     " x " + std::to_string(frame.height) + " pixels");
  }
  if (frame.width > largest_side || frame.height > largest_side ||
      std::int64_t{crop.width} * crop.height > largest_pixel_count) {
    throw UsageError(
        "found a picture of " + std::to_string(frame.width) + " x " + std::to_string(frame.height) +
        " pixels, of which " + std::to_string(std::int64_t{crop.width} * crop.height) +
        " are drawn, expected sides of at most " + std::to_string(largest_side) + " and at most " +
        std::to_string(largest_pixel_count) + " pixels drawn at a time");
  }
  if (const Image* const background = frame.background_image.get();
      background != nullptr &&
      (background->width != frame.width || background->height != frame.height)) {
    throw UsageError("background_image: found " + std::to_string(background->width) + " x " +
                     std::to_string(background->height) + " pixels, expected the picture's " +
                     std::to_string(frame.width) + " x " + std::to_string(frame.height));
  }
  if (frame.components.size() > 0xffff) {
    throw UsageError("found " + std::to_string(frame.components.size()) +
                     " components, expected at most 65535");
  }
}

void check_ranks(const Frame& frame, const Communicator* ranks) {
  if (!frame.spread) return;
  const int drawing = ranks == nullptr ? 1 : ranks->size();
  if (drawing == frame.spread->ranks().size()) return;
  throw UsageError("found particles that are spread over " +
                   std::to_string(frame.spread->ranks().size()) + " processes and a renderer of " +
                   std::to_string(drawing) +
                   ", expected one of all of them; give it the same communicator as the snapshot");
}

void require_doubles(const DeviceContext& device) {
  if (device.traits.double_numbers) return;
  throw DeviceError(
      "device " + device.device.name() +
      " has no double precision, which this frame needs: its tolerance is 0, or single "
      "precision does not keep its promise; choose a larger tolerance or another device");
}

}  // namespace splotchcl
