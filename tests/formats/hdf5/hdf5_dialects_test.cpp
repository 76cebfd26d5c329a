#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two cells or particles of gas in a group Header and PartType0.
class Hdf5Dialects : public ::testing::Test {
 protected:
  Hdf5Output create(const std::vector<double>& counts = {2, 0, 0, 0, 0, 0}) const {
    Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", counts);
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    return file;
  }
  // Of SWIFT, in Mpc, 1e10 solar masses and some gigayears.
  Hdf5Output create_swift() const {
    Hdf5Output file = create();
    make_group(file, "Code");
    write_text(file, "Code", "Code", "SWIFT");
    make_group(file, "Units");
    write_attribute(file, "Units", "Unit length in cgs (U_L)", {3.08567758e24});
    write_attribute(file, "Units", "Unit mass in cgs (U_M)", {1.98841e43});
    write_attribute(file, "Units", "Unit time in cgs (U_t)", {3.08567758e19});
    return file;
  }
  // Of mass, length, time and current.
  static void state_powers(const Hdf5Output& file, const std::string& dataset,
                           const std::vector<double>& powers) {
    const std::vector<const char*> names = {"U_M exponent", "U_L exponent", "U_t exponent",
                                            "U_I exponent"};
    for (std::size_t i = 0; i < names.size(); ++i)
      write_attribute(file, dataset, names[i], {powers[i]});
  }
  // Of a field of gas.
  std::string unit_of(const char* field) const {
    const auto snapshot = open_snapshot(path_);
    return find_field(*snapshot->info().find_type(0), field)->unit;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap.hdf5";
};

TEST_F(Hdf5Dialects, GizmoIsTold) {
  {
    const Hdf5Output file = create();
    write_attribute(file, "Header", "GIZMO_version", {2022});
    write_values(file, "PartType0/SmoothingLength", {0.5, 0.25});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "GIZMO HDF5");
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.5F, 0.25F));
}

// What GIZMO's io.c writes: its units divided by the Hubble parameter.
TEST_F(Hdf5Dialects, GizmosUnitsAreThoseOfItsHeader) {
  {
    const Hdf5Output file = create();
    write_attribute(file, "Header", "ComovingIntegrationOn", {1}, H5T_STD_I32LE);
    write_attribute(file, "Header", "Time", {0.5});
    write_attribute(file, "Header", "Redshift", {1});
    write_attribute(file, "Header", "Omega_Matter", {0.3});
    write_attribute(file, "Header", "Omega_Lambda", {0.7});
    write_attribute(file, "Header", "HubbleParam", {0.7});
    write_attribute(file, "Header", "UnitLength_In_CGS", {3.085678e21 / 0.7});
    write_attribute(file, "Header", "UnitMass_In_CGS", {1.989e43 / 0.7});
    write_attribute(file, "Header", "UnitVelocity_In_CGS", {1e5});
    write_values(file, "PartType0/Masses", {1, 2});
    write_values(file, "PartType0/Density", {1, 2});
    write_values(file, "PartType0/InternalEnergy", {1, 2});
    write_values(file, "PartType0/Velocities", {1, 2, 3, 4, 5, 6}, 3);
  }
  EXPECT_EQ(unit_of("position"), "kpc h^-1 a");
  EXPECT_EQ(unit_of("mass"), "1e10 M_sun h^-1");
  EXPECT_EQ(unit_of("density"), "1e10 M_sun kpc^-3 h^2 a^-3");
  EXPECT_EQ(unit_of("velocity"), "km/s a^0.5");
  EXPECT_EQ(unit_of("internal_energy"), "(km/s)^2");
  const auto snapshot = open_snapshot(path_);
  ASSERT_TRUE(snapshot->info().cosmology);
  EXPECT_EQ(snapshot->info().cosmology->scale_factor, 0.5);
  EXPECT_EQ(snapshot->info().cosmology->omega_matter, 0.3);
  EXPECT_EQ(snapshot->info().cosmology->velocity_power, 0.5);
  EXPECT_NEAR(snapshot->info().cosmology->hubble_rate, 0.1, 1e-6);
}

// Clouds that form stars, in parsecs, solar masses and meters per second; their time is a time.
TEST_F(Hdf5Dialects, GizmoHasNoScaleFactorWithoutCosmology) {
  {
    const Hdf5Output file = create();
    write_attribute(file, "Header", "ComovingIntegrationOn", {0}, H5T_STD_I32LE);
    write_attribute(file, "Header", "Time", {1});
    write_attribute(file, "Header", "Redshift", {0});
    write_attribute(file, "Header", "HubbleParam", {1});
    write_attribute(file, "Header", "UnitLength_In_CGS", {3.085678e18});
    write_attribute(file, "Header", "UnitMass_In_CGS", {1.989e33});
    write_attribute(file, "Header", "UnitVelocity_In_CGS", {100});
    write_values(file, "PartType0/Masses", {1, 2});
    write_values(file, "PartType0/Velocities", {1, 2, 3, 4, 5, 6}, 3);
  }
  EXPECT_EQ(unit_of("position"), "pc");
  EXPECT_EQ(unit_of("mass"), "M_sun");
  EXPECT_EQ(unit_of("velocity"), "100 cm/s");
  const auto snapshot = open_snapshot(path_);
  EXPECT_FALSE(snapshot->info().cosmology);
  EXPECT_FALSE(snapshot->info().redshift);
}

TEST_F(Hdf5Dialects, OlderGizmoFilesNameNoUnits) {
  {
    const Hdf5Output file = create();
    write_attribute(file, "Header", "GIZMO_version", {2017});
    write_attribute(file, "Header", "HubbleParam", {0.7});
  }
  EXPECT_EQ(unit_of("position"), "");
}

TEST_F(Hdf5Dialects, MassesOfGadgetFoursTableHaveItsUnitOfMass) {
  {
    const Hdf5Output file = create();
    make_group(file, "Parameters");
    write_attribute(file, "Header", "MassTable", {3, 0, 0, 0, 0, 0});
    write_attribute(file, "Parameters", "UnitMass_in_g", {1.989e43});
    write_attribute(file, "PartType0/Coordinates", "h_scaling", {-1});
  }
  EXPECT_EQ(unit_of("mass"), "1e10 M_sun h^-1");
}

// The power of the scale factor that SWIFT states counts where values are comoving.
TEST_F(Hdf5Dialects, WhatSwiftStoresAsPhysicalHasNoPowerOfTheScaleFactor) {
  for (const double is_physical : {0.0, 1.0}) {
    {
      const Hdf5Output file = create_swift();
      write_values(file, "PartType0/Densities", {1, 2});
      state_powers(file, "PartType0/Densities", {1, -3, 0, 0});
      write_attribute(file, "PartType0/Densities", "a-scale exponent", {-3});
      write_attribute(file, "PartType0/Densities", "Value stored as physical", {is_physical});
    }
    EXPECT_EQ(unit_of("density"),
              is_physical != 0 ? "1e10 M_sun Mpc^-3" : "1e10 M_sun Mpc^-3 a^-3");
  }
}

// Tesla are kilograms over amperes and seconds squared.
TEST_F(Hdf5Dialects, SwiftsUnitsOfCurrentsAreNotNamed) {
  {
    const Hdf5Output file = create_swift();
    write_values(file, "PartType0/MagneticFluxDensities", {1, 2, 3, 4, 5, 6}, 3);
    state_powers(file, "PartType0/MagneticFluxDensities", {1, 0, -2, -1});
  }
  EXPECT_EQ(unit_of("MagneticFluxDensities"), "");
}

// IllustrisTNG's rates are in solar masses per year, though the powers that it states give
// 1e10 M_sun km / (kpc s).
TEST_F(Hdf5Dialects, AStatedSizeOfAUnitCountsBeforeThatOfItsProduct) {
  const std::string rates = "PartType0/StarFormationRate", masses = "PartType0/Masses";
  for (const double to_cgs : {6.30387e25, 1e20}) {
    {
      const Hdf5Output file = create();
      write_attribute(file, "Header", "UnitLength_in_cm", {3.085678e21});
      write_attribute(file, "Header", "UnitMass_in_g", {1.989e43});
      write_attribute(file, "Header", "UnitVelocity_in_cm_per_s", {1e5});
      write_values(file, rates, {1, 2});
      write_values(file, masses, {1, 2});
      for (const auto& [name, power] : std::vector<std::pair<const char*, double>>{
               {"mass_scaling", 1}, {"length_scaling", -1}, {"velocity_scaling", 1}})
        write_attribute(file, rates, name, {power});
      write_attribute(file, rates, "to_cgs", {to_cgs});
      write_attribute(file, masses, "mass_scaling", {1});
      write_attribute(file, masses, "h_scaling", {-1});
      write_attribute(file, masses, "to_cgs", {1.989e43});
    }
    EXPECT_EQ(unit_of("star_formation_rate"), to_cgs == 1e20 ? "1e+20 g s^-1" : "M_sun/yr");
    EXPECT_EQ(unit_of("mass"), "1e10 M_sun h^-1");
  }
}

TEST_F(Hdf5Dialects, SwiftsUnitsHaveNoScaleFactorWithoutCosmology) {
  for (const double is_cosmological : {0.0, 1.0}) {
    {
      const Hdf5Output file = create_swift();
      make_group(file, "Cosmology");
      write_attribute(file, "Cosmology", "Cosmological run", {is_cosmological});
      state_powers(file, "PartType0/Coordinates", {0, 1, 0, 0});
      write_attribute(file, "PartType0/Coordinates", "a-scale exponent", {1});
    }
    EXPECT_EQ(unit_of("position"), is_cosmological != 0 ? "Mpc a" : "Mpc");
  }
}

// EAGLE's files say how large a unit is, not what it is one of.
TEST_F(Hdf5Dialects, EaglesUnitsAreRead) {
  {
    const Hdf5Output file = create();
    const auto state = [&file](const std::string& field, double in_cgs, double a, double h) {
      const std::string path = "PartType0/" + field;
      write_attribute(file, path, "CGSConversionFactor", {in_cgs});
      write_attribute(file, path, "aexp-scale-exponent", {a});
      write_attribute(file, path, "h-scale-exponent", {h});
    };
    for (const char* const field : {"Mass", "Density", "InternalEnergy", "Temperature", "Entropy",
                                    "StarFormationRate", "Metallicity"})
      write_values(file, std::string("PartType0/") + field, {1, 2});
    write_values(file, "PartType0/Velocity", {1, 2, 3, 4, 5, 6}, 3);
    state("Coordinates", 3.085678e24, 1, -1);
    state("Mass", 1.989e43, 0, -1);
    state("Density", 6.769911178294543e-31, -3, 2);
    state("Velocity", 1e5, 0.5, 0);
    state("InternalEnergy", 1e10, 0, 0);
    state("Temperature", 1, 0, 0);
    state("StarFormationRate", 6.30387e25, 0, 0);
    state("Metallicity", 1, 0, 0);
    state("Entropy", 7e-22, 0, 0);
  }
  EXPECT_EQ(unit_of("position"), "Mpc h^-1 a");
  EXPECT_EQ(unit_of("mass"), "1e10 M_sun h^-1");
  EXPECT_EQ(unit_of("density"), "1e10 M_sun Mpc^-3 h^2 a^-3");
  EXPECT_EQ(unit_of("velocity"), "km/s a^0.5");
  EXPECT_EQ(unit_of("internal_energy"), "(km/s)^2");
  EXPECT_EQ(unit_of("temperature"), "K");
  EXPECT_EQ(unit_of("star_formation_rate"), "M_sun/yr");
  EXPECT_EQ(unit_of("metallicity"), "");
  EXPECT_EQ(unit_of("entropy"), "");
}

TEST_F(Hdf5Dialects, InitialConditionsForSwiftHaveTheKernelsScale) {
  {
    const Hdf5Output file = create();
    make_group(file, "Units");
    write_attribute(file, "Units", "Unit length in cgs (U_L)", {3.08567758e24});
    write_values(file, "PartType0/SmoothingLength", {0.5, 0.25});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "SWIFT initial conditions, HDF5");
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")),
              ElementsAre(0.5F * 1.825742F, 0.25F * 1.825742F));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("the cubic spline's is taken")));
}

TEST_F(Hdf5Dialects, ArepoIsToldByItsCells) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/CenterOfMass", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "PartType0/Volume", {8, 27});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "AREPO HDF5");
  EXPECT_THAT(values_of(snapshot->read(0, "volume")), ElementsAre(8, 27));
}

TEST_F(Hdf5Dialects, TracersWithoutPositionsAreLeftOutWithANote) {
  {
    const Hdf5Output file = create({2, 0, 0, 3, 0, 0});
    write_attribute(file, "Header", "NumPart_Total", {2, 0, 0, 3, 0, 0});
    write_values(file, "PartType3/TracerID", {1, 2, 3}, 1, H5T_STD_U64LE);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("tracers of PartType3")));
}

TEST_F(Hdf5Dialects, CountsOfZeroOrNonsenseInTheHeaderAreTakenFromTheRows) {
  for (const std::vector<double>& counts :
       {std::vector<double>{0, 0, 0, 0, 0, 0}, {-1, 0, 0, 0, 0, 0}, {1e300, 0.5}, {0}}) {
    create(counts);
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("those of the rows of the positions")));
  }
}

TEST_F(Hdf5Dialects, RowsCountWhereTheHeaderClaimsMoreOrFewer) {
  for (const double count : {1.0, 3.0, 1e15}) {
    create({count, 0, 0, 0, 0, 0});
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
    EXPECT_EQ(snapshot->read(0, "position").size(), 6U);
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("Coordinates has 2 rows: these count")));
  }
}

TEST_F(Hdf5Dialects, RowsOfATypeThatTheHeaderDoesNotCountAreParticles) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType6/Coordinates", {7, 8, 9}, 3);
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().find_type(6)->count, 1U);
  EXPECT_EQ(snapshot->read(6, "position")[0] + static_cast<float>(snapshot->position_origin().a[0]),
            7);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("counts 0 particles of type 6")));
}

TEST_F(Hdf5Dialects, ATypeWithoutItsGroupIsLeftOutWithANote) {
  {
    const Hdf5Output file = create({2, 1157, 0, 0, 0, 0});
    write_attribute(file, "Header", "NumPart_Total", {2, 1157, 0, 0, 0, 0});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes,
              Contains(HasSubstr("counts 1157 particles, but there is no such group")));
}

TEST_F(Hdf5Dialects, ATypeWithoutPositionsIsLeftOutWithANote) {
  {
    const Hdf5Output file = create({2, 0, 0, 0, 3, 0});
    write_values(file, "PartType4/Masses", {1, 2, 3});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("PartType4 is left out")));
}

TEST_F(Hdf5Dialects, DatasetsOfOtherLengthsAreLeftOutWithANote) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/Center", {50, 51, 52});
    write_values(file, "PartType0/Masses", {4, 5});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_FALSE(has_field(*snapshot, 0, "Center"));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(4, 5));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("other than 2 rows: Center (3)")));
}

TEST_F(Hdf5Dialects, AnEmptyDatasetOfAnAbsentTypeIsNoObstacle) {
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

// As h5py writes numpy's: an enumeration.
TEST_F(Hdf5Dialects, TruthValuesAreNumbers) {
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

TEST_F(Hdf5Dialects, APartOfASwiftFileWithoutItsCodeHasTheKernelsScaleAndItsUnits) {
  const char* const in_cgs = "Conversion factor to CGS (not including cosmological corrections)";
  for (const std::string group : {"PartType0", "PartType4"}) {
    {
      const Hdf5Output file = create({2, 0, 0, 0, 2, 0});
      write_values(file, "PartType4/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
      write_values(file, group + "/SmoothingLengths", {0.5, 0.25});
      write_attribute(file, group + "/Coordinates", in_cgs, {3.08567758e24});
      write_attribute(file, group + "/Coordinates", "a-scale exponent", {1});
      write_attribute(file, group + "/SmoothingLengths", in_cgs, {3.08567758e24});
    }
    const int type = group == "PartType0" ? 0 : 4;
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().format, "SWIFT HDF5");
    EXPECT_THAT(values_of(snapshot->read(type, "smoothing_length")),
                ElementsAre(0.5F * 1.825742F, 0.25F * 1.825742F));
    EXPECT_EQ(find_field(*snapshot->info().find_type(type), "position")->unit, "Mpc a");
    EXPECT_EQ(find_field(*snapshot->info().find_type(type), "smoothing_length")->unit, "Mpc");
  }
}

TEST_F(Hdf5Dialects, WhereGizmosKernelEndsGoesByItsNewNameToo) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/KernelMaxRadius", {0.5, 0.25});
    write_values(file, "PartType0/Volume", {8, 27});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "Gadget HDF5");
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.5F, 0.25F));
}

// That of gas reaches to dark matter, and not to gas.
TEST_F(Hdf5Dialects, SubfindsAndStarsLengthsAreThoseOfTheirOwnType) {
  {
    const Hdf5Output file = create({2, 1, 0, 0, 1, 0});
    write_values(file, "PartType1/Coordinates", {1, 2, 3}, 3);
    write_values(file, "PartType4/Coordinates", {4, 5, 6}, 3);
    write_values(file, "PartType0/SubfindHsml", {7, 8});
    write_values(file, "PartType1/SubfindHsml", {9});
    write_values(file, "PartType4/StellarHsml", {0.75});
    write_values(file, "PartType4/SubfindHsml", {10});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_FALSE(has_field(*snapshot, 0, "smoothing_length"));
  EXPECT_THAT(values_of(snapshot->read(1, "smoothing_length")), ElementsAre(9));
  EXPECT_THAT(values_of(snapshot->read(4, "smoothing_length")), ElementsAre(0.75F));
}

TEST_F(Hdf5Dialects, SwiftsNegativeRatesOfStarFormationAreNone) {
  {
    const Hdf5Output file = create_swift();
    write_values(file, "PartType0/StarFormationRates", {-0.75, 2});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "star_formation_rate")), ElementsAre(0, 2));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("they count as 0")));
}

TEST_F(Hdf5Dialects, TotalsThatAreNonsenseAreIgnoredWithANote) {
  {
    const Hdf5Output file = create();
    write_attribute(file, "Header", "NumPart_Total", {-2, 0, 0, 0, 0, 0});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("NumPart_Total holds -2")));
}

TEST_F(Hdf5Dialects, IdentifiersOfAnyWidthAreExact) {
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

TEST_F(Hdf5Dialects, SingularAndPluralNamesMeanTheSame) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/Densities", {1, 2});
    write_values(file, "PartType0/InternalEnergies", {3, 4});
    write_values(file, "PartType0/SmoothingLengths", {5, 6});
    write_values(file, "PartType0/Velocity", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "PartType0/Mass", {7, 8});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "density")), ElementsAre(1, 2));
  EXPECT_THAT(values_of(snapshot->read(0, "internal_energy")), ElementsAre(3, 4));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "velocity")), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
}

TEST_F(Hdf5Dialects, AHeaderOfArraysOfAnyLengthIsRead) {
  for (const std::size_t types : {1U, 2U, 7U, 20U}) {
    std::vector<double> counts(types, 0);
    counts[0] = 2;
    {
      const Hdf5Output file = create(counts);
      write_attribute(file, "Header", "Time", {0.5, 9, 9});
      write_attribute(file, "Header", "BoxSize", {64, 64, 64});
      write_attribute(file, "Header", "MassTable", {3});
    }
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().time, 0.5) << types;
    EXPECT_EQ(snapshot->info().box_size, 64) << types;
    EXPECT_EQ(snapshot->read(0, "mass").uniform_value(), 3) << types;
  }
}

TEST_F(Hdf5Dialects, FieldsThatTheHeaderDoesNotCountAndNoCoordinatesAreLeftOut) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType3/Masses", {1, 2});
  }
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().types.size(), 1U);
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("PartType3 is left out")));
}

TEST_F(Hdf5Dialects, CoordinatesOfOtherWidthsAreRefusedWithTheirs) {
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {2});
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4}, 2);
  }
  EXPECT_THAT(refusal(path_), HasSubstr("only Coordinates of 2 columns"));
}

TEST_F(Hdf5Dialects, WithoutCoordinatesIsRefused) {
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {2});
    write_values(file, "PartType0/Masses", {1, 2});
  }
  EXPECT_THAT(refusal(path_), HasSubstr("expected a dataset Coordinates"));
}

}  // namespace
}  // namespace splotchcl
