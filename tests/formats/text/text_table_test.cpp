#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class TextTable : public ::testing::Test {
 protected:
  std::unique_ptr<Snapshot> open(const std::string& text,
                                 const std::vector<std::string>& columns = {}) const {
    write_bytes(path_, text);
    return open_snapshot(path_, {columns});
  }
  std::string refusal_of(const std::string& text,
                         const std::vector<std::string>& columns = {}) const {
    try {
      const auto snapshot = open(text, columns);
      for (const FieldInfo& field : snapshot->info().types.front().fields)
        snapshot->read(0, field.name);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "table";
};

std::vector<double> positions_of_table(const Snapshot& snapshot) {
  const Column offsets = snapshot.read(0, "position");
  std::vector<double> values;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    values.push_back(static_cast<double>(offsets[i]) + snapshot.position_origin().a[i % 3]);
  }
  return values;
}

TEST_F(TextTable, CommasWithAHeaderAreRead) {
  const auto snapshot = open("x,y,z,mass,U\n1,2,3,0.5,7\n4,5,6,1.5e-1,8\n");
  EXPECT_EQ(snapshot->info().format, "text with commas between columns");
  EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(0.5F, 0.15F));
  EXPECT_THAT(values_of(snapshot->read(0, "internal_energy")), ElementsAre(7, 8));
}

TEST_F(TextTable, AxesInSeveralUnitsAreConverted) {
  const auto snapshot =
      open("x [kpc] y [pc] z vx [km/s] vy vz [cm/s]\n1 2000 3 4 1 1e5\n5 6000 7 8 1 2e5\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(values_of(snapshot->read(0, "velocity")), ElementsAre(4, 1, 1, 8, 1, 2));
  EXPECT_EQ(snapshot->info().types[0].fields[0].unit, "kpc");
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("y is converted from pc to kpc")));
}

TEST_F(TextTable, AxesWhoseUnitsCannotBeComparedAreRefused) {
  EXPECT_THAT(refusal_of("x [kpc] y [K] z [kpc]\n1 2 3\n5 6 7\n"),
              HasSubstr("y is in \"K\" and others in \"kpc\""));
}

TEST_F(TextTable, NumbersOfColumnsAreNoUnits) {
  const auto snapshot = open("x(0),y(1),z(2)\n1,2,3\n5,6,7\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
}

TEST_F(TextTable, SmoothingLengthsAreInTheUnitOfPositions) {
  const auto snapshot = open("h [pc] x [kpc] y [kpc] z [kpc]\n500 1 2 3\n250 5 6 7\n");
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.5F, 0.25F));
}

TEST_F(TextTable, OfTwoColumnsOfAMeaningTheOneThatIsCalledSoHasTheName) {
  const auto snapshot = open("x y z m mass\n1 2 3 4 5\n5 6 7 8 9\n");
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(5, 9));
  EXPECT_THAT(values_of(snapshot->read(0, "m")), ElementsAre(4, 8));
}

TEST_F(TextTable, AByteOrderMarkIsNoPartOfTheFirstName) {
  const auto snapshot = open("\xef\xbb\xbfx,y,z\n1,2,3\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3));
}

TEST_F(TextTable, WhiteSpaceWithAHeaderInAnyStyleIsRead) {
  for (const char* header : {"x y z rho\n", "# x y z rho\n", "# a comment\n#x\ty\tz\trho\n",
                             "  x   y z\trho  \n", "// x y z rho\n", "# x, y, z, rho\n"}) {
    const auto snapshot = open(std::string(header) + "1 2\t3   4\n\n  5 6 7 8 \r\n# the end\n");
    EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7)) << header;
    EXPECT_THAT(values_of(snapshot->read(0, "density")), ElementsAre(4, 8)) << header;
  }
}

TEST_F(TextTable, SemicolonsQuotesAndUnitsAreRead) {
  const auto snapshot =
      open("\"x [kpc]\";\"y [kpc]\";\"z [kpc]\";\"m (Msun)\"\n\"1\";2;3;4\n5;6;7;8\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(4, 8));
  EXPECT_EQ(snapshot->info().types[0].fields[0].unit, "kpc");
  EXPECT_EQ(snapshot->info().types[0].fields[1].unit, "Msun");
}

TEST_F(TextTable, AColumnOfRowNumbersWithoutANameIsLeftOutWithANote) {
  for (const char* text :
       {",x,y,z,mass\n0,1,2,3,4\n1,5,6,7,8\n", "\tx\ty\tz\tmass\n0\t1\t2\t3\t4\n1\t5\t6\t7\t8\n",
        "\"\",\"x\",\"y\",\"z\",\"mass\"\n\"0\",1,2,3,4\n\"1\",5,6,7,8\n",
        ";x;y;z;mass\n0;1;2;3;4\n1;5;6;7;8\n"}) {
    const auto snapshot = open(text);
    EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7)) << text;
    EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(4, 8)) << text;
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("column 1 left out"))) << text;
  }
}

TEST_F(TextTable, AColumnWithTheNameOfAVectorOfColumnsIsLeftOutWithANote) {
  const auto snapshot = open("x,y,z,position,mass\n1,2,3,9,4\n5,6,7,9,8\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(4, 8));
  EXPECT_THAT(snapshot->info().notes,
              Contains("column position left out, as the field position is x,y,z; give it "
                       "another name"));
}

TEST_F(TextTable, UnitsInAHeaderOfWhiteSpaceBelongToTheNameBeforeThem) {
  for (const char* header : {"x [kpc] y [kpc] z [kpc] rho [Msun / kpc^3]\n",
                             "# x (kpc) y (kpc) z (kpc) rho (Msun / kpc^3)\n",
                             "x[kpc] y[kpc] z[kpc] rho [Msun / kpc^3]\n"}) {
    const auto snapshot = open(std::string(header) + "1 2 3 4\n5 6 7 8\n");
    EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7)) << header;
    EXPECT_THAT(values_of(snapshot->read(0, "density")), ElementsAre(4, 8)) << header;
    EXPECT_EQ(snapshot->info().types[0].fields[0].unit, "kpc") << header;
    EXPECT_EQ(snapshot->info().types[0].fields[1].unit, "Msun / kpc^3") << header;
  }
}

TEST_F(TextTable, BracketsThatDoNotCloseAreNoUnits) {
  EXPECT_THAT(refusal_of("x [kpc y z\n1 2 3\n"), HasSubstr("names above has 4"));
  EXPECT_THAT(refusal_of("[ ( [\n1 2 3\n"), HasSubstr("no positions"));
}

TEST_F(TextTable, UnitsInAHeaderOfAstropyAreThoseOfTheColumns) {
  const auto snapshot = open(
      "# %ECSV 1.0\n# ---\n# datatype:\n# - {name: x, unit: kpc, datatype: float64}\n"
      "# - {name: y, unit: kpc, datatype: float64}\n# - {name: z, unit: pc, datatype: float64}\n"
      "# - {name: hsml, unit: pc, datatype: float64, description: 'unit: Mpc'}\n"
      "# - {name: vx, unit: 'km / s', datatype: float64}\n# schema: astropy-2.0\n"
      "x y z hsml vx\n1 2 3000 300 7\n5 6 7000 400 8\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.3F, 0.4F));
  EXPECT_EQ(snapshot->info().types[0].fields[0].unit, "kpc");
  EXPECT_EQ(find_field(snapshot->info().types[0], "vx")->unit, "km / s");
}

TEST_F(TextTable, TheCommentWhoseWordsFitTheColumnsIsTheHeader) {
  // As Rockstar, numpy.savetxt and TOPCAT have them.
  for (const char* comments :
       {"#ID Mvir X Y Z\n#a = 0.5\n#Om = 0.3; Ol = 0.7; h = 0.7\n",
        "# ID Mvir X Y Z\n# five words that say nothing\n", "# made on a day\n# ID Mvir X Y Z\n"}) {
    const auto snapshot = open(std::string(comments) + "9 5 1 2 3\n8 6 5 6 7\n");
    EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7)) << comments;
    EXPECT_THAT(values_of(snapshot->read(0, "Mvir")), ElementsAre(5, 6)) << comments;
  }
}

TEST_F(TextTable, NamesOfOtherProgramsAreUnderstood) {
  // As AHF, ParaView and SPLASH have them.
  for (const char* header :
       {"#Mhalo(1)\tXc(2)\tYc(3)\tZc(4)\n", "Mhalo,Points:0,Points:1,Points:2\n",
        "#    Mhalo           x       y              z\n"}) {
    const std::string row = std::string(header).find(',') == std::string::npos
                                ? "9 1 2 3\n8 5 6 7\n"
                                : "9,1,2,3\n8,5,6,7\n";
    const auto snapshot = open(header + row);
    EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7)) << header;
    EXPECT_THAT(values_of(snapshot->read(0, "Mhalo")), ElementsAre(9, 8)) << header;
  }
}

TEST_F(TextTable, NamesMayHaveBlanksWhereTheyAreFarApart) {
  const auto snapshot =
      open("#     x        y       z    particle mass    h \n1 2 3 9 0.5\n5 6 7 8 0.25\n");
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(9, 8));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.5F, 0.25F));
}

TEST_F(TextTable, NamesInColumnsOfSplashMayBeCut) {
  const auto snapshot = open(
      "# units:\n#  1.0000000E+00   1.0000000E+00   1.0000000E+00   1.0000000E+00   "
      "1.0000000E+00\n#\n"
      "#          x [au]          y [au]          z [au] particle mass [ density [g/cm^3\n"
      "1 2 3 9 0.5\n5 6 7 8 0.25\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(9, 8));
  EXPECT_THAT(values_of(snapshot->read(0, "density")), ElementsAre(0.5F, 0.25F));
  EXPECT_EQ(snapshot->info().types[0].fields[0].unit, "au");
}

TEST_F(TextTable, EachColumnMayHaveACommentOfItsOwn) {
  const std::string header =
      "# Particles for SKIRT\n# Column 1: position x (kpc)\n# Column 2: position y (kpc)\n"
      "# Column 3: position z (kpc)\n# Column 4: smoothing length (pc)\n# Column 5: mass (Msun)\n";
  const auto snapshot = open(header + "1 2 3 500 9\n5 6 7 250 8\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.5F, 0.25F));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(9, 8));
  EXPECT_THAT(refusal_of(header + "1 2 3 4\n5 6 7 8\n"), HasSubstr("no positions"));
}

TEST_F(TextTable, CellsBetweenTabsMayBeEmpty) {
  const auto snapshot = open("age\tx\ty\tz\tstar mass\th\n4\t1\t2\t3\t\t0.5\n\t5\t6\t7\t8\t\n");
  EXPECT_EQ(snapshot->info().format, "text with tabs between columns");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_TRUE(std::isnan(snapshot->read(0, "star mass")[0]));
  EXPECT_EQ(snapshot->read(0, "star mass")[1], 8);
  EXPECT_EQ(snapshot->read(0, "age")[0], 4);
  EXPECT_TRUE(std::isnan(snapshot->read(0, "age")[1]));
  EXPECT_TRUE(std::isnan(snapshot->read(0, "h")[1]));
}

TEST_F(TextTable, LinesMayEndInAComma) {
  const auto snapshot = open("x, y, z, particle mass,\n1, 2, 3, 9,\n5, 6, 7, 8,\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(9, 8));
}

TEST_F(TextTable, CommasBetweenSemicolonsAreThoseOfNumbers) {
  const auto snapshot =
      open("Pos.x [m];Pos.y [m];Pos.z [m];Idp\n0,25;0,5;-1,75;7\n2;3e1;4,5e0;8\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(0.25, 0.5, -1.75, 2, 30, 4.5));
}

TEST_F(TextTable, ALineThatCountsTheRowsIsNoParticle) {
  const std::vector<std::string> names = {"x", "y", "z"};
  const auto counted = open("2 0 2\n0.25 0.5 0.75\n1 2 3\n", names);
  EXPECT_THAT(positions_of_table(*counted), ElementsAre(0.25, 0.5, 0.75, 1, 2, 3));
  EXPECT_THAT(counted->info().notes, Contains(HasSubstr("line 1 is left out")));
  EXPECT_EQ(open("2 0 2\n1 0.5 0.75\n1 2 3\n", names)->info().types[0].count, 2U);
  EXPECT_EQ(open("3 0 2\n0.25 0.5 0.75\n1 2 3\n", names)->info().types[0].count, 3U);
  EXPECT_EQ(open("2 0 0.5\n0.25 0.5 0.75\n1 2 3\n", names)->info().types[0].count, 3U);
}

TEST_F(TextTable, VectorsAreFoundByTheirAxes) {
  const auto snapshot = open(
      "vz,pos_x,pos_y,pos_z,vx,vy,Bx,By,Bz,tx\n"
      "3,4,5,6,1,2,7,8,9,10\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "velocity")), ElementsAre(1, 2, 3));
  EXPECT_THAT(values_of(snapshot->read(0, "magnetic_field")), ElementsAre(7, 8, 9));
  EXPECT_THAT(values_of(snapshot->read(0, "tx")), ElementsAre(10));
}

TEST_F(TextTable, ColumnsMayBeNamedByTheScene) {
  const std::string rows = "1 2 3 4 5\n6 7 8 9 10\n";
  EXPECT_THAT(refusal_of(rows), HasSubstr("without a header that names them"));
  const auto snapshot = open(rows, {"hsml", "-", "x", "y", "z"});
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(3, 4, 5, 8, 9, 10));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(1, 6));
  EXPECT_EQ(snapshot->info().types[0].fields.size(), 2U);
  EXPECT_THAT(positions_of_table(*open("a,b,c\n1,2,3\n", {"z", "y", "x"})), ElementsAre(3, 2, 1));
  EXPECT_THAT(refusal_of(rows, {"x", "y", "z"}), HasSubstr("line 1 has 5 columns"));
  EXPECT_THROW(open(rows, {"x", "y", "z"}), UsageError);  // it is the call that is wrong
}

TEST_F(TextTable, MissingValuesAreNotANumber) {
  const auto snapshot = open("x,y,z,T\n1,2,3,4\n1,2,3,\n1,2,3,nan\n1,2,3,NA\n1,2,3,-inf\n");
  const Column values = snapshot->read(0, "temperature");
  EXPECT_EQ(values[0], 4);
  for (const std::size_t row : {1U, 2U, 3U})
    EXPECT_TRUE(std::isnan(values[row])) << row;
  EXPECT_TRUE(std::isinf(values[4]));
}

TEST_F(TextTable, FortransExponentsAndSignsAreRead) {
  const auto snapshot = open("x y z\n+1.5D+01 -2d0 5.E-1\n");
  EXPECT_THAT(positions_of_table(*snapshot), ElementsAre(15, -2, 0.5));
}

TEST_F(TextTable, PositionsKeepTheirDigits) {
  const auto snapshot = open("x y z\n1000000.25 2000000.5 3e7\n1000000.375 2000000.5 3e7\n");
  EXPECT_THAT(positions_of_table(*snapshot),
              ElementsAre(1000000.25, 2000000.5, 3e7, 1000000.375, 2000000.5, 3e7));
}

TEST_F(TextTable, IdentifiersAreExact) {
  const auto snapshot = open("id,x,y,z\n18446744073709551615,1,2,3\n9007199254740993,4,5,6\n");
  EXPECT_THAT(snapshot->read_ids(0), ElementsAre(18446744073709551615U, 9007199254740993U));
}

TEST_F(TextTable, ColumnsOfWordsAreLeftOutWithANote) {
  const auto snapshot = open("name,x,y,z\nsun,0,0,0\nearth,1,0,0\n");
  EXPECT_EQ(snapshot->info().types[0].fields.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("name")));
}

TEST_F(TextTable, ABadRowIsRefusedWithItsLine) {
  EXPECT_THAT(refusal_of("x,y,z\n1,2,3\n\n4,5\n"), HasSubstr("line 4: found 2 values, expected 3"));
  EXPECT_THAT(refusal_of("x,y,z\n1,2,3\n4,5,six\n"),
              HasSubstr("line 3: found 'six', expected a number"));
  EXPECT_THAT(refusal_of("x y z\n1 2 3\n4 5 6 7\n"),
              HasSubstr("line 3: found 4 values, expected 3"));
}

TEST_F(TextTable, ARowUnlikeALineBeforeItIsRefusedWithWhatToDo) {
  EXPECT_THAT(refusal_of("2 0 1\n0.5 1.5\n1 2 3 4\n5 6 7 8\n", {"x", "y", "z"}),
              HasSubstr("line 2: found 2 values, expected 3 as in the first row; if the table "
                        "begins further down, leave out the lines before it with read.skip_lines"));
}

TEST_F(TextTable, WithoutPositionsIsRefused) {
  EXPECT_THAT(refusal_of("time,energy,mass\n1,2,3\n"),
              HasSubstr("no positions: its columns are time, energy, mass"));
}

TEST_F(TextTable, OtherTextIsNotATable) {
  for (const char* text : {"once upon a time\nthere was a star\n", "x,y,z\n", "snapshot = \"a\"\n",
                           "1 2\n3 4\n", "x y z\nw\n1 2 3\n"}) {
    EXPECT_THAT(refusal_of(text), HasSubstr("text, but no table")) << text;
  }
}

TEST_F(TextTable, AFolderOfTablesIsNoSnapshot) {
  open("x,y,z\n1,2,3\n");
  EXPECT_THAT(refusal(path_.parent_path()), HasSubstr("no snapshot in this folder"));
}

}  // namespace
}  // namespace splotchcl::test
