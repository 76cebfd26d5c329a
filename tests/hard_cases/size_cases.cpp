// Widths of clouds from far below a pixel to far beyond the picture, and where discs end.
#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// A cloud of this width whose brightest pixel is about `value`.
Cloud cloud_of(double x, double y, double z, double sigma, double value) {
  const double pixel_share = sigma < 0.5 ? pi * sigma * sigma : 1;
  return {x, y, z, sigma, value / pixel_share};
}

Frame widths(double low, double high, int count, double value, LightPlan plan) {
  Random random(31);
  std::vector<Cloud> clouds;
  for (int i = 0; i < count; ++i) {
    const double sigma = random.logarithmic(low, high);
    clouds.push_back(cloud_of(random.uniform(-50, 50), random.uniform(-35, 35),
                              random.uniform(1, 100), sigma, value * random.logarithmic(0.1, 1)));
  }
  return lit(frame_of(100, 70, {in_random_colors(component_of(clouds, two_colors()))}), plan);
}

// Every width of the range, in steps, side by side and over each other.
Frame every_width(LightPlan plan) {
  // h = sigma / kernel.width; frames of tests have kernel.width 1.
  return widths(1e-6, 1e5, 300, 0.3, plan);
}

// Bright grains in random places: what of their light falls on which pixel depends on
// their centre's last digits where they lie on an edge.
Frame bright_grains(LightPlan plan) {
  return widths(1e-6, 1e-2, 3000, 1, plan);
}

// Grains exactly on edges and corners of pixels: each pixel takes a half or a quarter.
Frame grains_on_edges(LightPlan plan) {
  std::vector<Cloud> clouds;
  Random random(33);
  for (int i = 0; i < 400; ++i) {
    const double x = std::floor(random.uniform(-50, 50)) + (i % 2 == 0 ? 0.5 : 0);
    const double y = std::floor(random.uniform(-35, 35));
    clouds.push_back(cloud_of(x, y, random.uniform(1, 100), random.logarithmic(1e-6, 1e-2), 1));
  }
  return lit(frame_of(100, 70, {in_random_colors(component_of(clouds, two_colors()))}), plan);
}

// Discs that end exactly at edges and corners of tiles of any width that divides 64, with
// the kernel cut where a pixel's centre lies, so that the boundary itself is drawn.
Frame discs_at_tile_edges(Sampling sampling, double cut, double sigma, LightPlan plan) {
  std::vector<Cloud> clouds;
  for (int ty = 0; ty < 5; ++ty) {
    for (int tx = 0; tx < 9; ++tx) {
      const double reach = cut * sigma;
      // The corner itself, and discs whose last pixel is the corner pixel of a tile.
      clouds.push_back({16.0 * tx, 16.0 * ty, 1, sigma, 0.5});
      clouds.push_back({16.0 * tx + 0.5 - reach, 16.0 * ty + 0.5, 2, sigma, 0.5});
      clouds.push_back({16.0 * tx - 0.5, 16.0 * ty - 0.5 + reach, 3, sigma, 0.5});
    }
  }
  for (Cloud& cloud : clouds) {
    cloud.x -= 64;  // camera at the picture's centre
    cloud.y -= 32;
  }
  Frame frame =
      lit(frame_of(128, 64, {in_random_colors(component_of(clouds, two_colors()))}), plan);
  frame.kernel.cut = cut;
  frame.kernel.sampling = sampling;
  return frame;
}

// Stars far brighter than white, some pixels apart: what is dark between them is judged
// against white.
Frame bright_stars(double brightest, LightPlan plan, double sigma_low = 0.2,
                   double sigma_high = 4) {
  std::vector<Cloud> clouds;
  Random random(37);
  for (int y = -25; y <= 25; y += 25) {
    for (int x = -40; x <= 40; x += 20) {
      clouds.push_back(cloud_of(x + random.uniform(), y + random.uniform(), 1,
                                random.logarithmic(sigma_low, sigma_high),
                                random.logarithmic(1, brightest)));
    }
  }
  return lit(frame_of(100, 70, {component_of(clouds, one_color(1, 0.5f, 0.1f))}), plan);
}

// Grains on edges of pixels whose kernel is cut: the pixel that holds the centre, and no
// other, keeps its part of the light.
Frame cut_grains_on_edges(LightPlan plan) {
  Frame frame = grains_on_edges(plan);
  frame.kernel.cut = 2;
  return frame;
}

Frame cut_kernel(double cut, LightPlan plan) {
  Frame frame = widths(0.3, 20, 200, 1, plan);
  frame.kernel.cut = cut;
  return frame;
}

// One cloud alone, wide enough for a coarse grid, whose cut edge is a step of exp(-cut^2) of
// its peak.
Frame lone_cut_edge(double sigma, LightPlan plan) {
  Frame frame =
      lit(frame_of(128, 96, {component_of({{0.3, -1.2, 1, sigma, 2}}, two_colors())}), plan);
  frame.kernel.cut = 2.66;
  return frame;
}

Frame smallest_radius(LightPlan plan) {
  Frame frame = widths(1e-3, 5, 500, 0.5, plan);
  frame.kernel.min_radius_pixels = 0.7;
  return frame;
}

}  // namespace

std::vector<HardCase> size_cases() {
  return {
      {"WidthsFrom1e_6To1e5Pixels",
       "squares of widths span 22 orders of magnitude, and the widest reach over every tile",
       every_width},
      {"BrightGrains",
       "a grain's light falls on one pixel or on its neighbour: a centre off by e pixels shows "
       "by e / sigma of it",
       bright_grains},
      {"GrainsOnPixelEdges", "light must be halved and quartered exactly", grains_on_edges},
      {"DiscsEndAtTileEdges",
       "the last pixel of a disc is the first of a tile, at exactly the cut's distance",
       [](LightPlan plan) { return discs_at_tile_edges(Sampling::center, 2, 4, plan); }},
      {"DiscsEndAtTileEdgesPixelMeans", "the same with means over pixels, whose widths are widened",
       [](LightPlan plan) { return discs_at_tile_edges(Sampling::mean, 2, 4, plan); }},
      {"CutKernelOfPixelMeans", "a low cut leaves a bright edge, which belongs to the model",
       [](LightPlan plan) { return cut_kernel(1.1, plan); }},
      {"LoneCutEdge", "no other edge hides what a coarse grid makes of this one",
       [](LightPlan plan) { return lone_cut_edge(13, plan); }},
      {"LoneWideCutEdge", "the same where a still coarser grid would do for the cloud itself",
       [](LightPlan plan) { return lone_cut_edge(31, plan); }},
      {"CutGrainsOnPixelEdges", "a cut grain has one pixel, also on the edge between two",
       cut_grains_on_edges},
      {"StarsOf100TimesWhite", "errors relative to a star's peak show in its dark surroundings",
       [](LightPlan plan) { return bright_stars(100, plan); }},
      {"StarsOf1e4TimesWhite", "errors of 1e-7 of a star's peak show in its dark surroundings",
       [](LightPlan plan) { return bright_stars(1e4, plan); }},
      {"StarsOf1e6TimesWhite", "the same of 1e-9, where single precision has digits of 1e-7",
       [](LightPlan plan) { return bright_stars(1e6, plan); }},
      {"WideStarsOf1e4TimesWhite", "the same on coarse grids, whose pixels mix bright and dark",
       [](LightPlan plan) { return bright_stars(1e4, plan, 4, 30); }},
      {"SmallestRadius", "widths and weights change together, below a pixel", smallest_radius},
  };
}

}  // namespace splotchcl::test
