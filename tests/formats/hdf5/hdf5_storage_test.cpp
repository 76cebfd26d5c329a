// How HDF5 stores a dataset, and what of it is not there.
#include "formats/hdf5/hdf5_column.h"
#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_checks.h"
#include "scene/particle_columns.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

using Properties = Hdf5Handle<H5Pclose>;

// Two particles, and the dataset Field with properties of its own.
class Hdf5Storage : public ::testing::Test {
 protected:
  Hdf5Storage() {
    make_group(file_, "Header");
    write_attribute(file_, "Header", "NumPart_ThisFile", {2});
    write_values(file_, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
  }
  void write_field(hid_t properties) {
    const hsize_t rows = 2;
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &rows, nullptr));
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file_.id(), "PartType0/Field", H5T_IEEE_F32LE,
                                                  space.id(), H5P_DEFAULT, properties,
                                                  H5P_DEFAULT));
    const float values[] = {7, 8};
    H5Dwrite(dataset.id(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  }
  std::string refusal_of_field() {
    file_ = Hdf5Output();
    const auto snapshot = open_snapshot(path_);
    return refusal_by<DataError>([&] { snapshot->read(0, "Field"); });
  }
  const Hdf5Silence silence_;
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap.hdf5";
  const Properties properties_ = Properties(H5Pcreate(H5P_DATASET_CREATE));
  Hdf5Output file_ = create_hdf5(path_);
};

TEST_F(Hdf5Storage, IsReadPieceByPieceToTheSameValues) {
  const hsize_t chunk = 1;
  H5Pset_chunk(properties_.id(), 1, &chunk);
  H5Pset_deflate(properties_.id(), 1);
  write_field(properties_.id());
  file_ = Hdf5Output();
  const Hdf5File file(path_);
  const Hdf5Values field = {path_, file.dataset("PartType0/Field")};
  const Hdf5Values places = {path_, file.dataset("PartType0/Coordinates")};
  const Column fields = read_streamed_column({field, field});
  EXPECT_TRUE(is_streamed(fields));
  EXPECT_EQ(fields[3], 8);
  EXPECT_THAT(values_of(fields), ElementsAre(7, 8, 7, 8));
  const Column moved = read_streamed_column({places, places}, {{1, 0, 0}}, 2);
  EXPECT_EQ(moved[7], 4);
  EXPECT_THAT(values_of(moved), ElementsAre(0, 4, 6, 6, 10, 12, 0, 4, 6, 6, 10, 12));
}

// The field's first value is another, which its checksum tells.
std::string damage_field(std::string file) {
  const float values[] = {7, 8};
  file.at(file.find(std::string(reinterpret_cast<const char*>(values), sizeof(values)))) ^= 1;
  return file;
}

TEST_F(Hdf5Storage, APieceThatCouldNotBeReadIsReadAgain) {
  const hsize_t chunk = 2;
  H5Pset_chunk(properties_.id(), 1, &chunk);
  H5Pset_fletcher32(properties_.id());
  write_field(properties_.id());
  file_ = Hdf5Output();
  const Column fields = read_streamed_column({{path_, Hdf5File(path_).dataset("PartType0/Field")}});
  const std::string whole = read_text(path_);
  write_bytes(path_, damage_field(whole));
  EXPECT_THROW(fields[0], DataError);
  EXPECT_THROW(fields[1], DataError);
  write_bytes(path_, whole);
  EXPECT_EQ(fields[0], 7);
}

TEST_F(Hdf5Storage, ChunksMayBePackedAndHaveChecksums) {
  const hsize_t chunk = 2;
  H5Pset_chunk(properties_.id(), 1, &chunk);
  H5Pset_shuffle(properties_.id());
  H5Pset_deflate(properties_.id(), 9);
  H5Pset_fletcher32(properties_.id());
  write_field(properties_.id());
  file_ = Hdf5Output();
  EXPECT_THAT(values_of(open_snapshot(path_)->read(0, "Field")), ElementsAre(7, 8));
}

std::size_t keep(unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) {
  return bytes;
}

TEST_F(Hdf5Storage, AFilterThatIsMissingIsNamed) {
  constexpr H5Z_filter_t id = 300;  // for testing, by HDF5's list
  const H5Z_class2_t filter = {H5Z_CLASS_T_VERS, id, 1, 1, "strange", nullptr, nullptr, keep};
  ASSERT_GE(H5Zregister(&filter), 0);
  const hsize_t chunk = 2;
  H5Pset_chunk(properties_.id(), 1, &chunk);
  H5Pset_filter(properties_.id(), id, H5Z_FLAG_MANDATORY, 0, nullptr);
  write_field(properties_.id());
  file_ = Hdf5Output();
  ASSERT_GE(H5Zunregister(id), 0);
  EXPECT_THAT(refusal_of_field(), HasSubstr("packed with strange (HDF5's filter 300)"));
}

TEST_F(Hdf5Storage, ValuesOutsideOfTheFileAreRefused) {
  H5Pset_external(properties_.id(), (folder_ / "values").c_str(), 0, H5F_UNLIMITED);
  write_field(properties_.id());
  EXPECT_THAT(refusal_of_field(), HasSubstr("lie outside of the file"));
}

// 10^12 of which two are mapped.
TEST_F(Hdf5Storage, AVirtualDatasetOfFewerPartsThanItClaimsIsRefused) {
  const hsize_t rows = 1000000000000, part = 2, first = 0;
  const Hdf5Handle<H5Sclose> all(H5Screate_simple(1, &rows, nullptr));
  const Hdf5Handle<H5Sclose> source(H5Screate_simple(1, &part, nullptr));
  H5Sselect_hyperslab(all.id(), H5S_SELECT_SET, &first, nullptr, &part, nullptr);
  write_values(file_, "values", {7, 8});
  H5Pset_virtual(properties_.id(), all.id(), ".", "values", source.id());
  {
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file_.id(), "PartType0/Large", H5T_IEEE_F32LE,
                                                  all.id(), H5P_DEFAULT, properties_.id(),
                                                  H5P_DEFAULT));
  }
  file_ = Hdf5Output();
  const Hdf5File file(path_);
  EXPECT_THAT([&] { file.check_complete(file.dataset("/PartType0/Large")); },
              ThrowsMessage<DataError>(HasSubstr("not all in the file")));
}

#if H5_VERSION_GE(1, 10, 7)
// As h5py does. HDF5 has a file open by one kind of locking only.
TEST(Hdf5, AFileThatTheProcessHasOpenByAnyLockingIsRead) {
  const TemporaryFolder folder;
  write_hdf5(folder / "snap", small_snapshot());
  for (const bool locks : {false, true}) {
    for (const bool goes_on_without : {false, true}) {
      const Properties properties(H5Pcreate(H5P_FILE_ACCESS));
      H5Pset_file_locking(properties.id(), locks, goes_on_without);
      const Hdf5Output open(H5Fopen((folder / "snap").c_str(), H5F_ACC_RDONLY, properties.id()));
      ASSERT_TRUE(open.is_valid());
      EXPECT_NO_THROW(open_snapshot(folder / "snap")) << locks << goes_on_without;
    }
  }
}
#endif

// It is never written to: HDF5 itself would follow it without end.
TEST_F(Hdf5Storage, AVirtualDatasetMadeOfItselfIsRefused) {
  const hsize_t rows = 2;
  const Hdf5Handle<H5Sclose> all(H5Screate_simple(1, &rows, nullptr));
  H5Pset_virtual(properties_.id(), all.id(), ".", "PartType0/Field", all.id());
  {
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file_.id(), "PartType0/Field", H5T_IEEE_F32LE,
                                                  all.id(), H5P_DEFAULT, properties_.id(),
                                                  H5P_DEFAULT));
  }
  EXPECT_THAT(refusal_of_field(), HasSubstr("which is missing"));
}

}  // namespace
}  // namespace splotchcl::test
