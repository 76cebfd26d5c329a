#include "formats/hdf5/hdf5_dialects.h"

#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace splotchcl::test
