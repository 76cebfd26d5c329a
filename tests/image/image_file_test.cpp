#include "splotchcl/image_file.h"

#include <sys/resource.h>

#include "testing.h"
// GCC says so by a macro, clang by a feature.
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <csignal>

#include "common/unfinished_file.h"

namespace splotchcl::test {
namespace {

// Every value different, up to `brightest`.
Image ramp(int width, int height, float brightest) {
  Image image(width, height);
  const auto last = static_cast<float>(image.pixels.size() - 1);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = brightest * static_cast<float>(i) / last;
  }
  return image;
}

// Writes beyond `bytes` fail while this lives, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_ = {};
  void (*handler_)(int);
};

// What a library allocates while this lives may leak.
#ifdef __SANITIZE_ADDRESS__
using WithoutLeakDetection = __lsan::ScopedDisabler;
#else
struct WithoutLeakDetection {
  WithoutLeakDetection() {}  // so that it is not an unused variable
};
#endif

class FloatFormats : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(ImageFile, FloatFormats, ::testing::Values("exr", "tif", "tiff"));

TEST_P(FloatFormats, KeepEveryBitOfColorAndAlpha) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("picture.") + GetParam());
  const Image image = ramp(7, 5, 20);
  write_image(path, image, {2.2, false, {}});
  const Image read = read_image(path);
  EXPECT_EQ(read.width, 7);
  EXPECT_EQ(read.height, 5);
  EXPECT_EQ(read.pixels, image.pixels);
}

class ByteFormats : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(ImageFile, ByteFormats,
                         ::testing::Values("png", "tga", "bmp", "ppm", "pnm", "PNG"));

TEST_P(ByteFormats, KeepColorRoundedToEightBits) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("picture.") + GetParam());
  const Image image = ramp(9, 6, 1);
  write_image(path, image);
  const Image read = read_image(path);
  ASSERT_EQ(read.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float expected =
        i % 4 == 3 ? 1.0F : static_cast<float>(std::lround(255 * image.pixels[i])) / 255.0F;
    EXPECT_FLOAT_EQ(read.pixels[i], expected) << i;
  }
  EXPECT_FALSE(read_image_info(path).has_alpha);
}

class LossyFormats : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(ImageFile, LossyFormats, ::testing::Values("jpg", "jpeg", "webp", "jp2"));

TEST_P(LossyFormats, KeepASmoothPictureNearly) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("picture.") + GetParam());
  Image image(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.at(x, y)[0] = static_cast<float>(x) / 63;
      image.at(x, y)[1] = static_cast<float>(y) / 63;
      image.at(x, y)[2] = 0.5F;
    }
  }
  write_image(path, image);
  const Image read = read_image(path);
  ASSERT_EQ(read.pixels.size(), image.pixels.size());
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) sum += std::abs(read.pixels[i] - image.pixels[i]);
  }
  // A few of 255 steps per value; a wrong channel order or a lost row is off by far more.
  EXPECT_LT(sum / (3 * 64 * 64), 0.02);
}

using ImageFile = FolderTest;

TEST_F(ImageFile, AppliesTheGammaToEightBitsOnly) {
  Image image(1, 1);
  image.pixels = {0.25F, 1, 0, 1};
  write_image(folder_ / "a.png", image, {2, false, {}});
  EXPECT_FLOAT_EQ(read_image(folder_ / "a.png").at(0, 0)[0], 128.0F / 255);  // 127.5 rounds up
  write_image(folder_ / "a.exr", image, {2, false, {}});
  EXPECT_EQ(read_image(folder_ / "a.exr").at(0, 0)[0], 0.25F);
}

// Of a picture of two rows, abc and def.
TEST_F(ImageFile, IsReadUprightHoweverTheCameraWasHeld) {
  Image image(3, 2);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(51 * (i / 4)) / 255;
  write_image(folder_ / "a.tif", image, {1, false, {}});
  std::ifstream in(folder_ / "a.tif", std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  const std::size_t tag = bytes.find(std::string("\x12\x01\x03\0\1\0\0\0", 8));
  ASSERT_NE(tag, std::string::npos);
  const std::vector<std::string> expected = {"abcdef", "cbafed", "fedcba", "defabc",
                                             "adbecf", "daebfc", "fcebda", "cfbead"};
  for (std::size_t orientation = 1; orientation <= expected.size(); ++orientation) {
    bytes[tag + 8] = static_cast<char>(orientation);
    std::ofstream(folder_ / "b.tif", std::ios::binary) << bytes;
    LinearImageOptions linear;
    linear.gamma = 1;
    for (const Image& read :
         {read_image(folder_ / "b.tif"), read_linear_image(folder_ / "b.tif", linear)}) {
      std::string found;
      for (std::size_t i = 0; i < read.pixels.size(); i += 4)
        found += static_cast<char>('a' + std::lround(read.pixels[i] * 5));
      EXPECT_EQ(found, expected[orientation - 1]) << orientation;
      EXPECT_EQ(read.width, orientation < 5 ? 3 : 2);
      EXPECT_EQ(read_image_info(folder_ / "b.tif").width, read.width);
    }
  }
}

TEST_F(ImageFile, ClampsColorsBeyondWhiteInEightBits) {
  Image image(1, 1);
  image.pixels = {7, -1, std::numeric_limits<float>::infinity(), 1};
  write_image(folder_ / "a.png", image);
  const Image read = read_image(folder_ / "a.png");
  EXPECT_EQ(read.at(0, 0)[0], 1);
  EXPECT_EQ(read.at(0, 0)[1], 0);
  EXPECT_EQ(read.at(0, 0)[2], 1);
}

TEST_F(ImageFile, KeepsColorBeyondWhiteInRadianceFiles) {
  Image image(1, 1);
  image.pixels = {8, 4, 2, 1};  // exact in a shared exponent
  write_image(folder_ / "a.hdr", image);
  const Image read = read_image(folder_ / "a.hdr");
  EXPECT_NEAR(read.at(0, 0)[0], 8, 8.0 / 256);
  EXPECT_NEAR(read.at(0, 0)[2], 2, 8.0 / 256);
}

TEST_F(ImageFile, RefusesToStoreNotANumberInEightBitsAndSaysWhere) {
  Image image(3, 2);
  image.at(2, 1)[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT([&] { write_image(folder_ / "a.png", image); },
              ThrowsMessage<DataError>(AllOf(HasSubstr("2,1"), HasSubstr(".exr"))));
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(ImageFile, RoundsColorsOfRadianceFilesToTheNearestStep) {
  Image image(2, 1);
  image.pixels = {1,           0.9999F, 0.503F, 1,   // steps of 1/128
                  0.99999994F, 0.25F,   0,      1};  // too close to 1 for steps of 1/256
  write_image(folder_ / "a.hdr", image);
  const Image read = read_image(folder_ / "a.hdr");
  for (std::size_t i = 0; i < 8; ++i) {
    if (i % 4 == 3) continue;
    EXPECT_NEAR(read.pixels[i], image.pixels[i], 0.5 / 128) << i;
  }
}

TEST_F(ImageFile, RefusesLightThatRadianceFilesCannotHoldAndSaysWhere) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float light : {-1.0F, infinity, std::numeric_limits<float>::quiet_NaN(), 3e38F}) {
    Image image(3, 2);
    image.at(2, 1)[1] = light;
    EXPECT_THAT([&] { write_image(folder_ / "a.hdr", image); },
                ThrowsMessage<DataError>(AllOf(HasSubstr("2,1"), HasSubstr(".exr"))));
  }
  EXPECT_EQ(folder_.count_files(), 0U);
}

// The value of a tag with one short number, in a little-endian TIFF file; none where it is absent.
std::optional<int> short_tag(const std::string& file, int wanted) {
  const auto number = [&file](std::size_t place, std::size_t bytes) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      value += std::size_t{static_cast<unsigned char>(file.at(place + i))} << (8 * i);
    return value;
  };
  const std::size_t directory = number(4, 4);
  for (std::size_t i = 0; i < number(directory, 2); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (number(entry, 2) == static_cast<std::size_t>(wanted)) {
      return static_cast<int>(number(entry + 8, 2));
    }
  }
  return std::nullopt;
}

// Which tifffile cannot undo without more libraries, and others not at all.
TEST_F(ImageFile, PredictsNoValuesOfTiffFiles) {
  write_image(folder_ / "a.tif", ramp(70, 130, 3));
  const std::string file = read_text(folder_ / "a.tif");
  ASSERT_EQ(file.substr(0, 4), std::string("II*\0", 4));
  constexpr int compression = 259, predictor = 317, sample_format = 339;
  EXPECT_EQ(short_tag(file, compression), 8);
  EXPECT_EQ(short_tag(file, predictor).value_or(1), 1);
  EXPECT_TRUE(short_tag(file, sample_format).has_value());
  EXPECT_EQ(read_image(folder_ / "a.tif").pixels, ramp(70, 130, 3).pixels);
}

TEST_F(ImageFile, KeepsMetadataInExr) {
  const std::string scene = "[image]\nwidth = 3\n";
  write_image(folder_ / "a.exr", Image(2, 2), {1, false, {{"splotchcl:scene", scene}}});
  const ImageFileInfo info = read_image_info(folder_ / "a.exr");
  EXPECT_EQ(info.metadata.at("splotchcl:scene"), scene);
  EXPECT_TRUE(info.has_alpha);
}

TEST_F(ImageFile, WritesTheSameBytesForTheSamePicture) {
  for (const std::string ending : {".png", ".exr", ".tif", ".jpg"}) {
    write_image(folder_ / ("a" + ending), ramp(20, 20, 1));
    write_image(folder_ / ("b" + ending), ramp(20, 20, 1));
    EXPECT_EQ(read_text(folder_ / ("a" + ending)), read_text(folder_ / ("b" + ending))) << ending;
  }
}

TEST_F(ImageFile, ReplacesAnOlderPicture) {
  write_image(folder_ / "a.png", Image(2, 2));
  write_image(folder_ / "a.png", Image(5, 4));
  EXPECT_EQ(read_image(folder_ / "a.png").width, 5);
  EXPECT_EQ(folder_.count_files(), 1U);
}

TEST_F(ImageFile, ReadsGrayAsEqualRedGreenAndBlue) {
  std::ofstream(folder_ / "gray.pgm") << "P2\n2 1\n255\n51 255\n";
  const Image image = read_image(folder_ / "gray.pgm");
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0.2F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[1], 0.2F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[2], 0.2F);
  EXPECT_EQ(image.at(1, 0)[3], 1);
}

TEST_F(ImageFile, RefusesAnEndingThatNamesNoFormatAndListsThoseThatDo) {
  for (const std::string name : {"picture.xyz", "picture", "picture.null", "picture.mp4"}) {
    EXPECT_THAT([&] { check_image_path(folder_ / name); },
                ThrowsMessage<UsageError>(AllOf(HasSubstr(name), HasSubstr(".png"))))
        << name;
  }
}

TEST_F(ImageFile, NoticesAMissingFolder) {
  EXPECT_THAT([&] { check_image_path(folder_ / "nowhere/a.png"); },
              ThrowsMessage<DataError>(HasSubstr("nowhere")));
}

TEST_F(ImageFile, NoticesAFolderThatIsNotWritable) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::permissions(
      folder_.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT([&] { check_image_path(folder_ / "a.png"); },
              ThrowsMessage<DataError>(HasSubstr("denied")));
}

TEST_F(ImageFile, NoticesThatThePathIsAFolder) {
  std::filesystem::create_directory(folder_ / "a.png");
  EXPECT_THROW(check_image_path(folder_ / "a.png"), DataError);
}

TEST_F(ImageFile, LeavesNothingBehindWhenTheDiskIsFull) {
  for (const std::string name : {"a.png", "a.exr", "a.jpg", "a.tif"}) {
    const FileSizeLimit limit(100);
    EXPECT_THAT([&] { write_image(folder_ / name, ramp(50, 50, 1)); },
                ThrowsMessage<DataError>(HasSubstr(name)));
    EXPECT_EQ(folder_.count_files(), 0U) << name;
  }
}

TEST_F(ImageFile, KeepsTheOlderPictureWhenTheDiskIsFull) {
  write_image(folder_ / "a.png", Image(2, 2));
  {
    const FileSizeLimit limit(100);
    EXPECT_THROW(write_image(folder_ / "a.png", ramp(50, 50, 1)), DataError);
  }
  EXPECT_EQ(read_image(folder_ / "a.png").width, 2);
}

TEST_F(ImageFile, RefusesPicturesTooLargeForTheirFormat) {
  EXPECT_THAT([&] { write_image(folder_ / "a.jpg", Image(70000, 1)); },
              ThrowsMessage<UsageError>(HasSubstr("70000x1")));
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(ImageFile, RefusesToReadWhatIsNoPicture) {
  std::ofstream(folder_ / "a.png") << "this is text";
  EXPECT_THAT([&] { (void)read_image(folder_ / "a.png"); },
              ThrowsMessage<DataError>(HasSubstr("a.png")));
  EXPECT_THAT([&] { (void)read_image(folder_ / "missing.png"); },
              ThrowsMessage<DataError>(HasSubstr("missing.png")));
}

TEST_F(ImageFile, RefusesATruncatedPicture) {
  for (const std::string name : {"a.png", "a.exr", "a.tif", "a.jpg"}) {
    write_image(folder_ / name, ramp(200, 200, 1));
    std::filesystem::resize_file(folder_ / name, std::filesystem::file_size(folder_ / name) / 2);
    const WithoutLeakDetection libpng_jumps_over_destructors;
    EXPECT_THROW((void)read_image(folder_ / name), DataError) << name;
  }
}

TEST(UnfinishedFile, AppearsOnlyWhenItIsFinished) {
  const TemporaryFolder folder;
  UnfinishedFile file(folder / "data");
  file.write("abc", 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "data"));
  file.finish();
  EXPECT_EQ(read_text(folder / "data"), "abc");
  EXPECT_EQ(folder.count_files(), 1U);
}

TEST(UnfinishedFile, IsRemovedWhenItIsAbandoned) {
  const TemporaryFolder folder;
  {
    UnfinishedFile file(folder / "data");
    file.write("abc", 3);
  }
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(UnfinishedFile, ReplacesWhatALinkPointsTo) {
  const TemporaryFolder folder;
  std::ofstream(folder / "target") << "old";
  std::filesystem::create_symlink("target", folder / "link");
  UnfinishedFile file(folder / "link");
  file.write("new", 3);
  file.finish();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_text(folder / "target"), "new");
}

}  // namespace
}  // namespace splotchcl::test
