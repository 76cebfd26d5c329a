// Questions that users asked: the pages that answer them.
#include "testing.h"

namespace splotchcl::test {
namespace {

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

}  // namespace
}  // namespace splotchcl::test
