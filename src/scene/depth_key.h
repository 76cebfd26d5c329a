#pragma once

#include <cstdint>

#include "splotchcl/frame.h"

// Depths as integers. They decide which of two particles lies in front and who is within the near
// and far limits, in both renderers: kernels/project/depth_key.cl and src/reference/depth_key.cpp
// compute them, bit for bit alike, from what is made here. docs/dev/accuracy.md derives the
// numbers.
//
// Lengths are counted in units of 2^unit. A particle's place from the camera, per axis, is
//   D = (origin - camera) + offset      both in units, the offset truncated, |D| < 2^60
// Where an offset is too large for that, the particle's unit is 2^coarser times as large, and
// (origin - camera) is shifted down by as much. From D follows the magnitude
//   z   = D . forward / 2^60            in units; forward counts 2^-60
//   d^2 = D . D / 2^60                  wide angles, with D doubled as often as 60 bits allow
// in products of 30 bits, a = 2^30 a_high + a_low with 0 <= a_low < 2^30:
//   a . b / 2^60 = sum a_high b_high + floor(sum (a_high b_low + a_low b_high) / 2^30)
// What that leaves out is below 4. The magnitude's leading 41 bits, after their exponent, make the
// key of 48 bits. No digit depends on other particles or on what is drawn.
namespace splotchcl {

constexpr int depth_key_bits = 48;

// What both renderers make the keys of one component's particles from.
struct DepthKeyScale {
  bool by_distance = false;              // wide angles: the distance, else z
  bool is_perspective = false;           // z must be least_perspective_depth at least
  int finest_unit = 0;                   // of the frame, as an exponent of 2: keys count in it
  int unit = 0;                          // of the component's D, as well; >= finest_unit
  std::int64_t origin_from_camera[3]{};  // in units; |each| <= 2^59
  std::int64_t forward[3]{};             // the view direction, in 2^-60
  std::uint64_t near_key = 0;            // particles of smaller keys are left out,
  std::uint64_t far_key = 0;             // and those of larger ones
  // Where no near limit is set, nearer than near_factor * 2^(near_exponent - 60) times its
  // smoothing length, as it is stored, a particle is left out. 0: there is a near limit.
  std::int64_t near_factor = 0;
  int near_exponent = 0;
};

// In units: nearer to the plane of a perspective camera nothing is drawn. That much is what
// double precision, and extended precision, may be wrong by in a depth.
constexpr std::int64_t least_perspective_depth = std::int64_t{1} << 22;

DepthKeyScale make_depth_key_scale(const Frame& frame, const DrawnComponent& component);

// The key of a depth or, in wide angles, of a distance that is known in double precision. A
// particle's own is made from its coordinates.
std::uint64_t key_of_depth(double depth, const DepthKeyScale& scale);

}  // namespace splotchcl
