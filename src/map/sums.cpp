#include "map/sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "map/geometry.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

constexpr int cells_along = 64;
constexpr std::size_t enough = 1u << 20;  // particles

// Clouds beside the picture count up to so many of their cells away.
constexpr int guard = 2;

// Of the weights, and of the values' sizes.
using Pair = std::array<double, 2>;

// Square cells around the picture's middle, as wide as the widest of their clouds.
class CellGrid {
 public:
  CellGrid(double cell, const SumPicture& picture)
      : cell_(cell),
        columns_(static_cast<int>(std::ceil(picture.width / cell)) + 2 * guard),
        rows_(static_cast<int>(std::ceil(picture.height / cell)) + 2 * guard),
        left_(-0.5 * picture.width - guard * cell),
        top_(-0.5 * picture.height - guard * cell),
        sums_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(double x, double y, const Pair& sums) {
    const double column = (x - left_) / cell_, row = (y - top_) / cell_;
    if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) return;
    Pair& at = this->at(static_cast<int>(column), static_cast<int>(row));
    for (std::size_t s = 0; s < at.size(); ++s)
      at[s] += sums[s];
  }

  // About what clouds as wide as a cell give a pixel here: a cell's weights are spread over nine.
  Pair per_pixel(double x, double y) const {
    constexpr std::array<double, 3> spread = {0.25, 0.5, 0.25};
    const int column = clamped((x - left_) / cell_, columns_);
    const int row = clamped((y - top_) / cell_, rows_);
    Pair sums = {0, 0};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double part = spread[static_cast<std::size_t>(i)] *
                            spread[static_cast<std::size_t>(j)] / (cell_ * cell_);
        const Pair& near = at(column + j - 1, row + i - 1);
        for (std::size_t s = 0; s < sums.size(); ++s)
          sums[s] += part * near[s];
      }
    }
    return sums;
  }

 private:
  // With a neighbor on each side.
  static int clamped(double place, int count) {
    return std::clamp(static_cast<int>(place), 1, count - 2);
  }
  std::size_t place_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  Pair& at(int column, int row) { return sums_[place_of(column, row)]; }
  const Pair& at(int column, int row) const { return sums_[place_of(column, row)]; }

  double cell_;
  int columns_, rows_;
  double left_, top_;
  std::vector<Pair> sums_;
};

class CoarseSums {
 public:
  explicit CoarseSums(const SumPicture& picture)
      : picture_(picture), side_(std::max(picture.width, picture.height)) {
    cell_ = std::max(1.0, side_ / cells_along);
    for (double cell = cell_; grids_.empty() || cell < 2 * side_; cell *= 2)
      grids_.emplace_back(cell, picture);
  }

  void add(double x, double y, double sigma, const Pair& sums) {
    const double octaves = sigma > cell_ ? std::ceil(std::log2(sigma / cell_)) : 0;
    if (octaves < static_cast<double>(grids_.size())) {
      grids_[static_cast<std::size_t>(octaves)].add(x, y, sums);
      return;
    }
    // So wide that it gives all pixels about the same.
    const double part = std::exp(-(x * x + y * y) / (sigma * sigma)) / (pi * sigma * sigma);
    for (std::size_t s = 0; s < even_.size(); ++s)
      even_[s] += part * sums[s];
  }

  // Of pixels in the middle of cells.
  Pair least() const {
    Pair least = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    for (double y = 0.5 * (cell_ - picture_.height); y < 0.5 * picture_.height; y += cell_) {
      for (double x = 0.5 * (cell_ - picture_.width); x < 0.5 * picture_.width; x += cell_) {
        Pair here = even_;
        for (const CellGrid& grid : grids_) {
          const Pair of_grid = grid.per_pixel(x, y);
          for (std::size_t s = 0; s < here.size(); ++s)
            here[s] += of_grid[s];
        }
        for (std::size_t s = 0; s < here.size(); ++s)
          least[s] = std::min(least[s], here[s]);
      }
    }
    return least;
  }

 private:
  SumPicture picture_;
  double side_, cell_ = 1;
  std::vector<CellGrid> grids_;  // each of cells twice as wide as the one before
  Pair even_ = {0, 0};
};

// About the least that any pixel has of a request's sum, or of the smaller one of its sums
// (SumRequest): an estimate from few large cells, and of many
// particles from a part of them.
double expected_least_sum(const PlacedParticles& placed, const std::vector<float>& size,
                          const SumRequest& request, const SumPicture& picture) {
  CoarseSums sums(picture);
  const bool has_factors = !request.factors.empty();
  const std::size_t step = std::max<std::size_t>(1, placed.count() / enough);
  for (std::size_t i = 0; i < placed.count(); i += step) {
    const double weight = static_cast<double>(step) * static_cast<double>(request.weight[i]);
    Pair of_cloud = {weight, weight};
    if (has_factors) {
      of_cloud[0] *= static_cast<double>(request.factors[3 * i]);
      of_cloud[1] *= static_cast<double>(request.factors[3 * i + 1]) +
                     static_cast<double>(request.factors[3 * i + 2]);
    }
    sums.add(static_cast<double>(placed.position[3 * i]),
             static_cast<double>(placed.position[3 * i + 1]),
             picture.kernel_width * static_cast<double>(size[i]), of_cloud);
  }
  const Pair least = sums.least();
  return std::min(least[0], least[1]);
}

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
