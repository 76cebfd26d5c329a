#include "map/figure.h"
#include "map/gas.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::map_scene;

Map even_map(int width, int height, float value) {
  Map map;
  map.width = width;
  map.height = height;
  map.values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value);
  map.quantity = "surface density";
  map.unit = "Msun/pc^2";
  map.right_name = "x";
  map.up_name = "y";
  map.length_unit = "kpc";
  map.pixel = 0.5;
  return map;
}

// From 0 in the left column to width - 1 in the right one.
Map ramp(int width, int height) {
  Map map = even_map(width, height, 0);
  for (std::size_t i = 0; i < map.values.size(); ++i)
    map.values[i] = static_cast<float>(i % static_cast<std::size_t>(width));
  return map;
}

MapSettings settings(MapScaling scaling, double minimum, double maximum) {
  MapSettings settings;
  settings.scaling = scaling;
  settings.minimum = minimum;
  settings.maximum = maximum;
  return settings;
}

// A palette from black to white.
TEST(MapFigure, ShowsValuesByThePaletteAsItsBarDoes) {
  Scene scene = map_scene();
  scene.map = settings(MapScaling::log, 1, 100);
  scene.map.palette = "gray";
  const Image figure = draw_figure(plan_figure(even_map(600, 400, 10), scene.map), scene, {});
  EXPECT_NEAR(figure.at(200, 200)[0], 0.5F, 1e-3F);  // the middle of two decades
}

TEST(MapFigure, ShowsGrayWhereThereIsNoValue) {
  Scene scene = map_scene();
  Map map = even_map(600, 400, 10);
  map.values[200 * 600 + 200] = std::nanf("");
  EXPECT_EQ(draw_figure(plan_figure(map, scene.map), scene, {}).at(200, 200)[1], 0.2F);
}

TEST(MapFigure, HasAWhiteLineAtAContour) {
  Scene scene = map_scene();
  scene.map = settings(MapScaling::linear, 0, 599);
  scene.map.palette = "gray";
  scene.map.contours = {150.5};
  const Image figure = draw_figure(plan_figure(ramp(600, 400), scene.map), scene, {});
  // Values are those of pixel centers: 150.5 lies at the border of pixels 150 and 151.
  EXPECT_NEAR(figure.at(150, 200)[0], 0.5F + 0.5F * 0.1F, 0.1F);
  EXPECT_NEAR(figure.at(140, 200)[0], 140.0F / 599, 1e-3F);
  EXPECT_GT(figure.at(151, 200)[0], 0.4F);
}

TEST(MapFigure, IsAPdfFileOnRequest) {
  Scene scene = map_scene();
  scene.map.contour_count = 3;
  scene.finish.title.text = "Σ at z = 0";
  const Map map = ramp(60, 40);
  const Figure figure = plan_figure(map, scene.map);
  const auto bytes = encode_pdf("a.pdf", figure, scene, {});
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_EQ(text.substr(0, 5), "%PDF-");
  EXPECT_THAT(text, HasSubstr("%%EOF"));
  EXPECT_EQ(bytes, encode_pdf("a.pdf", figure, scene, {})) << "the same map, the same bytes";
}

TEST(MapFigure, IsRefusedBeforeTheMapIsDrawnWhereItCannotBe) {
  Scene scene = map_scene();
  EXPECT_NO_THROW(check_map_output("a.png", scene, {}));
  scene.map.palette = "viridiss";
  EXPECT_THROW(check_map_output("a.png", scene, {}), UsageError);
  EXPECT_NO_THROW(check_map_output("a.fits", scene, {}));
  scene.map.palette = "viridis";
  scene.finish.title.text = "{redshift}";
  EXPECT_THROW(check_map_output("a.pdf", scene, {}), UsageError);
}

TEST(MapColors, ScaleAsTheSettingsSay) {
  const std::vector<float> none;
  EXPECT_NEAR(MapColors(none, settings(MapScaling::linear, 10, 30)).place(15), 0.25, 1e-12);
  EXPECT_NEAR(MapColors(none, settings(MapScaling::log, 1, 1e4)).place(10), 0.25, 1e-12);
  EXPECT_NEAR(MapColors(none, settings(MapScaling::power, 0, 16)).place(1), 0.25, 1e-12);
  MapSettings asinh = settings(MapScaling::asinh, -std::sinh(2), std::sinh(2));
  asinh.softening = 1;
  EXPECT_NEAR(MapColors(none, asinh).place(std::sinh(-1)), 0.25, 1e-12);
}

TEST(MapColors, TakePercentilesOfFiniteValuesForLimits) {
  std::vector<float> values;
  for (int i = 0; i <= 100; ++i)
    values.push_back(static_cast<float>(i));
  values.push_back(std::nanf(""));
  MapSettings half;
  half.scaling = MapScaling::linear;
  half.percentiles = {25, 75};
  const MapColors colors(values, half);
  EXPECT_NEAR(colors.place(25), 0, 1e-9);
  EXPECT_NEAR(colors.place(75), 1, 1e-9);
}

// Powers of ten from 1e-10 to 1.
std::vector<float> eleven_decades() {
  std::vector<float> values;
  for (int i = -100; i <= 0; ++i)
    values.push_back(static_cast<float>(std::pow(10.0, 0.1 * i)));
  return values;
}

TEST(MapColors, BeginAtTheFloorWhereTheyAreLogarithmic) {
  MapSettings all;
  all.percentiles = {0, 100};
  EXPECT_NEAR(MapColors(eleven_decades(), all, 1e-4).place(1e-4), 0, 1e-9);
  EXPECT_NEAR(MapColors(eleven_decades(), all, 1e-4).place(1e-2), 0.5, 1e-6);
  EXPECT_NEAR(MapColors(eleven_decades(), all, 1e-12).place(1e-10), 0, 1e-6);
  all.scaling = MapScaling::linear;
  EXPECT_NEAR(MapColors(eleven_decades(), all, 1e-4).place(1e-10), 0, 1e-9);
}

TEST(MapColors, BeginBelowTheFloorWhereTheSettingsSay) {
  MapSettings deep;
  deep.minimum = 1e-8;
  EXPECT_NEAR(MapColors(eleven_decades(), deep, 1e-4).place(1e-8), 0, 1e-9);
  MapSettings faint;
  faint.maximum = 1e-6;
  EXPECT_NEAR(MapColors(eleven_decades(), faint, 1e-4).place(1e-6), 1, 1e-9);
}

TEST(MapColors, EndAtTheLargestValueWhereThePercentileLiesBelowTheFloor) {
  std::vector<float> values(10000, 1e-9F);
  values.back() = 1;
  const MapColors colors(values, {}, 1e-7);
  EXPECT_NEAR(colors.place(1e-7), 0, 1e-9);
  EXPECT_NEAR(colors.place(1), 1, 1e-9);
}

TEST(MapFigure, HasANoteOnPixelsBelowTheFloor) {
  Map map = even_map(10, 10, 1);
  map.value_floor = 1e-3;
  EXPECT_TRUE(plan_figure(map, {}).notes().empty());
  std::fill_n(map.values.begin(), 25, 1e-6F);
  ASSERT_EQ(plan_figure(map, {}).notes().size(), 1U);
  EXPECT_THAT(plan_figure(map, {}).notes().front(), HasSubstr("25 % of the map's pixels"));
  EXPECT_TRUE(plan_figure(map, settings(MapScaling::log, 1e-8, 2)).notes().empty());
}

std::vector<float> from_minus_hundred_to(int last) {
  std::vector<float> values;
  for (int i = -100; i <= last; ++i)
    values.push_back(static_cast<float>(i));
  return values;
}

TEST(MapColors, AreEvenInValuesOfBothSignsWithZeroInTheMiddle) {
  MapSettings all;
  all.percentiles = {0, 100};
  const MapColors colors(from_minus_hundred_to(50), all);
  EXPECT_NEAR(colors.place(-100), 0, 1e-9);
  EXPECT_NEAR(colors.place(0), 0.5, 1e-9);
  EXPECT_NEAR(colors.place(50), 0.75, 1e-9);
}

TEST(MapColors, SpreadValuesOfBothSignsThatSpanDecades) {
  std::vector<float> values = eleven_decades();
  for (float value : eleven_decades())
    values.push_back(-value);
  MapSettings all;
  all.percentiles = {0, 100};
  const MapColors colors(values, all);
  EXPECT_NEAR(colors.place(0), 0.5, 1e-9);
  EXPECT_GT(colors.place(0.01), 0.6) << "an asinh";
}

TEST(MapColors, ReachFromLimitsThatAreSetBelowZero) {
  MapSettings set;
  set.percentiles = {0, 100};
  set.minimum = -200;
  const MapColors colors(from_minus_hundred_to(200), set);
  EXPECT_NEAR(colors.place(-200), 0, 1e-9);
  EXPECT_NEAR(colors.place(0), 0.5, 1e-9);
}

TEST(MapColors, EndAtTheValuesWhereAllLieBelowZero) {
  MapSettings all;
  all.percentiles = {0, 100};
  EXPECT_NEAR(MapColors(from_minus_hundred_to(-10), all).place(-10), 1, 1e-9);
}

TEST(MapColors, AreLogarithmicWhereFewValuesLieBelowZero) {
  std::vector<float> values(1000, 1);
  values[0] = -1e-6F;
  values[1] = 100;
  MapSettings limits;
  limits.maximum = 100;
  EXPECT_NEAR(MapColors(values, limits).place(10), 0.5, 1e-9);
}

// Of values of both signs, whose sums err where there is nothing.
TEST(MapColors, AreLogarithmicWhereValuesLieBelowZeroByTheirErrorAlone) {
  std::vector<float> values(1000, -1e-6F);
  std::fill_n(values.begin(), 500, 10.0F);
  MapSettings limits;
  limits.maximum = 100;
  EXPECT_EQ(MapColors(values, limits, 1e-2, 1e-5).range().scaling, MapScaling::log);
  EXPECT_NE(MapColors(values, limits, 1e-2, 1e-7).range().scaling, MapScaling::log);
}

TEST(MapFigure, HasANoteOnPixelsWithoutALogarithm) {
  Map map = even_map(10, 10, 1);
  std::fill_n(map.values.begin(), 25, -1.0F);
  EXPECT_TRUE(plan_figure(map, {}).notes().empty());
  MapSettings log;
  log.scaling = MapScaling::log;
  ASSERT_EQ(plan_figure(map, log).notes().size(), 1U);
  EXPECT_THAT(plan_figure(map, log).notes().front(), HasSubstr("25 % of the map's pixels"));
}

TEST(MapColors, MarkTheBarWhereTheValuesAre) {
  MapSettings asinh = settings(MapScaling::asinh, -1e-3, 1e-3);
  asinh.softening = 1e-6;
  for (const MapSettings& one :
       {settings(MapScaling::power, 0, 100), asinh, settings(MapScaling::log, 1e-3, 1e3)}) {
    const MapColors colors({}, one);
    const std::vector<Tick> ticks = colors.ticks(6, true);
    EXPECT_GE(ticks.size(), 4U);
    for (const Tick& tick : ticks) {
      EXPECT_NEAR(tick.position, colors.place(tick.value), 1e-12);
      EXPECT_GE(tick.position, -1e-9);
      EXPECT_LE(tick.position, 1 + 1e-9);
    }
  }
}

TEST(MapColors, RefuseALogarithmOfZero) {
  EXPECT_THROW(MapColors({}, settings(MapScaling::log, 0, 1)), UsageError);
}

TEST(MapFigure, HasItsLimitsRefusedBeforeAnythingIsDrawn) {
  Scene scene = map_scene();
  for (const MapSettings& wrong :
       {settings(MapScaling::log, 0, 1), settings(MapScaling::linear, 2, 1)}) {
    scene.map = wrong;
    EXPECT_THROW(check_map_output("a.png", scene, {}), UsageError);
    EXPECT_NO_THROW(check_map_output("a.fits", scene, {}));
  }
}

TEST(MapColors, RefuseLimitsOutOfOrder) {
  EXPECT_THROW(MapColors({}, settings(MapScaling::linear, 2, 1)), UsageError);
  EXPECT_THROW(MapColors({}, settings(MapScaling::log, 1e-9, 1e-9)), UsageError);
}

TEST(Contours, LieWhereTheMapHasTheirValue) {
  const auto pieces = contour_pieces(ramp(20, 10), 7.25);
  EXPECT_EQ(pieces.size(), 9U);
  for (const ContourPiece& piece : pieces) {
    EXPECT_NEAR(piece[0][0], 7.75, 1e-12);  // the center of pixel 7 lies at 7.5
    EXPECT_NEAR(piece[1][0], 7.75, 1e-12);
  }
}

TEST(Contours, CloseAroundAPeak) {
  Map map = even_map(5, 5, 0);
  map.values[12] = 1;
  EXPECT_EQ(contour_pieces(map, 0.5).size(), 4U);
}

TEST(Contours, LeaveOutWhatHasNoValue) {
  Map map = ramp(3, 2);
  map.values[0] = std::nanf("");
  EXPECT_TRUE(contour_pieces(map, 0.5).empty());
  EXPECT_EQ(contour_pieces(map, 1.5).size(), 1U);
}

}  // namespace
}  // namespace splotchcl
