#include "scene/plan/stencil.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scene/constants.h"
#include "scene/plan/grid_filters.h"

namespace splotchcl {
namespace {

constexpr std::size_t pixels = stencil_pixels, pairs = pixels / 2;
constexpr std::size_t place_powers = stencil_place_powers, width_powers = stencil_width_powers;

using Weights = SmallVector<pixels>;
using Matrix = SmallMatrix<pixels>;

double sum_of(const Weights& weights) {
  double sum = 0;
  for (const double weight : weights)
    sum += weight;
  return sum;
}

// What a grid's pixels hold when a stencil is blurred, and which stencil comes closest to a
// Gaussian there.
class BlurredPixels {
 public:
  BlurredPixels(const std::vector<float>& blur, double largest)
      : blur_(blur.begin(), blur.end()),
        half_(static_cast<int>(blur.size() / 2)),
        reach_(std::max(half_ + static_cast<int>(pairs), static_cast<int>(4.5 * largest) + 1)) {
    Matrix products{};
    for (std::size_t i = 0; i < pixels; ++i) {
      for (std::size_t k = 0; k < pixels; ++k)
        products[i][k] = product_of(static_cast<int>(i) - static_cast<int>(k));
    }
    inverse_ = inverse_of(products);
    Weights ones{};
    ones.fill(1);
    of_light_ = times(inverse_, ones);
  }

  // As close to exp(-(x - place)^2 / sigma^2) as the sum of squares of all differences tells, of
  // those that have its light.
  Weights closest(double place, double sigma) const {
    Weights against{};
    double light = 0;
    for (int x = -reach_; x <= reach_; ++x) {
      const double wanted = gaussian(x, place, sigma);
      light += wanted;
      for (std::size_t k = 0; k < pixels; ++k)
        against[k] += blur_at(x - pixel(k)) * wanted;
    }
    Weights weights = times(inverse_, against);
    const double missing = (light - sum_of(weights)) / sum_of(of_light_);
    for (std::size_t k = 0; k < pixels; ++k)
      weights[k] += missing * of_light_[k];
    return weights;
  }

  double error_of(const Weights& weights, double place, double sigma) const {
    double largest = 0;
    for (int x = -reach_; x <= reach_; ++x) {
      double value = 0;
      for (std::size_t k = 0; k < pixels; ++k)
        value += weights[k] * blur_at(x - pixel(k));
      largest = std::max(largest, std::abs(value - gaussian(x, place, sigma)));
    }
    return largest;
  }

 private:
  static int pixel(std::size_t k) { return static_cast<int>(k) - static_cast<int>(pairs) + 1; }
  static double gaussian(int x, double place, double sigma) {
    const double distance = (x - place) / sigma;
    return std::exp(-distance * distance);
  }
  double blur_at(int x) const {
    return std::abs(x) > half_ ? 0 : blur_[static_cast<std::size_t>(x + half_)];
  }
  double product_of(int shift) const {
    double sum = 0;
    for (int x = -half_; x <= half_; ++x)
      sum += blur_at(x) * blur_at(x + shift);
    return sum;
  }

  std::vector<double> blur_;
  int half_, reach_;
  Matrix inverse_{};
  Weights of_light_{};  // the change of weights that adds light and changes least else
};

// Coefficients of the polynomial through `values` at `nodes`, by Newton's differences.
template <std::size_t count>
std::array<double, count> polynomial_through(const std::array<double, count>& nodes,
                                             std::array<double, count> values) {
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t i = count - 1; i >= order; --i)
      values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - order]);
  }
  std::array<double, count> coefficients{};
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t k = count - 1; k > 0; --k)
      coefficients[k] = coefficients[k - 1] - nodes[i] * coefficients[k];
    coefficients[0] = values[i] - nodes[i] * coefficients[0];
  }
  return coefficients;
}

template <std::size_t count>
std::array<double, count> nodes_of() {
  std::array<double, count> nodes{};
  for (std::size_t i = 0; i < count; ++i)
    nodes[i] = std::cos(pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
  return nodes;
}

// The square of a place's distance from the middle between two pixels, 0 to 1/4, at a node.
double square_at(double node) {
  return 0.125 * (1 + node);
}

// Of a splat at either side of the middle, and its reflection: halves of sums, then of differences
// over the distance. Both are functions of its square.
std::array<double, pixels> even_and_odd(const Weights& weights, double distance) {
  std::array<double, pixels> parts{};
  for (std::size_t k = 0; k < pairs; ++k) {
    parts[k] = (weights[k] + weights[pixels - 1 - k]) / 2;
    parts[pairs + k] = (weights[k] - weights[pixels - 1 - k]) / (2 * distance);
  }
  return parts;
}

void fit(const BlurredPixels& pixels_of_grid, Stencil& stencil) {
  const auto place_nodes = nodes_of<place_powers>();
  const auto width_nodes = nodes_of<width_powers>();
  std::array<double, place_powers> squares{};
  std::transform(place_nodes.begin(), place_nodes.end(), squares.begin(), square_at);
  std::array<std::array<std::array<double, pixels>, width_powers>, place_powers> parts{};
  for (std::size_t i = 0; i < place_powers; ++i) {
    const double distance = std::sqrt(squares[i]);
    for (std::size_t j = 0; j < width_powers; ++j) {
      const double sigma = std::sqrt(static_cast<double>(stencil.middle) +
                                     width_nodes[j] / static_cast<double>(stencil.per_width));
      parts[i][j] = even_and_odd(pixels_of_grid.closest(0.5 + distance, sigma), distance);
    }
  }
  for (std::size_t k = 0; k < pixels; ++k) {
    std::array<std::array<double, width_powers>, place_powers> of_widths{};
    for (std::size_t i = 0; i < place_powers; ++i) {
      std::array<double, width_powers> values{};
      for (std::size_t j = 0; j < width_powers; ++j)
        values[j] = parts[i][j][k];
      of_widths[i] = polynomial_through(width_nodes, values);
    }
    for (std::size_t j = 0; j < width_powers; ++j) {
      std::array<double, place_powers> values{};
      for (std::size_t i = 0; i < place_powers; ++i)
        values[i] = of_widths[i][j];
      const auto coefficients = polynomial_through(squares, values);
      for (std::size_t i = 0; i < place_powers; ++i)
        stencil.coefficients[(i * width_powers + j) * pixels + k] =
            static_cast<float>(coefficients[i]);
    }
  }
}

}  // namespace

double blur_of_stencil(double smallest) {
  // The best ones of a search lie close to these lines.
  const double beyond = smallest - 2.65;
  const double sigma = smallest + (beyond < 0 ? 0.28 * beyond : std::min(0.17 * beyond, 0.2));
  return sigma * sigma;
}

Stencil make_stencil(double smallest, double largest, const std::vector<float>& blur_weights) {
  Stencil stencil;
  stencil.largest_sigma = largest;
  stencil.middle = static_cast<float>((largest * largest + smallest * smallest) / 2);
  stencil.per_width = static_cast<float>(2 / (largest * largest - smallest * smallest));
  const BlurredPixels pixels_of_grid(blur_weights, largest);
  fit(pixels_of_grid, stencil);
  constexpr int places = 8, widths = 8;
  for (int i = 0; i <= places; ++i) {
    for (int j = 0; j <= widths; ++j) {
      const double place = static_cast<double>(i) / (2 * places);
      const double sigma2 =
          smallest * smallest + j * (largest * largest - smallest * smallest) / widths;
      const double sigma = std::sqrt(sigma2);
      stencil.error =
          std::max(stencil.error,
                   pixels_of_grid.error_of(stencil_weights(stencil, place, sigma), place, sigma));
    }
  }
  return stencil;
}

std::array<double, stencil_pixels> stencil_weights(const Stencil& stencil, double place,
                                                   double sigma) {
  const double distance = place - 0.5, square = distance * distance;
  const double width = (sigma * sigma - static_cast<double>(stencil.middle)) *
                       static_cast<double>(stencil.per_width);
  std::array<double, pixels> parts{};
  for (std::size_t k = 0; k < pixels; ++k) {
    for (std::size_t i = place_powers; i-- > 0;) {
      double of_width = 0;
      for (std::size_t j = width_powers; j-- > 0;)
        of_width = of_width * width +
                   static_cast<double>(stencil.coefficients[(i * width_powers + j) * pixels + k]);
      parts[k] = parts[k] * square + of_width;
    }
  }
  std::array<double, pixels> weights{};
  for (std::size_t k = 0; k < pairs; ++k) {
    weights[k] = parts[k] + distance * parts[pairs + k];
    weights[pixels - 1 - k] = parts[k] - distance * parts[pairs + k];
  }
  return weights;
}

}  // namespace splotchcl
