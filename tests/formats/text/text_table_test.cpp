// Tables of text, each with what is read from it or why it is refused.
#include "formats/snapshot_format.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

class TextTable : public ::testing::TestWithParam<SnapshotRow> {};

TEST_P(TextTable, IsReadOrRefused) {
  const TemporaryFolder folder;
  for (const std::string& text : GetParam().contents) {
    SCOPED_TRACE(text);
    write_bytes(folder / "table", text);
    expect_snapshot(folder / "table", GetParam().options, GetParam().expected);
  }
}

const SnapshotOptions xyz = {{"x", "y", "z"}};
const std::string two_rows = "1 2 3 4\n5 6 7 8\n", five_columns = "1 2 3 4 5\n6 7 8 9 10\n",
                  dashes = std::string(80, '-') + "\n";
const std::string skirt =
    "# Particles for SKIRT\n# Column 1: position x (kpc)\n# Column 2: position y (kpc)\n"
    "# Column 3: position z (kpc)\n# Column 4: smoothing length (pc)\n# Column 5: mass (Msun)\n";

// Separators, headers, names and their units.
INSTANTIATE_TEST_SUITE_P(
    Headers, TextTable,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"CommasWithAHeaderAreRead",
         {"x,y,z,mass,U\n1,2,3,0.5,7\n4,5,6,1.5e-1,8\n"},
         "format text with commas between columns | count 2 | position 1 2 3 4 5 6 | "
         "mass 0.5 0.15 | internal_energy 7 8"},
        {"AxesInSeveralUnitsAreConverted",
         {"x [kpc] y [pc] z vx [km/s] vy vz [cm/s]\n1 2000 3 4 1 1e5\n5 6000 7 8 1 2e5\n"},
         "position 1 2 3 5 6 7 | velocity 4 1 1 8 1 2 | unit position kpc | "
         "note y is converted from pc to kpc"},
        {"AxesWhoseUnitsCannotBeComparedAreRefused",
         {"x [kpc] y [K] z [kpc]\n1 2 3\n5 6 7\n"},
         "refused y is in \"K\" and others in \"kpc\""},
        {"NumbersOfColumnsAreNoUnits", {"x(0),y(1),z(2)\n1,2,3\n5,6,7\n"}, "position 1 2 3 5 6 7"},
        {"SmoothingLengthsAreInTheUnitOfPositions",
         {"h [pc] x [kpc] y [kpc] z [kpc]\n500 1 2 3\n250 5 6 7\n"},
         "smoothing_length 0.5 0.25"},
        {"OfTwoColumnsOfAMeaningTheOneThatIsCalledSoHasTheName",
         {"x y z m mass\n1 2 3 4 5\n5 6 7 8 9\n"},
         "mass 5 9 | m 4 8"},
        {"AByteOrderMarkIsNoPartOfTheFirstName", {"\xef\xbb\xbfx,y,z\n1,2,3\n"}, "position 1 2 3"},
        {"WhiteSpaceWithAHeaderInAnyStyleIsRead",
         {"x y z rho\n1 2\t3   4\n\n  5 6 7 8 \r\n# the end\n", "# x y z rho\n" + two_rows,
          "# a comment\n#x\ty\tz\trho\n" + two_rows, "  x   y z\trho  \n" + two_rows,
          "// x y z rho\n" + two_rows, "# x, y, z, rho\n" + two_rows},
         "position 1 2 3 5 6 7 | density 4 8"},
        {"SemicolonsQuotesAndUnitsAreRead",
         {"\"x [kpc]\";\"y [kpc]\";\"z [kpc]\";\"m (Msun)\"\n\"1\";2;3;4\n5;6;7;8\n"},
         "position 1 2 3 5 6 7 | mass 4 8 | unit position kpc | unit mass Msun"},
        {"AColumnOfRowNumbersWithoutANameIsLeftOutWithANote",
         {",x,y,z,mass\n0,1,2,3,4\n1,5,6,7,8\n", "\tx\ty\tz\tmass\n0\t1\t2\t3\t4\n1\t5\t6\t7\t8\n",
          "\"\",\"x\",\"y\",\"z\",\"mass\"\n\"0\",1,2,3,4\n\"1\",5,6,7,8\n",
          ";x;y;z;mass\n0;1;2;3;4\n1;5;6;7;8\n"},
         "position 1 2 3 5 6 7 | mass 4 8 | note column 1 left out"},
        {"AColumnWithTheNameOfAVectorOfColumnsIsLeftOutWithANote",
         {"x,y,z,position,mass\n1,2,3,9,4\n5,6,7,9,8\n"},
         "position 1 2 3 5 6 7 | mass 4 8 | note column position left out, as the field position "
         "is x,y,z; give it another name"},
        {"UnitsInAHeaderOfWhiteSpaceBelongToTheNameBeforeThem",
         {"x [kpc] y [kpc] z [kpc] rho [Msun / kpc^3]\n" + two_rows,
          "# x (kpc) y (kpc) z (kpc) rho (Msun / kpc^3)\n" + two_rows,
          "x[kpc] y[kpc] z[kpc] rho [Msun / kpc^3]\n" + two_rows},
         "position 1 2 3 5 6 7 | density 4 8 | unit position kpc | unit density Msun / kpc^3"},
        {"BracketsThatDoNotCloseAreNoUnits", {"x [kpc y z\n1 2 3\n"}, "refused names above has 4"},
        {"BracketsAloneAreNoUnits", {"[ ( [\n1 2 3\n"}, "refused no positions"},
        {"UnitsInAHeaderOfAstropyAreThoseOfTheColumns",
         {"# %ECSV 1.0\n# ---\n# datatype:\n# - {name: x, unit: kpc, datatype: float64}\n"
          "# - {name: y, unit: kpc, datatype: float64}\n"
          "# - {name: z, unit: pc, datatype: float64}\n"
          "# - {name: hsml, unit: pc, datatype: float64, description: 'unit: Mpc'}\n"
          "# - {name: vx, unit: 'km / s', datatype: float64}\n# schema: astropy-2.0\n"
          "x y z hsml vx\n1 2 3000 300 7\n5 6 7000 400 8\n"},
         "position 1 2 3 5 6 7 | smoothing_length 0.3 0.4 | unit position kpc | unit vx km / s"},
        // As Rockstar, numpy.savetxt and TOPCAT have them.
        {"TheCommentWhoseWordsFitTheColumnsIsTheHeader",
         {"#ID Mvir X Y Z\n#a = 0.5\n#Om = 0.3; Ol = 0.7; h = 0.7\n9 5 1 2 3\n8 6 5 6 7\n",
          "# ID Mvir X Y Z\n# five words that say nothing\n9 5 1 2 3\n8 6 5 6 7\n",
          "# made on a day\n# ID Mvir X Y Z\n9 5 1 2 3\n8 6 5 6 7\n"},
         "position 1 2 3 5 6 7 | Mvir 5 6"},
        // As AHF, ParaView and SPLASH have them.
        {"NamesOfOtherProgramsAreUnderstood",
         {"#Mhalo(1)\tXc(2)\tYc(3)\tZc(4)\n9 1 2 3\n8 5 6 7\n",
          "Mhalo,Points:0,Points:1,Points:2\n9,1,2,3\n8,5,6,7\n",
          "#    Mhalo           x       y              z\n9 1 2 3\n8 5 6 7\n"},
         "position 1 2 3 5 6 7 | Mhalo 9 8"},
        {"NamesMayHaveBlanksWhereTheyAreFarApart",
         {"#     x        y       z    particle mass    h \n1 2 3 9 0.5\n5 6 7 8 0.25\n"},
         "mass 9 8 | smoothing_length 0.5 0.25"},
        {"NamesInColumnsOfSplashMayBeCut",
         {"# units:\n#  1.0000000E+00   1.0000000E+00   1.0000000E+00   1.0000000E+00   "
          "1.0000000E+00\n#\n"
          "#          x [au]          y [au]          z [au] particle mass [ density [g/cm^3\n"
          "1 2 3 9 0.5\n5 6 7 8 0.25\n"},
         "position 1 2 3 5 6 7 | mass 9 8 | density 0.5 0.25 | unit position au"},
        {"EachColumnMayHaveACommentOfItsOwn",
         {skirt + "1 2 3 500 9\n5 6 7 250 8\n"},
         "position 1 2 3 5 6 7 | smoothing_length 0.5 0.25 | mass 9 8"},
        {"CommentsOnMoreColumnsThanThereAreNameNone", {skirt + two_rows}, "refused no positions"},
        {"UnitsMayStandInALineBelowTheNames",
         {"# x y z mass t\n# kpc kpc kpc Msun -\n1 2 3 7 9\n4 5 6 8 9\n",
          "x y z mass t\n[kpc] [kpc] [kpc] [Msun] [1]\n1 2 3 7 9\n4 5 6 8 9\n",
          "x,y,z,mass,t\nkpc,kpc,kpc,Msun,\n1 2 3 7 9\n4 5 6 8 9\n"},
         "unit position kpc | unit mass Msun | unit t "},
        {"RockstarSaysTheUnitsOfKindsOfColumns",
         {"#ID Mvir Rvir X Y Z\n#a = 0.5\n#Units: Masses in Msun / h\n#Units: Positions in Mpc / h "
          "(comoving)\n#Units: Halo Distances, Lengths, and Radii in kpc / h (comoving)\n1 2 3 4 "
          "5 6\n2 3 4 5 6 7\n"},
         "unit position Mpc/h a | unit Rvir kpc/h a | unit Mvir Msun/h"},
        {"MoreColumnsThanNamesAreRefusedWithBothNumbers",
         {"x y z mass\n1 2 3 4 5\n6 7 8 9 0\n", "# x y z mass\n1 2 3 4 5\n6 7 8 9 0\n",
          "x,y,z,mass\n1 2 3 4 5\n6 7 8 9 0\n"},
         "refused line 2 has 5 columns, but the line of names above has 4 | "
         "refused read.columns = ["},
        {"FewerColumnsThanNamesAreRefused",
         {"x y z mass h u\n1 2 3 4 5\n"},
         "refused names above has 6"},
        {"NamesMayBeQuotedAndNumbered",
         {"'x','y','z','h'\n1,2,3,7\n4,5,6,8\n", "pos_0,pos_1,pos_2,h\n1,2,3,7\n4,5,6,8\n",
          "pos[0],pos[1],pos[2],h\n1,2,3,7\n4,5,6,8\n",
          "Coordinates_1,Coordinates_2,Coordinates_3,h\n1,2,3,7\n4,5,6,8\n",
          "pos1,pos2,pos3,h,\n1,2,3,7\n4,5,6,8\n"},
         "position 1 2 3 4 5 6 | smoothing_length 7 8"},
        {"NamesMayBeInLatin1",
         {"x,y,z,gr\xf6\xdf"
          "e\n1,2,3,7\n4,5,6,8\n"},
         "gr\xc3\xb6\xc3\x9f"
         "e 7 8"},
        {"OfColumnsOfOneNameTheFirstCounts",
         {"x,y,z,x,mass\n1,2,3,40,7\n4,5,6,50,8\n"},
         "position 1 2 3 4 5 6 | no x | note column 4 left out"},
        {"VectorsAreFoundByTheirAxes",
         {"vz,pos_x,pos_y,pos_z,vx,vy,Bx,By,Bz,tx\n3,4,5,6,1,2,7,8,9,10\n"},
         "position 4 5 6 | velocity 1 2 3 | magnetic_field 7 8 9 | tx 10"},
        {"NumbersOfColumnsInNamesAreNoPartOfThem",
         {"#scale(0) x(1) y(2) z(3)\n1 1 2 3\n1 4 5 6\n",
          "# 1:scale 2:x 3:y 4:z\n1 1 2 3\n1 4 5 6\n",
          "# [1]=scale [2]=x [3]=y [4]=z\n1 1 2 3\n1 4 5 6\n",
          "# [01 scale] [02    x] [03    y] [04    z]\n1 1 2 3\n1 4 5 6\n"},
         "position 1 2 3 4 5 6"},
        {"NumbersOfColumnsStayWithNamesWhereOthersAreCutOut",
         {"#ID(1)\tXc(6)\tYc(7)\tZc(8)\tRhalo(12)\n1\t1\t2\t3\t210.5\n"},
         "position 1 2 3 | Rhalo 210.5 | unit Rhalo "},
        {"UnitsThatAreNamedCountBeforeThoseOfTheFile",
         {"x [kpc],y [kpc],z [kpc],mass\n1,2,3,7\n4,5,6,8\n"},
         "unit mass Msun | unit position Mpc | mass 7 8 | "
         "note position is taken to be in Mpc, as read.units says, not in kpc",
         {{}, 0, {"mass=Msun", "position=Mpc"}}},
        {"SystemsOfUnitsCountWhereTheFileSaysNothing",
         {"x,y,z,mass [kg],rho,hsml\n1,2,3,7,1,1\n4,5,6,8,1,1\n"},
         "unit position a kpc/h | unit smoothing_length a kpc/h | "
         "unit density 1e10 Msun/h (a kpc/h)^-3 | unit mass kg | notes 1 | note units that the "
         "file states are kept: mass in kg",
         {{}, 0, {"gadget"}}},
        {"SystemsOfUnitsMayBeThoseOfTheFile",
         {"x,y,z,mass [kg]\n1,2,3,7\n4,5,6,8\n"},
         "no notes",
         {{}, 0, {"si"}}},
        {"UnitsOfAFieldCountBeforeThoseOfASystem",
         {"x,y,z\n1,2,3\n"},
         "unit position pc",
         {{}, 0, {"position=pc", "cgs"}}},
        {"UnknownSystemsOfUnitsAreRefused",
         {"x,y,z\n1,2,3\n"},
         "misuse or a system: gadget, cgs, si",
         {{}, 0, {"gadgets"}}},
        {"UnitsOfOtherFieldsAreRefused",
         {"x,y,z,mass\n1,2,3,7\n4,5,6,8\n"},
         "misuse read.units: found weight | misuse some of mass, position",
         {{}, 0, {"weight=kg"}}},
        {"UnknownUnitsAreRefused",
         {"x,y,z,mass\n1,2,3,7\n4,5,6,8\n"},
         "misuse read.units.mass",
         {{}, 0, {"mass=stone"}}},
        {"UnitsOfOtherDimensionsAreRefused",
         {"x,y,z,mass\n1,2,3,7\n4,5,6,8\n"},
         "misuse read.units.position: found kg, expected a unit such as cm",
         {{}, 0, {"position=kg"}}}}),
    name_of_row);

// Rows, numbers, and lines that are no rows.
INSTANTIATE_TEST_SUITE_P(
    Rows, TextTable,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"CellsBetweenTabsMayBeEmpty",
         {"age\tx\ty\tz\tstar mass\th\n4\t1\t2\t3\t\t0.5\n\t5\t6\t7\t8\t\n"},
         "format text with tabs between columns | position 1 2 3 5 6 7 | 'star mass' nan 8 | age 4 "
         "nan | h 0.5 nan"},
        {"LinesMayEndInAComma",
         {"x, y, z, particle mass,\n1, 2, 3, 9,\n5, 6, 7, 8,\n"},
         "position 1 2 3 5 6 7 | mass 9 8"},
        {"CommasBetweenSemicolonsAreThoseOfNumbers",
         {"Pos.x [m];Pos.y [m];Pos.z [m];Idp\n0,25;0,5;-1,75;7\n2;3e1;4,5e0;8\n"},
         "position 0.25 0.5 -1.75 2 30 4.5"},
        {"DecimalCommasBetweenBlanksAreRead",
         {"x y z\n1,5 2,25 -3,5\n4,5 5 6e1\n"},
         "position 1.5 2.25 -3.5 4.5 5 60"},
        {"DecimalCommasBetweenTabsAreRead",
         {"x\ty\tz\n1,5\t2,25\t-3,5\n"},
         "position 1.5 2.25 -3.5"},
        {"ALineThatCountsTheRowsIsNoParticle",
         {"2 0 2\n0.25 0.5 0.75\n1 2 3\n"},
         "position 0.25 0.5 0.75 1 2 3 | note line 1 is left out",
         xyz},
        {"ALineThatCountsTheRowsIsNoneOfWholeNumbersEither",
         {"2 0 2\n1 0.5 0.75\n1 2 3\n"},
         "count 2",
         xyz},
        {"ALineOfOtherNumbersIsAParticle",
         {"3 0 2\n0.25 0.5 0.75\n1 2 3\n", "2 0 0.5\n0.25 0.5 0.75\n1 2 3\n"},
         "count 3",
         xyz},
        {"ALineThatMayTellTheNumberOfRowsIsSaid",
         {"2 1 0.5\n1.5 2 3\n4.5 5 6\n"},
         "count 3 | notes 1 | note line 1 is taken for a particle; if its 2 is the number | "
         "note read.skip_lines",
         xyz},
        {"ALineThatTellsNoNumberOfRowsIsNotSaid", {"2 1 0.5\n1 2 3\n4 5 6\n"}, "no notes", xyz},
        {"CountsBeforeTheNamesAreLeftOut",
         {"Np;Nbound;Time [s]\n2;0;0.5\nPos.x [m];Pos.y [m];Pos.z [m];Idp\n1;2;3;7\n4;5;6;8\n"},
         "position 1 2 3 4 5 6 | unit position m | note the first row is line 4"},
        {"TextBeforeNamesOfPositionsIsLeftOut",
         {"A run of mine\nmade on a day\nx y z mass\n1 2 3 7\n4 5 6 8\n"},
         "mass 7 8"},
        {"TextBeforeOtherRowsIsNotLeftOut",
         {"A run of mine\nmade on a day\n1 2 3 7\n4 5 6 8\n"},
         "refused no table"},
        {"RowsOfOtherLengthsBeforeTheNamedOnesAreLeftOut",
         {"2 0 1\n0.5 1.66\n0 0 0 0 0 0 1\n1 2 3 7\n4 5 6 8\n"},
         "position 1 2 3 4 5 6 | note the first row is line 4",
         {{"x", "y", "z", "mass"}}},
        {"LinesToSkipAreNoPartOfTheTable",
         {"x y z\n9 9 9\n\n1 2 3\n4 5 6\n"},
         "position 1 2 3 4 5 6",
         {{"x", "y", "z"}, 3}},
        {"LinesToSkipMayStandBeforeTheNames",
         {"junk, junk\n1 2 3 4\nx y z\n1 2 3\n"},
         "position 1 2 3",
         {{}, 2}},
        {"MoreLinesToSkipThanThereAreAreRefused",
         {"x y z\n9 9 9\n\n1 2 3\n4 5 6\n"},
         "refused no table after 5 lines | refused read.skip_lines",
         {{"x", "y", "z"}, 5}},
        {"LinesOfBinaryFilesAreNotSkipped",
         {std::string("\x89HDF\r\n\x1a\n", 8)},
         "misuse read.skip_lines is for tables",
         {{}, 1}},
        {"LinesThatEndInCarriageReturnsAloneAreToldSo",
         {"x,y,z\r1,2,3\r4,5,6\r"},
         "refused carriage returns alone"},
        {"LinesMayEndInCarriageReturns", {"x,y,z\r\n1,2,3\r\n4,5,6\r\n"}, "position 1 2 3 4 5 6"},
        {"CommentsBehindRowsAreRefusedForTheirCells",
         {"x y z\n1 2 3 # one\n4 5 6 # two\n"},
         "refused line 2 has 5 columns, but the line of names above has 3"},
        {"ColumnsNeedAHeaderThatNamesThem",
         {five_columns},
         "refused without a header that names them"},
        {"ColumnsMayBeNamedByTheScene",
         {five_columns},
         "position 3 4 5 8 9 10 | smoothing_length 1 6 | fields 2",
         {{"hsml", "-", "x", "y", "z"}}},
        {"ColumnsOfAHeaderMayBeNamedByTheScene",
         {"a,b,c\n1,2,3\n"},
         "position 3 2 1",
         {{"z", "y", "x"}}},
        {"OtherNumbersOfColumnsThanNamesOfTheSceneAreMisuse",
         {five_columns},
         "misuse line 1 has 5 columns",
         xyz},
        {"ColumnsMayHaveOtherNames",
         {"a [kpc],b,c,Mvir,x\n1,2,3,7,0\n4,5,6,8,0\n"},
         "position 1 2 3 4 5 6 | mass 7 8 | unit position kpc",
         {{"x=a", "y=B", "z=c", "mass=Mvir"}}},
        {"ColumnsThatAreNotThereAreRefused",
         {"a,b,c\n1,2,3\n"},
         "misuse no such column | misuse a, b, c",
         {{"x=a", "y=b", "z=d"}}},
        {"ColumnsAreAllRenamedOrNone",
         {"a,b,c\n1,2,3\n"},
         "misuse expected it for all",
         {{"x=a", "y", "z"}}},
        {"ColumnsWithoutNamesHaveNumbers",
         {"9 1 2 3\n9 4 5 6\n"},
         "position 1 2 3 4 5 6",
         {{"x=2", "y=3", "z=4"}}},
        {"MissingValuesAreNotANumber",
         {"x,y,z,T\n1,2,3,4\n1,2,3,\n1,2,3,nan\n1,2,3,NA\n1,2,3,-inf\n"},
         "temperature 4 nan nan nan -inf"},
        {"FortransExponentsAndSignsAreRead",
         {"x y z\n+1.5D+01 -2d0 5.E-1\n"},
         "position 15 -2 0.5"},
        {"ExponentsOfThreeDigitsMayLackTheirLetter",
         {"x y z h\n1.5-103 2.5+002 -3.5D+01 1\n"},
         "position 0 250 -35"},
        {"DatesAreNoExponents", {"x y z date\n1 2 3 2020-001\n"}, "no date"},
        {"PositionsKeepTheirDigits",
         {"x y z\n1000000.25 2000000.5 3e7\n1000000.375 2000000.5 3e7\n"},
         "position 1000000.25 2000000.5 3e7 1000000.375 2000000.5 3e7"},
        {"IdentifiersAreExact",
         {"id,x,y,z\n18446744073709551615,1,2,3\n9007199254740993,4,5,6\n"},
         "ids 18446744073709551615 9007199254740993"},
        {"ColumnsOfWordsAreLeftOutWithANote",
         {"name,x,y,z\nsun,0,0,0\nearth,1,0,0\n"},
         "fields 1 | note name"},
        {"ABadRowIsRefusedWithItsLine",
         {"x,y,z\n1,2,3\n\n4,5\n"},
         "refused line 4: found 2 values, expected 3"},
        {"AWordInARowIsRefusedWithItsLine",
         {"x,y,z\n1,2,3\n4,5,six\n"},
         "refused line 3: found 'six', expected a number"},
        {"AValueTooManyIsRefusedWithItsLine",
         {"x y z\n1 2 3\n4 5 6 7\n"},
         "refused line 3: found 4 values, expected 3"},
        {"AnAxisOfOtherThanNumbersIsNotTakenForZero",
         {"x,y,z,m\n1,2,1_000,4\n4,5,6,7\n"},
         "refused line 2: column z: found '1_000', expected a number"},
        {"AFirstAxisOfOtherThanNumbersIsNotTakenForZero",
         {"x,y,z,m\n1_000,2,3,4\n4,5,6,7\n"},
         "refused column x: found '1_000'"},
        {"ARowUnlikeALineBeforeItIsRefusedWithWhatToDo",
         {"2 0 1\n0.5 1.5\n1 2 3 4\n5 6 7 8\n"},
         "refused line 2: found 2 values, expected 3 as in the first row; if the table begins "
         "further down, leave out the lines before it with read.skip_lines",
         xyz},
        {"WithoutPositionsIsRefused",
         {"time,energy,mass\n1,2,3\n"},
         "refused no positions: its columns are time, energy, mass"},
        {"OtherTextIsNotATable",
         {"once upon a time\nthere was a star\n", "x,y,z\n", "snapshot = \"a\"\n", "1 2\n3 4\n",
          "x y z\nw\n1 2 3\n"},
         "refused text, but no table"},
        {"OfIpacIsReadByItsPlaces",
         {"\\catalog='mine'\n\\ made up\n"
          "|    x    |   y |   z |  name  | hsml |\n"
          "| double  | real| real|  char  | real |\n"
          "|  kpc    | kpc | kpc |        |  pc  |\n"
          "|  null   |     |     |        |      |\n"
          "   1.5       2     3    a b c     500 \n"
          "   4         5     6              700 \n"},
         "position 1.5 2 3 4 5 6 | smoothing_length 0.5 0.7 | unit position kpc"},
        {"BetweenBarsIsRead",
         {"| x | y | z | mass |\n|---|--:|---|------|\n| 1 | 2 | 3 | 7 |\n| 4 | 5 | 6 |   |\n"},
         "position 1 2 3 4 5 6 | mass 7 nan"},
        {"BetweenRulersIsRead",
         {"=== === ===\n x   y   z\n=== === ===\n  1   2   3\n  4   5   6\n=== === ===\n"},
         "position 1 2 3 4 5 6"},
        {"ThatIsDescribedByteByByteIsRead",
         {"Title: made up\n" + std::string(80, '=') +
          "\nByte-by-byte Description of file: t.dat\n" + dashes +
          "   Bytes Format Units   Label   Explanations\n" + dashes +
          "   1-  4 F4.1   kpc     x       Right of the middle\n"
          "   5-  8 F4.1   kpc     y       Above the middle,\n"
          "                                and so on\n"
          "   9- 12 F4.1   kpc     z       Before it\n"
          "      13 A1     ---     Type    One letter\n"
          "  14- 17 F4.1   ---     mass    ?=- Its mass\n" +
          dashes + "Note (1): none\n" + dashes + " 1.0 2.0 3.0A 7.0\n-4.0-5.0-6.0B\n"},
         "position 1 2 3 -4 -5 -6 | unit position kpc | mass 7 nan"},
        {"OfXmlIsRefusedWithWhatToDo",
         {"<?xml version=\"1.0\"?>\n<VOTABLE version=\"1.4\"></VOTABLE>\n"},
         "refused it is a VOTable; write it as ECSV"},
        {"OfLatexIsRefusedWithWhatToDo",
         {"\\begin{table}\nx & y & z \\\\\nkpc & kpc & kpc \\\\\n1 & 2 & 3 \\\\\n"},
         "refused it is a LaTeX table; write it as CSV"},
        {"OfXmlWhoseColumnsAreNamedIsRefused",
         {"<VOTABLE version=\"1.4\"></VOTABLE>\n"},
         "refused it is a VOTable",
         xyz}}),
    name_of_row);

// A number, a line of text and as many rows, each after its element.
INSTANTIATE_TEST_SUITE_P(
    OfXyz, TextTable,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"ElementsAreLeftOutAndPositionsRead",
         {"2\nmade on a day\nH 1 2 3\nHe 4 5 6\n"},
         "position 1 2 3 4 5 6 | note do not hold numbers: element"},
        {"TheLineOfTextMayBeEmpty", {"2\n\n1 2 3\n4 5 6\n"}, "position 1 2 3 4 5 6"},
        {"TheLineOfTextMayTellWhatTheColumnsAre",
         {"2\nLattice=\"10 0 0 0 20 0 0 0 30\" Properties=species:S:1:pos:R:3:mass:R:1 Time=0.5\n"
          "H 1 2 3 7\nH 4 5 6 8\n"},
         "position 1 2 3 4 5 6 | mass 7 8 | time 0.5 | box 10 20 30"},
        {"ABoxThatLeansOrIsNotPeriodicIsNone",
         {"2\nLattice=\"1 0 0 1 1 0 0 0 1\" Properties=pos:R:3\n1 2 3\n4 5 6\n",
          "2\nLattice=\"1 0 0 0 1 0 0 0 1\" pbc=\"T T F\" Properties=pos:R:3\n1 2 3\n4 5 6\n"},
         "no box"},
        {"NamesBelowANumberAreThoseOfColumns",
         {"2\ny x z\n1 2 3\n4 5 6\n"},
         "position 2 1 3 5 4 6"},
        {"RowsBelowANumberAreNoText",
         {"2\n1 2 3\n4 5 6\n"},
         "position 3 2 1 6 5 4",
         {{"z", "y", "x"}}},
        {"TextBelowTextIsRefused",
         {"no table\nat all\n"},
         "refused found no row of 3 columns",
         {{"z", "y", "x"}}},
        {"OfSeveralTablesTheLastIsRead",
         {"1\nfirst\nH 1 2 3\n2\nsecond\nH 4 5 6\nH 7 8 9\n"},
         "position 4 5 6 7 8 9 | note 2 tables one after the other"},
        {"OtherNumbersOfRowsThanItSaysAreRefused",
         {"3\ntext\nH 1 2 3\nH 4 5 6\n"},
         "refused found 2 rows, expected 3"}}),
    name_of_row);

TEST(TextTables, InAFolderAreNoSnapshot) {
  const TemporaryFolder folder;
  write_bytes(folder / "table", "x,y,z\n1,2,3\n");
  EXPECT_THAT(refusal(folder.path()), HasSubstr("no snapshot in this folder"));
}

}  // namespace
}  // namespace splotchcl::test
