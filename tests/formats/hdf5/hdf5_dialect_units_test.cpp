// Units as codes state them.
#include "formats/hdf5/hdf5_dialects.h"
#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

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
TEST_F(Hdf5Dialects, UnitsInWordsCountWhereNothingElseStatesThem) {
  {
    const Hdf5Output file = create();
    write_values(file, "PartType0/Masses", {1, 2});
    write_text(file, "PartType0/Masses", "units", "Msun");
  }
  EXPECT_EQ(unit_of("mass"), "Msun");
}

TEST_F(Hdf5Dialects, SmoothingLengthsAreInTheUnitOfPositions) {
  {
    const Hdf5Output file = create();
    write_text(file, "PartType0/Coordinates", "units", "Mpc");
    write_values(file, "PartType0/SmoothingLength", {500, 2000});
    write_text(file, "PartType0/SmoothingLength", "units", "kpc");
  }
  EXPECT_EQ(unit_of("smoothing_length"), "Mpc");
  EXPECT_THAT(values_of(open_snapshot(path_)->read(0, "smoothing_length")),
              ::testing::ElementsAre(0.5F, 2));
}

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

}  // namespace
}  // namespace splotchcl::test
