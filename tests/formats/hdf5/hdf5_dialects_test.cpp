// What codes write: their names, units and headers, and headers and rows that do not agree.
#include "formats/hdf5/described_hdf5.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

class Hdf5Dialects : public ::testing::TestWithParam<SnapshotRow> {};

TEST_P(Hdf5Dialects, AreReadOrRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "snap.hdf5";
  for (const std::string& content : GetParam().contents) {
    SCOPED_TRACE(content);
    write_described_hdf5(path, content);
    expect_snapshot(path, GetParam().options, GetParam().expected);
  }
}

// Two cells or particles of gas; the same of SWIFT, in Mpc, 1e10 solar masses and some gigayears.
const std::string gas = "gadget 2 0 0 0 0 0 | ";
const std::string swift =
    gas +
    "Code@Code: \"SWIFT | Units@Unit length in cgs (U_L): 3.08567758e24 | "
    "Units@Unit mass in cgs (U_M): 1.98841e43 | Units@Unit time in cgs (U_t): 3.08567758e19";
const std::string in_cgs = "Conversion factor to CGS (not including cosmological corrections)";
const std::string any_length =
    " | Header@Time: 0.5 9 9 | Header@BoxSize: 64 64 64 | Header@MassTable: 3";
const std::string gizmo_cosmology =
    "Header@ComovingIntegrationOn i32: 1 | Header@Time: 0.5 | Header@Redshift: 1 | "
    "Header@Omega_Matter: 0.3 | Header@Omega_Lambda: 0.7 | Header@HubbleParam: 0.7 | "
    "Header@UnitLength_In_CGS: 4.408111428571429e21 | "
    "Header@UnitMass_In_CGS: 2.841428571428571e43 | Header@UnitVelocity_In_CGS: 1e5";

// Of mass, length, time and current, as SWIFT states them.
std::string powers(const std::string& dataset, const std::array<int, 4>& values) {
  const char* const names[] = {"U_M", "U_L", "U_t", "U_I"};
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += " | " + dataset + "@" + names[i] + " exponent: " + std::to_string(values[i]);
  return text;
}

const std::string in_lengths =
    powers("PartType0/Coordinates", {0, 1, 0, 0}) + " | PartType0/Coordinates@a-scale exponent: 1";
const std::string densities = " | PartType0/Densities: 1 2" +
                              powers("PartType0/Densities", {1, -3, 0, 0}) +
                              " | PartType0/Densities@a-scale exponent: -3 | "
                              "PartType0/Densities@Value stored as physical: ";
const std::string rates =
    "Header@UnitLength_in_cm: 3.085678e21 | Header@UnitMass_in_g: 1.989e43 | "
    "Header@UnitVelocity_in_cm_per_s: 1e5 | PartType0/StarFormationRate: 1 2 | "
    "PartType0/Masses: 1 2 | PartType0/StarFormationRate@mass_scaling: 1 | "
    "PartType0/StarFormationRate@length_scaling: -1 | "
    "PartType0/StarFormationRate@velocity_scaling: 1 | PartType0/Masses@mass_scaling: 1 | "
    "PartType0/Masses@h_scaling: -1 | PartType0/Masses@to_cgs: 1.989e43 | "
    "PartType0/StarFormationRate@to_cgs: ";

// A field with the size of its unit, and powers of the scale factor and the Hubble parameter.
std::string eagles(const std::string& field, const std::string& in_cgs_units, double a, double h) {
  const std::string path = "PartType0/" + field.substr(0, field.find(' '));
  std::string text;
  if (field != "Coordinates")
    text = " | PartType0/" + field + (field.back() == '3' ? ": 1 2 3 4 5 6" : ": 1 2");
  return text + " | " + path + "@CGSConversionFactor: " + in_cgs_units + " | " + path +
         "@aexp-scale-exponent: " + std::to_string(a) + " | " + path +
         "@h-scale-exponent: " + std::to_string(h);
}

INSTANTIATE_TEST_SUITE_P(
    OfFields, Hdf5Dialects,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"GizmoIsTold",
         {gas + "Header@GIZMO_version: 2022 | PartType0/SmoothingLength: 0.5 0.25"},
         "format GIZMO HDF5 | smoothing_length 0.5 0.25"},
        {"InitialConditionsForSwiftHaveTheKernelsScale",
         {gas +
          "Units@Unit length in cgs (U_L): 3.08567758e24 | PartType0/SmoothingLength: 0.5 0.25"},
         "format SWIFT initial conditions, HDF5 | smoothing_length 0.912871 0.4564355 | "
         "note the cubic spline's is taken"},
        {"ArepoIsToldByItsCells",
         {gas + "PartType0/CenterOfMass x3: 1 2 3 4 5 6 | PartType0/Volume: 8 27"},
         "format AREPO HDF5 | volume 8 27"},
        {"APartOfASwiftFileWithoutItsCodeHasTheKernelsScaleAndItsUnits",
         {gas + "PartType0/SmoothingLengths: 0.5 0.25 | PartType0/Coordinates@" + in_cgs +
          ": 3.08567758e24 | PartType0/Coordinates@a-scale exponent: 1 | "
          "PartType0/SmoothingLengths@" +
          in_cgs + ": 3.08567758e24"},
         "format SWIFT HDF5 | smoothing_length 0.912871 0.4564355 | unit position Mpc a | "
         "unit smoothing_length Mpc"},
        {"APartOfASwiftFileWithStarsHasThemToo",
         {"gadget 2 0 0 0 2 0 | PartType4/Coordinates x3: 1 2 3 4 5 6 | "
          "PartType4/SmoothingLengths: 0.5 0.25 | PartType4/Coordinates@" +
          in_cgs +
          ": 3.08567758e24 | PartType4/Coordinates@a-scale exponent: 1 | "
          "PartType4/SmoothingLengths@" +
          in_cgs + ": 3.08567758e24"},
         "format SWIFT HDF5 | smoothing_length/4 0.912871 0.4564355 | unit position/4 Mpc a | "
         "unit smoothing_length/4 Mpc"},
        {"WhereGizmosKernelEndsGoesByItsNewNameToo",
         {gas + "PartType0/KernelMaxRadius: 0.5 0.25 | PartType0/Volume: 8 27"},
         "format Gadget HDF5 | smoothing_length 0.5 0.25"},
        // That of gas reaches to dark matter, and not to gas.
        {"SubfindsAndStarsLengthsAreThoseOfTheirOwnType",
         {"gadget 2 1 0 0 1 0 | PartType1/Coordinates x3: 1 2 3 | PartType4/Coordinates x3: 4 5 6 "
          "| "
          "PartType0/SubfindHsml: 7 8 | PartType1/SubfindHsml: 9 | PartType4/StellarHsml: 0.75 | "
          "PartType4/SubfindHsml: 10"},
         "no smoothing_length | smoothing_length/1 9 | smoothing_length/4 0.75"},
        {"SwiftsNegativeRatesOfStarFormationAreNone",
         {swift + " | PartType0/StarFormationRates: -0.75 2"},
         "star_formation_rate 0 2 | note they count as 0"},
        {"SingularAndPluralNamesMeanTheSame",
         {gas + "PartType0/Densities: 1 2 | PartType0/InternalEnergies: 3 4 | "
                "PartType0/SmoothingLengths: 5 6 | PartType0/Velocity x3: 1 2 3 4 5 6 | "
                "PartType0/Mass: 7 8"},
         "density 1 2 | internal_energy 3 4 | smoothing_length 5 6 | velocity 1 2 3 4 5 6 | mass 7 "
         "8"},
        {"OfGizmosMetalsTheFirstIsTheWholeAndOthersAreElements",
         {gas + "PartType0/Metallicity x11 f32: 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 "
                "20 21"},
         "metallicity 0 11 | Metallicity.O 4 15 | Metallicity.Fe 10 21"},
        {"SwiftsColumnsHaveTheNamesThatTheFileLists",
         {gas + "PartType0/ElementMassFractions x4: 1 2 3 4 5 6 7 8 | "
                "SubgridScheme/NamedColumns/ElementMassFractions lines: Hydrogen, Helium, Carbon, "
                "Oxygen"},
         "ElementMassFractions.Oxygen 4 8"},
        {"ColumnsWithoutNamesHaveNumbersFromOne",
         {gas + "PartType0/Extra x2: 1 2 3 4"},
         "Extra.1 1 3 | Extra.2 2 4"},
        {"EaglesElementsAreInAGroup",
         {gas + "PartType0/ElementAbundance/Oxygen: 5 6 | PartType0/ElementAbundance/Iron: 7 8 | "
                "PartType0/ElementAbundance/Broken: 7"},
         "ElementAbundance.Oxygen 5 6 | ElementAbundance.Iron 7 8 | "
         "note ElementAbundance.Broken (1)"},
        {"NumbersThatAreKeptAsTextCount",
         {gas + "Header@BoxSize: \"100.5 | Header@HubbleParam: \" 0.7 "},
         "box 100.5 | hubble 0.7"},
        {"TextThatIsNoNumberIsIgnoredWithANote",
         {gas + "Header@BoxSize: \"100 Mpc"},
         "no box | note BoxSize is the text \"100 Mpc\""}}),
    name_of_row);

INSTANTIATE_TEST_SUITE_P(
    OfCounts, Hdf5Dialects,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"TracersWithoutPositionsAreLeftOutWithANote",
         {"gadget 2 0 0 3 0 0 | Header@NumPart_Total: 2 0 0 3 0 0 | PartType3/TracerID u64: 1 2 3"},
         "types 1 | note tracers of PartType3"},
        {"CountsOfZeroOrNonsenseInTheHeaderAreTakenFromTheRows",
         {"gadget 0 0 0 0 0 0", "gadget -1 0 0 0 0 0", "gadget 1e300 0.5", "gadget 0"},
         "count 2 | note those of the rows of the positions"},
        {"RowsCountWhereTheHeaderClaimsMoreOrFewer",
         {"gadget 1 0 0 0 0 0", "gadget 3 0 0 0 0 0", "gadget 1e15 0 0 0 0 0"},
         "count 2 | position 1 2 3 4 5 6 | note Coordinates has 2 rows: these count"},
        {"RowsOfATypeThatTheHeaderDoesNotCountAreParticles",
         {gas + "PartType6/Coordinates x3: 7 8 9"},
         "count/6 1 | position/6 7 8 9 | note counts 0 particles of type 6"},
        {"ATypeWithoutItsGroupIsLeftOutWithANote",
         {"gadget 2 1157 0 0 0 0 | Header@NumPart_Total: 2 1157 0 0 0 0"},
         "types 1 | note counts 1157 particles, but there is no such group"},
        {"ATypeWithoutPositionsIsLeftOutWithANote",
         {"gadget 2 0 0 0 3 0 | PartType4/Masses: 1 2 3"},
         "types 1 | note PartType4 is left out"},
        {"DatasetsOfOtherLengthsAreLeftOutWithANote",
         {gas + "PartType0/Center: 50 51 52 | PartType0/Masses: 4 5"},
         "no Center | mass 4 5 | note other than 2 rows: Center (3)"},
        {"TotalsThatAreNonsenseAreIgnoredWithANote",
         {gas + "Header@NumPart_Total: -2 0 0 0 0 0"},
         "count 2 | note NumPart_Total holds -2"},
        {"AHeaderOfArraysOfAnyLengthIsRead",
         {"gadget 2" + any_length, "gadget 2 0" + any_length, "gadget 2 0 0 0 0 0 0" + any_length,
          "gadget 2 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0" + any_length},
         "time 0.5 | box 64 | mass 3"},
        {"FieldsThatTheHeaderDoesNotCountAndNoCoordinatesAreLeftOut",
         {gas + "PartType3/Masses: 1 2"},
         "types 1 | note PartType3 is left out"},
        {"CoordinatesOfOtherWidthsAreRefusedWithTheirs",
         {"Header@NumPart_ThisFile: 2 | PartType0/Coordinates x2: 1 2 3 4"},
         "refused only Coordinates of 2 columns"},
        {"WithoutCoordinatesIsRefused",
         {"Header@NumPart_ThisFile: 2 | PartType0/Masses: 1 2"},
         "refused expected a dataset Coordinates"}}),
    name_of_row);

INSTANTIATE_TEST_SUITE_P(
    OfUnits, Hdf5Dialects,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        // What GIZMO's io.c writes: its units divided by the Hubble parameter.
        {"GizmosUnitsAreThoseOfItsHeader",
         {gas + gizmo_cosmology +
          " | PartType0/Masses: 1 2 | PartType0/Density: 1 2 | "
          "PartType0/InternalEnergy: 1 2 | PartType0/Velocities x3: 1 2 3 4 5 6"},
         "unit position kpc h^-1 a | unit mass 1e10 M_sun h^-1 | "
         "unit density 1e10 M_sun kpc^-3 h^2 a^-3 | unit velocity km/s a^0.5 | "
         "unit internal_energy (km/s)^2"},
        {"UnitsInWordsCountWhereNothingElseStatesThem",
         {gas + "PartType0/Masses: 1 2 | PartType0/Masses@units: \"Msun"},
         "unit mass Msun"},
        {"SmoothingLengthsAreInTheUnitOfPositions",
         {gas + "PartType0/Coordinates@units: \"Mpc | PartType0/SmoothingLength: 500 2000 | "
                "PartType0/SmoothingLength@units: \"kpc"},
         "unit smoothing_length Mpc | smoothing_length 0.5 2"},
        // Clouds that form stars, in parsecs, solar masses and meters per second; their time is a
        // time.
        {"GizmoHasNoScaleFactorWithoutCosmology",
         {gas + "Header@ComovingIntegrationOn i32: 0 | Header@Time: 1 | Header@Redshift: 0 | "
                "Header@HubbleParam: 1 | Header@UnitLength_In_CGS: 3.085678e18 | "
                "Header@UnitMass_In_CGS: 1.989e33 | Header@UnitVelocity_In_CGS: 100 | "
                "PartType0/Masses: 1 2 | PartType0/Velocities x3: 1 2 3 4 5 6"},
         "unit position pc | unit mass M_sun | unit velocity 100 cm/s | no cosmology | no "
         "redshift"},
        {"OlderGizmoFilesNameNoUnits",
         {gas + "Header@GIZMO_version: 2017 | Header@HubbleParam: 0.7"},
         "unit position "},
        {"MassesOfGadgetFoursTableHaveItsUnitOfMass",
         {gas + "Header@MassTable: 3 0 0 0 0 0 | Parameters@UnitMass_in_g: 1.989e43 | "
                "PartType0/Coordinates@h_scaling: -1"},
         "unit mass 1e10 M_sun h^-1"},
        // The power of the scale factor that SWIFT states counts where values are comoving.
        {"WhatSwiftStoresAsComovingHasAPowerOfTheScaleFactor",
         {swift + densities + "0"},
         "unit density 1e10 M_sun Mpc^-3 a^-3"},
        {"WhatSwiftStoresAsPhysicalHasNoPowerOfTheScaleFactor",
         {swift + densities + "1"},
         "unit density 1e10 M_sun Mpc^-3"},
        // Tesla are kilograms over amperes and seconds squared.
        {"SwiftsUnitsOfCurrentsAreNotNamed",
         {swift + " | PartType0/MagneticFluxDensities x3: 1 2 3 4 5 6" +
          powers("PartType0/MagneticFluxDensities", {1, 0, -2, -1})},
         "unit MagneticFluxDensities "},
        // IllustrisTNG's rates are in solar masses per year, though the powers that it states give
        // 1e10 M_sun km / (kpc s).
        {"AStatedSizeOfAUnitCountsBeforeThatOfItsProduct",
         {gas + rates + "6.30387e25"},
         "unit star_formation_rate M_sun/yr | unit mass 1e10 M_sun h^-1"},
        {"AStatedSizeOfNoKnownUnitCountsAsWell",
         {gas + rates + "1e20"},
         "unit star_formation_rate 1e+20 g s^-1 | unit mass 1e10 M_sun h^-1"},
        {"SwiftsUnitsHaveNoScaleFactorWithoutCosmology",
         {swift + " | Cosmology@Cosmological run: 0" + in_lengths},
         "unit position Mpc"},
        {"SwiftsUnitsHaveAScaleFactorWithCosmology",
         {swift + " | Cosmology@Cosmological run: 1" + in_lengths},
         "unit position Mpc a"},
        // EAGLE's files say how large a unit is, not what it is one of.
        {"EaglesUnitsAreRead",
         {gas.substr(0, gas.size() - 3) + eagles("Coordinates", "3.085678e24", 1, -1) +
          eagles("Mass", "1.989e43", 0, -1) + eagles("Density", "6.769911178294543e-31", -3, 2) +
          eagles("Velocity x3", "1e5", 0.5, 0) + eagles("InternalEnergy", "1e10", 0, 0) +
          eagles("Temperature", "1", 0, 0) + eagles("StarFormationRate", "6.30387e25", 0, 0) +
          eagles("Metallicity", "1", 0, 0) + eagles("Entropy", "7e-22", 0, 0)},
         "unit position Mpc h^-1 a | unit mass 1e10 M_sun h^-1 | "
         "unit density 1e10 M_sun Mpc^-3 h^2 a^-3 | unit velocity km/s a^0.5 | "
         "unit internal_energy (km/s)^2 | unit temperature K | unit star_formation_rate M_sun/yr | "
         "unit metallicity  | unit entropy "}}),
    name_of_row);

class Hdf5Gas : public ::testing::Test {
 protected:
  Hdf5Output create() const {
    write_described_hdf5(path_, "gadget 2 0 0 0 0 0");
    return Hdf5Output(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap.hdf5";
};

TEST_F(Hdf5Gas, OfGizmoHasItsCosmology) {
  write_described_hdf5(path_, gas + gizmo_cosmology);
  const auto cosmology = open_snapshot(path_)->info().cosmology;
  ASSERT_TRUE(cosmology);
  EXPECT_EQ(cosmology->scale_factor, 0.5);
  EXPECT_EQ(cosmology->omega_matter, 0.3);
  EXPECT_EQ(cosmology->velocity_power, 0.5);
  EXPECT_NEAR(cosmology->hubble_rate, 0.1, 1e-6);
}

// As h5py writes numpy's: an enumeration.
TEST_F(Hdf5Gas, TruthValuesAreNumbers) {
  {
    const Hdf5Output file = create();
    const Hdf5Handle<H5Tclose> truth(H5Tenum_create(H5T_STD_I8LE));
    const std::int8_t values[2] = {0, 1};
    H5Tenum_insert(truth.id(), "FALSE", &values[0]);
    H5Tenum_insert(truth.id(), "TRUE", &values[1]);
    const hsize_t rows = 2;
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &rows, nullptr));
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "PartType0/is_bound", truth.id(),
                                                  space.id(), H5P_DEFAULT, H5P_DEFAULT,
                                                  H5P_DEFAULT));
    H5Dwrite(dataset.id(), truth.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "is_bound")), ElementsAre(0, 1));
  EXPECT_THAT(snapshot->read_integers(0, "is_bound"), ElementsAre(0U, 1U));
}

TEST_F(Hdf5Gas, IdentifiersOfAnyWidthAreExact) {
  const Hdf5Handle<H5Tclose> six_bytes(H5Tcopy(H5T_STD_U64BE));
  H5Tset_size(six_bytes.id(), 6);
  for (const hid_t type : {H5T_STD_U32BE, six_bytes.id(), H5T_STD_I64LE}) {
    {
      const Hdf5Output file = create();
      write_values(file, "PartType0/ParticleIDs", {4294967295.0, 1}, 1, type);
    }
    EXPECT_THAT(open_snapshot(path_)->read_ids(0), ElementsAre(4294967295U, 1U));
  }
}

TEST_F(Hdf5Gas, AnEmptyDatasetOfAnAbsentTypeIsNoObstacle) {
  {
    const Hdf5Output file = create();
    make_group(file, "PartType5");
    const Hdf5Handle<H5Sclose> none(H5Screate(H5S_NULL));
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "PartType5/Coordinates",
                                                  H5T_IEEE_F32LE, none.id(), H5P_DEFAULT,
                                                  H5P_DEFAULT, H5P_DEFAULT));
  }
  EXPECT_EQ(open_snapshot(path_)->info().types.size(), 1U);
}

}  // namespace
}  // namespace splotchcl::test
