#include "finish/effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "finish/tone.h"
#include "parallel/for_blocks.h"
#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"

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

void mix(Image& image, const Image& other, double amount) {
  const auto part = static_cast<float>(amount);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = (1 - part) * image.pixels[i] + part * other.pixels[i];
}

void fade_to_color(Image& image, const FinishSettings& finish, double gamma) {
  if (finish.fade == 0) return;
  const auto part = static_cast<float>(finish.fade);
  const std::array<float, 3> light = light_of(finish.fade_color, gamma);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float target = i % 4 == 3 ? 1 : light[i % 4];
    image.pixels[i] = (1 - part) * image.pixels[i] + part * target;
  }
}

Image squeezed(const Image& image, int columns, int rows) {
  Image result(image.width / columns, image.height / rows);
  const float part = 1.0F / static_cast<float>(columns * rows);
  for (int y = 0; y < result.height * rows; ++y) {
    for (int x = 0; x < result.width * columns; ++x) {
      const float* const from = image.at(x, y);
      float* const to = result.at(x / columns, y / rows);
      for (std::size_t c = 0; c < 4; ++c)
        to[c] += part * from[c];
    }
  }
  return result;
}

namespace {

bool is_same_run(const SequenceSettings& a, const SequenceSettings& b) {
  return a.is_set() && a.snapshots == b.snapshots && a.pattern == b.pattern;
}

}  // namespace

std::optional<Scene> cross_fade_scene(const Scene& scene) {
  const CrossFade& fade = scene.finish.cross_fade;
  if (fade.scene.empty() || fade.amount == 0) return std::nullopt;
  Scene other = read_scene_file(fade.scene);
  if (!other.finish.cross_fade.scene.empty()) {
    throw UsageError("key finish.cross_fade.scene: found " + fade.scene +
                     ", which fades to another scene itself, expected one that does not");
  }
  other.image.width = scene.image.width;
  other.image.height = scene.image.height;
  other.image.gamma = scene.image.gamma;
  if (!other.camera) other.camera = scene.camera;
  if (is_same_run(other.time, scene.time)) other.time.index = scene.time.index;
  if (!other.finish.frame) other.finish.frame = scene.finish.frame;
  const std::vector<PictureSize> own = picture_sizes(scene, scene.image.width, scene.image.height);
  const std::vector<PictureSize> others =
      picture_sizes(other, other.image.width, other.image.height);
  bool is_same = own.size() == others.size();
  for (std::size_t i = 0; is_same && i < own.size(); ++i) {
    is_same = own[i].suffix == others[i].suffix && own[i].width == others[i].width &&
              own[i].height == others[i].height;
  }
  if (!is_same) {
    throw UsageError("key finish.cross_fade.scene: found " + fade.scene +
                     ", whose pictures are others (stereo, projection), expected the same ones");
  }
  return other;
}

void check_cross_fade(const Scene& scene) {
  const std::string& file = scene.finish.cross_fade.scene;
  std::error_code error;
  if (!file.empty() && !std::filesystem::is_regular_file(file, error)) {
    throw UsageError("key finish.cross_fade.scene: found no file " + file +
                     ", expected a scene file");
  }
  (void)cross_fade_scene(scene);
}

namespace {

using LinearLight = std::array<double, 3>;
using Matrix = std::array<LinearLight, 3>;  // rows: red, green, blue

// What each eye's light adds to the picture.
struct Matrices {
  Matrix left, right;
};

// E. Dubois, A projection method to generate anaglyph stereo images, ICASSP 2001; the values for
// red and cyan filters and a cathode ray tube's phosphors.
constexpr Matrices dubois = {{{{0.4561, 0.500484, 0.176381},
                               {-0.0400822, -0.0378246, -0.0157589},
                               {-0.0152161, -0.0205971, -0.00546856}}},
                             {{{-0.0434706, -0.0879388, -0.00155529},
                               {0.378476, 0.73364, -0.0184503},
                               {-0.0721527, -0.112961, 1.2264}}}};

// Rec. 709's.
constexpr LinearLight luminance = {0.2126, 0.7152, 0.0722};
constexpr LinearLight nothing = {0, 0, 0};

const Matrices& matrices_of(StereoLayout layout) {
  static constexpr Matrices half_color = {{{luminance, nothing, nothing}},
                                          {{nothing, {0, 1, 0}, {0, 0, 1}}}};
  static constexpr Matrices gray = {{{luminance, nothing, nothing}},
                                    {{nothing, luminance, luminance}}};
  if (layout == StereoLayout::anaglyph_half_color) return half_color;
  return layout == StereoLayout::anaglyph_gray ? gray : dubois;
}

// Between a picture's light and what a display emits.
class Display {
 public:
  explicit Display(double gamma) : exponent_(2.2 / gamma) {}
  LinearLight emitted(const float* pixel) const {
    LinearLight light{};
    for (std::size_t c = 0; c < 3; ++c)
      light[c] = raised(std::clamp(static_cast<double>(pixel[c]), 0.0, 1.0), exponent_);
    return light;
  }
  float picture_light(double emitted) const {
    return static_cast<float>(raised(std::clamp(emitted, 0.0, 1.0), 1 / exponent_));
  }

 private:
  static double raised(double value, double exponent) {
    return exponent == 1 ? value : std::pow(value, exponent);
  }
  double exponent_;
};

double product(const LinearLight& row, const LinearLight& light) {
  return row[0] * light[0] + row[1] * light[1] + row[2] * light[2];
}

}  // namespace

Image anaglyph(const Image& left, const Image& right, StereoLayout layout, double gamma) {
  const Matrices& matrices = matrices_of(layout);
  const Display display(gamma);
  Image both(left.width, left.height);
  for (std::size_t i = 0; i < both.pixels.size(); i += 4) {
    const LinearLight of_left = display.emitted(&left.pixels[i]);
    const LinearLight of_right = display.emitted(&right.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double sum = product(matrices.left[c], of_left) + product(matrices.right[c], of_right);
      both.pixels[i + c] = display.picture_light(sum);
    }
    both.pixels[i + 3] = 0.5F * (left.pixels[i + 3] + right.pixels[i + 3]);
  }
  return both;
}

}  // namespace splotchcl
