#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

class Hdf5Layout : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "particles.h5";
};

// {pos: 3 floats, more: {id: 64 bits}, name: text}
TEST_F(Hdf5Layout, ArraysAndRecordsInRecordsAreRead) {
  struct Record {
    float position[3];
    std::uint64_t id;
    char name[4];
  };
  const std::array<Record, 2> records = {
      {{{1, 2, 3}, 18446744073709551615U, "abc"}, {{4, 5, 6}, 7, "d"}}};
  {
    const Hdf5Output file = create_hdf5(path_);
    const hsize_t three = 3, rows = records.size();
    const Hdf5Handle<H5Tclose> vector(H5Tarray_create2(H5T_NATIVE_FLOAT, 1, &three));
    const Hdf5Handle<H5Tclose> text(H5Tcopy(H5T_C_S1));
    H5Tset_size(text.id(), 4);
    const Hdf5Handle<H5Tclose> inner(H5Tcreate(H5T_COMPOUND, sizeof(std::uint64_t)));
    H5Tinsert(inner.id(), "id", 0, H5T_NATIVE_UINT64);
    const Hdf5Handle<H5Tclose> record(H5Tcreate(H5T_COMPOUND, sizeof(Record)));
    H5Tinsert(record.id(), "pos", offsetof(Record, position), vector.id());
    H5Tinsert(record.id(), "more", offsetof(Record, id), inner.id());
    H5Tinsert(record.id(), "name", offsetof(Record, name), text.id());
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &rows, nullptr));
    const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), "table", record.id(), space.id(),
                                                  H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Dwrite(dataset.id(), record.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, records.data());
  }
  expect_snapshot(path_, {}, "position 1 2 3 4 5 6 | note left out of /table");
  EXPECT_THAT(open_snapshot(path_)->read_integers(0, "more.id"),
              ElementsAre(18446744073709551615U, 7U));
}

TEST_F(Hdf5Layout, OtherNamesOfAGroupAreNoMoreParticles) {
  const auto write_with_link = [this](const std::string& group, const std::string& target) {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, group + "/pos", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, group + "/mass", {7, 8});
    H5Lcreate_soft(target.c_str(), file.id(), "dm", H5P_DEFAULT, H5P_DEFAULT);
  };
  write_with_link("gas", "/gas");
  expect_snapshot(path_, {}, "types 1 | mass/0 7 8");
  write_with_link("1/2/3/4/5/6/7/8", "/1/2/3/4/5/6/7/8");  // where nobody looks for particles
  expect_snapshot(path_, {}, "types 1 | mass/1 7 8");
}

TEST_F(Hdf5Layout, UnitsThatAstropyKeepsBesideATableAreRead) {
  {
    const Hdf5Output file = create_hdf5(path_);
    write_records(file, "galaxy", {"x", "y", "z", "hsml"}, {1, 2, 3, 500, 4, 5, 6, 700});
    write_lines(
        file, "galaxy.__table_column_meta__",
        {"datatype:", "- {name: x, unit: kpc, datatype: float64}",
         "- {name: y, unit: kpc, datatype: float64}", "- {name: z, unit: kpc, datatype: float64}",
         "- {name: hsml, unit: pc, datatype: float64}"});
  }
  expect_snapshot(path_, {}, "unit position kpc | smoothing_length 0.5 0.7");
}

// format="table": arrays in records, whose columns attributes name as Python pickles lists.
TEST_F(Hdf5Layout, TablesOfPandasAreRead) {
  struct Row {
    double index, block[4];
  };
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "df");
    const hsize_t columns = 4, count = 2;
    const Hdf5Handle<H5Tclose> block(H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &columns));
    const Hdf5Handle<H5Tclose> type(H5Tcreate(H5T_COMPOUND, sizeof(Row)));
    H5Tinsert(type.id(), "index", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(type.id(), "values_block_0", sizeof(double), block.id());
    const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &count, nullptr));
    const Hdf5Handle<H5Dclose> table(H5Dcreate2(file.id(), "df/table", type.id(), space.id(),
                                                H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    const Row rows[] = {{0, {1, 2, 3, 10}}, {1, {4, 5, 6, 20}}};
    H5Dwrite(table.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows);
    write_text(file, "df/table", "values_block_0_kind",
               "(lp0\nVx\np1\naVy\np2\naVz\np3\naVmass\np4\na.");
  }
  expect_snapshot(path_, {}, "position 1 2 3 4 5 6 | mass 10 20");
}

// A link back to the root makes the tree of groups endless.
TEST_F(Hdf5Layout, GroupsThatLeadInCirclesHaveAnEnd) {
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "a");
    H5Lcreate_soft("/", file.id(), "a/b", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/", file.id(), "a/c", H5P_DEFAULT, H5P_DEFAULT);
  }
  expect_snapshot(path_, {}, "refused no positions");
}

}  // namespace
}  // namespace splotchcl::test
