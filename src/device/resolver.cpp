#include "device/resolver.h"

#include <algorithm>
#include <string>
#include <vector>

#include "device/blur_filter.h"

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
  parameters_.circle_x = 2 * frame.crop.x - frame.width;
  parameters_.circle_y = 2 * frame.crop.y - frame.height;
  parameters_.circle_diameter = std::min(frame.width, frame.height);
  std::string defines = kernel_defines(frame, plan, layout) + "#define LANES_8\n";
  if (frame.background_image) defines += "#define BACKGROUND_IMAGE\n";
  program_ = device.programs.get(
      defines, {"common.cl", "lanes.cl", "shape.cl", "opacity.cl", "precise.cl", "resolve.cl"});
  if (layout.bands) {
    blur_program_ =
        device.programs.get(kernel_defines(frame, plan, layout), {"common.cl", "blur.cl"});
  }
}

// What every grid holds, brought to the picture's own: blurred level by level, then refined
// from the coarsest on. Grids without light are left out.
void Resolver::collect(const compute::buffer& planes, std::uint32_t used_grids) {
  const auto is_used = [&used_grids](std::uint32_t grid) { return (used_grids >> grid & 1) != 0; };
  const auto levels = static_cast<std::uint32_t>(layout_.level_grids.size());
  for (std::uint32_t level = 1; layout_.bands && level < levels; ++level) {
    const std::uint32_t narrow = layout_.level_grids[level], wide = narrow + 1;
    if (is_used(wide)) {
      blur(planes, wide, narrow, layout_.blur[1] - layout_.blur[0], is_used(narrow));
      used_grids |= 1u << narrow;
    }
    if (is_used(narrow)) blur(planes, narrow, narrow, layout_.blur[0], false);
  }
  for (std::uint32_t level = levels - 1; level > 0; --level) {
    const std::uint32_t coarse = layout_.level_grids[level], fine = layout_.level_grids[level - 1];
    if (!is_used(coarse)) continue;
    refine(planes, coarse, fine, is_used(fine));
    used_grids |= 1u << fine;
  }
}

void Resolver::blur(const compute::buffer& planes, std::uint32_t source, std::uint32_t target,
                    double sigma2, bool add) {
  const std::vector<float> weights = blur_weights(sigma2, layout_.blur_error);
  kernel::BlurParameters parameters{};
  parameters.source = source;
  parameters.target = target;
  parameters.half_width = static_cast<int>(weights.size() / 2);
  parameters.add = add;
  std::copy(weights.begin(), weights.end(), parameters.weights);

  const kernel::Grid& from = layout_.grids[source];
  const kernel::Grid& to = layout_.grids[target];
  const compute::buffer temporary = device_.buffers.get(
      "blurred columns",
      4ull * layout_.planes * static_cast<std::uint64_t>(from.height) * (from.stride + 8));
  Launch(device_, "resolve", blur_program_.create_kernel("blur_columns"))
      .value(parameters)
      .arg(grids_)
      .arg(planes)
      .arg(temporary)
      .run_grid(strips(static_cast<std::size_t>(from.width), 8),
                static_cast<std::size_t>(from.height), layout_.planes);
  Launch(device_, "resolve", blur_program_.create_kernel("blur_rows"))
      .value(parameters)
      .arg(grids_)
      .arg(planes)
      .arg(temporary)
      .run_grid(strips(static_cast<std::size_t>(to.width), 8), static_cast<std::size_t>(to.height),
                layout_.planes);
}

void Resolver::refine(const compute::buffer& planes, std::uint32_t coarse, std::uint32_t fine,
                      bool add) {
  const auto fine_width = static_cast<std::size_t>(layout_.grids[fine].width);
  const auto fine_height = static_cast<std::size_t>(layout_.grids[fine].height);
  const auto coarse_height = static_cast<std::size_t>(layout_.grids[coarse].height);
  const compute::buffer temporary = device_.buffers.get(
      "refined columns", 4ull * layout_.planes * coarse_height * layout_.grids[fine].stride);
  Launch(device_, "resolve", program_.create_kernel("refine_columns"))
      .value(coarse)
      .value(fine)
      .arg(grids_)
      .arg(planes)
      .arg(temporary)
      .run_grid(strips(fine_width, 16), coarse_height, layout_.planes);
  Launch(device_, "resolve", program_.create_kernel("refine_rows"))
      .value(coarse)
      .value(fine)
      .value(cl_int{add})
      .arg(grids_)
      .arg(planes)
      .arg(temporary)
      .run_grid(strips(fine_width, 8), fine_height, layout_.planes);
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

Image Resolver::resolve(const compute::buffer& planes, std::uint32_t used_grids) {
  collect(planes, used_grids);
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
