#include "scene/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/constants.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "scene/plan/cloud_sample.h"
#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

constexpr double left_out_at_each_end = 0.005;

// One value for all is nobody's own.
ParticlePass pass_over_values(const Column& column, const ParticlePass& pass) {
  return column.is_array() ? pass : ParticlePass(column.is_uniform() ? 1 : 0);
}

// Of the scaled values that are finite; without any the lower end is above the upper one.
ValueRange range_of(const Column& column, Scaling scaling, const ParticleRun& run) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ValueRange range = {infinity, -infinity};
  for_stretches(run, [&](std::size_t begin, std::size_t end) {
    const ColumnStretch stretch(column, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const double value = scaled(static_cast<double>(stretch[i]), scaling);
      if (!std::isfinite(value)) continue;
      range.minimum = std::min(range.minimum, value);
      range.maximum = std::max(range.maximum, value);
    }
  });
  return range;
}

}  // namespace

std::size_t sampled_index(std::size_t first, std::size_t stride, std::size_t count) {
  const std::size_t range = std::min(stride, count - first);
  return first + static_cast<std::size_t>(hash_of(first / stride) % range);
}

double percentile(std::vector<double>& values, double fraction) {
  const double place = fraction * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(std::floor(place));
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), lower, values.end());
  if (below + 1 >= values.size()) return *lower;
  const double upper = *std::min_element(lower + 1, values.end());
  return *lower + (place - static_cast<double>(below)) * (upper - *lower);
}

std::vector<double> sample_scaled(const Column& column, Scaling scaling, const ParticlePass& pass) {
  const std::size_t stride = least_sample_stride(column.size());
  return pass_over_values(column, pass)
      .collect<double>([&](const ParticleRun& run, std::vector<double>& values) {
        for (std::size_t i = first_sampled(run, stride); i < run.end; i += stride) {
          const double value = scaled(static_cast<double>(column[i]), scaling);
          if (std::isfinite(value)) values.push_back(value);
        }
      });
}

std::vector<double> sample_scaled(const Column& column, Scaling scaling) {
  return sample_scaled(column, scaling, ParticlePass(column.size()));
}

std::optional<ValueRange> percentile_range(const Column& column, Scaling scaling, double low,
                                           double high, const ParticlePass& pass) {
  std::vector<double> values = sample_scaled(column, scaling, pass);
  if (values.empty()) return std::nullopt;
  ValueRange range = {percentile(values, low / 100), percentile(values, high / 100)};
  if (low > 0 && high < 100) return range;
  const std::vector<ValueRange> ends =
      pass_over_values(column, pass)
          .collect<ValueRange>([&](const ParticleRun& run, std::vector<ValueRange>& found) {
            found.push_back(range_of(column, scaling, run));
          });
  for (const ValueRange& end : ends) {
    if (low <= 0) range.minimum = std::min(range.minimum, end.minimum);
    if (high >= 100) range.maximum = std::max(range.maximum, end.maximum);
  }
  return range;
}

std::optional<ValueRange> bulk_range(const Column& column, Scaling scaling,
                                     const ParticlePass& pass) {
  std::vector<double> values = sample_scaled(column, scaling, pass);
  if (values.empty()) return std::nullopt;
  return ValueRange{percentile(values, left_out_at_each_end),
                    percentile(values, 1 - left_out_at_each_end)};
}

std::optional<ValueRange> bulk_range(const Column& column, Scaling scaling) {
  return bulk_range(column, scaling, ParticlePass(column.size()));
}

// A picture saturates where the optical depth is well above 1 and is black where it is
// well below, so the reference follows from the columns that the picture itself will
// show, not from the particles' own: how many clouds overlap depends on the view. The
// picture is estimated on a coarse grid of fixed width (of fixed height for a very high
// picture), so that the reference, and with it the brightness, depends neither on the size
// of the picture nor on its crop.

namespace {

constexpr int coarse_width = 256;
constexpr double most_rows_per_column = 4;  // of a picture that is higher than wide
constexpr int level_count = 9;              // the last level's cell is as wide as the picture
constexpr std::size_t particle_limit = 500000;

// A pixel is lit when it shows at least this part of what the brightest pixels show;
// what is dimmer is black in any picture and says nothing about its exposure.
constexpr double lit_fraction = 0.002;
constexpr double brightest_percentile = 0.999;

// The reference is the column that this part of the lit pixels stays below.
constexpr double exposed_percentile = 0.9;

struct Cloud {
  double x, y, sigma;  // in coarse pixels
  double column;       // through its centre, times the strength of its colour
};

struct Grid {
  int width, height;
  std::vector<double> cells;

  Grid(int w, int h)
      : width(w), height(h), cells(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  double& at(int x, int y) {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)];
  }
};

// Columns of matter on grids whose cells double in width from level to level.
class ColumnPyramid {
 public:
  ColumnPyramid(int width, int height) {
    for (int level = 0; level < level_count; ++level) {
      levels_.emplace_back((width >> level) + 1, (height >> level) + 1);
    }
    width_ = width;
    height_ = height;
  }

  // Adds a cloud at the level whose cells are about as large as the cloud, shared by the
  // four nearest cells.
  void add(const Cloud& cloud) {
    const double side = std::sqrt(pi) * cloud.sigma;  // of a square with the cloud's flux
    const int level =
        static_cast<int>(std::lround(std::clamp(std::log2(side), 0.0, level_count - 1.0)));
    const double cell = std::ldexp(1.0, level);
    // A cloud wider than the widest cell adds its column, not all its flux.
    const double column = cloud.column * std::min(side * side / (cell * cell), 2.0);
    const double x = cloud.x / cell - 0.5;
    const double y = cloud.y / cell - 0.5;
    Grid& grid = levels_[static_cast<std::size_t>(level)];
    if (!(x > -1 && y > -1 && x < grid.width && y < grid.height)) return;
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    for (int dy = 0; dy <= 1; ++dy) {
      for (int dx = 0; dx <= 1; ++dx) {
        if (x0 + dx < 0 || x0 + dx >= grid.width || y0 + dy < 0 || y0 + dy >= grid.height) continue;
        grid.at(x0 + dx, y0 + dy) +=
            column * (1 - std::abs(x - (x0 + dx))) * (1 - std::abs(y - (y0 + dy)));
      }
    }
  }

  // The sum of all levels in every pixel.
  std::vector<double> pixels() {
    std::vector<double> sums;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        double sum = 0;
        for (int level = 0; level < level_count; ++level) {
          sum += levels_[static_cast<std::size_t>(level)].at(x >> level, y >> level);
        }
        sums.push_back(sum);
      }
    }
    return sums;
  }

 private:
  int width_ = 0, height_ = 0;
  std::vector<Grid> levels_;
};

// Coarse pixels per pixel.
double coarse_scale(const Frame& frame) {
  return coarse_width / std::max<double>(frame.width, frame.height / most_rows_per_column);
}

// How much of a column the particle's colour lets through to the picture: its brightest
// channel, of emission or absorption. Black palette entries count a little, so that a
// component without any light still has a reference.
double color_strength(const DrawnComponent& component, std::size_t i) {
  constexpr double least = 0.02;
  const Column& color = component.particles.color;
  const double place =
      color.is_absent() ? 0.0 : normalized(static_cast<double>(color[i]), component.color);
  double strength = least;
  const auto emitted = sample_knots(component.palette.emission, place);
  for (std::size_t c = 0; c < 3; ++c) {
    const Column& vector = component.particles.color_vector;
    const double own = vector.is_absent() ? 1.0 : static_cast<double>(vector[3 * i + c]);
    strength = std::max(strength, own * emitted[c]);
  }
  if (!component.palette.has_own_absorption()) return strength;
  for (const double channel : sample_knots(component.palette.absorption, place))
    strength = std::max(strength, channel);
  return strength;
}

// Nothing for particles that are bad or outside the camera's limits.
std::optional<Cloud> cloud_of(const DrawnComponent& component, const Frame& frame, std::size_t i) {
  const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i);
  if (!cloud) return std::nullopt;
  const double coarse_pixels = coarse_scale(frame);
  const double column = cloud->column * color_strength(component, i);
  if (!(column > 0 && std::isfinite(column))) return std::nullopt;
  return Cloud{coarse_pixels * cloud->x, coarse_pixels * cloud->y, coarse_pixels * cloud->sigma,
               column};
}

std::vector<double> lit_pixels(std::vector<double> pixels) {
  pixels.erase(std::remove(pixels.begin(), pixels.end(), 0.0), pixels.end());
  if (pixels.empty()) return pixels;
  const double limit = lit_fraction * percentile(pixels, brightest_percentile);
  pixels.erase(std::remove_if(pixels.begin(), pixels.end(),
                              [limit](double column) { return column < limit; }),
               pixels.end());
  return pixels;
}

}  // namespace

std::optional<double> find_reference_column(const DrawnComponent& component, const Frame& frame,
                                            const ParticlePass& pass, std::size_t stands_for) {
  const auto coarse = [&frame](int pixels) {
    return std::max(1, static_cast<int>(std::lround(coarse_scale(frame) * pixels)));
  };
  ColumnPyramid pyramid(coarse(frame.width), coarse(frame.height));
  const std::size_t stride = sample_stride(component.particles.count, particle_limit);
  const auto look = [&](const ParticleRun& run, std::vector<Cloud>& clouds) {
    for (std::size_t i = first_sampled(run, stride); i < run.end; i += stride) {
      std::optional<Cloud> cloud = cloud_of(component, frame, i);
      if (!cloud) continue;
      cloud->column *= static_cast<double>(stands_for * stride);  // for those passed over
      clouds.push_back(*cloud);
    }
  };
  for (const Cloud& cloud : pass.collect<Cloud>(look))
    pyramid.add(cloud);
  std::vector<double> lit = lit_pixels(pyramid.pixels());
  if (lit.empty()) return std::nullopt;
  return percentile(lit, exposed_percentile);
}

std::optional<double> find_reference_column(const DrawnComponent& component, const Frame& frame) {
  return find_reference_column(component, frame, ParticlePass(component.particles.count));
}

FieldStatistics find_statistics(const Column& values) {
  FieldStatistics result;
  result.count = values.is_uniform() ? 1 : values.size();
  float minimum = std::numeric_limits<float>::infinity();
  float maximum = -std::numeric_limits<float>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < result.count; ++i) {
    const float value = values[i];
    if (!std::isfinite(value)) {
      ++result.bad;
      if (std::isinf(value)) ++result.infinite;
      continue;
    }
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
    sum += static_cast<double>(value);
  }
  if (result.bad == result.count) return result;
  result.minimum = static_cast<double>(minimum);
  result.maximum = static_cast<double>(maximum);
  result.mean = sum / static_cast<double>(result.count - result.bad);
  return result;
}

std::string advice_on_infinite_values() {
  return "numbers beyond single precision, which ends at 3.4e38, are read as infinite: store them "
         "in a larger unit, as masses in Msun in place of g";
}

}  // namespace splotchcl
