#include "palette/palette_file.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using ::testing::IsSupersetOf;
namespace fs = std::filesystem;

std::string message_for_name(const std::string& name) {
  return test::refusal_by<Error>([&] { load_palette(name); });
}

double lightness(const Rgb& rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

TEST(BuiltInPalettes, HaveTheUsualOnesAndOnesForMatter) {
  EXPECT_THAT(palette_names(),
              IsSupersetOf({"viridis", "magma", "inferno", "plasma", "cividis", "gas", "hot_gas",
                            "stars", "temperature", "dust", "nebula", "gray", "fire", "veil"}));
}

TEST(BuiltInPalettes, HaveMatplotlibsUsualNames) {
  EXPECT_THAT(palette_names(),
              IsSupersetOf({"turbo", "jet", "hot", "coolwarm", "RdBu", "seismic", "twilight",
                            "Blues", "Greys", "Spectral", "bwr", "hsv", "rainbow", "cubehelix"}));
}

struct KnownColor {
  const char* palette;
  double position;
  Rgb color;
};

// As Matplotlib's maps of these names have them, to two digits.
TEST(BuiltInPalettes, HaveMatplotlibsColors) {
  for (const KnownColor& known : {KnownColor{"turbo", 0.5, {0.64F, 0.99F, 0.23F}},
                                  {"jet", 0, {0, 0, 0.5F}},
                                  {"jet", 0.5, {0.48F, 1, 0.49F}},
                                  {"hot", 0.365079, {1, 0, 0}},
                                  {"coolwarm", 0, {0.23F, 0.30F, 0.75F}},
                                  {"coolwarm", 1, {0.71F, 0.02F, 0.15F}},
                                  {"RdBu", 0, {0.40F, 0, 0.12F}},
                                  {"RdBu", 1, {0.02F, 0.19F, 0.38F}},
                                  {"seismic", 0.25, {0, 0, 1}},
                                  {"seismic", 0.75, {1, 0, 0}},
                                  {"twilight", 0.5, {0.18F, 0.08F, 0.22F}},
                                  {"Blues", 1, {0.03F, 0.19F, 0.42F}},
                                  {"viridis", 1, {0.99F, 0.91F, 0.14F}}}) {
    const auto color = sample_knots(load_palette(known.palette).emission, known.position);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(color[c], static_cast<double>(known.color[c]), 0.02)
          << known.palette << " at " << known.position << ", channel " << c;
    }
  }
}

TEST(BuiltInPalettes, OfOthersAreInTheNotice) {
  std::ifstream file(test::source_folder() / "palettes" / "NOTICE");
  const std::string notice{std::istreambuf_iterator<char>(file), {}};
  const auto folder = test::source_folder() / "palettes";
  for (const std::string& name : palette_names()) {
    std::ifstream palette(folder / (name + ".txt"));
    std::string first, second;
    std::getline(palette, first);
    std::getline(palette, second);
    if (second.rfind("# By ", 0) != 0 && second.rfind("# As in ", 0) != 0) continue;
    EXPECT_THAT(notice, ::testing::ContainsRegex("[ \n]" + name + "[,:.]")) << second;
  }
}

TEST(BuiltInPalettes, AreListedInAlphabeticalOrder) {
  const std::vector<std::string> names = palette_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST(BuiltInPalettes, AllLoadUnderTheirNames) {
  for (const std::string& name : palette_names()) {
    const Palette palette = load_palette(name);
    EXPECT_EQ(palette.name, name);
    EXPECT_FALSE(palette.emission.empty()) << name;
  }
}

TEST(BuiltInPalettes, AreTheFilesOfThePalettesFolder) {
  for (const auto& entry : fs::directory_iterator(test::source_folder() / "palettes")) {
    if (entry.path().extension() != ".txt") continue;
    const Palette from_file = load_palette(entry.path().string());
    EXPECT_EQ(load_palette(entry.path().stem().string()).emission, from_file.emission);
  }
}

TEST(BuiltInPalettes, HaveNamesThatAreNoPaths) {
  for (const std::string& name : palette_names())
    EXPECT_FALSE(is_palette_path(name)) << name;
}

// A denser or hotter place must never look darker.
TEST(BuiltInPalettes, ForDensityGrowLighterAllTheWay) {
  for (const char* name : {"viridis", "magma", "inferno", "plasma", "cividis", "gas", "hot_gas",
                           "nebula", "halo", "fire", "ice", "gray", "dust", "veil"}) {
    const Palette palette = load_palette(name);
    for (std::size_t i = 1; i < palette.emission.size(); ++i) {
      EXPECT_GT(lightness(palette.emission[i]), lightness(palette.emission[i - 1]))
          << name << ", knot " << i;
    }
  }
}

TEST(ReversedPalettes, RunFromTheLastColorToTheFirst) {
  const Palette magma = load_palette("magma");
  Palette reversed = load_palette("magma_r");
  EXPECT_EQ(reversed.name, "magma_r");
  std::reverse(reversed.emission.begin(), reversed.emission.end());
  EXPECT_EQ(reversed.emission, magma.emission);
}

TEST(ReversedPalettes, ReverseWhatIsAbsorbedToo) {
  Palette reversed = load_palette("veil_r");
  std::reverse(reversed.absorption.begin(), reversed.absorption.end());
  EXPECT_EQ(reversed.absorption, load_palette("veil").absorption);
}

TEST(VeilPalette, TurnsTransparentTowardsHighValues) {
  const Palette veil = load_palette("veil");
  ASSERT_TRUE(veil.has_own_absorption());
  EXPECT_GT(lightness(veil.absorption.front()), 0.5);
  EXPECT_EQ(veil.absorption.back(), (Rgb{0, 0, 0}));
  for (std::size_t i = 1; i < veil.absorption.size(); ++i) {
    EXPECT_LE(lightness(veil.absorption[i]), lightness(veil.absorption[i - 1]));
  }
}

TEST(DustPalette, AbsorbsBlueMost) {
  for (const Rgb& knot : load_palette("dust").absorption) {
    EXPECT_LT(knot[0], knot[1]);
    EXPECT_LT(knot[1], knot[2]);
  }
}

TEST(StarsPalette, GoesFromRedToBlue) {
  const Palette stars = load_palette("stars");
  EXPECT_GT(stars.emission.front()[0], stars.emission.front()[2]);
  EXPECT_LT(stars.emission.back()[0], stars.emission.back()[2]);
}

class PaletteFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / "splotchcl_palettes_test";
    fs::create_directories(folder_);
  }
  void TearDown() override {
    unsetenv("SPLOTCHCL_PALETTES");
    fs::remove_all(folder_);
  }
  void use_folder() const { setenv("SPLOTCHCL_PALETTES", folder_.c_str(), 1); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  fs::path folder_;
};

TEST_F(PaletteFolder, HoldsPalettesOfItsOwn) {
  write("mine.txt", "0.25 0.5 0.75\n");
  write("old.pal", "Old\n0100\n1\n255 0 0\n");
  use_folder();
  EXPECT_THAT(load_palette("mine").emission, ElementsAre(Rgb{0.25f, 0.5f, 0.75f}));
  EXPECT_THAT(load_palette("old").emission, ElementsAre(Rgb{1, 0, 0}));
}

TEST_F(PaletteFolder, ComesBeforeTheBuiltInPalettes) {
  write("magma.txt", "0.25 0.5 0.75\n");
  EXPECT_GT(load_palette("magma").emission.size(), 1u);
  use_folder();
  EXPECT_EQ(load_palette("magma").emission.size(), 1u);
}

TEST_F(PaletteFolder, HasPalettesThatCanBeReversed) {
  write("mine.txt", "1 0 0\n0 0 1\n");
  use_folder();
  EXPECT_THAT(load_palette("mine_r").emission, ElementsAre(Rgb{0, 0, 1}, Rgb{1, 0, 0}));
}

TEST_F(PaletteFolder, MayHaveAPaletteWhoseNameEndsLikeAReversedOne) {
  write("magma_r.txt", "0.25 0.5 0.75\n");
  use_folder();
  EXPECT_THAT(load_palette("magma_r").emission, ElementsAre(Rgb{0.25f, 0.5f, 0.75f}));
}

TEST_F(PaletteFolder, IsListedWithTheBuiltInPalettes) {
  write("magma.txt", "# magma: of mine.\n1 1 1\n");
  write("Mine.pal", "Old one\n0100\n1\n255 0 0\n");
  use_folder();
  std::vector<std::string> lines;
  for (const PaletteInfo& info : list_palettes())
    lines.push_back(info.name + "|" + info.file.filename().string() + "|" + info.description);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) { return line.rfind("magma|", 0) == 0; }),
            1);
  EXPECT_THAT(lines, IsSupersetOf({"magma|magma.txt|of mine.", "Mine|Mine.pal|Old one",
                                   "gray||black to white."}));
}

TEST_F(PaletteFolder, LeavesTheBuiltInPalettesInPlace) {
  use_folder();
  EXPECT_EQ(load_palette("magma").name, "magma");
}

TEST_F(PaletteFolder, IsSearchedForNamesNearby) {
  write("swirl.txt", "1 1 1\n");
  use_folder();
  EXPECT_THAT(message_for_name("swril"), HasSubstr("; did you mean swirl?"));
}

TEST_F(PaletteFolder, IsRefusedWhenItIsNone) {
  setenv("SPLOTCHCL_PALETTES", (folder_ / "nowhere").c_str(), 1);
  EXPECT_THAT(message_for_name("magma"), HasSubstr("SPLOTCHCL_PALETTES: found"));
}

TEST_F(PaletteFolder, MayHoldAFileGivenByPath) {
  write("mine.txt", "1 1 1\n");
  EXPECT_EQ(load_palette("mine.txt", folder_).emission.size(), 1u);
  EXPECT_EQ(load_palette((folder_ / "mine.txt").string()).emission.size(), 1u);
}

TEST_F(PaletteFolder, NamesFileAndLineOfABadPalette) {
  write("bad.txt", "0 0 0\n0 0 x\n");
  EXPECT_THAT(message_for_name((folder_ / "bad.txt").string()),
              HasSubstr("bad.txt:2: found \"x\""));
}

TEST(UnknownPalettes, AreRefusedWithTheNearestName) {
  EXPECT_THAT(message_for_name("infreno"), HasSubstr("; did you mean inferno?"));
  EXPECT_THAT(message_for_name("Magmma"), HasSubstr("; did you mean magma?"));
  EXPECT_THAT(message_for_name("veil.txt"), HasSubstr("; did you mean veil?"));
  EXPECT_THAT(message_for_name("palettes/gray.pal"), HasSubstr("; did you mean gray?"));
  EXPECT_THAT(message_for_name("infreno_r"), HasSubstr("; did you mean inferno_r?"));
}

TEST(PalettesOfOtherPrograms, AreKnownByTheNamesThatTheseHave) {
  for (const auto& [name, ours] :
       std::vector<std::pair<std::string, std::string>>{{"Viridis (matplotlib)", "viridis"},
                                                        {"Cool to Warm", "coolwarm"},
                                                        {"rdbu", "RdBu"},
                                                        {"Grayscale", "gray"},
                                                        {"matplotlib:plasma", "plasma"},
                                                        {"Magma_r", "magma_r"}}) {
    const Palette palette = load_palette(name);
    EXPECT_EQ(palette.emission, load_palette(ours).emission) << name;
  }
}

TEST(UnknownPalettes, AreRefusedWithTheCommandThatListsAll) {
  EXPECT_THAT(message_for_name("mauve"), HasSubstr("\"splotchcl palettes\" lists"));
}

TEST(UnknownPalettes, AreAMistakeOfTheScene) {
  EXPECT_THROW(load_palette("mauve"), UsageError);
  EXPECT_THROW(load_palette("mauve.txt"), UsageError);
  EXPECT_THROW(load_palette(""), UsageError);
}

TEST(UnknownPalettes, ThatAreFoldersAreRefused) {
  EXPECT_THROW(load_palette(::testing::TempDir()), DataError);
}

TEST(OriginalPalettes, OfTheOriginalProgramAreRead) {
  const fs::path folder = test::data_folder() / "splotch_par";
  if (!fs::exists(folder)) GTEST_SKIP() << "no data in " << test::data_folder();
  EXPECT_EQ(load_palette("M51.pal", folder).emission.size(), 256u);
  EXPECT_EQ(load_palette("OrionNew1.pal", folder).emission.size(), 7u);
  EXPECT_THAT(load_palette("OldSplotch.pal", folder).emission,
              ElementsAre(Rgb{0, 0, 1}, Rgb{128 / 255.f, 1, 128 / 255.f}, Rgb{1, 0, 0}));
}

}  // namespace
}  // namespace splotchcl
