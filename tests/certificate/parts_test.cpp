#include "certificate/cells.h"
#include "certificate/color_light.h"
#include "reference/frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Where many splats lie upon one another, by cells.

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

// Cell (x, y) holds 1 + x + 10 y.
CellSums numbered(int columns, int rows) {
  CellSums cells;
  cells.side = 2;
  cells.columns = columns;
  cells.rows = rows;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x)
      cells.values.push_back(static_cast<float>(1 + x + 10 * y));
  }
  return cells;
}

double added_up(const CellSums& cells, const CellRange& range) {
  double sum = 0;
  for (int y = range.y0; y < range.y1; ++y) {
    for (int x = range.x0; x < range.x1; ++x) {
      const bool exists = x >= 0 && x < cells.columns && y >= 0 && y < cells.rows;
      if (exists)
        sum += static_cast<double>(cells.values[static_cast<std::size_t>(y * cells.columns + x)]);
    }
  }
  return sum;
}

TEST(BlockSums, AddUpEveryRectangleInAndAroundTheCells) {
  const CellSums cells = numbered(5, 3);
  const int margin = 2;
  const BlockSums sums(cells, margin);
  for (int x0 = -margin; x0 <= 5 + margin; ++x0) {
    for (int x1 = x0; x1 <= 5 + margin; ++x1) {
      for (int y0 = -margin; y0 <= 3 + margin; ++y0) {
        for (int y1 = y0; y1 <= 3 + margin; ++y1) {
          const CellRange range = {x0, x1, y0, y1};
          ASSERT_EQ(sums.over_near(range), added_up(cells, range));
          ASSERT_EQ(sums.over(range), added_up(cells, range));
        }
      }
    }
  }
}

TEST(BlockSums, AreEmptyFarFromTheCells) {
  const CellSums cells = numbered(5, 3);
  const BlockSums sums(cells, 1);
  EXPECT_EQ(sums.over({-100, 200, -50, 70}), added_up(cells, {0, 5, 0, 3}));
  EXPECT_EQ(sums.over({20, 30, 0, 3}), 0);
}

// A star of some color among these knots, and the range of its field.
Frame star_among(const std::vector<Rgb>& knots, const ScalarMap& range) {
  DrawnComponent component = component_of({{0, 0, 1, 3, 1}}, {"some colors", knots, {}});
  component.particles.color = Column::uniform(1);
  component.color = range;
  component.absorption = {Absorption::Kind::none, 0};
  return frame_of(10, 10, {component});
}

double of_brightest(const Frame& frame, const FramePlan& plan) {
  return parts_of_colors(frame, plan).of_brightest;
}

FramePlan certified(const Frame& frame) {
  PlanOptions options;
  options.certify = true;
  return make_plan(frame, options);
}

double part_of_range(Scaling scaling, double minimum, double maximum) {
  const Frame frame = star_among({{1, 0, 0}, {0, 0, 1}}, {scaling, minimum, maximum});
  return of_brightest(frame, certified(frame));
}

double part_of_knots(const std::vector<Rgb>& knots) {
  const Frame frame = star_among(knots, {Scaling::linear, 0, 1});
  return of_brightest(frame, certified(frame));
}

TEST(Depths, AreLookedAtInOrderAndWhereColorsOfMatterAreRounded) {
  Frame frame = star_among({{1, 0, 0}, {0, 0, 1}}, {Scaling::linear, 0, 1});
  const auto needed = [&frame] { return needs_depths(frame, make_plan(frame)); };
  EXPECT_FALSE(needed()) << "nothing absorbs";
  frame.components.front().absorption.kind = Absorption::Kind::as_emission;
  EXPECT_TRUE(needed());
  frame.components.front().particles.color = {};
  EXPECT_FALSE(needed()) << "all have one color";
  frame.components.front().absorption = {Absorption::Kind::gray, 1};
  EXPECT_TRUE(needed()) << "in order";
}

TEST(ColorErrors, HaveABoundUnlessAPaletteIsBlackElsewhereThanWhereItBegins) {
  const auto has_bound = [](const std::vector<Rgb>& knots) {
    const Frame frame = star_among(knots, {Scaling::linear, 0, 1});
    return parts_of_colors(frame, certified(frame)).are_bounds;
  };
  const Rgb black = {0, 0, 0}, red = {1, 0, 0}, blue = {0, 0, 1};
  EXPECT_TRUE(has_bound({red, blue}));
  EXPECT_TRUE(has_bound({black, red, blue}));
  EXPECT_TRUE(has_bound({black, black}));
  EXPECT_FALSE(has_bound({red, black}));
  EXPECT_FALSE(has_bound({red, black, blue}));
}

TEST(ColorErrors, DoNotFollowTheRange) {
  EXPECT_EQ(part_of_range(Scaling::linear, 0, 1), part_of_range(Scaling::linear, 1e6, 1e6 + 1));
  EXPECT_EQ(part_of_range(Scaling::log, 1, 6), part_of_range(Scaling::log, 5.995, 6));
  EXPECT_EQ(part_of_range(Scaling::asinh, -1, 20), part_of_range(Scaling::asinh, 20, 20.01));
  EXPECT_LT(part_of_range(Scaling::log, 1, 6), 6e-6);
}

TEST(ColorErrors, GrowAsTheRangeBecomesNarrowBesideLogarithmsOfWhatFloatsHardlyHold) {
  EXPECT_GT(part_of_range(Scaling::log, -39, -38.995), 500 * part_of_range(Scaling::log, -39, -34));
}

TEST(ColorErrors, GrowWithTheNumberOfTimesThatColorsChange) {
  const Rgb red = {1, 0, 0}, blue = {0, 0, 1};
  EXPECT_NEAR(part_of_knots({red, blue, red, blue, red}), 4 * part_of_knots({red, blue}), 1e-12);
  EXPECT_LT(part_of_knots({red, {1, 0, 0.1f}}), 0.2 * part_of_knots({red, blue}));
}

TEST(ColorErrors, OfAFastPictureAreLessThanItsBoundAndMoreThanOfAnExtendedOne) {
  const Frame frame = star_among({{1, 0, 0}, {0, 0, 1}}, {Scaling::log, 1, 8});
  const FramePlan plan = make_plan(frame);
  const double part = of_brightest(frame, plan);
  EXPECT_LT(part, of_brightest(frame, certified(frame)));
  EXPECT_GT(part, 1000 * of_brightest(frame, extend_plan(frame, plan)));
}

TEST(ColorErrors, AreThoseOfTheChannelItselfWhereItIsNeverDark) {
  const auto of_itself = [](const std::vector<Rgb>& knots) {
    const Frame frame = star_among(knots, {Scaling::linear, 0, 1});
    return parts_of_colors(frame, make_plan(frame)).of_itself;
  };
  EXPECT_LT(of_itself({{1, 0.5f, 0.1f}, {0.5f, 1, 0.2f}}), 1e-6);
  EXPECT_LT(of_itself({{0, 0, 0}, {0.5f, 1, 0.2f}}), 1e-6) << "it grows from nothing";
  EXPECT_EQ(of_itself({{1, 0, 0}, {0, 0, 1}}), std::numeric_limits<double>::infinity());
}

TEST(ColorErrors, CountByTheBrightestChannelWhereItIsFaintest) {
  const double halfway = part_of_knots({{1, 0, 0}, {0, 0, 1}});
  EXPECT_NEAR(part_of_knots({{1, 0, 0}, {1, 0, 1}}), 0.5 * halfway, 1e-12);
  EXPECT_NEAR(part_of_knots({{0, 0, 0}, {0, 0, 1}}), halfway, 1e-12);
}

TEST(ColorErrors, AreNoneOfAPaletteOfOneColor) {
  EXPECT_EQ(part_of_knots({{1, 0.5f, 0}}), 0);
  EXPECT_EQ(part_of_knots({{1, 0.5f, 0}, {1, 0.5f, 0}}), 0);
}

}  // namespace
}  // namespace splotchcl::test
