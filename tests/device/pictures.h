#pragma once

#include "device/pipeline.h"
#include "device/scenes.h"
#include "splotchcl/image.h"
#include "splotchcl/renderer.h"
#include "testing.h"

namespace splotchcl::test {

// Tests of whole pictures share a renderer per shape of compositing, and with it the
// compiled kernels.
class PictureTest : public testing::Test {
 protected:
  static void TearDownTestSuite() {
    rows_.reset();
    groups_.reset();
  }

  static Renderer& renderer(CompositeShape shape = CompositeShape::rows) {
    std::unique_ptr<Renderer>& renderer = shape == CompositeShape::groups ? groups_ : rows_;
    if (!renderer) renderer = std::make_unique<Renderer>(RendererOptions{"", shape});
    return *renderer;
  }
  static Image draw(const Frame& frame, CompositeShape shape = CompositeShape::rows) {
    return renderer(shape).render(frame);
  }

 private:
  static inline std::unique_ptr<Renderer> rows_, groups_;
};

// Rows of `part` whose bits are not those of `whole` there.
inline int rows_that_differ(const Image& part, const Image& whole, const Rectangle& crop) {
  int rows = 0;
  for (int y = 0; y < crop.height; ++y) {
    const std::size_t bytes = 4 * sizeof(float) * static_cast<std::size_t>(crop.width);
    rows += std::memcmp(part.at(0, y), whole.at(crop.x, crop.y + y), bytes) != 0;
  }
  return rows;
}

struct DrawnOnce {
  Image image;
  DrawCounts counts;
};

// Whatever a check of the picture would say.
inline DrawnOnce draw_with_plan(DeviceContext& device, const Frame& frame, const FramePlan& plan) {
  ParticleStore particles(device);
  const std::uint64_t number = particles.begin_frame();
  Pipeline pipeline(device, particles, frame, plan);
  Image image = pipeline.draw();
  device.queue.finish();
  particles.end_frame(number);
  return {std::move(image), pipeline.counts()};
}

// Drawn with the frame's first plan.
inline Image draw_once(DeviceContext& device, const Frame& frame, CompositeShape shape) {
  device.traits.choose_shape(shape == CompositeShape::rows);
  return draw_with_plan(device, frame, make_plan(frame)).image;
}

// The largest |a - b| / max(1, |b|) over pixels and colours. Two pictures that each keep the
// tolerance differ by at most twice as much.
inline double largest_difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return 1e300;
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double from = static_cast<double>(b.pixels[i]);
    const double error = std::abs(static_cast<double>(a.pixels[i]) - from);
    const double relative = error / std::max(1.0, std::abs(from));
    largest = std::isfinite(relative) ? std::max(largest, relative) : 1e300;
  }
  return largest;
}

// The light of one colour, added up over the picture.
inline double sum_of_light(const Image& image, std::size_t channel = 0) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += 4)
    sum += static_cast<double>(image.pixels[i]);
  return sum;
}

}  // namespace splotchcl::test
