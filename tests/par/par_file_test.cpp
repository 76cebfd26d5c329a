// The lines of a parameter file.
#include "par/par_file.h"

#include "testing.h"

namespace splotchcl::par {
namespace {

template <class Do>
std::string message_of(Do&& action) {
  return test::refusal_by<UsageError>([&] { action(); });
}

TEST(ParFile, HasKeysValuesAndRemarks) {
  ParFile file("# all a remark\n  infile = snap_   # its name\r\nfidx=92\n\n a_eq_e=t\nempty=\n",
               "x");
  EXPECT_EQ(file.text("infile"), "snap_");
  EXPECT_EQ(file.number("fidx"), 92);
  EXPECT_EQ(file.boolean("a_eq_e"), true);
  EXPECT_EQ(file.text("empty"), std::nullopt);
  EXPECT_EQ(file.text("absent"), std::nullopt);
}

TEST(ParFile, KnowsAllSpellingsOfTruth) {
  ParFile file("a=T\nb=TRUE\nc=true\nd=F\ne=False\nf=0\n", "x");
  for (const char* const key : {"a", "b", "c"})
    EXPECT_EQ(file.boolean(key), true) << key;
  for (const char* const key : {"d", "e", "f"})
    EXPECT_EQ(file.boolean(key), false) << key;
}

TEST(ParFile, TakesANumberBeforeARemarkWithoutItsMark) {
  ParFile file("particle_mem_factor=3 \t(default: 4)\n", "x");
  EXPECT_EQ(file.number("particle_mem_factor"), 3);
}

TEST(ParFile, NamesWhatNobodyAskedForInTheFilesOrder) {
  ParFile file("zebra=1\nused=2\napple=3\n", "x");
  file.number("used");
  EXPECT_THAT(file.unused(), ElementsAre("zebra", "apple"));
}

TEST(ParFile, RefusesWithFileLineAndKey) {
  ParFile file("\nfov=wide\nxres=1.5\nflag=perhaps\n", "demo.par");
  EXPECT_EQ(message_of([&] { file.number("fov"); }),
            "demo.par:2: key fov: found \"wide\", expected a finite number");
  EXPECT_THAT(message_of([&] { file.integer("xres", 1, 9); }), HasSubstr("from 1 to 9"));
  EXPECT_THAT(message_of([&] { file.boolean("flag"); }), HasSubstr("expected T or F"));
}

TEST(ParFile, RefusesLinesThatAreNoSettings) {
  EXPECT_THAT(message_of([] { ParFile("a=1\nwhat is this\n", "demo.par"); }),
              HasSubstr("demo.par:2: found \"what is this\""));
  EXPECT_THAT(message_of([] { ParFile("= 1\n", "demo.par"); }), HasSubstr("demo.par:1"));
}

TEST(ParFile, TellsOfKeysThatAreGivenTwice) {
  ParFile file("fov=1\nfov=2\n", "demo.par");
  EXPECT_EQ(file.number("fov"), 2);
  EXPECT_THAT(file.notes(), ElementsAre(HasSubstr("demo.par:2: fov is given again")));
}

}  // namespace
}  // namespace splotchcl::par
