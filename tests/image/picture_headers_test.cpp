#include <zlib.h>

#include "image/picture_encoders.h"
#include "image/png_chunks.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using namespace std::string_literals;
using namespace test;

// Pictures of a few bytes that claim to have 300 million pixels: their files are looked at before
// memory is claimed for them.

constexpr std::uint32_t width = 20000, height = 15000;

std::string zeros(std::size_t count) {
  return std::string(count, '\0');
}

std::string png() {
  return "\x89PNG\r\n\x1a\n" +
         chunk_of_png("IHDR" + big(width, 4) + big(height, 4) + "\x08\x02"s + zeros(3)) +
         chunk_of_png("IDAT") + chunk_of_png("IEND");
}

std::string tiff(std::uint32_t compression) {
  std::string entries;
  const auto add = [&entries](std::uint32_t tag, std::uint32_t value) {
    entries += little(tag, 2) + little(4, 2) + little(1, 4) + little(value, 4);
  };
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> values = {
      {256, width}, {257, height}, {258, 8},      {259, compression}, {262, 1},
      {273, 8},     {277, 1},      {278, height}, {279, 20}};
  for (const auto& [tag, value] : values)
    add(tag, value);
  return "II*\0"s + little(8, 4) + little(static_cast<std::uint32_t>(values.size()), 2) + entries +
         little(0, 4);
}

std::string card(const std::string& text) {
  return text + std::string(80 - text.size(), ' ');
}

std::string fits() {
  const std::string cards =
      card("SIMPLE  =                    T") + card("BITPIX  =                  -32") +
      card("NAXIS   =                    2") + card("NAXIS1  =                20000") +
      card("NAXIS2  =                15000") + card("END");
  return cards + std::string(2880 - cards.size(), ' ');
}

std::string bmp() {
  return "BM" + little(58, 4) + zeros(4) + little(54, 4) + little(40, 4) + little(width, 4) +
         little(height, 4) + little(1, 2) + little(24, 2) + zeros(24) + "abcd";
}

std::string dpx(std::uint32_t columns, std::uint32_t rows) {
  return "SDPX" + big(2048, 4) + "V2.0" + zeros(4) + big(3000, 4) + zeros(748) + big(0, 2) +
         big(1, 2) + big(columns, 4) + big(rows, 4);
}

// Red, green and blue in words, whose first two bits are of no use.
std::string dpx_of_10_bits() {
  constexpr std::uint32_t columns = 8, rows = 4;
  const std::string element = zeros(20) + "\x32\x02\x02\x0a\0\1\0\0"s + big(2048, 4) + zeros(40);
  std::string file = dpx(columns, rows) + element;
  file += zeros(2048 - file.size());
  for (std::uint32_t i = 0; i < columns * rows; ++i)
    file += big(0x12345678 + 1000000 * i, 4);
  return file;
}

std::string tga(char kind, const std::string& data) {
  return zeros(2) + kind + zeros(9) + little(width, 2) + little(height, 2) + "\x18\x20" + data;
}

struct Claim {
  std::string ending, content;
};

std::vector<Claim> claims() {
  return {{"ppm", "P6\n20000 15000\n255\nabc"},
          {"pgm", "P5\n20000 15000\n255\nabc"},
          {"pbm", "P4\n20000 15000\nabc"},
          {"text.ppm", "P3\n20000 15000\n255\n1 2 3"},
          {"pfm", "PF\n20000 15000\n-1.0\nabcdefgh"},
          {"tga", tga('\2', "")},
          {"runs.tga", tga('\x0a', "\xff\1\2\3"s)},
          {"bmp", bmp()},
          {"png", png()},
          {"gif", "GIF89a" + little(width, 2) + little(height, 2) + "\x80"s + zeros(5) + ","},
          {"hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 15000 +X 20000\nabcd"},
          {"psd", "8BPS" + big(1, 2) + zeros(6) + big(3, 2) + big(height, 4) + big(width, 4) +
                      big(8, 2) + big(3, 2) + zeros(14) + "abc"},
          {"sgi", big(474, 2) + "\0\1"s + big(3, 2) + big(width, 2) + big(height, 2) + big(3, 2) +
                      zeros(503)},
          {"dpx", dpx(width, height) + zeros(2000)},
          {"fits", fits()},
          {"tif", tiff(1)},
          {"packed.tif", tiff(5)}};
}

TEST(ClaimedPixels, AreRefusedWhereTheFileCannotHoldThem) {
  const TemporaryFolder folder;
  for (const Claim& claim : claims()) {
    const auto path = folder / ("a." + claim.ending);
    std::ofstream(path, std::ios::binary) << claim.content;
    EXPECT_THAT([&] { read_image(path); },
                ThrowsMessage<DataError>(HasSubstr("claims 20000x15000 pixels, which ")))
        << claim.ending;
  }
}

TEST(ClaimedPixels, ThatAreBeyondAllNumbersAreRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.ppm") << "P6\n99999999999 99999999999\n255\n";
  EXPECT_THROW(read_image(folder / "a.ppm"), DataError);
}

TEST(CutPicture, OfDpxIsRefusedWhereItsReaderWouldNotNotice) {
  const TemporaryFolder folder;
  const auto path = folder / "a.dpx";
  const std::string whole = dpx_of_10_bits();
  std::ofstream(path, std::ios::binary) << whole;
  EXPECT_NO_THROW(read_image(path));
  for (const std::size_t missing : {1, 4, 64, 128}) {
    std::filesystem::resize_file(path, whole.size() - missing);
    EXPECT_THAT([&] { read_image(path); }, ThrowsMessage<DataError>(HasSubstr("the file is cut")))
        << missing;
  }
}

// Data of PNG files, strip by strip.

std::vector<unsigned char> noise(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> values(0, 255);
  std::vector<unsigned char> bytes(count);
  for (unsigned char& byte : bytes)
    byte = static_cast<unsigned char>(values(random));
  return bytes;
}

// As a reader does: one stream, then each row from the differences to the pixel on its left.
std::vector<unsigned char> read(const std::vector<std::vector<unsigned char>>& strips,
                                const PngRows& picture) {
  std::vector<unsigned char> stream;
  for (const std::vector<unsigned char>& strip : strips)
    stream.insert(stream.end(), strip.begin(), strip.end());
  std::vector<unsigned char> filtered(picture.rows * (picture.row_bytes + 1));
  uLongf size = filtered.size();
  EXPECT_EQ(uncompress(filtered.data(), &size, stream.data(), stream.size()), Z_OK);
  EXPECT_EQ(size, filtered.size());
  std::vector<unsigned char> bytes;
  for (std::size_t row = 0; row < picture.rows; ++row) {
    const std::size_t first = bytes.size();
    const unsigned char* from = filtered.data() + row * (picture.row_bytes + 1);
    EXPECT_EQ(*from++, 1);
    for (std::size_t i = 0; i < picture.row_bytes; ++i) {
      const int left = i < picture.pixel_bytes ? 0 : bytes[first + i - picture.pixel_bytes];
      bytes.push_back(static_cast<unsigned char>(from[i] + left));
    }
  }
  return bytes;
}

// How many they are of these rows, which are read as they were.
std::size_t strips_of(const std::vector<unsigned char>& bytes, std::size_t row_bytes,
                      std::size_t pixel_bytes) {
  const PngRows picture = {bytes.data(), row_bytes, bytes.size() / row_bytes, pixel_bytes};
  const std::vector<std::vector<unsigned char>> strips = png_strips(picture);
  EXPECT_EQ(read(strips, picture), bytes);
  return strips.size();
}

TEST(PngStrips, AreOneStreamOfAllRows) {
  constexpr std::size_t row_bytes = 3 * 731, rows = 600;
  EXPECT_GT(strips_of(noise(row_bytes * rows), row_bytes, 3), 4U);
}

TEST(PngStrips, HoldRowsThatAreLongerThanAStrip) {
  constexpr std::size_t row_bytes = 6 * 60000, rows = 3;
  EXPECT_EQ(strips_of(noise(row_bytes * rows), row_bytes, 6), 3U);
}

TEST(PngStrips, AreOneForASinglePixel) {
  EXPECT_EQ(strips_of({1, 200, 3}, 3, 3), 1U);
}

// Headers of EXR files that claim more than the file holds: the library would take the memory.

std::string bytes_of_number(std::uint32_t number) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(number >> shift & 0xFFU);
  return bytes;
}

std::string picture_bytes(const TemporaryFolder& folder) {
  write_image(folder / "whole.exr", Image(8, 6), {1, false, {{"splotchcl:scene", "a scene"}}});
  return read_text(folder / "whole.exr");
}

// Behind the name and type of an attribute there is its length, and then its value.
std::size_t length_place(const std::string& file, const std::string& name,
                         const std::string& type) {
  const std::string both = name + '\0' + type + '\0';
  const std::size_t place = file.find(both);
  EXPECT_NE(place, std::string::npos);
  return place + both.size();
}

void expect_refused(const TemporaryFolder& folder, const std::string& bytes,
                    const std::string& reason) {
  const auto path = folder / "damaged.exr";
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_THAT([&] { (void)read_image_info(path); },
              ThrowsMessage<DataError>(AllOf(HasSubstr("damaged.exr"), HasSubstr(reason))));
  EXPECT_THAT([&] { (void)read_image(path); }, ThrowsMessage<DataError>(HasSubstr(reason)));
  EXPECT_THAT([&] { (void)read_linear_image(path, {}); },
              ThrowsMessage<DataError>(HasSubstr(reason)));
}

using ExrHeader = FolderTest;

TEST_F(ExrHeader, OfAWholeFileIsReadByTheLibrary) {
  (void)picture_bytes(folder_);
  EXPECT_EQ(read_image_info(folder_ / "whole.exr").metadata.at("splotchcl:scene"), "a scene");
}

TEST_F(ExrHeader, ThatClaimsALongerTextThanTheFileIsRefused) {
  std::string file = picture_bytes(folder_);
  const std::size_t place = length_place(file, "splotchcl:scene", "string");
  file.replace(place, 4, bytes_of_number(0x676B2000));
  expect_refused(folder_, file, "it claims 1735073792 bytes for \"splotchcl:scene\"");
  file.replace(place, 4, bytes_of_number(0xFFFFFFFF));
  expect_refused(folder_, file, "it claims -1 bytes");
}

TEST_F(ExrHeader, ThatClaimsMoreLinesThanTheFileHasRoomForIsRefused) {
  std::string file = picture_bytes(folder_);
  const std::size_t window = length_place(file, "dataWindow", "box2i") + 4;
  file.replace(window + 12, 4, bytes_of_number(0x40000000));
  expect_refused(folder_, file, "it claims 1073741825 lines");
}

TEST_F(ExrHeader, WithAPreviewOfAnotherSizeIsRefused) {
  std::string file = picture_bytes(folder_);
  const std::string preview = std::string("preview") + '\0' + "preview" + '\0' +
                              bytes_of_number(12) + bytes_of_number(30000) +
                              bytes_of_number(30000) + "abcd";
  file.insert(8, preview);
  expect_refused(folder_, file, "a preview of 30000x30000 pixels in 12 bytes");
}

TEST_F(ExrHeader, CutAtAnyByteIsRefused) {
  const std::string file = picture_bytes(folder_);
  const std::size_t header_end = length_place(file, "splotchcl:scene", "string");
  for (std::size_t bytes = 8; bytes < header_end; ++bytes) {
    const auto path = folder_ / "cut.exr";
    std::ofstream(path, std::ios::binary | std::ios::trunc) << file.substr(0, bytes);
    EXPECT_THROW((void)read_image_info(path), DataError) << bytes;
  }
}

// Profiles as ICC.1:2004-10 has them.

std::uint32_t number(const std::vector<unsigned char>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | bytes.at(at + i);
  return value;
}

double fixed(const std::vector<unsigned char>& bytes, std::size_t at) {
  return static_cast<std::int32_t>(number(bytes, at)) / 65536.0;
}

std::string text(const std::vector<unsigned char>& bytes, std::size_t at) {
  return {bytes.begin() + static_cast<std::ptrdiff_t>(at),
          bytes.begin() + static_cast<std::ptrdiff_t>(at + 4)};
}

// Where each element begins.
std::map<std::string, std::size_t> elements(const std::vector<unsigned char>& profile) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < number(profile, 128); ++i) {
    const std::size_t entry = 132 + 12 * i;
    const std::size_t place = number(profile, entry + 4);
    EXPECT_EQ(place % 4, 0U);
    EXPECT_LE(place + number(profile, entry + 8), profile.size());
    places[text(profile, entry)] = place;
  }
  return places;
}

TEST(ColorProfile, SaysItsSizeAndWhatItIs) {
  for (const ColorSpace space : {ColorSpace::srgb, ColorSpace::linear}) {
    const std::vector<unsigned char> profile = color_profile(space);
    EXPECT_EQ(number(profile, 0), profile.size());
    EXPECT_EQ(text(profile, 12), "mntr");
    EXPECT_EQ(text(profile, 16), "RGB ");
    EXPECT_EQ(text(profile, 20), "XYZ ");
    EXPECT_EQ(text(profile, 36), "acsp");
  }
}

// Red, green and blue together are the white that profiles refer to.
TEST(ColorProfile, HasPrimariesThatAddUpToWhite) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::srgb);
  auto places = elements(profile);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (const char* primary : {"rXYZ", "gXYZ", "bXYZ"})
      sum += fixed(profile, places.at(primary) + 8 + 4 * axis);
    EXPECT_NEAR(sum, fixed(profile, places.at("wtpt") + 8 + 4 * axis), 5e-4);
  }
}

// The white of D65 becomes that of D50.
TEST(ColorProfile, AdaptsItsWhite) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::linear);
  const std::size_t matrix = elements(profile).at("chad") + 8;
  const double daylight[] = {0.9505, 1, 1.0890}, white[] = {0.9642, 1, 0.8249};
  for (std::size_t row = 0; row < 3; ++row) {
    double sum = 0;
    for (std::size_t column = 0; column < 3; ++column)
      sum += fixed(profile, matrix + 12 * row + 4 * column) * daylight[column];
    EXPECT_NEAR(sum, white[row], 5e-4);
  }
}

TEST(ColorProfile, HasTheCurveOfSrgb) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::srgb);
  const std::size_t curve = elements(profile).at("gTRC");
  EXPECT_EQ(text(profile, curve), "para");
  const auto parameter = [&](std::size_t i) { return fixed(profile, curve + 12 + 4 * i); };
  EXPECT_NEAR(std::pow(parameter(1) * 0.5 + parameter(2), parameter(0)), 0.21404, 1e-4);
  EXPECT_NEAR(parameter(3) * 0.04, 0.04 / 12.92, 1e-5);
}

TEST(ColorProfile, HasNoCurveForLinearLight) {
  const std::vector<unsigned char> profile = color_profile(ColorSpace::linear);
  const std::size_t curve = elements(profile).at("rTRC");
  EXPECT_EQ(text(profile, curve), "curv");
  EXPECT_EQ(number(profile, curve + 8), 0U);
}

}  // namespace
}  // namespace splotchcl::test
