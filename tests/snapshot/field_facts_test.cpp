#include <fstream>
#include <limits>

#include "scene/statistics.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"
#include "testing.h"

namespace splotchcl {
namespace {

ParticleTypeInfo type_with(const std::vector<std::string>& labels) {
  ParticleTypeInfo type;
  for (const std::string& label : labels)
    type.fields.push_back({"", label, 1, ""});
  name_fields(type);
  return type;
}

TEST(FieldNames, LabelsOfAllDialectsMeanTheCanonicalField) {
  for (const char* label : {"U", "u", "U   ", "InternalEnergy", "INTERNALENERGY",
                            "InternalEnergies", "internal_energy"}) {
    EXPECT_EQ(canonical_field_name(label), "internal_energy") << label;
  }
  EXPECT_EQ(canonical_field_name("HSMS"), "star_smoothing_length");
  EXPECT_EQ(canonical_field_name("Voronoi"), "");
}

TEST(FieldNames, AreAsTheDocumentationSays) {
  std::ifstream document(test::source_folder() / "docs" / "formats.md");
  std::set<std::string> names;
  for (std::string line; std::getline(document, line);) {
    // A line of that list: - `name`: label, label
    const std::size_t end = line.find("`: ");
    const bool is_row = line.rfind("- `", 0) == 0 && end != std::string::npos &&
                        line.find('`', end + 1) == std::string::npos;
    if (!is_row) continue;
    const std::string name = line.substr(3, end - 3);
    names.insert(name);
    EXPECT_EQ(canonical_field_name(name), name);
    std::istringstream labels(line.substr(end + 3));
    for (std::string label; std::getline(labels >> std::ws, label, ',');)
      EXPECT_EQ(canonical_field_name(label), name) << label;
  }
  EXPECT_GT(names.size(), 20U);
  EXPECT_EQ(names.count("smoothing_length"), 1U);
}

TEST(FieldNames, AFieldIsFoundByCanonicalNameAndByAnyLabel) {
  const ParticleTypeInfo type = type_with({"Coordinates", "HSML"});
  for (const char* name : {"smoothing_length", "HSML", "hsml", "SmoothingLengths"}) {
    ASSERT_NE(find_field(type, name), nullptr) << name;
    EXPECT_EQ(find_field(type, name)->file_name, "HSML");
  }
  EXPECT_EQ(find_field(type, "density"), nullptr);
}

TEST(FieldNames, OfFieldsThatWereLeftOutTellWhy) {
  SnapshotInfo info;
  info.notes = {"particles have no density",
                "left out, as they have other than 9 rows: Masses (8), s"};
  for (const char* name : {"mass", "Masses", "S"})
    EXPECT_EQ(why_left_out(info, name), " (" + info.notes.back() + ")") << name;
  for (const char* name : {"density", "row", ""})
    EXPECT_EQ(why_left_out(info, name), "") << name;
}

TEST(FieldNames, UnknownLabelsKeepTheirSpellingAndAreFoundInAnyCase) {
  const ParticleTypeInfo type = type_with({"Voronoi_Volume"});
  EXPECT_EQ(type.fields[0].name, "Voronoi_Volume");
  EXPECT_NE(find_field(type, "voronoi_volume"), nullptr);
}

TEST(FieldNames, TheSecondFieldOfTheSameQuantityKeepsItsOwnName) {
  const ParticleTypeInfo type = type_with({"Metallicity", "GFM_Metallicity"});
  EXPECT_EQ(find_field(type, "metallicity")->file_name, "Metallicity");
  EXPECT_EQ(find_field(type, "GFM_Metallicity")->file_name, "GFM_Metallicity");
}

TEST(FieldNames, OfTwoFieldsTheOneThatIsCalledSoHasTheName) {
  const ParticleTypeInfo type = type_with({"Masses", "mass"});
  EXPECT_EQ(type.fields[0].name, "Masses");
  EXPECT_EQ(type.fields[1].name, "mass");
  EXPECT_EQ(find_field(type, "mass")->file_name, "mass");
  EXPECT_EQ(find_field(type, "Masses")->file_name, "Masses");
}

TEST(FieldNames, StarSmoothingLengthsStandInOnlyWhereThereAreNoOthers) {
  EXPECT_EQ(find_field(type_with({"HSMS"}), "smoothing_length")->file_name, "HSMS");
  EXPECT_EQ(find_field(type_with({"HSMS", "HSML"}), "smoothing_length")->file_name, "HSML");
}

TEST(MemberNames, AreTakenApart) {
  const auto plain = parse_member_name("folder/snap_002.1");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->base, "folder/snap_002");
  EXPECT_EQ(plain->index, 1);
  EXPECT_EQ(plain->ending, "");
  const auto hdf5 = parse_member_name("snap_002.12.hdf5");
  ASSERT_TRUE(hdf5);
  EXPECT_EQ(hdf5->base, "snap_002");
  EXPECT_EQ(hdf5->index, 12);
  EXPECT_EQ(hdf5->ending, ".hdf5");
}

TEST(MemberNames, OthersAreNotMistakenForThem) {
  for (const char* name : {"snap_002", "snap_002.hdf5", "tiny.000640", "snap.1a", "snap.", ".1",
                           "snap.99999999999999999999"}) {
    EXPECT_FALSE(parse_member_name(name)) << name;
  }
}

TEST(MemberNames, OfMoreFilesThanMemoryHoldsTheFirstThatIsMissingIsToldAtOnce) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "snap.0").put(0);
  try {
    find_members(folder / "snap.0", std::numeric_limits<int>::max());
    ADD_FAILURE() << "no error";
  } catch (const DataError& error) {
    EXPECT_THAT(error.what(), HasSubstr("snap.1: missing"));
  }
}

TEST(MemberNames, ALinkToAFileOfItsOwnKeepsItsName) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "snap.0").put(0);
  std::filesystem::create_symlink(folder / "snap.0", folder / "latest");
  EXPECT_THAT(find_siblings(folder / "latest"), ElementsAre(folder / "latest"));
}

TEST(ParticleTypes, TheNamesThatPeopleUseAreFoundInAnyCase) {
  const std::vector<std::pair<std::string, int>> names = {
      {"gas", 0},       {"halo", 1},      {"dm", 1},         {"dark_matter", 1},
      {"disk", 2},      {"bulge", 3},     {"stars", 4},      {"star", 4},
      {"Star", 4},      {"DM", 1},        {"boundary", 5},   {"black_holes", 5},
      {"PartType0", 0}, {"parttype1", 1}, {"PartType31", 31}};
  for (const auto& [name, type] : names)
    EXPECT_EQ(find_particle_type(name), type) << name;
}

TEST(ParticleTypes, OtherWordsMeanNone) {
  for (const char* word : {"", "g", "PartType", "PartType32", "PartType-1", "PartType1x", "4"})
    EXPECT_FALSE(find_particle_type(word)) << word;
}

TEST(UnitRatio, ConvertsWhatIsKnown) {
  const auto found = unit_ratio("g/cm^3", "(Msun) (kpc)^-3", {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found * 6.7679e-32, 1, 1e-4);
  EXPECT_EQ(unit_ratio("1e10 M_sun kpc^-3", "(1e10 M_sun) (kpc)^-3", {}), 1.0);
}

TEST(UnitRatio, IsOneWhereNothingTellsUnitsApart) {
  EXPECT_EQ(unit_ratio("", "g", {}), 1.0);
  EXPECT_EQ(unit_ratio("g", "", {}), 1.0);
  EXPECT_EQ(unit_ratio("2", "1", {}), 1.0);
  EXPECT_EQ(unit_ratio("1", "0", {}), 1.0);
  EXPECT_EQ(unit_ratio("code_mass", "code_mass", {}), 1.0);
  EXPECT_EQ(unit_ratio("code_mass/code_length**3", "(code_mass) (code_length)^-3", {}), 1.0);
}

TEST(UnitRatio, IsNotKnownOfOtherDimensionsAndOfOneKnownUnit) {
  EXPECT_FALSE(unit_ratio("K", "kpc", {}));
  EXPECT_FALSE(unit_ratio("code_length", "kpc", {}));
}

TEST(UnitRatio, NeedsScaleFactorAndHubbleParameterUnlessTheyCancel) {
  EXPECT_EQ(unit_ratio("M_sun kpc^-3 h^2 a^-3", "(M_sun h^-1) (kpc h^-1 a)^-3", {}), 1.0);
  EXPECT_FALSE(unit_ratio("kpc a", "kpc", {}));
  EXPECT_NEAR(unit_ratio("kpc a", "kpc", {0.25, 0}).value_or(0), 0.25, 1e-12);
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(FieldStatistics, AreThoseOfTheValues) {
  const FieldStatistics statistics = find_statistics(Column::owning({3, -1, 4}));
  EXPECT_EQ(statistics.count, 3U);
  EXPECT_EQ(statistics.bad, 0U);
  EXPECT_EQ(statistics.minimum, -1);
  EXPECT_EQ(statistics.maximum, 4);
  EXPECT_EQ(statistics.mean, 2);
}

TEST(FieldStatistics, CountBadValuesAndLeaveThemOut) {
  const FieldStatistics statistics =
      find_statistics(Column::owning({nan, 2, infinity, 4, -infinity}));
  EXPECT_EQ(statistics.count, 5U);
  EXPECT_EQ(statistics.bad, 3U);
  EXPECT_EQ(statistics.infinite, 2U);
  EXPECT_EQ(statistics.minimum, 2);
  EXPECT_EQ(statistics.maximum, 4);
  EXPECT_EQ(statistics.mean, 3);
}

TEST(FieldStatistics, OfNothingGoodAreZero) {
  EXPECT_EQ(find_statistics(Column::owning({nan})).maximum, 0);
  EXPECT_EQ(find_statistics(Column::owning({nan})).bad, 1U);
  EXPECT_EQ(find_statistics(Column()).count, 0U);
}

TEST(FieldStatistics, OfAUniformColumnAreItsValue) {
  const FieldStatistics statistics = find_statistics(Column::uniform(7));
  EXPECT_EQ(statistics.minimum, 7);
  EXPECT_EQ(statistics.maximum, 7);
  EXPECT_EQ(statistics.mean, 7);
}

TEST(FieldStatistics, MeanOfManyLargeValuesIsNotRounded) {
  // In single precision the sum would stop growing at 2^24.
  EXPECT_EQ(find_statistics(Column::owning(std::vector<float>(20000000, 1))).mean, 1);
}

}  // namespace
}  // namespace splotchcl
