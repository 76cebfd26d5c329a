#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class TextForm : public ::testing::Test {
 protected:
  std::unique_ptr<Snapshot> open(const std::string& text,
                                 const SnapshotOptions& options = {}) const {
    write_bytes(path_, text);
    return open_snapshot(path_, options);
  }
  std::string refusal_of(const std::string& text, const SnapshotOptions& options = {}) const {
    try {
      open(text, options);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  static std::string unit_of(const Snapshot& snapshot, const std::string& field) {
    return require_field(snapshot.info(), 0, field).unit;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "table";
};

TEST_F(TextForm, CountsBeforeTheNamesAreLeftOut) {
  const auto snapshot =
      open("Np;Nbound;Time [s]\n2;0;0.5\nPos.x [m];Pos.y [m];Pos.z [m];Idp\n1;2;3;7\n4;5;6;8\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(unit_of(*snapshot, "position"), "m");
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("the first row is line 4")));
}

TEST_F(TextForm, ALineThatMayTellTheNumberOfRowsIsSaid) {
  const auto snapshot = open("2 1 0.5\n1.5 2 3\n4.5 5 6\n", {{"x", "y", "z"}});
  EXPECT_EQ(snapshot->info().types.front().count, 3U);
  EXPECT_THAT(snapshot->info().notes,
              ElementsAre(AllOf(HasSubstr("line 1 is taken for a particle; if its 2 is the number"),
                                HasSubstr("read.skip_lines"))));
  EXPECT_THAT(open("2 1 0.5\n1 2 3\n4 5 6\n", {{"x", "y", "z"}})->info().notes, IsEmpty());
}

TEST_F(TextForm, TextBeforeNamesOfPositionsIsLeftOut) {
  const auto snapshot = open("A run of mine\nmade on a day\nx y z mass\n1 2 3 7\n4 5 6 8\n");
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
  EXPECT_THAT(refusal_of("A run of mine\nmade on a day\n1 2 3 7\n4 5 6 8\n"),
              HasSubstr("no table"));
}

TEST_F(TextForm, UnitsMayStandInALineBelowTheNames) {
  for (const char* const header :
       {"# x y z mass t\n# kpc kpc kpc Msun -\n", "x y z mass t\n[kpc] [kpc] [kpc] [Msun] [1]\n",
        "x,y,z,mass,t\nkpc,kpc,kpc,Msun,\n"}) {
    const auto snapshot = open(std::string(header) + "1 2 3 7 9\n4 5 6 8 9\n");
    EXPECT_EQ(unit_of(*snapshot, "position"), "kpc") << header;
    EXPECT_EQ(unit_of(*snapshot, "mass"), "Msun") << header;
    EXPECT_EQ(unit_of(*snapshot, "t"), "") << header;
  }
}

TEST_F(TextForm, RockstarSaysTheUnitsOfKindsOfColumns) {
  const auto snapshot = open(
      "#ID Mvir Rvir X Y Z\n#a = 0.5\n#Units: Masses in Msun / h\n#Units: Positions in Mpc / h "
      "(comoving)\n#Units: Halo Distances, Lengths, and Radii in kpc / h (comoving)\n1 2 3 4 5 "
      "6\n2 3 4 5 6 7\n");
  EXPECT_EQ(unit_of(*snapshot, "position"), "Mpc/h a");
  EXPECT_EQ(unit_of(*snapshot, "Rvir"), "kpc/h a");
  EXPECT_EQ(unit_of(*snapshot, "Mvir"), "Msun/h");
}

TEST_F(TextForm, MoreOrFewerNamesThanColumnsAreRefusedWithBothNumbers) {
  for (const std::string header : {"x y z mass\n", "# x y z mass\n", "x,y,z,mass\n"}) {
    EXPECT_THAT(refusal_of(header + "1 2 3 4 5\n6 7 8 9 0\n"),
                AllOf(HasSubstr("line 2 has 5 columns, but the line of names above has 4"),
                      HasSubstr("read.columns = [")))
        << header;
  }
  EXPECT_THAT(refusal_of("x y z mass h u\n1 2 3 4 5\n"), HasSubstr("names above has 6"));
}

TEST_F(TextForm, LinesThatEndInCarriageReturnsAloneAreToldSo) {
  EXPECT_THAT(refusal_of("x,y,z\r1,2,3\r4,5,6\r"), HasSubstr("carriage returns alone"));
  EXPECT_THAT(absolute_positions(*open("x,y,z\r\n1,2,3\r\n4,5,6\r\n"), 0),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(TextForm, CommentsBehindRowsAreRefusedForTheirCells) {
  EXPECT_THAT(refusal_of("x y z\n1 2 3 # one\n4 5 6 # two\n"),
              HasSubstr("line 2 has 5 columns, but the line of names above has 3"));
}

TEST_F(TextForm, NamesMayBeQuotedNumberedAndInLatin1) {
  for (const std::string header :
       {"'x','y','z','h'\n", "pos_0,pos_1,pos_2,h\n", "pos[0],pos[1],pos[2],h\n",
        "Coordinates_1,Coordinates_2,Coordinates_3,h\n", "pos1,pos2,pos3,h,\n"}) {
    const auto snapshot = open(header + "1,2,3,7\n4,5,6,8\n");
    EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6)) << header;
    EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(7, 8)) << header;
  }
  const auto latin = open(
      "x,y,z,gr\xf6\xdf"
      "e\n1,2,3,7\n4,5,6,8\n");
  EXPECT_THAT(values_of(latin->read(0,
                                    "gr\xc3\xb6\xc3\x9f"
                                    "e")),
              ElementsAre(7, 8));
}

TEST_F(TextForm, ExponentsOfThreeDigitsMayLackTheirLetter) {
  const auto snapshot = open("x y z h\n1.5-103 2.5+002 -3.5D+01 1\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0),
              ElementsAre(::testing::DoubleNear(0, 1e-6), 250, -35));
  EXPECT_EQ(find_field(*open("x y z date\n1 2 3 2020-001\n")->info().find_type(0), "date"),
            nullptr);
}

TEST_F(TextForm, OfColumnsOfOneNameTheFirstCounts) {
  const auto snapshot = open("x,y,z,x,mass\n1,2,3,40,7\n4,5,6,50,8\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(find_field(*snapshot->info().find_type(0), "x"), nullptr);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("column 4 left out")));
}

TEST_F(TextForm, AnAxisOfOtherThanNumbersIsNotTakenForZero) {
  EXPECT_THAT(refusal_of("x,y,z,m\n1,2,1_000,4\n4,5,6,7\n"),
              HasSubstr("line 2: column z: found '1_000', expected a number"));
  EXPECT_THAT(refusal_of("x,y,z,m\n1_000,2,3,4\n4,5,6,7\n"), HasSubstr("column x: found '1_000'"));
}

TEST_F(TextForm, UnitsThatAreNamedCountBeforeThoseOfTheFile) {
  const auto snapshot = open("x [kpc],y [kpc],z [kpc],mass\n1,2,3,7\n4,5,6,8\n",
                             {{}, 0, {"mass=Msun", "position=Mpc"}});
  EXPECT_EQ(unit_of(*snapshot, "mass"), "Msun");
  EXPECT_EQ(unit_of(*snapshot, "position"), "Mpc");
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
  EXPECT_THAT(
      snapshot->info().notes,
      Contains(HasSubstr("position is taken to be in Mpc, as read.units says, not in kpc")));
}

TEST_F(TextForm, SystemsOfUnitsCountWhereTheFileSaysNothing) {
  const std::string table = "x,y,z,mass [kg],rho,hsml\n1,2,3,7,1,1\n4,5,6,8,1,1\n";
  const auto snapshot = open(table, {{}, 0, {"gadget"}});
  EXPECT_EQ(unit_of(*snapshot, "position"), "a kpc/h");
  EXPECT_EQ(unit_of(*snapshot, "smoothing_length"), "a kpc/h");
  EXPECT_EQ(unit_of(*snapshot, "density"), "1e10 Msun/h (a kpc/h)^-3");
  EXPECT_EQ(unit_of(*snapshot, "mass"), "kg");
  EXPECT_THAT(snapshot->info().notes,
              ElementsAre("units that the file states are kept: mass in kg"));
  EXPECT_THAT(open(table, {{}, 0, {"si"}})->info().notes, IsEmpty());
  EXPECT_EQ(unit_of(*open(table, {{}, 0, {"position=pc", "cgs"}}), "position"), "pc");
  EXPECT_THAT(refusal_of(table, {{}, 0, {"gadgets"}}), HasSubstr("or a system: gadget, cgs, si"));
}

TEST_F(TextForm, UnitsOfOtherFieldsAndOtherUnitsAreRefused) {
  const std::string table = "x,y,z,mass\n1,2,3,7\n4,5,6,8\n";
  EXPECT_THAT(refusal_of(table, {{}, 0, {"weight=kg"}}),
              AllOf(HasSubstr("read.units: found weight"), HasSubstr("some of mass, position")));
  EXPECT_THAT(refusal_of(table, {{}, 0, {"mass=stone"}}), HasSubstr("read.units.mass"));
  EXPECT_THAT(refusal_of(table, {{}, 0, {"position=kg"}}),
              HasSubstr("read.units.position: found kg, expected a unit such as cm"));
}

TEST_F(TextForm, RowsOfOtherLengthsBeforeTheNamedOnesAreLeftOut) {
  const auto snapshot =
      open("2 0 1\n0.5 1.66\n0 0 0 0 0 0 1\n1 2 3 7\n4 5 6 8\n", {{"x", "y", "z", "mass"}});
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("the first row is line 4")));
}

TEST_F(TextForm, LinesToSkipAreNoPartOfTheTable) {
  const std::string text = "x y z\n9 9 9\n\n1 2 3\n4 5 6\n";
  EXPECT_THAT(absolute_positions(*open(text, {{"x", "y", "z"}, 3}), 0),
              ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(absolute_positions(*open("junk, junk\n1 2 3 4\nx y z\n1 2 3\n", {{}, 2}), 0),
              ElementsAre(1, 2, 3));
  EXPECT_THAT(refusal_of(text, {{"x", "y", "z"}, 5}),
              AllOf(HasSubstr("no table after 5 lines"), HasSubstr("read.skip_lines")));
}

TEST_F(TextForm, LinesOfBinaryFilesAreNotSkipped) {
  write_bytes(path_, std::string("\x89HDF\r\n\x1a\n", 8));
  EXPECT_THAT(
      [&] {
        open_snapshot(path_, {{}, 1});
      },
      ThrowsMessage<UsageError>(HasSubstr("read.skip_lines is for tables")));
}

TEST_F(TextForm, ColumnsMayHaveOtherNames) {
  const auto snapshot =
      open("a [kpc],b,c,Mvir,x\n1,2,3,7,0\n4,5,6,8,0\n", {{"x=a", "y=B", "z=c", "mass=Mvir"}});
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
  EXPECT_EQ(unit_of(*snapshot, "position"), "kpc");
  EXPECT_THAT(refusal_of("a,b,c\n1,2,3\n", {{"x=a", "y=b", "z=d"}}),
              AllOf(HasSubstr("no such column"), HasSubstr("a, b, c")));
  EXPECT_THAT(refusal_of("a,b,c\n1,2,3\n", {{"x=a", "y", "z"}}), HasSubstr("expected it for all"));
}

TEST_F(TextForm, ColumnsWithoutNamesHaveNumbers) {
  const auto snapshot = open("9 1 2 3\n9 4 5 6\n", {{"x=2", "y=3", "z=4"}});
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(TextForm, DecimalCommasBetweenBlanksAndTabsAreRead) {
  EXPECT_THAT(absolute_positions(*open("x y z\n1,5 2,25 -3,5\n4,5 5 6e1\n"), 0),
              ElementsAre(1.5, 2.25, -3.5, 4.5, 5, 60));
  EXPECT_THAT(absolute_positions(*open("x\ty\tz\n1,5\t2,25\t-3,5\n"), 0),
              ElementsAre(1.5, 2.25, -3.5));
}

TEST_F(TextForm, TablesOfIpacAreReadByTheirPlaces) {
  const auto snapshot = open(
      "\\catalog='mine'\n\\ made up\n"
      "|    x    |   y |   z |  name  | hsml |\n"
      "| double  | real| real|  char  | real |\n"
      "|  kpc    | kpc | kpc |        |  pc  |\n"
      "|  null   |     |     |        |      |\n"
      "   1.5       2     3    a b c     500 \n"
      "   4         5     6              700 \n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1.5, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.5F, 0.7F));
  EXPECT_EQ(unit_of(*snapshot, "position"), "kpc");
}

TEST_F(TextForm, TablesBetweenBarsAreRead) {
  const auto snapshot = open(
      "| x | y | z | mass |\n|---|--:|---|------|\n| 1 | 2 | 3 | 7 |\n"
      "| 4 | 5 | 6 |   |\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  const auto mass = values_of(snapshot->read(0, "mass"));
  EXPECT_EQ(mass[0], 7);
  EXPECT_TRUE(std::isnan(mass[1]));
}

TEST_F(TextForm, TablesBetweenRulersAreRead) {
  EXPECT_THAT(absolute_positions(*open("=== === ===\n x   y   z\n=== === ===\n  1   2   3\n"
                                       "  4   5   6\n=== === ===\n"),
                                 0),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(TextForm, TablesThatAreDescribedByteByByteAreRead) {
  const std::string dashes(80, '-');
  const auto snapshot = open(
      "Title: made up\n" + std::string(80, '=') + "\nByte-by-byte Description of file: t.dat\n" +
      dashes + "\n   Bytes Format Units   Label   Explanations\n" + dashes +
      "\n   1-  4 F4.1   kpc     x       Right of the middle\n"
      "   5-  8 F4.1   kpc     y       Above the middle,\n"
      "                                and so on\n"
      "   9- 12 F4.1   kpc     z       Before it\n"
      "      13 A1     ---     Type    One letter\n"
      "  14- 17 F4.1   ---     mass    ?=- Its mass\n" +
      dashes + "\nNote (1): none\n" + dashes + "\n 1.0 2.0 3.0A 7.0\n-4.0-5.0-6.0B\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, -4, -5, -6));
  EXPECT_EQ(unit_of(*snapshot, "position"), "kpc");
  EXPECT_TRUE(std::isnan(snapshot->read(0, "mass")[1]));
}

TEST_F(TextForm, TablesForOthersAreRefusedWithWhatToDo) {
  EXPECT_THAT(refusal_of("<?xml version=\"1.0\"?>\n<VOTABLE version=\"1.4\"></VOTABLE>\n"),
              HasSubstr("it is a VOTable; write it as ECSV"));
  EXPECT_THAT(refusal_of("\\begin{table}\nx & y & z \\\\\nkpc & kpc & kpc \\\\\n1 & 2 & 3 \\\\\n"),
              HasSubstr("it is a LaTeX table; write it as CSV"));
  EXPECT_THAT(refusal_of("<VOTABLE version=\"1.4\"></VOTABLE>\n", {{"x", "y", "z"}}),
              HasSubstr("it is a VOTable"));
}

TEST_F(TextForm, NumbersOfColumnsInNamesAreNoPartOfThem) {
  for (const char* const header :
       {"#scale(0) x(1) y(2) z(3)", "# 1:scale 2:x 3:y 4:z", "# [1]=scale [2]=x [3]=y [4]=z",
        "# [01 scale] [02    x] [03    y] [04    z]"}) {
    EXPECT_THAT(absolute_positions(*open(std::string(header) + "\n1 1 2 3\n1 4 5 6\n"), 0),
                ElementsAre(1, 2, 3, 4, 5, 6))
        << header;
  }
}

TEST_F(TextForm, NumbersOfColumnsStayWithNamesWhereOthersAreCutOut) {
  const auto snapshot = open("#ID(1)\tXc(6)\tYc(7)\tZc(8)\tRhalo(12)\n1\t1\t2\t3\t210.5\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3));
  EXPECT_EQ(snapshot->read(0, "Rhalo")[0], 210.5F);
  EXPECT_EQ(unit_of(*snapshot, "Rhalo"), "");
}

}  // namespace
}  // namespace splotchcl::test
