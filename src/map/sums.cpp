#include "map/sums.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "map/expected_least.h"
#include "scene/constants.h"

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

Frame frame_of_sums(const PlacedParticles& placed, const std::vector<float>& size,
                    SumRequest request, const SumPicture& picture) {
  Frame frame = empty_frame(picture);
  DrawnComponent component;
  component.name = "map";
  component.weight = WeightModel::mass;
  component.palette.name = "white";
  component.palette.emission = {Rgb{1, 1, 1}};
  component.absorption.kind = Absorption::Kind::none;
  component.particles.count = placed.count();
  component.particles.position = Column(nullptr, placed.position.data(), placed.position.size());
  component.particles.smoothing_length = Column(nullptr, size.data(), size.size());
  component.particles.weight = Column(nullptr, request.weight.data(), request.weight.size());
  if (!request.factors.empty())
    component.particles.color_vector = Column::owning(std::move(request.factors));
  frame.components.push_back(std::move(component));
  return frame;
}

// The pixels of which a sum is below some limit: a rectangle that holds them all, and the least.
struct DimPixels {
  int x0 = std::numeric_limits<int>::max(), y0 = x0, x1 = 0, y1 = 0;
  double least = std::numeric_limits<double>::max();

  bool are_any() const { return x1 > x0; }
  Rectangle rectangle() const { return {x0, y0, x1 - x0, y1 - y0}; }
};

// Frames are promised to a part of what counts as white, or of the light where that is more. So
// the higher white is the less there is to draw, and where all pixels are above it their sums are
// known to a part of themselves.
class SumDrawing {
 public:
  SumDrawing(Frame frame, std::size_t sums, const DrawFrame& draw)
      : frame_(std::move(frame)), count_(sums), draw_(draw) {
    const std::size_t pixels =
        static_cast<std::size_t>(frame_.width) * static_cast<std::size_t>(frame_.height);
    for (std::size_t s = 0; s < count_; ++s)
      sums_[s].resize(pixels);
  }

  void draw(const Rectangle& part, double white) {
    frame_.crop = part;
    frame_.components.front().reference_column = white;
    const Image image = draw_(frame_);
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) {
        const float* const pixel = image.at(x, y);
        for (std::size_t s = 0; s < count_; ++s)
          sums_[s][pixel_at(part.x + x, part.y + y)] = white * static_cast<double>(pixel[s]);
      }
    }
  }

  DimPixels below(double limit) const {
    DimPixels dim;
    for (int y = 0; y < frame_.height; ++y) {
      for (int x = 0; x < frame_.width; ++x) {
        const double sum = smaller_sum(pixel_at(x, y));
        if (sum >= limit) continue;
        dim.x0 = std::min(dim.x0, x);
        dim.x1 = std::max(dim.x1, x + 1);
        dim.y0 = std::min(dim.y0, y);
        dim.y1 = std::max(dim.y1, y + 1);
        dim.least = std::min(dim.least, sum);
      }
    }
    return dim;
  }

  PixelSums take() { return std::move(sums_); }

 private:
  std::size_t pixel_at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) +
           static_cast<std::size_t>(x);
  }
  double smaller_sum(std::size_t pixel) const {
    if (count_ == 1) return sums_[0][pixel];
    return std::min(sums_[0][pixel], sums_[1][pixel] + sums_[2][pixel]);
  }

  Frame frame_;
  std::size_t count_;
  const DrawFrame& draw_;
  PixelSums sums_;
};

}  // namespace

double least_floor(const std::vector<float>& size, const std::vector<float>& weight,
                   const std::vector<float>& factors, double kernel_width) {
  constexpr double digits = 0x1p-50;
  double brightest = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double sigma = kernel_width * static_cast<double>(size[i]);
    double light = static_cast<double>(weight[i]) / std::max(1.0, pi * sigma * sigma);
    if (!factors.empty()) {
      const auto of_particle = factors.begin() + 3 * static_cast<std::ptrdiff_t>(i);
      light *= static_cast<double>(*std::max_element(of_particle, of_particle + 3));
    }
    brightest = std::max(brightest, light);
  }
  return digits * brightest;
}

namespace {

double floor_of(const std::vector<float>& size, const SumRequest& request, double kernel_width) {
  if (request.factors.empty()) return request.floor;
  return std::max(request.floor, least_floor(size, request.weight, request.factors, kernel_width));
}

}  // namespace

PixelSums draw_sums(const PlacedParticles& placed, const std::vector<float>& size,
                    SumRequest request, const SumPicture& picture, const DrawFrame& draw) {
  if (placed.count() == 0) {
    const std::vector<double> nothing(static_cast<std::size_t>(picture.width) *
                                      static_cast<std::size_t>(picture.height));
    return {nothing, nothing, nothing};
  }
  const std::size_t sums = request.factors.empty() ? 1 : PixelSums().size();
  const Rectangle whole = {0, 0, picture.width, picture.height};
  const double floor = floor_of(size, request, picture.kernel_width);
  // A cell's mean is more than its darkest pixel has.
  constexpr double of_least = 0.5;
  const double least =
      request.are_parts ? of_least * expected_least_sum(placed, size, request, picture) : 0;
  double white = std::max(floor, least);
  SumDrawing drawing(frame_of_sums(placed, size, std::move(request), picture), sums, draw);
  drawing.draw(whole, white);
  for (DimPixels dim = drawing.below(white); white > floor && dim.are_any();
       dim = drawing.below(white)) {
    white = std::max(floor, of_least * std::min(white, dim.least));
    drawing.draw(dim.rectangle(), white);
  }
  return drawing.take();
}

}  // namespace splotchcl
