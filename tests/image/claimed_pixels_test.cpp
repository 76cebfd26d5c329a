// Pictures of a few bytes that claim to have 300 million pixels: their files are looked at before
// memory is claimed for them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "image/png_chunks.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

using namespace std::string_literals;

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
    EXPECT_THAT([&] { read_image(path); }, ::testing::ThrowsMessage<DataError>(::testing::HasSubstr(
                                               "claims 20000x15000 pixels, which ")))
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
    EXPECT_THAT([&] { read_image(path); },
                ::testing::ThrowsMessage<DataError>(::testing::HasSubstr("the file is cut")))
        << missing;
  }
}

}  // namespace
}  // namespace splotchcl::test
