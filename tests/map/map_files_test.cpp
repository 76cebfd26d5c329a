#include "map/map_files.h"

#include <fitsio.h>

#include "map/gas.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::map_scene;

// 3 x 2 pixels, 1 to 6 from the top left.
Map small_map() {
  Map map;
  map.width = 3;
  map.height = 2;
  map.values = {1, 2, 3, 4, 5, std::nanf("")};
  map.effective_particles = {10, 20, 30, 40, 50, 0};
  map.quantity = "surface density";
  map.unit = "Msun/pc^2";
  map.view = "xy";
  map.right_name = "x";
  map.up_name = "y";
  map.length_unit = "kpc";
  map.pixel = 0.5;
  map.center_right = 7;
  map.center_up = -2;
  return map;
}

void write(const std::filesystem::path& path, const Map& map) {
  write_map(path, map, map_scene(), {}, {{"splotchcl:scene", "[map]\nview = \"xy\""}});
}

using MapFiles = test::FolderTest;

TEST_F(MapFiles, OnlyFiguresHaveNotesOnWhatTheyDoNotShow) {
  Map map = small_map();
  map.width = map.height = 200;
  map.values.assign(40000, 1);
  map.values[0] = -1;  // no logarithm
  map.effective_particles.clear();
  for (const char* name : {"a.fits", "a.hdf5", "a.npy", "a.exr"})
    EXPECT_TRUE(write_map(folder_ / name, map, map_scene(), {}, {}).empty()) << name;
  for (const char* name : {"a.png", "a.pdf"})
    EXPECT_EQ(write_map(folder_ / name, map, map_scene(), {}, {}).size(), 1U) << name;
}

TEST_F(MapFiles, HoldFitsImagesWithTheLowestRowFirst) {
  write(folder_ / "a.fits", small_map());
  fitsfile* file = nullptr;
  int status = 0;
  fits_open_diskfile(&file, (folder_ / "a.fits").c_str(), READONLY, &status);
  std::vector<float> values(6);
  char unit[FLEN_VALUE] = "", axis[FLEN_VALUE] = "";
  double place = 0, pixel = 0;
  fits_read_img(file, TFLOAT, 1, 6, nullptr, values.data(), nullptr, &status);
  fits_read_key(file, TSTRING, "BUNIT", unit, nullptr, &status);
  fits_read_key(file, TSTRING, "CUNIT1", axis, nullptr, &status);
  fits_read_key(file, TDOUBLE, "CRVAL2", &place, nullptr, &status);
  fits_read_key(file, TDOUBLE, "CRPIX1", &pixel, nullptr, &status);
  int hdus = 0;
  fits_get_num_hdus(file, &hdus, &status);
  EXPECT_EQ(status, 0);
  fits_close_file(file, &status);
  EXPECT_EQ(values[0], 4);
  EXPECT_EQ(values[3], 1);
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_STREQ(unit, "solMass/pc**2");
  EXPECT_STREQ(axis, "kpc");
  EXPECT_EQ(place, -2);
  EXPECT_EQ(pixel, 2);
  EXPECT_EQ(hdus, 2);
}

TEST_F(MapFiles, HoldNumPyArraysWithTheLowestRowFirst) {
  const std::vector<unsigned char> bytes = encode_npy(small_map());
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_EQ(text.substr(1, 5), "NUMPY");
  EXPECT_THAT(text, HasSubstr("'shape': (2, 2, 3)"));
  const std::size_t start = 10 + static_cast<std::size_t>(bytes[8]) + 256U * bytes[9];
  EXPECT_EQ(start % 64, 0U);
  ASSERT_EQ(bytes.size(), start + 12 * sizeof(float));
  float first = 0, seventh = 0;
  std::memcpy(&first, bytes.data() + start, sizeof first);
  std::memcpy(&seventh, bytes.data() + start + 6 * sizeof(float), sizeof seventh);
  EXPECT_EQ(first, 4);
  EXPECT_EQ(seventh, 40);
}

TEST_F(MapFiles, HoldHdf5AndPicturesToo) {
  Map map = small_map();
  write(folder_ / "a.hdf5", map);
  map.values[5] = 6;
  write(folder_ / "a.exr", map);
  EXPECT_GT(std::filesystem::file_size(folder_ / "a.hdf5"), 48U);
  EXPECT_EQ(read_image(folder_ / "a.exr").at(1, 0)[0], 2);
  EXPECT_EQ(read_image(folder_ / "a.exr").at(1, 0)[1], 20);
}

TEST_F(MapFiles, RefuseEndingsThatHoldLight) {
  EXPECT_THROW(check_map_path(folder_ / "a.tif"), UsageError);
}

TEST_F(MapFiles, NameTheEndingsOfMapsWhereOneIsUnknown) {
  for (const char* name : {"a.txt", "a"}) {
    EXPECT_THAT([&] { check_map_path(folder_ / name); },
                ThrowsMessage<UsageError>(
                    AllOf(HasSubstr(".fits, .hdf5, .npy or .exr"), HasSubstr(".pdf"))));
  }
}

// The program of FITS' own support office looks at every card and sum.
TEST_F(MapFiles, PassFitsverify) {
  if (std::system("fitsverify -q > /dev/null 2>&1") != 0 &&
      std::system("command -v fitsverify > /dev/null") != 0) {
    GTEST_SKIP() << "fitsverify is not installed; scripts/setup does that";
  }
  Map map = small_map();
  write(folder_ / "lengths.fits", map);
  map.unit = "1e10 M_sun Mpc^-2 a^-2";
  map.quantity = std::string(100, 'q');
  map.sky = SkyPlace{187.5, 12.25, 1e-3};
  write(folder_ / "sky.fits", map);
  for (const char* const name : {"lengths.fits", "sky.fits"}) {
    const std::string command = "fitsverify -q " + (folder_ / name).string() + " > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << name;
  }
}

TEST_F(MapFiles, HaveCoordinatesOnTheSkyAndLengthsBeside) {
  Map map = small_map();
  map.sky = SkyPlace{187.5, 12.25, 1e-3};
  write(folder_ / "a.fits", map);
  fitsfile* file = nullptr;
  int status = 0;
  fits_open_diskfile(&file, (folder_ / "a.fits").c_str(), READONLY, &status);
  char axis[FLEN_VALUE] = "", unit[FLEN_VALUE] = "";
  double east = 0, declination = 0, length = 0;
  fits_read_key(file, TSTRING, "CTYPE1", axis, nullptr, &status);
  fits_read_key(file, TSTRING, "CUNIT2P", unit, nullptr, &status);
  fits_read_key(file, TDOUBLE, "CDELT1", &east, nullptr, &status);
  fits_read_key(file, TDOUBLE, "CRVAL2", &declination, nullptr, &status);
  fits_read_key(file, TDOUBLE, "CDELT1P", &length, nullptr, &status);
  EXPECT_EQ(status, 0);
  fits_close_file(file, &status);
  EXPECT_STREQ(axis, "RA---TAN");
  EXPECT_STREQ(unit, "kpc");
  EXPECT_EQ(east, -1e-3);  // right ascension grows to the left
  EXPECT_EQ(declination, 12.25);
  EXPECT_EQ(length, 0.5);
}

}  // namespace
}  // namespace splotchcl
