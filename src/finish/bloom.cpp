#include "finish/bloom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

constexpr int boxes = 4;
// Four columns of floats are a line of most caches.
constexpr std::size_t rows_together = 16, columns_together = 4;

// Sums run over values of very different size, which single precision would not forget.
using Sample = std::array<double, 4>;
using SampleLine = std::vector<Sample>;

// One of the four boxes: samples up to `reach` away count fully, the next ones in part.
struct PartBox {
  explicit PartBox(double deviation) {
    const double variance = deviation * deviation / boxes;
    reach = static_cast<int>(std::floor(0.5 * (std::sqrt(12 * variance + 1) - 1)));
    const double next = reach + 1.0;
    edge = (2 * reach + 1) * (reach * next - 3 * variance) / (6 * (variance - next * next));
  }
  std::size_t margin() const { return static_cast<std::size_t>(reach) + 1; }
  double total() const { return 2 * reach + 1 + 2 * edge; }

  int reach = 0;
  double edge = 0;
};

// As if the line went on as its own image in a mirror, again and again.
std::size_t mirrored(std::ptrdiff_t place, std::size_t size) {
  const auto period = static_cast<std::ptrdiff_t>(2 * size);
  const std::ptrdiff_t inside = ((place % period) + period) % period;
  return static_cast<std::size_t>(std::min(inside, period - 1 - inside));
}

// `to` is shorter than `from` by a margin at either end.
void average(const SampleLine& from, const PartBox& box, SampleLine& to) {
  const std::size_t margin = box.margin();
  to.resize(from.size() - 2 * margin);
  Sample sum = {};
  for (std::size_t i = 1; i < 2 * margin - 1; ++i) {
    for (std::size_t c = 0; c < 4; ++c)
      sum[c] += from[i][c];
  }
  const double share = 1 / box.total();
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Sample &first = from[i], &last = from[i + 2 * margin];
    const Sample &entering = from[i + 2 * margin - 1], &leaving = from[i + 1];
    for (std::size_t c = 0; c < 4; ++c) {
      sum[c] += entering[c];
      to[i][c] = share * (sum[c] + box.edge * (first[c] + last[c]));
      sum[c] -= leaving[c];
    }
  }
}

// Lines of an image, along its rows or columns.
struct Lines {
  std::size_t count, size;      // of lines; of pixels in each
  std::size_t step, next_line;  // in floats
};

void blur_line(const float* from, const Lines& lines, const PartBox& box, float* to, SampleLine& a,
               SampleLine& b) {
  const auto margin = static_cast<std::ptrdiff_t>(boxes * box.margin());
  a.resize(lines.size + 2 * static_cast<std::size_t>(margin));
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::size_t place = mirrored(static_cast<std::ptrdiff_t>(i) - margin, lines.size);
    std::copy_n(from + place * lines.step, 4, a[i].begin());
  }
  for (int i = 0; i < boxes; ++i) {
    average(a, box, b);
    a.swap(b);
  }
  for (std::size_t i = 0; i < lines.size; ++i) {
    for (std::size_t c = 0; c < 4; ++c)
      to[i * lines.step + c] = static_cast<float>(std::max(0.0, a[i][c]));
  }
}

void blur_lines(const Image& from, const Lines& lines, const PartBox& box, std::size_t together,
                Image& to) {
  for_blocks(lines.count, together, [&](std::size_t first, std::size_t last) {
    SampleLine a, b;
    for (std::size_t line = first; line < last; ++line) {
      const std::size_t start = line * lines.next_line;
      blur_line(&from.pixels[start], lines, box, &to.pixels[start], a, b);
    }
  });
}

}  // namespace

Image blurred(const Image& image, double deviation) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const PartBox box(deviation);
  Image along_rows(image.width, image.height), result(image.width, image.height);
  blur_lines(image, {height, width, 4, 4 * width}, box, rows_together, along_rows);
  blur_lines(along_rows, {width, height, 4 * width, 4}, box, columns_together, result);
  return result;
}

void add_bloom(Image& image, double part) {
  if (part == 0) return;
  constexpr std::array<double, 3> deviations = {1.0 / 360, 1.0 / 90, 2.0 / 45};
  const double side = std::min(image.width, image.height);
  const auto kept = static_cast<float>(1 - part);
  const auto share = static_cast<float>(part / deviations.size());
  const Image drawn = image;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) image.pixels[i] *= kept;
  }
  for (const double deviation : deviations) {
    const Image glow = blurred(drawn, deviation * side);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      if (i % 4 != 3) image.pixels[i] += share * glow.pixels[i];
    }
  }
}

}  // namespace splotchcl
