// How the program is told to read a snapshot: names of columns, headers only, parts of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "cli/program.h"
#include "paths.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A thousand particles in a cube, with or without a line of names.
void write_table(const std::filesystem::path& path, const std::string& header) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 10);
  std::ofstream file(path);
  file << header;
  for (int i = 0; i < 1000; ++i) {
    file << uniform(random) << ' ' << uniform(random) << ' ' << uniform(random) << ' '
         << uniform(random) << '\n';
  }
}

TEST(InfoHeader, TellsFieldsWithoutReadingThem) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 2000").exit_code, 0);
  const ProgramResult text = splotchcl_in(folder, "info u --header");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("type 0, gas: 1700 particles"), HasSubstr("internal_energy"),
                    Not(HasSubstr("[[component]]")), Not(HasSubstr("mean"))));
  const auto json = nlohmann::json::parse(splotchcl_in(folder, "info u --header --json").out);
  EXPECT_EQ(json["types"][0]["count"], 1700);
  EXPECT_EQ(json["types"][0]["fields"][0]["values_per_particle"], 3);
  EXPECT_FALSE(json["types"][0]["fields"][0].contains("minimum"));
  EXPECT_FALSE(json.contains("scene"));
}

// The values of this file of 4.8 GB are holes: reading them would take seconds, and all would
// be bad or zero.
TEST(InfoHeader, ReadsNoParticlesOfAHugeFile) {
  const TemporaryFolder folder;
  {
    std::ofstream file(folder / "huge", std::ios::binary);
    const std::uint32_t length = 256, count = 400000000;
    std::string header(256, '\0');
    header.replace(4, 4, reinterpret_cast<const char*>(&count), 4);
    const auto mark = [&file](std::uint32_t bytes) {
      file.write(reinterpret_cast<const char*>(&bytes), 4);
    };
    mark(length);
    file.write(header.data(), 256);
    mark(length);
    const std::uint64_t bytes = std::uint64_t{12} * count;
    mark(static_cast<std::uint32_t>(bytes));
    file.seekp(static_cast<std::streamoff>(bytes), std::ios::cur);
    mark(static_cast<std::uint32_t>(bytes));
    if (!file.flush()) GTEST_SKIP() << "no files of 4.8 GB here";
  }
  // With so little memory nothing of it could be read, only mapped.
  const ProgramResult result =
      run_in(folder, "ulimit -v 6000000; ulimit -t 5; \"$splotchcl\" info huge --header");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("type 1, halo: 400000000 particles"));
}

TEST(Tables, AreDrawnWithTheirOwnNamesOrThoseOfTheCall) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  write_table(folder / "named.txt", "# x y z mass\n");
  write_table(folder / "plain.txt", "");
  const std::string size = " --set image.size=[64,64]";
  const ProgramResult named = splotchcl_in(folder, "render named.txt -o named.png" + size);
  EXPECT_EQ(named.exit_code, 0) << named.err;
  const ProgramResult plain = splotchcl_in(
      folder,
      "render plain.txt -o plain.png --set 'read.columns=[\"x\",\"y\",\"z\",\"mass\"]'" + size);
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(read_text(folder / "named.png"), read_text(folder / "plain.png"));
  EXPECT_THAT(splotchcl_in(folder, "info plain.txt --columns x,y,-,z --header").out,
              AllOf(HasSubstr("text with white space"), HasSubstr("x,y,z")));
  const ProgramResult unnamed = splotchcl_in(folder, "info plain.txt");
  EXPECT_EQ(unnamed.exit_code, 1);
  EXPECT_TRUE(is_one_line(unnamed.err)) << unnamed.err;
}

TEST(Tables, ColumnsForASnapshotThatHasNamesAreRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 2000").exit_code, 0);
  const ProgramResult result = splotchcl_in(folder, "info u --columns x,y,z");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("read.columns is for tables"));
}

double mean_light(const std::filesystem::path& picture) {
  const Image image = read_image(picture);
  double sum = 0;
  for (const float value : image.pixels)
    sum += static_cast<double>(value);
  return sum / static_cast<double>(image.pixels.size());
}

TEST(RenderSubset, IsAsBrightAsAll) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 20000").exit_code, 0);
  const std::string call =
      "render u --set image.size=[128,128] --set component.0.absorption=none -o ";
  ASSERT_EQ(splotchcl_in(folder, call + "all.exr").exit_code, 0);
  const double all = mean_light(folder / "all.exr");
  for (const std::string option : {"--every 5", "--max-particles 4000"}) {
    const ProgramResult result = splotchcl_in(folder, call + "part.exr " + option);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("each stands for 5"));
    // The exposure is chosen anew from the particles that are left, which are noisier.
    EXPECT_NEAR(mean_light(folder / "part.exr") / all, 1, 0.3) << option;
  }
}

TEST(RenderSubset, MayStandInTheScene) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 2000").exit_code, 0);
  EXPECT_THAT(splotchcl_in(folder, "render u --every 7 --explain").out,
              HasSubstr("[read]\nevery = 7\n"));
  EXPECT_THAT(splotchcl_in(folder, "render u --max-particles 100 --explain").out,
              HasSubstr("max_particles = 100\n"));
  EXPECT_EQ(splotchcl_in(folder, "render u --every 0 --explain").exit_code, 2);
}

TEST(RealFiles, AreAllTold) {
  SKIP_WITHOUT_TEST_DATA();
  const TemporaryFolder folder;
  const std::filesystem::path data = test::data_folder();
  int files = 0;
  for (const char* name :
       {"gadget2_ics", "gadget_minimal", "galaxy_collision", "gassphere", "gassphere_id64",
        "gassphere_multifile", "lcdm", "phantom", "swift", "tipsy"}) {
    for (const auto& entry : std::filesystem::directory_iterator(data / name)) {
      const ProgramResult result =
          splotchcl_in(folder, "info --header '" + entry.path().string() + "'");
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(result.err, "");
      EXPECT_THAT(result.out, HasSubstr("position"));
      ++files;
    }
  }
  EXPECT_GE(files, 37);
}

}  // namespace
}  // namespace splotchcl::test
