#include "device/resolver.h"

#include <algorithm>
#include <string>
#include <vector>

namespace splotchcl {
namespace {

std::size_t strips(std::size_t pixels, std::size_t per_item) {
  return (pixels + per_item - 1) / per_item;
}

}  // namespace

Resolver::Resolver(DeviceContext& device, const FrameLayout& layout, const Frame& frame,
                   const Plan& plan, const compute::buffer& grids)
    : device_(device), layout_(layout), frame_(frame), grids_(grids) {
  parameters_.width = frame.crop.width;
  parameters_.height = frame.crop.height;
  for (std::size_t c = 0; c < 3; ++c) {
    parameters_.source[c] = static_cast<float>(plan.source[c]);
    parameters_.background[c] = static_cast<float>(frame.background[c]);
  }
  std::string defines = kernel_defines(frame, plan, layout) + "#define LANES_8\n";
  if (frame.background_image) defines += "#define BACKGROUND_IMAGE\n";
  program_ = device.programs.get(defines,
                                 {"common.cl", "lanes.cl", "shape.cl", "precise.cl", "resolve.cl"});
}

// From the coarsest grid to the picture's own, each added to the next finer one.
void Resolver::refine(const compute::buffer& planes) {
  const std::size_t grid_count = layout_.grids.size();
  if (grid_count < 2) return;
  std::uint64_t largest = 0;
  for (std::size_t g = 1; g < grid_count; ++g) {
    const auto height = static_cast<std::uint64_t>(layout_.grids[g].height);
    largest = std::max(largest, layout_.planes * height * layout_.grids[g - 1].stride);
  }
  const compute::buffer temporary = device_.buffers.get("refined columns", 4 * largest);
  for (std::size_t g = grid_count - 1; g > 0; --g) {
    const auto coarse_index = static_cast<std::uint32_t>(g);
    const auto fine_width = static_cast<std::size_t>(layout_.grids[g - 1].width);
    const auto fine_height = static_cast<std::size_t>(layout_.grids[g - 1].height);
    const auto coarse_height = static_cast<std::size_t>(layout_.grids[g].height);
    Launch(device_, "resolve", program_.create_kernel("refine_columns"))
        .value(coarse_index)
        .arg(grids_)
        .arg(planes)
        .arg(temporary)
        .run_grid(strips(fine_width, 16), coarse_height, layout_.planes);
    Launch(device_, "resolve", program_.create_kernel("refine_rows"))
        .value(coarse_index)
        .arg(grids_)
        .arg(planes)
        .arg(temporary)
        .run_grid(strips(fine_width, 8), fine_height, layout_.planes);
  }
}

// The crop's part of the background's picture, a plane per channel.
compute::buffer Resolver::upload_background() {
  const Rectangle& crop = frame_.crop;
  const std::size_t stride = 8 * strips(static_cast<std::size_t>(crop.width), 8);
  parameters_.background_stride = static_cast<int>(stride);
  const std::size_t plane = stride * static_cast<std::size_t>(crop.height);
  std::vector<float> planes(3 * plane);
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const float* pixel = frame_.background_image->at(crop.x + x, crop.y + y);
      const std::size_t place = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
      for (std::size_t c = 0; c < 3; ++c)
        planes[c * plane + place] = pixel[c];
    }
  }
  return device_.buffers.upload("background", planes);
}

Image Resolver::resolve(const compute::buffer& planes) {
  refine(planes);
  Image image(parameters_.width, parameters_.height);
  const std::uint64_t bytes = image.pixels.size() * sizeof(float);
  const compute::buffer pixels = device_.buffers.get("image", bytes);
  const compute::buffer background =
      frame_.background_image ? upload_background() : compute::buffer();
  Launch launch(device_, "resolve", program_.create_kernel("resolve"));
  launch.value(parameters_).arg(grids_).arg(planes);
  if (frame_.background_image) launch.arg(background);
  launch.arg(pixels).run_grid(strips(static_cast<std::size_t>(image.width), 8),
                              static_cast<std::size_t>(image.height), 1);
  device_.queue.enqueue_read_buffer(pixels, 0, bytes, image.pixels.data());
  return image;
}

}  // namespace splotchcl
