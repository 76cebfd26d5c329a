// What people have on disk, and what they put into scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "cli/program.h"
#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_writer.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class EverydayFiles : public ::testing::Test {
 protected:
  // A line for each place of a lattice with a little disorder.
  void write_table(const char* name, const std::string& header,
                   const std::function<std::string(int)>& row_starts_with) const {
    std::ofstream table(folder_ / name);
    table << header << '\n';
    for (int i = 0; i < 512; ++i)
      table << row_starts_with(i) << i % 8 + 0.01 * (i % 7) << ',' << i / 8 % 8 << ','
            << i / 64 + 0.01 * (i % 5) << '\n';
  }
  ProgramResult run(const std::string& arguments) const {
    return run_in(folder_, "timeout 120 \"$splotchcl\" " + arguments);
  }
  TemporaryFolder folder_;
};

TEST_F(EverydayFiles, OfPandasHaveAColumnOfRowNumbers) {
  write_table("t.csv", ",x,y,z", [](int i) { return std::to_string(i) + ","; });
  const ProgramResult result = run("info t.csv");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("512 particles"));
}

TEST_F(EverydayFiles, OfWhiteSpaceHaveUnitsInTheirHeaders) {
  std::ofstream(folder_ / "t.txt") << "x [kpc] y [kpc] z [kpc]\n1 2 3\n2 3 4\n3 5 4\n";
  const ProgramResult result = run("info t.txt");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("kpc"));
}

// P-Gadget keeps other things there, in the first file of a set alone.
TEST_F(EverydayFiles, OfGadgetMayHaveHighWordsThatAreNoCounts) {
  auto members = split(small_snapshot(), 2);
  members[0].high_words = {0, 0, 228, 0, 0, 0};
  write_gadget_set(folder_ / "snap", members, 2);
  const ProgramResult result = run("info snap.0");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("gas: 37 particles"));
}

TEST_F(EverydayFiles, OfH5pyHaveNoHeader) {
  write_values(create_hdf5(folder_ / "t.hdf5"), "pos", {1, 2, 3, 4, 5, 6, 7, 8, 9}, 3);
  const ProgramResult result = run("info t.hdf5");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("3 particles"));
}

// What swiftsimio writes names no code, and has the kernel's scale for its radius.
TEST_F(EverydayFiles, OfSwiftsimioStartSimulations) {
  {
    const Hdf5Output file = create_hdf5(folder_ / "t.hdf5");
    make_group(file, "Header");
    make_group(file, "Units");
    write_attribute(file, "Header", "NumPart_ThisFile", {2, 0, 0, 0, 0, 0});
    write_attribute(file, "Units", "Unit length in cgs (U_L)", {3.08567758e24});
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "PartType0/SmoothingLength", {0.5, 0.5});
  }
  EXPECT_THAT(run("info t.hdf5").out,
              AllOf(HasSubstr("SWIFT initial conditions"), HasSubstr("0.912871")));
}

TEST_F(EverydayFiles, OfEvenMatterAreShownWithContrast) {
  write_table("t.csv", "x,y,z", [](int) { return ""; });
  EXPECT_THAT(run("render t.csv --explain").out, HasSubstr("percentiles = [50, 99.9]"));
}

TEST_F(EverydayFiles, OfAWrappedBoxAreSelectedAcrossItsFaces) {
  std::ofstream(folder_ / "t.csv") << "x,y,z\n0.05,0.5,0.5\n9.95,0.5,0.5\n5,5,5\n";
  std::ofstream(folder_ / "s.toml")
      << "snapshot = 't.csv'\nperiodic = {wrap = true, box = 10}\n[image]\nsize = [16, 12]\n"
         "[camera]\nposition = [0.5, 0.5, 20]\nlook_at = [0.5, 0.5, 0.5]\n[[component]]\n"
         "size.fixed = 0.5\nselect.sphere = {center = [0, 0.5, 0.5], radius = 0.5}\n";
  const ProgramResult result = run("render s.toml --reference -o a.png --stats s.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_text(folder_ / "s.json"), HasSubstr("\"drawn\": 2"));
}

TEST_F(EverydayFiles, ThatAreTablesWithoutRowsAreNotCalledScenes) {
  std::ofstream(folder_ / "empty.csv") << "x,y,z\n";
  for (const char* arguments : {"render empty.csv -o a.png", "map empty.csv -o a.npy"}) {
    const ProgramResult result = run(arguments);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("text, but no table with three or more numbers"),
                                  HasSubstr("or a scene file"), Not(HasSubstr("TOML"))));
  }
}

class LargeScenes : public EverydayFiles {
 protected:
  void expect_refused_in_a_line(const std::string& scene) const {
    std::ofstream(folder_ / "t.csv") << "x,y,z\n1,2,3\n2,3,4\n3,5,4\n";
    std::ofstream(folder_ / "s.toml") << "snapshot = 't.csv'\nimage.size = [16, 12]\n" << scene;
    const ProgramResult result = run("render s.toml --reference -o a.png");
    EXPECT_EQ(result.exit_code, 2) << result.err.substr(0, 500);
    EXPECT_TRUE(is_one_line(result.err)) << result.err.substr(0, 500);
    EXPECT_LT(result.err.size(), 1000U);
  }
  static std::string many(const std::string& part, int count) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += part;
    return text;
  }
};

TEST_F(LargeScenes, HaveNoKeysOfAnyDepth) {
  expect_refused_in_a_line(many("a.", 200000) + "a = 1\n");
  expect_refused_in_a_line("[" + many("a.", 200000) + "a]\n");
}

TEST_F(LargeScenes, HaveNoNumbersOfAnyPrecision) {
  expect_refused_in_a_line("[[component]]\n[finish.title]\ntext = '{time:.999999999f}'\n");
}

TEST_F(LargeScenes, HaveNoTextsOfAnyLength) {
  expect_refused_in_a_line("[[component]]\n[finish.title]\ntext = '" + many("x", 2000000) + "'\n");
}

TEST_F(LargeScenes, HaveNoThousandsOfComponents) {
  expect_refused_in_a_line(many("[[component]]\n", 5000));
}

}  // namespace
}  // namespace splotchcl::test
