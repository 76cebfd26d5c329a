#include "palette/palette_file.h"

#include "testing.h"
#include "text_rows.h"

namespace splotchcl {
namespace {

Palette parse(const std::string& text) {
  return parse_palette(text, "p.txt");
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

class PaletteText : public ::testing::TestWithParam<test::TextRow> {};

TEST_P(PaletteText, IsReadOrRefusedInOneLine) {
  const std::string& text = GetParam().texts.front();
  std::string file = "p.txt";
  for (const std::string& part : GetParam().expected) {
    const std::size_t blank = part.find(' ');
    const std::string what = part.substr(0, blank), value = part.substr(blank + 1);
    if (what == "file") {
      file = value;
    } else if (what == "red_white_blue") {
      EXPECT_THAT(parse_palette(text, file).emission,
                  ElementsAre(Rgb{1, 0, 0}, Rgb{1, 1, 1}, Rgb{0, 0, 1}));
    } else {
      ASSERT_EQ(what, "refused");
      EXPECT_THAT(
          test::refusal_by<DataError>([&] { parse_palette(text, file); }),
          AllOf(HasSubstr(value), StartsWith(file), HasSubstr("expected"), Not(HasSubstr("\n"))));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, PaletteText,
                         ::testing::ValuesIn(test::read_text_rows(test::source_folder() /
                                                                  "tests/palette/palettes.rows")),
                         [](const auto& info) { return info.param.name; });

TEST(PaletteFile, OfNothingIsRefused) {
  for (const char* const name : {"p.txt", "a.cpt"}) {
    EXPECT_THAT(test::refusal_by<DataError>([&] { parse_palette("", name); }),
                AllOf(StartsWith(name), HasSubstr("found no "), HasSubstr("expected")));
  }
}

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
