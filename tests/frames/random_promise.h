#pragma once

#include "device/pictures.h"
#include "testing.h"

// Random frames of one kind keep their promises: each against the oracle, in the variants that the
// test names.
namespace splotchcl::test {

// In words that tell one frame from others.
inline std::string describe(const Frame& frame) {
  std::ostringstream out;
  out << name(choose_light(frame)) << ", projection " << static_cast<int>(frame.projection) << ", "
      << frame.width << " x " << frame.height << ", crop " << frame.crop.x << "," << frame.crop.y
      << "," << frame.crop.width << "," << frame.crop.height << ", cut "
      << frame.kernel.cut.value_or(0)
      << (frame.kernel.sampling == Sampling::mean ? ", means" : ", centres") << ", min_radius "
      << frame.kernel.min_radius_pixels << ", footprint " << frame.kernel.footprint_pixels
      << ", lens " << frame.lens.aperture << " at " << frame.lens.focus << ", fades "
      << frame.fade.near_length << " and " << frame.fade.far_length << ", eye "
      << frame.camera.eye_offset << ", tolerance " << frame.tolerance << ", components "
      << frame.components.size();
  return out.str();
}

// Light of each pixel of the crop that is open where places are known to so many pixels.
using OpenLight = std::function<std::vector<double>(const Frame&, double known_to)>;

// As largest_error(), where each pixel's error may be larger by what is open.
inline double largest_error_beyond(const Image& image, const ReferenceImage& exact,
                                   const std::vector<double>& open) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double error = std::abs(static_cast<double>(image.pixels[i]) - exact.pixels[i]);
    const double beyond = error - (open.empty() ? 0 : open[i / 4]);
    worst = larger(worst, beyond / std::max(1.0, std::abs(exact.pixels[i])));
  }
  return worst;
}

struct RandomKind {
  std::function<Frame(std::uint64_t seed)> make;
  double lit_share = 2.0 / 3;  // of the frames, that show something at least
  OpenLight open_light = [](const Frame&, double) { return std::vector<double>(); };
  double known_to = 0;
};

// Every fourth is seen through a footprint of up to two pixels, where nothing else widens it.
inline Frame with_footprint(Frame frame, std::uint64_t seed) {
  if (seed % 4 == 1 && frame.kernel.min_radius_pixels == 0)
    frame.kernel.footprint_pixels = 0.02 * static_cast<double>(seed * 37 % 101);
  return frame;
}

// Every fifth through a lens that blurs by some pixels, and with light that fades with depth, where
// the camera has them.
inline Frame with_lens(Frame frame, std::uint64_t seed) {
  if (seed % 5 != 2) return frame;
  const double distance = frame.camera.look_at_distance;
  if (frame.projection == Projection::perspective && frame.kernel.min_radius_pixels == 0) {
    const double blurred_pixels = 0.3 * static_cast<double>(seed % 31);
    frame.lens.aperture = blurred_pixels * distance / frame.camera.focal_pixels;
    frame.lens.focus = distance;
  }
  frame.fade.near_length = 0.4 * distance;
  if (frame.far_limit) frame.fade.far_length = 0.3 * distance;
  return frame;
}

class RandomPromise : public PictureTest {
 protected:
  // The tolerance is that of the frame, or what tolerance 0 promises.
  static void expect_kept(const RandomKind& kind, const Frame& frame, Renderer& renderer,
                          std::uint64_t seed) {
    const bool is_exact = frame.tolerance == 0;
    const ReferenceImage exact = reference::render(frame);
    const std::vector<double> open = kind.open_light(frame, is_exact ? 1e-9 : kind.known_to);
    EXPECT_LE(largest_error_beyond(renderer.render(frame), exact, open),
              is_exact ? extended_tolerance : frame.tolerance)
        << "seed " << seed << ": " << describe(frame);
    EXPECT_EQ(renderer.stats().bad_particles, reference::count_bad(frame)) << "seed " << seed;
  }

  // Every third in groups.
  static void expect_tolerance_kept(const RandomKind& kind,
                                    const std::vector<std::uint64_t>& seeds) {
    std::size_t lit = 0;
    for (const std::uint64_t seed : seeds) {
      const Frame frame = with_lens(with_footprint(kind.make(seed), seed), seed);
      lit += largest_value(reference::render(frame)) > 0.05;
      const bool in_groups = seed % 3 == 0;
      expect_kept(kind, frame, renderer(in_groups ? CompositeShape::groups : CompositeShape::rows),
                  seed);
    }
    EXPECT_GT(static_cast<double>(lit), kind.lit_share * static_cast<double>(seeds.size()))
        << "most should have something to see";
  }

  static void expect_tolerance_zero_kept(const RandomKind& kind,
                                         const std::vector<std::uint64_t>& seeds) {
    for (const std::uint64_t seed : seeds) {
      Frame frame = with_lens(with_footprint(kind.make(seed), seed), seed);
      frame.tolerance = 0;
      const bool in_groups = seed / 2 % 2 == 0;
      expect_kept(kind, frame, renderer(in_groups ? CompositeShape::groups : CompositeShape::rows),
                  seed);
    }
  }
};

}  // namespace splotchcl::test
