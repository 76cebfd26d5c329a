#include "map/sums.h"

#include <utility>

namespace splotchcl {
namespace {

// Looks straight down on the particles, one length to a pixel.
CameraFrame camera_above(int width, int height) {
  CameraFrame camera;
  camera.look_at_distance = width;
  camera.position = {{0, 0, -camera.look_at_distance}};
  camera.right = {{1, 0, 0}};
  camera.down = {{0, 1, 0}};
  camera.forward = {{0, 0, 1}};
  camera.focal_pixels = camera.look_at_distance;
  camera.pixels_per_length = 1;
  camera.center_x = 0.5 * width;
  camera.center_y = 0.5 * height;
  return camera;
}

Frame empty_frame(const SumPicture& picture) {
  Frame frame;
  frame.width = picture.width;
  frame.height = picture.height;
  frame.crop = {0, 0, frame.width, frame.height};
  frame.camera = camera_above(frame.width, frame.height);
  frame.projection = Projection::orthographic;
  frame.kernel.width = picture.kernel_width;
  frame.tolerance = picture.tolerance;
  return frame;
}

}  // namespace

PixelSums draw_sums(const PlacedParticles& placed, const std::vector<float>& size,
                    SumRequest request, const SumPicture& picture, const DrawFrame& draw) {
  if (placed.count() == 0) {
    const std::vector<double> nothing(static_cast<std::size_t>(picture.width) *
                                      static_cast<std::size_t>(picture.height));
    return {nothing, nothing, nothing};
  }
  Frame frame = empty_frame(picture);
  DrawnComponent component;
  component.name = "map";
  component.weight = WeightModel::mass;
  component.reference_column = request.white;
  component.palette.name = "white";
  component.palette.emission = {Rgb{1, 1, 1}};
  component.absorption.kind = Absorption::Kind::none;
  component.particles.count = placed.count();
  component.particles.position = Column(nullptr, placed.position.data(), placed.position.size());
  component.particles.smoothing_length = Column(nullptr, size.data(), size.size());
  component.particles.weight = Column::owning(std::move(request.weight));
  component.particles.color_vector = Column::owning(std::move(request.factors));
  frame.components.push_back(std::move(component));
  const Image image = draw(frame);

  PixelSums sums;
  for (std::size_t channel = 0; channel < sums.size(); ++channel) {
    sums[channel].resize(image.pixels.size() / 4);
    for (std::size_t i = 0; i < sums[channel].size(); ++i)
      sums[channel][i] = request.white * static_cast<double>(image.pixels[4 * i + channel]);
  }
  return sums;
}

}  // namespace splotchcl
