#include "formats/numpy/numpy_writer.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

// A plain array.
template <class T>
std::string array(const char* type, const char* shape, const std::vector<T>& values) {
  return numpy_bytes(numpy_header(type, shape), bytes_of(values));
}

std::string floats(const char* shape, const std::vector<float>& values) {
  return array("<f4", shape, values);
}

std::string of_ones(const char* shape, std::size_t count) {
  return floats(shape, std::vector<float>(count, 1));
}

const std::vector<float> one_to_six = {1, 2, 3, 4, 5, 6};
const std::string two_rows = floats("(2, 3)", one_to_six);

std::string big_endian_columns() {
  std::string data = bytes_of<float>({1, 4, 2, 5, 3, 6});
  for (std::size_t i = 0; i < data.size(); i += 4)
    std::reverse(&data[i], &data[i] + 4);
  return numpy_bytes(numpy_header(">f4", "(2, 3)", true), data);
}

std::string records() {
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
  return numpy_bytes(header, data, 2);
}

// Two particles: p of x, y, z, then mass.
std::string records_in_records(const char* shape_of_p) {
  const std::string header =
      std::string("{'descr': [('p', [('x', '<f4'), ('y', '<f4'), ('z', '<f4')]") + shape_of_p +
      "), ('mass', '<f4')], 'fortran_order': False, 'shape': (2,)}";
  return numpy_bytes(header, bytes_of<float>({1, 2, 3, 7, 4, 5, 6, 8}));
}

std::vector<std::string> no_python() {
  std::vector<std::string> files;
  for (const char* const header :
       {"", "{'descr': '<f4'", "{'descr': '<f4', 'shape': (2, 3)}", "[[[[[[[[[[[[[[[[[[[[[[",
        "{'descr': 'f', 'fortran_order': False, 'shape': (2, 3)}",
        "{'descr': [('x', [('y', '<f4')])], 'fortran_order': False, 'shape': (2,)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (-2, 3)}"})
    files.push_back(numpy_bytes(header, std::string(24, 'x')));
  return files;
}

SnapshotOptions xyz_of_64() {
  std::vector<std::string> names(64, "-");
  names[0] = "x", names[1] = "y", names[2] = "z";
  return {names};
}

const std::string five_columns = array<double>("<f8", "(2, 5)", {1, 2, 3, 7, 8, 4, 5, 6, 9, 10});

INSTANTIATE_TEST_SUITE_P(
    NumpyArray, SnapshotFile,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"RowsOfThreeArePositions",
         {two_rows},
         "format NumPy array | count 2 | position 1 2 3 4 5 6"},
        // The float next to 1e-7.
        {"FloatsAreTakenAsTheyAre",
         {floats("(3, 3)", {1e-7F, 0, 0, 1000, 0, 0, 1001, 0, 0})},
         "origin 0 | position 1.00000001168609742e-07 0 0 1000 0 0 1001 0 0"},
        // 1, -2, the largest, the smallest, infinity, a third.
        {"HalvesAreRead",
         {array<std::uint16_t>("<f2", "(2, 3)", {0x3c00, 0xc000, 0x7bff, 0x0001, 0x7c00, 0x3555})},
         "position 1 -2 65504 5.960464477539063e-8 inf 0.333251953125"},
        {"FurtherColumnsHaveNumbers", {five_columns}, "column_4 7 9"},
        {"ColumnsHaveTheNamesThatAreGiven",
         {five_columns},
         "mass 1 4 | position 3 7 8 6 9 10 | no column_2",
         {{"mass", "-", "x", "y", "z"}}},
        {"NamesThatDoNotFitItsColumnsAreAWrongCall", {two_rows}, "misuse 2", {{"x", "y"}}},
        {"ThatIsAnImageIsRefused",
         {of_ones("(6, 64)", 384), of_ones("(2, 3, 64)", 384)},
         "refused as images and maps are"},
        {"OfManyColumnsIsReadByTheirNames", {of_ones("(6, 64)", 384)}, "count 6", xyz_of_64()},
        {"FortranOrderAndBigEndianAreRead", {big_endian_columns()}, "position 1 2 3 4 5 6"},
        {"RecordsWithNamesAreRead",
         {records()},
         "position 0 1 2 10 11 12 | smoothing_length 0.5 10.5 | flag 0 1 | "
         "ids 9223372036854775808 9223372036854775809 | note name"},
        {"RecordsInRecordsHaveTheNamesOfBoth",
         {records_in_records("")},
         "position 1 2 3 4 5 6 | mass 7 8",
         {{"x=p.x", "y=p.y", "z=p.z"}}},
        {"ArraysOfRecordsInRecordsAreRefused",
         {records_in_records(", (1,)")},
         "refused member p of its records is an array of records"},
        {"ShapesThatOverflowAreRefused",
         {numpy_bytes(numpy_header("<f4", "(4611686018427387904, 3)"), std::string(24, 'x'))},
         "refused overflows"},
        {"ShapesOfMoreThanThereIsAreRefused",
         {numpy_bytes(numpy_header("<f4", "(1000000000000, 3)"), std::string(24, 'x'))},
         "refused 24 bytes of values"},
        {"MoreBytesThanItsShapeHasAreRefused",
         {two_rows + "x"},
         "refused 25 bytes of values, expected 24"},
        {"TwoColumnsAreNotPositions", {floats("(3, 2)", one_to_six)}, "refused save its transpose"},
        {"HeadersThatAreNoPythonAreRefused", no_python(), "refused snap: "},
        {"OfPythonsObjectsIsRefusedByTheirName",
         {numpy_bytes(numpy_header("|O", "(2,)"), "a pickle")},
         "refused objects of Python"}}),
    name_of_row);

TEST(NumpyArrays, OfDoublesAreOffsetsFromAnOrigin) {
  const TemporaryFolder folder;
  const std::vector<double> stored = {1e6 + 1e-7, 0, 0, 1e6, 0, 0, 1e6, 0, 0};
  write_bytes(folder / "a.npy", array("<f8", "(3, 3)", stored));
  EXPECT_NEAR(absolute_positions(*open_snapshot(folder / "a.npy"), 0)[0], stored[0], 1e-9);
}

TEST(NumpyArrays, TruncatedAtAnyByteAreRefused) {
  const TemporaryFolder folder;
  for (std::size_t size = 0; size < two_rows.size(); ++size) {
    write_bytes(folder / "a.npy", two_rows.substr(0, size));
    ASSERT_NE(refusal(folder / "a.npy"), "") << "cut to " << size << " bytes";
  }
}

// Stored as they are, and packed.
std::vector<std::string> archives(std::vector<std::pair<std::string, std::string>> arrays) {
  for (auto& [name, bytes] : arrays)
    name += ".npy";
  return {zip_bytes(arrays, false), zip_bytes(arrays, true)};
}

const std::string threes = array<double>("<f8", "(2, 3)", {1, 2, 3, 4, 5, 6});
const std::string masses = floats("(2,)", {7, 8}), of_haloes = floats("(3,)", {7, 8, 9});

std::vector<std::string> archives_of_threes_called(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    for (const std::string& archive : archives({{"a_number_of_haloes", of_haloes},
                                                {"mass", masses},
                                                {name, threes},
                                                {"vel", threes}}))
      all.push_back(archive);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(
    NumpyArchive, SnapshotFile,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"ArraysBecomeFields",
         archives({{"pos", threes},
                   {"mass", masses},
                   {"ids", array<std::int64_t>("<i8", "(2,)", {5, 6})},
                   {"halo_mass", of_haloes},
                   {"time", array<double>("<f8", "()", {0.25})},
                   {"BoxSize", array<double>("<f8", "()", {64})}}),
         "format NumPy archive | time 0.25 | box 64 | position 1 2 3 4 5 6 | mass 7 8 | ids 5 6 | "
         "note halo_mass"},
        {"NumbersOfTheWholeMayBeArraysOfOneAndSidesOfABox",
         archives({{"pos", threes},
                   {"time", array<double>("<f8", "(1,)", {0.25})},
                   {"redshift", array<double>("<f8", "(1,)", {3})},
                   {"box_size", array<double>("<f8", "(3,)", {8, 16, 32})}}),
         "time 0.25 | redshift 3 | box 8 16 32 | no notes"},
        {"AxesInArraysOfTheirOwnAreJoined",
         archives({{"z", floats("(2,)", {3, 6})},
                   {"y", floats("(2,)", {2, 5})},
                   {"x", floats("(2,)", {1, 4})}}),
         "position 1 2 3 4 5 6"},
        {"AnAxisOfAnotherLengthIsNotTakenForZero",
         archives({{"x", masses}, {"y", masses}, {"z", of_haloes}}),
         "refused z is not one number for each of 2"},
        {"ASingleMassIsThatOfAllParticles",
         archives({{"pos", two_rows}, {"mass", array<double>("<f8", "()", {2.5})}}),
         "mass 2.5 2.5"},
        {"TheOnlyRowsOfThreeThatAreNothingElseArePositions",
         archives_of_threes_called({"arr_0", "r", "x", "particles"}),
         "position 1 2 3 4 5 6 | mass 7 8 | note taken for the positions"},
        {"ArraysOfPythonsObjectsAreLeftOutWithANote",
         archives({{"about", numpy_bytes(numpy_header("|O", "()"), "a pickle")},
                   {"names", numpy_bytes(numpy_header("|O", "(2,)"), "a pickle")},
                   {"pos", two_rows}}),
         "position 1 2 3 4 5 6 | note about, names"},
        {"OfTwoArraysThatCouldBePositionsNoneIsTaken",
         archives({{"arr_0", threes}, {"arr_1", threes}}),
         "refused no positions: its columns are arr_0, arr_1"},
        {"OfNoArraysIsRefused",
         {zip_bytes({{"readme.txt", "nothing"}}, true)},
         "refused zip archive without NumPy arrays"}}),
    name_of_row);

TEST(NumpyArchives, ThatAreDamagedAreRefused) {
  const TemporaryFolder folder;
  std::vector<float> values(3000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(i * i % 977);
  for (const std::string& whole : archives({{"pos", floats("(1000, 3)", values)}})) {
    for (const std::size_t size : {whole.size() / 4, whole.size() / 2, whole.size() - 1}) {
      write_bytes(folder / "a.npz", whole.substr(0, size));
      EXPECT_NE(refusal(folder / "a.npz"), "");
    }
    std::string damaged = whole;  // the archive's checksum tells
    damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 0x55);
    write_bytes(folder / "a.npz", damaged);
    EXPECT_THROW(open_snapshot(folder / "a.npz")->read(0, "position"), DataError);
  }
}

}  // namespace
}  // namespace splotchcl::test
