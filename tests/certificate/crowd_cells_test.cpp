// Where many splats lie upon one another, by cells.
#include "certificate/crowd_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace splotchcl::test {
namespace {

struct Splat {
  double x, y, light;
};

constexpr int shift = 2, side = 1 << shift;

// By its definition, square by square.
class Field {
 public:
  explicit Field(const std::vector<Splat>& splats) {
    for (const Splat& splat : splats) {
      auto& [light, count] = cells_[cell_of(splat)];
      light += splat.light;
      count += 1;
    }
  }
  double crowded_light(bool is_sample) const {
    double most = 0;
    for (const auto& [cell, sums] : cells_) {
      for (const int left : {cell.first - 1, cell.first}) {
        for (const int top : {cell.second - 1, cell.second})
          most = std::max(most, of_square(left, top, is_sample));
      }
    }
    return most;
  }

 private:
  static std::pair<int, int> cell_of(const Splat& splat) {
    return {static_cast<int>(std::floor(splat.x / side)),
            static_cast<int>(std::floor(splat.y / side))};
  }
  std::pair<double, double> within(int left, int top, int cells) const {
    std::pair<double, double> all{0, 0};
    for (const auto& [cell, sums] : cells_) {
      if (cell.first < left || cell.first >= left + cells || cell.second < top ||
          cell.second >= top + cells)
        continue;
      all.first += sums.first;
      all.second += sums.second;
    }
    return all;
  }
  double of_square(int left, int top, bool is_sample) const {
    const auto [light, count] = within(left, top, 2);
    if (is_sample && count < 6) return 0;
    const double certain = is_sample ? 1 - 2 / std::sqrt(count) : 1;
    return certain * light - (within(left - 2, top - 2, 6).first - light) / 8;
  }

  std::map<std::pair<int, int>, std::pair<double, double>> cells_;
};

// Some crowds among others all over a picture and beside it.
std::vector<Splat> splats_of(unsigned seed, int count, double width) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-width, width), light(0.1, 1), close(0, 6);
  std::vector<Splat> splats;
  for (int i = 0; i < count; ++i)
    splats.push_back({place(random), place(random), light(random)});
  for (int i = 0; i < count / 4; ++i)
    splats.push_back({17 + close(random), -40 + close(random), light(random)});
  return splats;
}

double crowded_light(const std::vector<Splat>& splats, bool is_sample) {
  CrowdCells cells(shift);
  for (const Splat& splat : splats)
    cells.add(splat.x, splat.y, splat.light);
  return cells.crowded_light(is_sample);
}

TEST(CrowdCells, FindTheFullestSquareBeyondItsSurroundings) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    for (const double width : {10.0, 60.0, 400.0}) {
      const std::vector<Splat> splats = splats_of(seed, 120, width);
      const Field field(splats);
      for (const bool is_sample : {false, true})
        EXPECT_NEAR(crowded_light(splats, is_sample), field.crowded_light(is_sample), 1e-9)
            << "seed " << seed << ", width " << width;
    }
  }
}

TEST(CrowdCells, OfASampleTellNothingByFewSplats) {
  const std::vector<Splat> five(5, Splat{1, 1, 1});
  EXPECT_EQ(crowded_light(five, true), 0);
  EXPECT_EQ(crowded_light(five, false), 5);
}

TEST(CrowdCells, HoldSplatsHoweverFarBesideThePicture) {
  EXPECT_EQ(crowded_light({{1e30, -1e30, 2}, {3, 3, 1}}, false), 2);
}

TEST(CrowdCells, FindNothingAmongNone) {
  EXPECT_EQ(crowded_light({}, false), 0);
}

}  // namespace
}  // namespace splotchcl::test
