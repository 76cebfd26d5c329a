#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "splotchcl/frame.h"

namespace splotchcl {

// Clouds around the camera (Frame::through_clouds): what is in front of the camera along each ray,
// where a splat would show a cloud's whole column or none. docs/projections.md has the formulas.
// The reference renderer has a copy of its own on purpose (src/reference/render.cpp).

// Distances from the camera in sigma. Up to the first a cloud is what a ray finds, from the second
// on it is a splat.
constexpr double all_ray = 4, all_splat = 12;

// Whether the frame's clouds may be around the camera: an orthographic one is nowhere.
bool has_clouds_around(const Frame& frame);

// The part of a cloud at this distance that a ray finds: 1 at all_ray, 0 at all_splat.
double ray_part(double distance_in_sigma);

// Where a splat of the cloud lies in the picture, in pixels.
struct SplatAround {
  double x = 0, y = 0, sigma_x = 0, sigma_y = 0;
};

struct CloudAround {
  std::uint64_t key = 0;            // by which it is sorted
  Vec3 center{};                    // in sigma, along right, down and forward, as the eye sees it
  double ray = 0, splat = 0;        // its parts, which are factors on columns of 1
  std::vector<SplatAround> splats;  // copies of one; none where the projection cannot show it
  std::array<double, 3> emission{}, absorption{};  // E w, A w
  // Nothing of it shows farther from its center, in sigma, squared: however bright, exp(-90).
  double farthest2 = 90;
};

// Particle i of the component, which is good and around the camera; its key is left 0.
CloudAround cloud_around(const DrawnComponent& component, const Frame& frame, std::size_t i);

// How far from the view direction the picture's corners are seen, in radians.
double widest_angle(const Frame& frame);

// No more than this column, of a central one of 1, is in any pixel of the picture.
double largest_column_around(const CloudAround& cloud, const Frame& frame, double widest_angle);

// No detail of clouds [first, end) is narrower in the picture than exp(-x^2 / n^2) with this n, in
// pixels. Seen from u sigma away a cloud is 1 / u wide in radians, from within it about 1. Less
// than a pixel where a kernel that is cut ends.
double narrowest_detail(const std::vector<CloudAround>& clouds, std::size_t first, std::size_t end,
                        const Frame& frame);

// Of clouds [first, end) stretches that follow each other, by their ends: where a cut kernel ends
// in the picture every pixel has to be worked out, and the clouds before and behind it need not be
// worked out with it. A single stretch where no kernel ends in the picture.
std::vector<std::size_t> ends_of_stretches(const std::vector<CloudAround>& clouds,
                                           std::size_t first, std::size_t end, const Frame& frame);

}  // namespace splotchcl
