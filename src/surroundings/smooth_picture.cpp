#include "surroundings/smooth_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

// Of Lagrange's interpolation: between nodes 3 and 4 of 8.
constexpr int taps = 8, taps_before = 3;
constexpr int widest_spacing = 64;
// Eight taps foretell 2^8 times as well where nodes lie twice as close; so much of that is relied
// on.
constexpr double better_when_halved = 8;

int floor_divide(int value, int by) {
  return value >= 0 ? value / by : -ceil_divide(-value, by);
}

using Weights = std::array<double, taps>;

// For a place between nodes 3 and 4, at this part of the way.
Weights lagrange_weights(double part) {
  Weights weights;
  for (int i = 0; i < taps; ++i) {
    double weight = 1;
    for (int k = 0; k < taps; ++k) {
      if (k != i) weight *= (part + taps_before - k) / (i - k);
    }
    weights[static_cast<std::size_t>(i)] = weight;
  }
  return weights;
}

// Nodes so many pixels apart along one axis, from which a range of pixels is interpolated.
struct Axis {
  int spacing, first, count;  // node `first` is pixel first * spacing

  Axis(int first_pixel, int pixels, int by) : spacing(by) {
    const int before = by == 1 ? 0 : taps_before, behind = by == 1 ? 0 : taps - taps_before - 1;
    first = floor_divide(first_pixel, by) - before;
    count = floor_divide(first_pixel + pixels - 1, by) + behind - first + 1;
  }
  int pixel(int node) const { return (first + node) * spacing; }
  // The first of the nodes that a pixel is made from.
  int base(int pixel) const {
    return floor_divide(pixel, spacing) - first - (spacing == 1 ? 0 : taps_before);
  }
  int phase(int pixel) const { return pixel - floor_divide(pixel, spacing) * spacing; }
};

// Of what is as narrow as can be and lies in the middle between the nodes that are halved first,
// half as far apart, a node shows exp(-1/2) still: a picture that they miss does not look smooth.
int first_spacing(int side, double narrowest) {
  int spacing = 1;
  while (spacing < widest_spacing && 8 * spacing <= side && spacing <= narrowest)
    spacing *= 2;
  return spacing;
}

// Where nodes lie, until they are pixels.
Rectangle looked_at(const SmoothPictureSettings& settings) {
  if (settings.crop_alone) return settings.crop;
  return {0, 0, settings.width, settings.height};
}

}  // namespace

class SmoothPicture::Nodes {
 public:
  Nodes(const Rectangle& part, int spacing, int channels)
      : x_(part.x, part.width, spacing),
        y_(part.y, part.height, spacing),
        channels_(static_cast<std::size_t>(channels)),
        values_(static_cast<std::size_t>(x_.count) * static_cast<std::size_t>(y_.count) *
                channels_) {
    for (int phase = 0; phase < spacing; ++phase) {
      const Weights of_phase = lagrange_weights(static_cast<double>(phase) / spacing);
      for (std::size_t k = 0; k < taps; ++k)
        weights_[k].push_back(of_phase[k]);
    }
  }

  // Of nodes that are twice as far apart those that are known are taken.
  void fill(const PixelsFunction& pixels, const Nodes* coarse) {
    for_blocks(static_cast<std::size_t>(y_.count), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row)
        fill_row(static_cast<int>(row), pixels, coarse);
    });
  }

  // The largest error of these nodes' foretelling of finer ones, within the picture.
  double largest_error(const Nodes& fine, const SmoothPictureSettings& settings) const {
    std::vector<double> largest(static_cast<std::size_t>(fine.y_.count));
    for_blocks(largest.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row)
        largest[row] = largest_error_of_row(static_cast<int>(row), fine, settings);
    });
    return *std::max_element(largest.begin(), largest.end());
  }

  void row(const Rectangle& part, int y, std::vector<double>& channels) const {
    const auto width = static_cast<std::size_t>(part.width);
    channels.resize(channels_ * width);
    std::vector<double> between(static_cast<std::size_t>(x_.count) * channels_);
    interpolate_row(part.y + y, between);
    // Pixels between the same two nodes at a time.
    for (int x = 0; x < part.width;) {
      const int phase = x_.phase(part.x + x);
      const int count = std::min(x_.spacing - phase, part.width - x);
      interpolate_between(between, x_.base(part.x + x), phase, count, channels.data() + x, width);
      x += count;
    }
  }

 private:
  std::size_t place(int column, int row) const {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(x_.count) +
            static_cast<std::size_t>(column)) *
           channels_;
  }
  double* at(int column, int row) { return values_.data() + place(column, row); }
  const double* at(int column, int row) const { return values_.data() + place(column, row); }

  // None where no node is this pixel.
  const double* node_at(int x, int y) const {
    if (x_.phase(x) != 0 || y_.phase(y) != 0) return nullptr;
    const int column = floor_divide(x, x_.spacing) - x_.first;
    const int row = floor_divide(y, y_.spacing) - y_.first;
    if (column < 0 || column >= x_.count || row < 0 || row >= y_.count) return nullptr;
    return at(column, row);
  }

  void fill_row(int row, const PixelsFunction& pixels, const Nodes* coarse) {
    const int y = y_.pixel(row);
    std::vector<int> columns, x;
    for (int column = 0; column < x_.count; ++column) {
      const double* known = coarse ? coarse->node_at(x_.pixel(column), y) : nullptr;
      if (known) {
        std::copy_n(known, channels_, at(column, row));
        continue;
      }
      columns.push_back(column);
      x.push_back(x_.pixel(column));
    }
    std::vector<double> found(x.size() * channels_);
    pixels(x, y, x_.spacing, found.data());
    for (std::size_t k = 0; k < columns.size(); ++k)
      std::copy_n(found.data() + k * channels_, channels_, at(columns[k], row));
  }

  double weight_of(int tap, int phase) const {
    return weights_[static_cast<std::size_t>(tap)][static_cast<std::size_t>(phase)];
  }

  // All columns of nodes, at the pixel's height.
  void interpolate_row(int y, std::vector<double>& row) const {
    const int base = y_.base(y);
    if (y_.spacing == 1) {
      std::copy_n(at(0, base), row.size(), row.begin());
      return;
    }
    std::fill(row.begin(), row.end(), 0.0);
    for (int k = 0; k < taps; ++k) {
      const double weight = weight_of(k, y_.phase(y));
      const double* nodes = at(0, base + k);
      for (std::size_t i = 0; i < row.size(); ++i)
        row[i] += weight * nodes[i];
    }
  }

  // The channels of `count` pixels from this phase on, `plane` numbers apart.
  void interpolate_between(const std::vector<double>& row, int base, int phase, int count,
                           double* pixels, std::size_t plane) const {
    const double* nodes = row.data() + static_cast<std::size_t>(base) * channels_;
    if (x_.spacing == 1) {
      for (std::size_t c = 0; c < channels_; ++c)
        pixels[c * plane] = nodes[c];
      return;
    }
    std::array<const double*, taps> weights;
    for (std::size_t k = 0; k < taps; ++k)
      weights[k] = weights_[k].data() + phase;
    for (std::size_t c = 0; c < channels_; ++c) {
      std::array<double, taps> of_taps;
      for (std::size_t k = 0; k < taps; ++k)
        of_taps[k] = nodes[k * channels_ + c];
      double* const of_channel = pixels + c * plane;
      // All taps of a pixel at once: sums stay in registers.
      for (int i = 0; i < count; ++i) {
        double sum = weights[0][i] * of_taps[0];
        for (std::size_t k = 1; k < taps; ++k)
          sum += weights[k][i] * of_taps[k];
        of_channel[i] = sum;
      }
    }
  }

  double largest_error_of_row(int row, const Nodes& fine,
                              const SmoothPictureSettings& settings) const {
    const int y = fine.y_.pixel(row);
    const Rectangle seen = looked_at(settings);
    if (y < seen.y || y >= seen.y + seen.height) return 0;
    std::vector<double> foretold(channels_), here(static_cast<std::size_t>(x_.count) * channels_);
    interpolate_row(y, here);
    double largest = 0;
    for (int column = 0; column < fine.x_.count; ++column) {
      const int x = fine.x_.pixel(column);
      if (x < seen.x || x >= seen.x + seen.width || node_at(x, y)) continue;
      interpolate_between(here, x_.base(x), x_.phase(x), 1, foretold.data(), 1);
      largest = std::max(largest, settings.error_of(fine.at(column, row), foretold.data()));
    }
    return largest;
  }

  Axis x_, y_;
  std::size_t channels_;
  std::vector<double> values_;
  std::array<std::vector<double>, taps> weights_;  // of each tap, phase by phase
};

SmoothPicture::SmoothPicture(const SmoothPictureSettings& settings, const PixelsFunction& pixels)
    : crop_(settings.crop) {
  const Rectangle seen = looked_at(settings);
  int spacing = first_spacing(std::min(settings.width, settings.height), settings.narrowest);
  Nodes nodes(spacing == 1 ? settings.crop : seen, spacing, settings.channels);
  nodes.fill(pixels, nullptr);
  while (spacing > 1) {
    spacing /= 2;
    // Pixels themselves need no other, so that of them only those wanted are worked out.
    Nodes finer(spacing == 1 ? settings.crop : seen, spacing, settings.channels);
    finer.fill(pixels, &nodes);
    const bool foretells = spacing > 1 && nodes.largest_error(finer, settings) <=
                                              better_when_halved * settings.allowed;
    nodes = std::move(finer);
    if (foretells) break;
  }
  nodes_ = std::make_unique<const Nodes>(std::move(nodes));
}

SmoothPicture::SmoothPicture(SmoothPicture&&) noexcept = default;
SmoothPicture& SmoothPicture::operator=(SmoothPicture&&) noexcept = default;
SmoothPicture::~SmoothPicture() = default;

void SmoothPicture::row(int y, std::vector<double>& channels) const {
  nodes_->row(crop_, y, channels);
}

}  // namespace splotchcl
