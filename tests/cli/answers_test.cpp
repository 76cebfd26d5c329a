// What the program answers to what is typed.
#include "cli/program.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Questions that users asked: the pages that answer them, and what the answers rest on.

// Pages are wrapped anywhere.
std::string unwrapped(const std::string& page) {
  std::istringstream words(page);
  std::string text;
  for (std::string word; words >> word;)
    text += (text.empty() ? "" : " ") + word;
  return text;
}

// From a heading, or the bold start of a paragraph, to the next heading.
std::string section(const char* page, const std::string& start) {
  const std::string text = read_text(test::source_folder() / "docs" / page);
  const std::size_t begin = text.find(start);
  if (begin == std::string::npos) return "";
  return unwrapped(text.substr(begin, text.find("\n##", begin + start.size()) - begin));
}

TEST(Answers, TellWhatABillionParticlesTake) {
  EXPECT_THAT(section("dev/performance.md", "## A billion particles"),
              AllOf(HasSubstr("GB"), HasSubstr(" s |"), HasSubstr("--max-particles")));
}

TEST(Answers, TellWhichRowIsUpAndHowPythonReadsIt) {
  EXPECT_THAT(section("scene.md", "## Which way is up, and right"),
              AllOf(HasSubstr("row 0"), HasSubstr("x to the right"), HasSubstr("import OpenEXR")));
}

TEST(Answers, TellHowToCenterOnAHalo) {
  EXPECT_THAT(section("scene.md", "### To centre on a halo"),
              AllOf(HasSubstr("GroupPos"), HasSubstr("look_at"), HasSubstr("halo = 12")));
}

TEST(Answers, TellHowToDrawUnderSlurm) {
  EXPECT_THAT(section("movies.md", "**Under Slurm.**"),
              AllOf(HasSubstr("#SBATCH"), HasSubstr("--part"), HasSubstr("POCL_MAX_PTHREAD")));
}

TEST(Answers, TellHowManyNeighborsLengthsReachTo) {
  EXPECT_THAT(unwrapped(read_text(test::source_folder() / "docs/library.md")),
              HasSubstr("64th neighbour (`read.neighbours`)"));
}

// Errors name what was typed: an option, or a key of a scene.

class TypedOptions : public ::testing::Test {
 protected:
  void SetUp() override { write_hdf5(folder_ / "s.hdf5", small_snapshot()); }
  std::string error_of(const std::string& arguments) const {
    return splotchcl_in(folder_, arguments).err;
  }
  TemporaryFolder folder_;
};

TEST_F(TypedOptions, AreNamedForEachShapeOfAMap) {
  for (const std::string wrong :
       {"--voxels 4,4", "--voxels 0", "--profile 0", "--channels x", "--healpix 12", "--bins 0",
        "--shell 5 --profile 3", "--x-range 5,1 --histogram x,y", "--slice --voxels 4",
        "--noise --healpix 4", "--statistic integral --quantity x --voxels 4"}) {
    const std::string option = wrong.substr(0, wrong.find(' '));
    EXPECT_THAT(error_of("map s.hdf5 -o m.npy " + wrong), StartsWith("splotchcl: " + option + ": "))
        << wrong;
  }
}

TEST_F(TypedOptions, AreNamedWhereTheirValuesAreWrong) {
  EXPECT_THAT(error_of("map s.hdf5 -o m.npy --width -3"), StartsWith("splotchcl: --width: found"));
  EXPECT_THAT(error_of("render s.hdf5 --width -3"), StartsWith("splotchcl: --width: found"));
  EXPECT_THAT(error_of("render s.hdf5 --size 3"), StartsWith("splotchcl: --size: found"));
  EXPECT_THAT(error_of("map s.hdf5 -o m.npy --center 1,2"),
              StartsWith("splotchcl: --center: found"));
  EXPECT_THAT(error_of("map s.hdf5 -o m.npy --types type_9"),
              StartsWith("splotchcl: --types: found"));
  EXPECT_THAT(error_of("map s.hdf5 -o m.npy --where 'x <'"),
              StartsWith("splotchcl: --where: found"));
  EXPECT_THAT(error_of("view s.hdf5 --center 1,2"), StartsWith("splotchcl: --center: found"));
}

TEST_F(TypedOptions, AreNamedWhereNoParticleHasTheirField) {
  EXPECT_THAT(error_of("render s.hdf5 --field nothing"), HasSubstr("--field is \"nothing\""));
  EXPECT_THAT(error_of("map s.hdf5 -o m.npy --quantity nothing"),
              HasSubstr("--quantity is \"nothing\""));
  EXPECT_THAT(error_of("render s.hdf5 --where 'nothing > 3'"), HasSubstr("--where is \"nothing\""));
  EXPECT_THAT(error_of("render s.hdf5 --where 'x < 2 Mpc'"),
              HasSubstr("component gas: --where: found 2 Mpc"));
}

TEST_F(TypedOptions, NameUnitsInOneWay) {
  EXPECT_THAT(error_of("render s.hdf5 --units gadget --set read.units=cgs"),
              HasSubstr("--units gadget: found --set read.units=cgs beside it"));
  EXPECT_THAT(error_of("render s.hdf5 --units gadgets"),
              HasSubstr("--units: gadgets not in {gadget,cgs,si}"));
}

TEST_F(TypedOptions, AreNamedWhereNothingTellsAHalo) {
  EXPECT_THAT(error_of("render s.hdf5 --center halo=3"),
              StartsWith("splotchcl: --center halo=3: particles of type"));
}

TEST_F(TypedOptions, AreNamedWhereOneIsMissing) {
  std::ofstream(folder_ / "one.txt") << "x y z m\n1 2 3 4\n";
  EXPECT_THAT(error_of("map one.txt -o m.npy"), StartsWith("splotchcl: --width: all particles"));
}

TEST_F(TypedOptions, DoNotTakeTheNamesOfKeys) {
  EXPECT_THAT(error_of("map s.hdf5 -o m.npy --set map.width=-3 --width 4"),
              HasSubstr("key map.width: found"));
  std::ofstream(folder_ / "scene.toml")
      << "snapshot = 's.hdf5'\n[[component]]\ntypes = 'gas'\ncolor.field = 'nothing'\n";
  EXPECT_THAT(error_of("render scene.toml --where 'x > 0'"),
              HasSubstr("color.field is \"nothing\""));
}

}  // namespace
}  // namespace splotchcl::test
