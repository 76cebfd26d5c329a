#include "formats/numpy/numpy_writer.h"
#include "formats/snapshot_checks.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class NumpyArray : public ::testing::Test {
 protected:
  void write(const std::string& type, const std::string& shape, const std::string& values) const {
    write_bytes(path_, numpy_bytes(numpy_header(type, shape), values));
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "a.npy";
};

TEST_F(NumpyArray, RowsOfThreeArePositions) {
  write("<f4", "(2, 3)", bytes_of<float>({1, 2, 3, 4, 5, 6}));
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "NumPy array");
  EXPECT_EQ(snapshot->info().find_type(0)->count, 2U);
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(NumpyArray, FloatsAreTakenAsTheyAre) {
  const std::vector<float> stored = {1e-7F, 0, 0, 1000, 0, 0, 1001, 0, 0};
  write("<f4", "(3, 3)", bytes_of<float>(stored));
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(values_of(snapshot->read(0, "position")), stored);
  EXPECT_EQ(snapshot->position_origin().a[0], 0);
}

TEST_F(NumpyArray, DoublesAreOffsetsFromAnOrigin) {
  const std::vector<double> stored = {1e6 + 1e-7, 0, 0, 1e6, 0, 0, 1e6, 0, 0};
  write("<f8", "(3, 3)", bytes_of<double>(stored));
  EXPECT_NEAR(absolute_positions(*open_snapshot(path_), 0)[0], stored[0], 1e-9);
}

TEST_F(NumpyArray, HalvesAreRead) {
  // 1, -2, the largest, the smallest, infinity, a third.
  write("<f2", "(2, 3)", bytes_of<std::uint16_t>({0x3c00, 0xc000, 0x7bff, 0x0001, 0x7c00, 0x3555}));
  EXPECT_THAT(absolute_positions(*open_snapshot(path_), 0),
              ElementsAre(1, -2, 65504, 5.960464477539063e-8,
                          std::numeric_limits<double>::infinity(), 0.333251953125));
}

TEST_F(NumpyArray, FurtherColumnsHaveNumbersOrTheNamesThatAreGiven) {
  write("<f8", "(2, 5)", bytes_of<double>({1, 2, 3, 7, 8, 4, 5, 6, 9, 10}));
  const auto plain = open_snapshot(path_);
  EXPECT_THAT(values_of(plain->read(0, "column_4")), ElementsAre(7, 9));
  const auto named = open_snapshot(path_, {{"mass", "-", "x", "y", "z"}});
  EXPECT_THAT(values_of(named->read(0, "mass")), ElementsAre(1, 4));
  EXPECT_THAT(absolute_positions(*named, 0), ElementsAre(3, 7, 8, 6, 9, 10));
  EXPECT_FALSE(has_field(*named, 0, "column_2"));
}

TEST_F(NumpyArray, ThatIsAnImageIsRefused) {
  for (const char* const shape : {"(6, 64)", "(2, 3, 64)"}) {
    write("<f4", shape, bytes_of(std::vector<float>(384, 1)));
    EXPECT_THAT(refusal(path_), HasSubstr("as images and maps are"));
  }
}

TEST_F(NumpyArray, OfManyColumnsIsReadByTheirNames) {
  write("<f4", "(6, 64)", bytes_of(std::vector<float>(384, 1)));
  std::vector<std::string> names(64, "-");
  names[0] = "x", names[1] = "y", names[2] = "z";
  EXPECT_EQ(open_snapshot(path_, {names})->info().find_type(0)->count, 6U);
}

TEST_F(NumpyArray, FortranOrderAndBigEndianAreRead) {
  std::string data = bytes_of<float>({1, 4, 2, 5, 3, 6});
  for (std::size_t i = 0; i < data.size(); i += 4)
    std::reverse(data.begin() + static_cast<std::ptrdiff_t>(i),
                 data.begin() + static_cast<std::ptrdiff_t>(i) + 4);
  write_bytes(path_, numpy_bytes(numpy_header(">f4", "(2, 3)", true), data));
  EXPECT_THAT(absolute_positions(*open_snapshot(path_), 0), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(NumpyArray, RecordsWithNamesAreRead) {
  const std::string header =
      "{'descr': [('pos', '<f8', (3,)), ('hsml', '<f4'), ('id', '<u8'), ('name', '<U2'), "
      "('flag', '|b1')], 'fortran_order': False, 'shape': (2,)}";
  std::string data;
  for (std::uint64_t i = 0; i < 2; ++i) {
    const double first = 10.0 * static_cast<double>(i);
    data += bytes_of<double>({first, first + 1, first + 2});
    data += bytes_of<float>({static_cast<float>(first) + 0.5F});
    data += bytes_of<std::uint64_t>({(std::uint64_t{1} << 63) + i});
    data += std::string(8, 'x') + static_cast<char>(i);
  }
  write_bytes(path_, numpy_bytes(header, data, 2));
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(0, 1, 2, 10, 11, 12));
  EXPECT_THAT(values_of(snapshot->read(0, "smoothing_length")), ElementsAre(0.5F, 10.5F));
  EXPECT_THAT(values_of(snapshot->read(0, "flag")), ElementsAre(0, 1));
  EXPECT_THAT(snapshot->read_ids(0),
              ElementsAre(std::uint64_t{1} << 63, (std::uint64_t{1} << 63) + 1));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("name")));
}

TEST_F(NumpyArray, TruncatedAtAnyByteIsRefused) {
  const std::string whole =
      numpy_bytes(numpy_header("<f4", "(2, 3)"), bytes_of<float>({1, 2, 3, 4, 5, 6}));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(path_, whole.substr(0, size));
    ASSERT_NE(refusal(path_), "") << "cut to " << size << " bytes";
  }
  write_bytes(path_, whole + "x");
  EXPECT_THAT(refusal(path_), HasSubstr("25 bytes of values, expected 24"));
}

TEST_F(NumpyArray, ShapesThatOverflowAreRefused) {
  write("<f4", "(4611686018427387904, 3)", std::string(24, 'x'));
  EXPECT_THAT(refusal(path_), HasSubstr("overflows"));
  write("<f4", "(1000000000000, 3)", std::string(24, 'x'));
  EXPECT_THAT(refusal(path_), HasSubstr("24 bytes of values"));
}

TEST_F(NumpyArray, TwoColumnsAreNotPositions) {
  write("<f4", "(3, 2)", bytes_of<float>({1, 2, 3, 4, 5, 6}));
  EXPECT_THAT(refusal(path_), HasSubstr("save its transpose"));
}

TEST_F(NumpyArray, HeadersThatAreNoPythonAreRefused) {
  for (const char* header :
       {"", "{'descr': '<f4'", "{'descr': '<f4', 'shape': (2, 3)}", "[[[[[[[[[[[[[[[[[[[[[[",
        "{'descr': 'f', 'fortran_order': False, 'shape': (2, 3)}",
        "{'descr': [('x', [('y', '<f4')])], 'fortran_order': False, 'shape': (2,)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (-2, 3)}"}) {
    write_bytes(path_, numpy_bytes(header, std::string(24, 'x')));
    EXPECT_NE(refusal(path_), "") << header;
  }
}

TEST_F(NumpyArray, OfPythonsObjectsIsRefusedByTheirName) {
  write("|O", "(2,)", "a pickle");
  EXPECT_THAT(refusal(path_), HasSubstr("objects of Python"));
}

class NumpyArchive : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Packing, NumpyArchive, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "Packed" : "Stored"; });

TEST_P(NumpyArchive, ArraysBecomeFields) {
  const TemporaryFolder folder;
  write_zip(
      folder / "a.npz",
      {{"pos.npy",
        numpy_bytes(numpy_header("<f8", "(2, 3)"), bytes_of<double>({1, 2, 3, 4, 5, 6}))},
       {"mass.npy", numpy_bytes(numpy_header("<f4", "(2,)"), bytes_of<float>({7, 8}))},
       {"ids.npy", numpy_bytes(numpy_header("<i8", "(2,)"), bytes_of<std::int64_t>({5, 6}))},
       {"halo_mass.npy", numpy_bytes(numpy_header("<f4", "(3,)"), bytes_of<float>({7, 8, 9}))},
       {"time.npy", numpy_bytes(numpy_header("<f8", "()"), bytes_of<double>({0.25}))},
       {"BoxSize.npy", numpy_bytes(numpy_header("<f8", "()"), bytes_of<double>({64}))}},
      GetParam());
  const auto snapshot = open_snapshot(folder / "a.npz");
  EXPECT_EQ(snapshot->info().format, "NumPy archive");
  EXPECT_EQ(snapshot->info().time, 0.25);
  EXPECT_EQ(snapshot->info().box_size, 64);
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
  EXPECT_THAT(snapshot->read_ids(0), ElementsAre(5, 6));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("halo_mass")));
}

TEST_P(NumpyArchive, AxesInArraysOfTheirOwnAreJoined) {
  const TemporaryFolder folder;
  const auto axis = [](const std::vector<float>& values) {
    return numpy_bytes(numpy_header("<f4", "(2,)"), bytes_of(values));
  };
  write_zip(folder / "a.npz",
            {{"z.npy", axis({3, 6})}, {"y.npy", axis({2, 5})}, {"x.npy", axis({1, 4})}},
            GetParam());
  EXPECT_THAT(absolute_positions(*open_snapshot(folder / "a.npz"), 0),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_P(NumpyArchive, AnAxisOfAnotherLengthIsNotTakenForZero) {
  const TemporaryFolder folder;
  const std::string two = numpy_bytes(numpy_header("<f4", "(2,)"), bytes_of<float>({1, 4}));
  const std::string three = numpy_bytes(numpy_header("<f4", "(3,)"), bytes_of<float>({1, 4, 7}));
  write_zip(folder / "a.npz", {{"x.npy", two}, {"y.npy", two}, {"z.npy", three}}, GetParam());
  EXPECT_THAT([&] { open_snapshot(folder / "a.npz"); },
              ThrowsMessage<DataError>(HasSubstr("z is not one number for each of 2")));
}

TEST_P(NumpyArchive, ASingleMassIsThatOfAllParticles) {
  const TemporaryFolder folder;
  write_zip(
      folder / "a.npz",
      {{"pos.npy", numpy_bytes(numpy_header("<f4", "(2, 3)"), bytes_of<float>({1, 2, 3, 4, 5, 6}))},
       {"mass.npy", numpy_bytes(numpy_header("<f8", "()"), bytes_of<double>({2.5}))}},
      GetParam());
  EXPECT_THAT(values_of(open_snapshot(folder / "a.npz")->read(0, "mass")), ElementsAre(2.5F, 2.5F));
}

TEST_P(NumpyArchive, TheOnlyRowsOfThreeThatAreNothingElseArePositions) {
  const TemporaryFolder folder;
  const std::string threes =
      numpy_bytes(numpy_header("<f8", "(2, 3)"), bytes_of<double>({1, 2, 3, 4, 5, 6}));
  for (const char* name : {"arr_0.npy", "r.npy", "x.npy", "particles.npy"}) {
    write_zip(folder / "a.npz",
              {{"a_number_of_haloes.npy",
                numpy_bytes(numpy_header("<f4", "(3,)"), bytes_of<float>({7, 8, 9}))},
               {"mass.npy", numpy_bytes(numpy_header("<f4", "(2,)"), bytes_of<float>({7, 8}))},
               {name, threes},
               {"vel.npy", threes}},
              GetParam());
    const auto snapshot = open_snapshot(folder / "a.npz");
    EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6)) << name;
    EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8)) << name;
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("taken for the positions"))) << name;
  }
}

TEST_P(NumpyArchive, ArraysOfPythonsObjectsAreLeftOutWithANote) {
  const TemporaryFolder folder;
  write_zip(folder / "a.npz",
            {{"about.npy", numpy_bytes(numpy_header("|O", "()"), "a pickle")},
             {"names.npy", numpy_bytes(numpy_header("|O", "(2,)"), "a pickle")},
             {"pos.npy",
              numpy_bytes(numpy_header("<f4", "(2, 3)"), bytes_of<float>({1, 2, 3, 4, 5, 6}))}},
            GetParam());
  const auto snapshot = open_snapshot(folder / "a.npz");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("about, names")));
}

TEST_P(NumpyArchive, OfTwoArraysThatCouldBePositionsNoneIsTaken) {
  const TemporaryFolder folder;
  const std::string threes =
      numpy_bytes(numpy_header("<f8", "(2, 3)"), bytes_of<double>({1, 2, 3, 4, 5, 6}));
  write_zip(folder / "a.npz", {{"arr_0.npy", threes}, {"arr_1.npy", threes}}, GetParam());
  EXPECT_THAT(refusal(folder / "a.npz"), HasSubstr("no positions: its columns are arr_0, arr_1"));
}

TEST_P(NumpyArchive, ADamagedArchiveIsRefused) {
  const TemporaryFolder folder;
  std::vector<float> values(3000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(i * i % 977);
  write_zip(folder / "a.npz",
            {{"pos.npy", numpy_bytes(numpy_header("<f4", "(1000, 3)"), bytes_of(values))}},
            GetParam());
  const std::string whole = read_text(folder / "a.npz");
  for (const std::size_t size : {whole.size() / 4, whole.size() / 2, whole.size() - 1}) {
    write_bytes(folder / "a.npz", whole.substr(0, size));
    EXPECT_NE(refusal(folder / "a.npz"), "");
  }
  std::string damaged = whole;  // the archive's checksum tells
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 0x55);
  write_bytes(folder / "a.npz", damaged);
  EXPECT_THROW(
      {
        const auto snapshot = open_snapshot(folder / "a.npz");
        snapshot->read(0, "position");
      },
      DataError);
}

TEST_F(NumpyArray, NamesThatDoNotFitItsColumnsAreAWrongCall) {
  const std::vector<float> values = {1, 2, 3, 4, 5, 6};
  write("<f4", "(2, 3)", bytes_of(values));
  EXPECT_THROW(open_snapshot(path_, {{"x", "y"}}), UsageError);
}

TEST(NumpyArchives, AZipWithoutArraysIsRefused) {
  const TemporaryFolder folder;
  write_zip(folder / "a.zip", {{"readme.txt", "nothing"}}, true);
  EXPECT_THAT(refusal(folder / "a.zip"), HasSubstr("zip archive without NumPy arrays"));
}

}  // namespace
}  // namespace splotchcl::test
