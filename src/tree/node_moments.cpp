#include "tree/node_moments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

// Where the entries of symmetric tensors lie.
constexpr std::size_t second_at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
constexpr std::size_t third_at[3][3][3] = {{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}},
                                           {{1, 3, 4}, {3, 6, 7}, {4, 7, 8}},
                                           {{2, 4, 5}, {4, 7, 8}, {5, 8, 9}}};

double length2(const std::array<double, 3>& a) {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

double trace(const std::array<double, 6>& second) {
  return second[0] + second[3] + second[5];
}

void add_second(const NodeMoments& part, const std::array<double, 3>& a, double share,
                NodeMoments& sum) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j)
      sum.second[second_at[i][j]] += share * (part.second[second_at[i][j]] + a[i] * a[j]);
  }
}

void add_third(const NodeMoments& part, const std::array<double, 3>& a, double share,
               NodeMoments& sum) {
  const auto s = [&](std::size_t i, std::size_t j) { return part.second[second_at[i][j]]; };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      for (std::size_t k = j; k < 3; ++k) {
        sum.third[third_at[i][j][k]] +=
            share * (part.third[third_at[i][j][k]] + a[i] * s(j, k) + a[j] * s(i, k) +
                     a[k] * s(i, j) + a[i] * a[j] * a[k]);
      }
    }
  }
}

// <|d + a|^4>, with <d> = 0.
double moved_fourth(const NodeMoments& part, const std::array<double, 3>& a) {
  double along_third = 0, along_second = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      along_third += a[i] * part.third[third_at[i][j][j]];
      along_second += a[i] * a[j] * part.second[second_at[i][j]];
    }
  }
  const double a2 = length2(a);
  return part.fourth + 4 * along_third + 2 * a2 * trace(part.second) + 4 * along_second + a2 * a2;
}

void add_widths(const NodeMoments& part, const std::array<double, 3>& a, double share,
                NodeMoments& sum) {
  sum.h2 += share * part.h2;
  sum.h4 += share * part.h4;
  sum.inverse_h2 += share * part.inverse_h2;
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum.h2_offset[i] += share * (part.h2_offset[i] + a[i] * part.h2);
    along += a[i] * part.h2_offset[i];
  }
  sum.h2_spread += share * (part.h2_spread + 2 * along + length2(a) * part.h2);
}

}  // namespace

NodeMoments NodeMoments::of_particle(double flux, const Vec3& place, double h) {
  NodeMoments moments;
  moments.flux = flux;
  moments.centroid = place;
  moments.h2 = h * h;
  moments.h4 = moments.h2 * moments.h2;
  moments.inverse_h2 = 1 / moments.h2;
  moments.widest = h;
  return moments;
}

NodeMoments NodeMoments::merged(const std::vector<const NodeMoments*>& parts) {
  NodeMoments sum;
  for (const NodeMoments* const part : parts) {
    sum.flux += part->flux;
    sum.widest = std::max(sum.widest, part->widest);
  }
  const auto share = [&sum](const NodeMoments* part) { return part->flux / sum.flux; };
  for (const NodeMoments* const part : parts) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum.centroid.a[axis] += share(part) * part->centroid.a[axis];
  }
  for (const NodeMoments* const part : parts) {
    std::array<double, 3> a{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      a[axis] = part->centroid.a[axis] - sum.centroid.a[axis];
    add_second(*part, a, share(part), sum);
    add_third(*part, a, share(part), sum);
    sum.fourth += share(part) * moved_fourth(*part, a);
    add_widths(*part, a, share(part), sum);
    sum.reach = std::max(sum.reach, part->reach + std::sqrt(length2(a)));
  }
  return sum;
}

NodeShape shape_of(const NodeMoments& moments, double deviation_per_h) {
  const double c2 = deviation_per_h * deviation_per_h;
  NodeShape shape;
  std::array<double, 6> second = moments.second;
  const double mean = moments.variance();
  double squares = 0, total_squares = 0, total_trace = 0, third = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double diagonal = i == j ? 1 : 0;
      const double entry = second[second_at[i][j]];
      squares += std::pow(entry - diagonal * mean, 2);
      total_squares += std::pow(entry + diagonal * c2 * moments.h2, 2);
      total_trace += diagonal * (entry + c2 * moments.h2);
      for (std::size_t k = 0; k < 3; ++k) {
        double value = moments.third[third_at[i][j][k]];
        if (j == k) value += c2 * moments.h2_offset[i];
        if (i == k) value += c2 * moments.h2_offset[j];
        if (i == j) value += c2 * moments.h2_offset[k];
        third += value * value;
      }
    }
  }
  shape.uneven = std::sqrt(squares);
  shape.third = std::sqrt(third);
  // <|d + s n|^4> of Gaussians of deviations s = c h around members.
  const double fourth = moments.fourth + 10 * c2 * moments.h2_spread + 15 * c2 * c2 * moments.h4;
  shape.fourth = std::abs(fourth - total_trace * total_trace - 2 * total_squares);
  return shape;
}

}  // namespace splotchcl
