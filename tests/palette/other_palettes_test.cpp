#include "palette/palette_file.h"
#include "splotchcl/palette_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

std::string refusal_of_palette(const std::string& text, const std::string& name) {
  return test::refusal_by<DataError>([&] { parse_palette(text, name); });
}

TEST(OtherPalettes, AtUnevenPlacesHaveTheirColorsThere) {
  const Palette palette = parse_palette("0 1 0 0\n0.25 1 1 1\n1 0 0 1\n", "p.txt");
  EXPECT_NEAR(sample_knots(palette.emission, 0.25)[1], 1, 0.01);
  EXPECT_NEAR(sample_knots(palette.emission, 0.625)[0], 0.5, 0.01);
}

TEST(OtherPalettes, MayHaveStepsAsThoseOfGmt) {
  const Palette palette = parse_palette("0 255 0 0 1 255 0 0\n1 0 0 255 4 0 0 255\n", "p.cpt");
  EXPECT_EQ(sample_knots(palette.emission, 0.2)[0], 1);
  EXPECT_EQ(sample_knots(palette.emission, 0.3)[0], 0);
}

TEST(OtherPalettes, OfSaoimageHavePlacesOfTheirOwnForEachColor) {
  const Palette palette = parse_palette(
      "# SAOimage color table\nPSEUDOCOLOR\nRED:\n(0,0)(.5,1)\n(1,1)\nGREEN:\n(0,0)(1,1)\n"
      "BLUE:\n(0,1)(1,0)\n",
      "a.sao");
  const auto color = sample_knots(palette.emission, 0.25);
  EXPECT_NEAR(color[0], 0.5, 0.01);
  EXPECT_NEAR(color[1], 0.25, 0.01);
  EXPECT_NEAR(color[2], 0.75, 0.01);
}

TEST(OtherPalettes, OfBytesAreTripletsForAdobeAndPlanesForImageJ) {
  std::string triplets(768, '\0'), planes(768, '\0');
  triplets[3 * 7 + 1] = '\x33';
  planes[256 + 7] = '\x33';
  for (const auto& palette : {parse_palette(triplets, "a.act"), parse_palette(planes, "a.lut"),
                              parse_palette("ICOL" + std::string(28, '\0') + planes, "a.LUT")}) {
    ASSERT_EQ(palette.emission.size(), 256U);
    EXPECT_THAT(palette.emission[7], ElementsAre(0, 0.2F, 0));
    EXPECT_THAT(palette.emission[8], ElementsAre(0, 0, 0));
  }
}

TEST(OtherPalettes, OfAdobeMaySayHowManyColorsTheyHave) {
  std::string bytes(772, '\0');
  bytes[769] = 5;
  EXPECT_EQ(parse_palette(bytes, "a.act").emission.size(), 5U);
}

TEST(OtherPalettes, OfBytesThatAreNoneAreRefusedWithoutThem) {
  const std::string message =
      refusal_of_palette(std::string("\x93MUMPY\x01\0v\0\xff\xfe", 12), "map.bin");
  EXPECT_THAT(message, AllOf(HasSubstr("found 12 bytes that are no text"),
                             HasSubstr("an array of NumPy"), Not(HasSubstr("MUMPY\x01"))));
}

// Of version 1, its header of 118 bytes.
std::string numpy_array(const std::string& type, const std::string& shape,
                        const std::string& values) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + "}";
  header.resize(117, ' ');
  return std::string("\x93NUMPY\x01\0v\0", 10) + header + "\n" + values;
}

TEST(OtherPalettes, OfNumpyAreArraysOfColors) {
  const Palette palette = parse_palette(
      numpy_array("|u1", "(2, 3)", {'\0', '\x33', '\0', '\x66', '\0', '\0'}), "a.npy");
  ASSERT_EQ(palette.emission.size(), 2U);
  EXPECT_THAT(palette.emission[0], ElementsAre(0, 0.2F, 0));
  EXPECT_THAT(palette.emission[1], ElementsAre(0.4F, 0, 0));
}

TEST(OtherPalettes, OfNumpyMayBeWholeFloats) {
  const float values[] = {0, 51, 255};
  const std::string bytes(reinterpret_cast<const char*>(values), sizeof values);
  const Palette palette = parse_palette(numpy_array("<f4", "(1, 3)", bytes), "a.npy");
  EXPECT_THAT(palette.emission.front(), ElementsAre(0, 0.2F, 1));
}

TEST(OtherPalettes, OfNumpyThatAreNoColorsAreRefused) {
  EXPECT_THAT(refusal_of_palette(numpy_array("|u1", "(3, 2)", "abcdef"), "a.npy"),
              HasSubstr("an array of the shape 3 x 2"));
  EXPECT_THAT(refusal_of_palette(numpy_array("|u1", "(1, 4)", "abcd"), "a.npy"),
              HasSubstr("found 100 in row 0"));
}

// Gray of half the lightness is 119 of 255.
TEST(OtherPalettes, OfParaviewAreJoinedInLabWhereTheySaySo) {
  const Palette palette =
      parse_palette(R"([{"ColorSpace":"Lab","RGBPoints":[0,0,0,0,1,1,1,1]}])", "a.json");
  const Rgb middle = palette.emission[palette.emission.size() / 2];
  EXPECT_NEAR(middle[0], 118.9 / 255, 2e-3);
  EXPECT_NEAR(middle[1], middle[0], 1e-4);
  EXPECT_NEAR(middle[2], middle[0], 1e-4);
}

// Matplotlib's coolwarm is the table of these two ends in Moreland's paper.
TEST(OtherPalettes, OfParaviewThatDivergeGoOverWhite) {
  const Palette palette = parse_palette(
      R"([{"ColorSpace":"Diverging","RGBPoints":[0,0.23,0.299,0.754,1,0.706,0.016,0.15]}])",
      "a.json");
  const Palette table = load_palette("coolwarm", "");
  for (std::size_t i = 0; i < table.emission.size(); ++i) {
    const double place = static_cast<double>(i) / static_cast<double>(table.emission.size() - 1);
    const auto color = sample_knots(palette.emission, place);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(color[c], table.emission[i][c], 0.01) << "color " << i;
  }
}

// A gray and a color are joined without white between them.
TEST(OtherPalettes, OfParaviewThatDivergeFromGrayDoNotGoOverWhite) {
  const Palette palette = parse_palette(
      R"([{"ColorSpace":"Diverging","RGBPoints":[0,0.2,0.2,0.2,1,0.706,0.016,0.15]}])", "a.json");
  for (const Rgb& color : palette.emission)
    EXPECT_LT(color[1], 0.5);
}

TEST(OtherPalettes, OfMoreRowsThanPalettesHaveAreRefused) {
  std::string rows;
  for (int row = 0; row <= 4096; ++row)
    rows += "0.5 0.5 0.5\n";
  EXPECT_THAT(refusal_of_palette(rows, "a.txt"), HasSubstr("found 4097 rows"));
  EXPECT_THAT(
      refusal_of_palette(numpy_array("|u1", "(4097, 3)", std::string(12291, '\1')), "a.npy"),
      HasSubstr("at most 4096 rows"));
}

}  // namespace
}  // namespace splotchcl
