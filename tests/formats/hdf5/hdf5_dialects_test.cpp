// What codes write: their names, units and headers, and headers and rows that do not agree.
#include "formats/hdf5/described_hdf5.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

INSTANTIATE_TEST_SUITE_P(Dialects, DescribedHdf5,
                         ::testing::ValuesIn(snapshot_rows("hdf5/dialects.rows")), name_of_row);

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
  write_described_hdf5(
      path_,
      "gadget 2 0 0 0 0 0 | "
      "Header@ComovingIntegrationOn i32: 1 | Header@Time: 0.5 | Header@Redshift: 1 | "
      "Header@Omega_Matter: 0.3 | Header@Omega_Lambda: 0.7 | "
      "Header@HubbleParam: 0.7 | Header@UnitLength_In_CGS: 4.408111428571429e21 | "
      "Header@UnitMass_In_CGS: 2.841428571428571e43 | Header@UnitVelocity_In_CGS: 1e5");
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
