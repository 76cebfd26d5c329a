// Files that are no files: FIFOs, devices, what never ends. Wherever one is named, it is refused
// and not waited for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "cli/program.h"
#include "damaged_hdf5.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class OddFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o h --particles 1000").exit_code, 0);
    ASSERT_EQ(run_in(folder_, "mkfifo fifo fifo.par fifo.toml fifo.ttf").exit_code, 0);
    write_image(folder_ / "a.png", Image(8, 8));
  }
  ProgramResult run(const std::string& arguments) const {
    return run_in(folder_, "timeout 120 \"$splotchcl\" " + arguments);
  }
  // What is drawn of a file is told before another is found to be odd.
  static std::string without_notes(const std::string& text) {
    std::istringstream lines(text);
    std::string kept;
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("splotchcl: note: ", 0) != 0) kept += line + "\n";
    return kept;
  }
  void expect_refused(const std::string& arguments) const {
    const ProgramResult result = run(arguments);
    EXPECT_TRUE(result.exit_code == 1 || result.exit_code == 2)
        << arguments << ": " << result.exit_code;
    EXPECT_TRUE(is_one_line(without_notes(result.err))) << arguments << "\n" << result.err;
  }
  TemporaryFolder folder_;
};

TEST_F(OddFiles, AreRefusedWhereverTheyAreNamed) {
  const std::string scene = "render h --reference -o o.png --set ";
  for (const std::string odd : {"fifo", "/dev/zero"}) {
    for (const std::string& arguments :
         {"render " + odd + " -o o.png", "info " + odd, "compare a.png " + odd,
          "galaxy " + odd + " -o o.hdf5", "galaxy a.png -o o.hdf5 --rotation-curve " + odd,
          scene + "image.background_image=" + odd, scene + "component.0.select.ids=" + odd,
          scene + "component.0.exclude.ids=" + odd, scene + "component.0.snapshot=" + odd,
          scene + "finish.cross_fade.amount=0.5 --set finish.cross_fade.scene=" + odd,
          "movie h --reference -o o_%d.png --set path.file=" + odd}) {
      expect_refused(arguments);
    }
  }
  expect_refused(scene + "component.0.palette=./fifo");
  expect_refused(scene + "finish.title.text=a --set finish.font=./fifo.ttf");
  expect_refused("render fifo.par -o o.png");
  expect_refused("render fifo.toml -o o.png");
  expect_refused("convert fifo.par -o o.toml");
}

TEST_F(OddFiles, OfPicturesAreOneLineWhoeverReadsThem) {
  std::filesystem::resize_file(folder_ / "a.png",
                               std::filesystem::file_size(folder_ / "a.png") / 2);
  const ProgramResult result = run("compare a.png a.png");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("libpng error")));
}

TEST_F(OddFiles, MayBeginWithAByteOrderMark) {
  std::ofstream(folder_ / "own.txt") << "0 0 0\n1 1 1\n";
  std::ofstream(folder_ / "marked.par") << "\xEF\xBB\xBFinfile=h\nsimtype=2\npalette0=own.txt\n";
  const ProgramResult result = run("convert marked.par -o o.toml");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

// HDF5 may crash on it, or speak of it when the program ends, as it does for two of these.
TEST_F(OddFiles, OfDamagedHdf5AreOneLineInEvolveToo) {
  const std::string options = " --disk-stars 50 --bulge-stars 50 --clusters 1 --cluster-stars 10";
  Image spot(32, 32);
  for (int i = 0; i < 3; ++i)
    spot.at(16, 16)[i] = 1;
  write_image(folder_ / "spot.exr", spot);
  ASSERT_EQ(run("galaxy spot.exr -o g.hdf5" + options).exit_code, 0);
  DamagedHdf5 damaged(read_text(folder_ / "g.hdf5"), 3);
  for (int i = 0; i < 60; ++i) {
    std::ofstream(folder_ / "damaged.hdf5", std::ios::binary) << damaged.next();
    const ProgramResult result = run("evolve damaged.hdf5 --snapshots s_%d.hdf5 --frames 1");
    EXPECT_LE(result.exit_code, 2) << i;
    if (result.exit_code == 0) continue;
    EXPECT_TRUE(is_one_line(result.err)) << i << "\n" << result.err.substr(0, 1000);
  }
}

TEST_F(OddFiles, OfManyLettersAreToldInFew) {
  std::ofstream(folder_ / "long.toml") << "snapshot = '" << std::string(100000, 'x') << "'\n";
  const ProgramResult result = run("render long.toml -o o.png");
  EXPECT_TRUE(is_one_line(result.err));
  EXPECT_LT(result.err.size(), 5000U);
}

// A scene, which every picture keeps, is UTF-8.
TEST_F(OddFiles, WhoseNamesAreNoUtf8AreReadOrRefusedInOneLine) {
  const std::string name = "h\xff";
  ASSERT_EQ(run_in(folder_, "ln h '" + name + "'; ln a.png '" + name + ".png'").exit_code, 0);
  for (const std::string command : {"render --reference -o o.png", "movie --reference -o o_%d.png",
                                    "map --reference -o o.fits", "render --explain"}) {
    const ProgramResult result = run(command + " '" + name + "'");
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr("\"h?\" is not UTF-8")) << command;
  }
  for (const std::string command : {"info --json", "index", "info"})
    EXPECT_EQ(run(command + " '" + name + "'").exit_code, 0) << command;
  EXPECT_EQ(run("compare --json a.png '" + name + ".png'").exit_code, 0);
  EXPECT_EQ(run("generate halo --particles 1000 -o '" + name + ".new'").exit_code, 0);
  EXPECT_EQ(run("render h --reference --size 8x8 -o '" + name + "o.png'").exit_code, 0);
  EXPECT_THAT(run("render h --reference -o o.png --set component.0.palette=" + name).err,
              HasSubstr("is not UTF-8"));
}

}  // namespace
}  // namespace splotchcl::test
