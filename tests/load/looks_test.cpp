// What the looks make of a snapshot.
#include "snapshot/memory_snapshot.h"
#include "splotchcl/load.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/picture.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::MemorySnapshot;

std::vector<float> places(int count, double side) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(0, static_cast<float>(side));
  std::vector<float> position;
  for (int i = 0; i < 3 * count; ++i)
    position.push_back(place(random));
  return position;
}

// Gas of a universe whose heat reaches over some decades from `coldest`, in (km/s)^2.
MemorySnapshot universe(float coldest, int gas = 300, int dark = 300) {
  MemorySnapshot snapshot;
  std::vector<float> energy;
  for (int i = 0; i < gas; ++i)
    energy.push_back(coldest * std::pow(10.0F, 3.0F * static_cast<float>(i) / 300));
  snapshot.add(0, "position", places(gas, 10), 3);
  snapshot.add(0, "internal_energy", energy);
  snapshot.set_unit(0, "internal_energy", "km^2/s^2");
  snapshot.set_table_mass(0, 1);
  if (dark > 0) {
    snapshot.add(1, "position", places(dark, 10), 3);
    snapshot.set_table_mass(1, 5);
  }
  snapshot.set_cosmology(Cosmology());
  snapshot.set_box_size(10);
  return snapshot;
}

TEST(PressLook, GivesARunTheSameColorsInAllItsSnapshots) {
  const Component early = suggest_scene(universe(1)).components.front();
  const Component late = suggest_scene(universe(70)).components.front();
  ASSERT_TRUE(early.color.minimum && early.color.maximum);
  EXPECT_EQ(early.color.minimum, late.color.minimum);
  EXPECT_EQ(early.color.maximum, late.color.maximum);
  EXPECT_EQ(early.palette, late.palette);
}

TEST(PressLook, ColorsDarkMatterByHowMuchDenserItIsThanTheMean) {
  MemorySnapshot snapshot;
  snapshot.add(1, "position", places(2000, 10), 3);
  snapshot.set_table_mass(1, 3);
  snapshot.set_cosmology(Cosmology());
  snapshot.set_box_size(10);
  const Component press = suggest_component(snapshot, {1});
  constexpr double mean = 2000 * 3 / 1000.0;
  ASSERT_TRUE(press.color.minimum && press.color.maximum);
  EXPECT_LT(*press.color.minimum, mean);
  EXPECT_GT(*press.color.maximum, 1000 * mean);
}

TEST(PressLook, ColorsDiscsByDensitiesThatAreKnownInSolarMasses) {
  MemorySnapshot snapshot;
  snapshot.add(2, "position", places(300, 10), 3);
  snapshot.add(2, "mass", std::vector<float>(300, 1));
  const Component unknown = suggest_component(snapshot, {2});
  EXPECT_FALSE(unknown.color.minimum);
  snapshot.set_unit(2, "position", "kpc");
  snapshot.set_unit(2, "mass", "1e10 M_sun");
  const Component known = suggest_component(snapshot, {2});
  ASSERT_TRUE(known.color.minimum);
  EXPECT_NEAR(*known.color.minimum, 3e-5, 1e-9);
}

TEST(PressLook, GlowsAndEndsInWhite) {
  const FinishSettings finish = suggest_scene(universe(1)).finish;
  EXPECT_GT(finish.bloom, 0);
  EXPECT_GT(finish.highlights, 0);
  EXPECT_FALSE(finish.exposure || finish.white);
}

TEST(PressLook, DrawsFewStarsAsPoints) {
  MemorySnapshot snapshot;
  snapshot.add(4, "position", places(40, 10), 3);
  const Component few = suggest_scene(snapshot).components.front();
  EXPECT_LT(few.size_factor, 0.1);
  MemorySnapshot more;
  more.add(4, "position", places(4000, 10), 3);
  EXPECT_EQ(suggest_scene(more).components.front().size_factor, 1);
}

TEST(PressLook, ShowsTheDarkMatterThatCarriesThePicture) {
  const auto names = [](const MemorySnapshot& snapshot) {
    std::vector<std::string> all;
    for (const Component& component : suggest_scene(snapshot).components)
      all.push_back(component.name);
    return all;
  };
  EXPECT_EQ(names(universe(1, 50, 1000)), (std::vector<std::string>{"gas", "halo"}));
  EXPECT_EQ(names(universe(1, 300, 300)), (std::vector<std::string>{"gas"}));
}

TEST(ClassicLook, NeitherGlowsNorSaturates) {
  const FinishSettings finish = suggest_scene(universe(1), Look::classic).finish;
  EXPECT_EQ(finish.bloom, 0);
  EXPECT_EQ(finish.highlights, 0);
  EXPECT_EQ(finish.saturation, 1);
}

TEST(PaperLook, DrawsInkOnWhite) {
  const MemorySnapshot snapshot = universe(1);
  Scene scene = suggest_scene(snapshot, Look::paper);
  scene.image.width = scene.image.height = 24;
  std::vector<std::string> notes;
  const auto draw = [](const Frame& frame) { return reference::render(frame).to_float(); };
  const Image image = draw_pictures(scene, snapshot, draw, notes).front().image;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_LE(image.pixels[i], 1);
  EXPECT_LT(*std::min_element(image.pixels.begin(), image.pixels.end()), 0.9F);
}

// The largest luminance of the colors over the smallest, of light that a display shows.
double lightness_ratio(const std::string& name) {
  const Palette palette = load_palette(name);
  double least = 1, most = 0;
  for (int i = 0; i <= 40; ++i) {
    const auto color = sample_knots(palette.emission, i / 40.0);
    const double luminance = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
    least = std::min(least, std::pow(luminance, 1 / 2.4));
    most = std::max(most, std::pow(luminance, 1 / 2.4));
  }
  return most / least;
}

TEST(PressLook, LeavesDarknessToTheLight) {
  EXPECT_LT(lightness_ratio("cosmos"), 3);
  EXPECT_LT(lightness_ratio("spiral"), 3);
  EXPECT_LT(lightness_ratio("starlight"), 3);
  EXPECT_GT(lightness_ratio("hot_gas"), 3);
}

TEST(Looks, AreNotDrawnBeforeTheyHaveChosenComponents) {
  const MemorySnapshot snapshot = universe(1);
  Scene scene;
  scene.look = Look::press;
  std::vector<std::string> notes;
  EXPECT_THROW(load_frame(scene, snapshot, notes), UsageError);
  EXPECT_THROW(check_load(scene, snapshot), UsageError);
}

}  // namespace
}  // namespace splotchcl
