#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

template <typename... Values>
std::string bytes_of(bool is_swapped, Values... values) {
  std::string all;
  const auto add = [&](auto value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (is_swapped) std::reverse(bytes.begin(), bytes.end());
    all += bytes;
  };
  (add(values), ...);
  return all;
}

// In all, dimensions, gas, dark, stars.
std::string header(bool is_swapped, const std::array<std::int32_t, 5>& numbers,
                   bool is_padded = true) {
  std::string bytes = bytes_of(is_swapped, 0.25);
  for (const std::int32_t number : numbers)
    bytes += bytes_of(is_swapped, number);
  return bytes + (is_padded ? bytes_of(is_swapped, std::int32_t{0}) : "");
}

// Numbers that count up: 12 for each of gas, 9 for each that is dark, 11 for each star.
std::string counting(bool is_swapped, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i)
    bytes += bytes_of(is_swapped, static_cast<float>(i));
  return bytes;
}

std::string small_tipsy(bool is_swapped, bool is_padded = true) {
  return header(is_swapped, {5, 3, 2, 1, 2}, is_padded) + counting(is_swapped, 2 * 12 + 9 + 2 * 11);
}

// One dark particle with positions in double precision, and with such velocities or without.
template <typename Velocity>
std::string of_doubles(bool is_swapped) {
  return header(is_swapped, {1, 3, 0, 1, 0}) + bytes_of(is_swapped, 1.5F, 1.0, 2.0, 1e9 + 1) +
         bytes_of(is_swapped, Velocity{4}, Velocity{5}, Velocity{6}, 7.0F, 8.0F);
}

INSTANTIATE_TEST_SUITE_P(
    Tipsy, SnapshotFile,
    ::testing::ValuesIn(std::vector<SnapshotRow>{
        {"FieldsOfAllTypesAreRead",
         {small_tipsy(false), small_tipsy(true), small_tipsy(false, false),
          small_tipsy(true, false)},
         "time 0.25 | mass/0 0 12 | position/0 1 2 3 13 14 15 | density/0 7 19 | "
         "temperature/0 8 20 | potential/0 11 23 | velocity/1 28 29 30 | "
         "position/4 34 35 36 45 46 47 | tform/4 41 52"},
        {"PositionsInDoublePrecisionAreToldByTheLengthOfTheFile",
         {of_doubles<float>(false), of_doubles<float>(true), of_doubles<double>(false),
          of_doubles<double>(true)},
         "position/1 1 2 1000000001 | velocity/1 4 5 6 | phi/1 8"},
        {"SofteningIsNotTakenForASmoothingLength",
         {small_tipsy(false)},
         "no smoothing_length/0 | softening/0 9 21 | notes 1 | note softening"}}),
    name_of_row);

TEST(Tipsy, TruncatedAtAnyByteIsRefused) {
  const TemporaryFolder folder;
  for (const bool is_swapped : {false, true}) {
    const std::string whole = small_tipsy(is_swapped);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      // Four bytes less is what a file without padding has.
      if (size + 4 == whole.size()) continue;
      write_bytes(folder / "snap", whole.substr(0, size));
      ASSERT_NE(refusal(folder / "snap"), "") << "cut to " << size << " bytes";
    }
  }
}

TEST(RealTipsy, FilesOfPublicCodesAreRead) {
  if (!std::filesystem::is_directory(data_folder()))
    GTEST_SKIP() << "no real snapshots in " << data_folder();
  expect_snapshot(data_folder() / "tipsy/tiny.000640", {},
                  "format Tipsy, big-endian | count/0 171 | count/1 3078 | count/4 49");
  EXPECT_EQ(open_snapshot(data_folder() / "tipsy/tiny.000640")->read(0, "temperature").size(),
            171U);
  expect_snapshot(data_folder() / "tipsy/shocktube.std", {}, "count/0 20000");
}

// A file of one gas particle, one dark and two stars, big-endian on common machines, and arrays
// beside it, by their endings.
struct ArraysRow {
  const char* name;
  std::map<std::string, std::string> arrays;
  const char* expected;  // as of SnapshotRow
};
void PrintTo(const ArraysRow& row, std::ostream* out) {
  *out << row.name;
}

class TipsyArrays : public ::testing::TestWithParam<ArraysRow> {};

TEST_P(TipsyArrays, AreReadOrLeftOut) {
  const TemporaryFolder folder;
  write_bytes(folder / "snap", header(true, {4, 3, 1, 1, 2}) + counting(true, 12 + 9 + 2 * 11));
  for (const auto& [ending, content] : GetParam().arrays)
    write_bytes(folder / ("snap." + ending), content);
  expect_snapshot(folder / "snap", {}, GetParam().expected);
}

constexpr std::int32_t four = 4;

INSTANTIATE_TEST_SUITE_P(
    Beside, TipsyArrays,
    ::testing::ValuesIn(std::vector<ArraysRow>{
        {"OfTextAreRead",
         {{"HI", "4\n0.5\n1.5\n2.5\n3.5\n"}},
         "HI/0 0.5 | HI/1 1.5 | HI/4 2.5 3.5"},
        {"OfTheFilesEndiannessAreRead",
         {{"den", bytes_of(true, four, 0.5F, 1.5F, 2.5F, 3.5F)},
          {"iord", bytes_of(true, four, 16777217, 16777219, 16777221, 16777223)},
          {"grp", "4\n16777217\n16777219\n16777221\n16777223\n"}},
         "density/4 2.5 3.5 | ids/4 16777221 16777223 | whole/4 grp 16777221 16777223"},
        {"OfChangasLengthsReachTheEndOfTheKernel",
         {{"smoothlength", "4\n1\n2\n3\n4\n"}},
         "smoothing_length/4 6 8"},
        {"OfPynbodysLengthsReachTheEndOfTheKernel",
         {{"smooth", "4\n1\n2\n3\n4\n"}},
         "smoothing_length/4 6 8"},
        {"AreNotWhatOtherFilesAre",
         {{"param", "dTheta = 0.7\n"},
          {"other", "5\n1\n2\n3\n4\n5\n"},
          {"smooth", "3\n1\n2\n3\n"},
          {"vector", bytes_of(true, four) + std::string(48, 'x')}},
         "no param/0 | no other/0 | no vector/0 | note snap.vector left out | "
         "note snap.smooth left out: it does not begin with the number of particles, 4"},
        {"OfThreeValuesPerParticleAreLeftOutOfTextToo",
         {{"acc", "4\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n"}},
         "no acc/0 | note snap.acc left out"},
        {"ThatAreTruncatedAreRefused",
         {{"HI", "4\n0.5\n1.5\n2.5\n"}},
         "unreadable the end of the file as value 4"}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace splotchcl::test
