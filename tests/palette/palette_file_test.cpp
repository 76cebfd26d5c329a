#include "palette/palette_file.h"

#include "testing.h"

namespace splotchcl {
namespace {

Palette parse(const std::string& text) {
  return parse_palette(text, "p.txt");
}

std::string message_for(const std::string& text) {
  return test::refusal_by<DataError>([&] { parse(text); });
}

TEST(PaletteFile, HasAKnotPerLine) {
  const Palette palette = parse("0 0.5 1\n1 0.25 0\n");
  EXPECT_THAT(palette.emission, ElementsAre(Rgb{0, 0.5f, 1}, Rgb{1, 0.25f, 0}));
  EXPECT_FALSE(palette.has_own_absorption());
}

TEST(PaletteFile, MayHaveAbsorptionInThreeMoreColumns) {
  const Palette palette = parse("0 0.5 1 0.25 0.5 0.75\n1 1 1 0 0 0\n");
  EXPECT_THAT(palette.emission, ElementsAre(Rgb{0, 0.5f, 1}, Rgb{1, 1, 1}));
  EXPECT_THAT(palette.absorption, ElementsAre(Rgb{0.25f, 0.5f, 0.75f}, Rgb{0, 0, 0}));
}

TEST(PaletteFile, MayHaveCommentsBlankLinesTabsAndAnyLineEnding) {
  const Palette palette = parse("# a palette\r\n\r\n  0\t0  0\r\n#\n1 1 1");
  EXPECT_THAT(palette.emission, ElementsAre(Rgb{0, 0, 0}, Rgb{1, 1, 1}));
}

TEST(PaletteFile, MayHaveASingleKnot) {
  EXPECT_EQ(parse("1 0.5 0.25").emission.size(), 1u);
}

TEST(PaletteFile, ReadsNumbersAsTheyAreWritten) {
  EXPECT_THAT(parse("1e-3 .5 1.").emission, ElementsAre(Rgb{1e-3f, 0.5f, 1}));
}

struct Refused {
  std::string text, message;
};
void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.text;
}
class PaletteFileRefuses : public ::testing::TestWithParam<Refused> {};

TEST_P(PaletteFileRefuses, InOneLineThatSaysWhere) {
  const std::string message = message_for(GetParam().text);
  EXPECT_THAT(message, StartsWith(GetParam().message));
  EXPECT_THAT(message, HasSubstr("expected"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(
    OurOwn, PaletteFileRefuses,
    ::testing::Values(Refused{"", "p.txt: found no knots"},
                      Refused{"# nothing\n", "p.txt: found no knots"},
                      Refused{"0 0 0\n0 0\n", "p.txt:2: found 2 numbers, expected 3"},
                      Refused{"0 0\n", "p.txt:1: found 2 numbers, expected 3 (red"},
                      Refused{"0 0 0 0\n", "p.txt:1: found 4 numbers"},
                      Refused{"0 0 0\n\n0 0 0 0 0 0\n", "p.txt:3: found 6 numbers, expected 3 as"},
                      Refused{"0 0 0 1 1 1\n0 0 0\n", "p.txt:2: found 3 numbers, expected 6 as"},
                      Refused{"0 0 1.01\n", "p.txt:1: found \"1.01\", expected a number from 0"},
                      Refused{"0 -0.1 1\n", "p.txt:1: found \"-0.1\""},
                      Refused{"255 255 256\n", "p.txt:1: found \"256\""},
                      Refused{"255 0.5 0\n", "p.txt:1: found \"255\""},
                      Refused{"nan 0 0\n", "p.txt:1: found \"nan\""},
                      Refused{"inf 0 0\n", "p.txt:1: found \"inf\""},
                      Refused{"1e99 0 0\n", "p.txt:1: found \"1e99\""},
                      Refused{"0.5x 0 0\n", "p.txt:1: found \"0.5x\""},
                      Refused{"red green blue\n", "p.txt:1: found \"red\""},
                      Refused{"0 0 0\nred green blue\n", "p.txt:2: found \"red\""},
                      Refused{"0 0 0 0.5\n1 1 1 0.5\n0 0 0 1\n", "p.txt:1: found 4 numbers that"}));

INSTANTIATE_TEST_SUITE_P(
    TheOriginals, PaletteFileRefuses,
    ::testing::Values(Refused{"Name\n0100\n", "p.txt:3: found \"\", expected the number of knots"},
                      Refused{"Name\n0100\nmany\n", "p.txt:3: found \"many\""},
                      Refused{"Name\n0100\n0\n", "p.txt:3: found \"0\""},
                      Refused{"Name\n0100\n-1\n", "p.txt:3: found \"-1\""},
                      Refused{"Name\n0100\n2\n0 0 0\n", "p.txt: found 1 knots, expected 2"},
                      Refused{"Name\n0100\n1\n0 0 0\n1 1 1\n", "p.txt: found 2 knots, expected 1"},
                      Refused{"Name\n0100\n1\n0 0 256\n", "p.txt:4: found \"256\""},
                      Refused{"Name\n0100\n1\n0 0\n", "p.txt:4: found 2 numbers, expected 3"},
                      Refused{"Name\n0100\n99999999999999999999\n", "p.txt:3: found"},
                      Refused{"Name\n0100\n9999999999999\n0 0 0\n", "p.txt: found 1 knots"}));

TEST(OriginalPaletteFile, IsKnownByItsSecondLine) {
  const Palette palette = parse("Rainbow\n0100\n3\n  0   0 255\n128 255 128\n255   0   0\n\n");
  EXPECT_THAT(palette.emission,
              ElementsAre(Rgb{0, 0, 1}, Rgb{128 / 255.f, 1, 128 / 255.f}, Rgb{1, 0, 0}));
  EXPECT_FALSE(palette.has_own_absorption());
}

TEST(OriginalPaletteFile, MayHaveSpacesAroundItsNumbersAndAnyLineEnding) {
  EXPECT_EQ(parse("X\r\n0100 \r\n     1\r\n  255 0 0\r\n").emission.size(), 1u);
}

TEST(PaletteFile, IsReadOrRefusedWhateverItHolds) {
  std::mt19937 random(9);
  constexpr char letters[] = "0123456789.eE+- \n\r\t#ax\0\xff";
  std::uniform_int_distribution<std::size_t> letter(0, sizeof(letters) - 2), size(0, 60);
  for (int i = 0; i < 20000; ++i) {
    std::string text = i % 2 == 0 ? "" : "Name\n0100\n";
    for (std::size_t k = size(random); k > 0; --k)
      text += letters[letter(random)];
    try {
      EXPECT_FALSE(parse(text).emission.empty());
    } catch (const DataError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace splotchcl
