// Pictures whose colour profile says that it has a text far outside of it.
#include <zlib.h>

#include "image/picture_encoders.h"
#include "image/png_chunks.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using namespace std::string_literals;

// Of a profile, or of a file that holds one as it is.
std::string with_a_text_outside(std::string bytes) {
  const std::size_t text = bytes.find("mluc");
  EXPECT_NE(text, std::string::npos);
  constexpr std::size_t offset_of_first = 24;
  return bytes.replace(text + offset_of_first, 4, "\x7f\0\0\0"s);
}

std::string damaged_profile() {
  const std::vector<unsigned char> whole = color_profile(ColorSpace::srgb);
  return with_a_text_outside({whole.begin(), whole.end()});
}

std::string deflated(const std::string& bytes) {
  uLongf size = ::compressBound(bytes.size());
  std::string packed(size, '\0');
  ::compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  packed.resize(size);
  return packed;
}

std::string with_profile_in_png(std::string png) {
  constexpr std::size_t after_header = 8 + 25;
  return png.insert(after_header, chunk_of_png("iCCPname\0\0"s + deflated(damaged_profile())));
}

std::string with_profile_in_jpeg(std::string jpeg) {
  const std::string content = "ICC_PROFILE\0\1\1"s + damaged_profile();
  const auto bytes = static_cast<std::uint32_t>(content.size() + 2);
  return jpeg.insert(2, "\xff\xe2" + big(bytes, 2) + content);
}

Image some_picture() {
  Image image(8, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 4 == 3 ? 1.0F : static_cast<float>(i % 7) / 8;
  return image;
}

void expect_the_same_when_damaged(const std::string& ending,
                                  std::string (*damaged)(std::string bytes)) {
  const TemporaryFolder folder;
  const auto path = folder / ("a." + ending);
  write_image(path, some_picture(), {});
  const Image whole = read_image(path);
  const std::string bytes = damaged(read_text(path));
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(read_image(path).pixels, whole.pixels);
}

TEST(DamagedProfile, OfPngIsNotLookedAt) {
  expect_the_same_when_damaged("png", with_profile_in_png);
}

TEST(DamagedProfile, OfJpegIsNotLookedAt) {
  expect_the_same_when_damaged("jpg", with_profile_in_jpeg);
}

TEST(DamagedProfile, OfTiffIsNotLookedAt) {
  expect_the_same_when_damaged("tif", with_a_text_outside);
}

}  // namespace
}  // namespace splotchcl::test
