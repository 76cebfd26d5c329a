
#include "formats/snapshot_checks.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class TipsyBytes {
 public:
  explicit TipsyBytes(bool is_swapped) : is_swapped_(is_swapped) {}
  template <typename T>
  void add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (is_swapped_) std::reverse(bytes, bytes + sizeof(T));
    bytes_.append(bytes, sizeof(T));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  bool is_swapped_;
};

// Two gas particles of 12 numbers, one dark of 9, two stars of 11; the numbers count up.
std::string small_tipsy(bool is_swapped, bool is_padded = true) {
  TipsyBytes out(is_swapped);
  out.add(0.25);
  for (const std::int32_t number : {5, 3, 2, 1, 2})
    out.add(number);
  if (is_padded) out.add(std::int32_t{0});
  for (int i = 0; i < 2 * 12 + 9 + 2 * 11; ++i)
    out.add(static_cast<float>(i));
  return out.bytes();
}

class Tipsy : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Endianness, Tipsy, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "Swapped" : "Native"; });

TEST_P(Tipsy, FieldsOfAllTypesAreRead) {
  const TemporaryFolder folder;
  write_bytes(folder / "snap", small_tipsy(GetParam()));
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_EQ(snapshot->info().time, 0.25);
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(0, 12));
  EXPECT_THAT(values_of(snapshot->read(0, "position")), ElementsAre(1, 2, 3, 13, 14, 15));
  EXPECT_THAT(values_of(snapshot->read(0, "density")), ElementsAre(7, 19));
  EXPECT_THAT(values_of(snapshot->read(0, "temperature")), ElementsAre(8, 20));
  EXPECT_THAT(values_of(snapshot->read(0, "potential")), ElementsAre(11, 23));
  EXPECT_THAT(values_of(snapshot->read(1, "velocity")), ElementsAre(28, 29, 30));
  EXPECT_THAT(values_of(snapshot->read(4, "position")), ElementsAre(34, 35, 36, 45, 46, 47));
  EXPECT_THAT(values_of(snapshot->read(4, "tform")), ElementsAre(41, 52));
}

// One dark particle, with or without velocities in double precision too.
TEST_P(Tipsy, PositionsInDoublePrecisionAreToldByTheLengthOfTheFile) {
  for (const bool has_double_velocities : {false, true}) {
    TipsyBytes out(GetParam());
    out.add(0.25);
    for (const std::int32_t number : {1, 3, 0, 1, 0, 0})
      out.add(number);
    out.add(1.5F);
    for (const double x : {1.0, 2.0, 1e9 + 1})
      out.add(x);
    for (const double v : {4.0, 5.0, 6.0}) {
      if (has_double_velocities) {
        out.add(v);
      } else {
        out.add(static_cast<float>(v));
      }
    }
    out.add(7.0F);
    out.add(8.0F);
    const TemporaryFolder folder;
    write_bytes(folder / "snap", out.bytes());
    const auto snapshot = open_snapshot(folder / "snap");
    EXPECT_THAT(absolute_positions(*snapshot, 1), ElementsAre(1, 2, 1e9 + 1));
    EXPECT_THAT(values_of(snapshot->read(1, "velocity")), ElementsAre(4, 5, 6));
    EXPECT_THAT(values_of(snapshot->read(1, "phi")), ElementsAre(8));
  }
}

TEST_P(Tipsy, AHeaderWithoutPaddingIsRead) {
  const TemporaryFolder folder;
  write_bytes(folder / "snap", small_tipsy(GetParam(), false));
  EXPECT_THAT(values_of(open_snapshot(folder / "snap")->read(0, "mass")), ElementsAre(0, 12));
}

TEST_P(Tipsy, TruncatedAtAnyByteIsRefused) {
  const TemporaryFolder folder;
  const std::string whole = small_tipsy(GetParam());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    // Four bytes less is what a file without padding has.
    if (size + 4 == whole.size()) continue;
    write_bytes(folder / "snap", whole.substr(0, size));
    ASSERT_NE(refusal(folder / "snap"), "") << "cut to " << size << " bytes";
  }
}

TEST(TipsyFields, SofteningIsNotTakenForASmoothingLength) {
  const TemporaryFolder folder;
  write_bytes(folder / "snap", small_tipsy(false));
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_FALSE(has_field(*snapshot, 0, "smoothing_length"));
  EXPECT_TRUE(has_field(*snapshot, 0, "softening"));
  EXPECT_THAT(snapshot->info().notes, ElementsAre(HasSubstr("softening")));
}

TEST(RealTipsy, FilesOfPublicCodesAreRead) {
  const std::filesystem::path data = test::data_folder();
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real snapshots in " << data;
  const auto tiny = open_snapshot(data / "tipsy/tiny.000640");
  EXPECT_EQ(tiny->info().format, "Tipsy, big-endian");
  EXPECT_EQ(tiny->info().find_type(0)->count, 171U);
  EXPECT_EQ(tiny->info().find_type(1)->count, 3078U);
  EXPECT_EQ(tiny->info().find_type(4)->count, 49U);
  EXPECT_EQ(tiny->read(0, "temperature").size(), 171U);
  EXPECT_EQ(open_snapshot(data / "tipsy/shocktube.std")->info().find_type(0)->count, 20000U);
}

template <typename T>
std::string swapped(T value) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

// One gas particle, one dark, two stars, big-endian on common machines.
void write_tipsy(const std::filesystem::path& path) {
  std::string bytes = swapped(0.25);
  for (const std::int32_t number : {4, 3, 1, 1, 2, 0})
    bytes += swapped(number);
  for (int i = 0; i < 12 + 9 + 2 * 11; ++i)
    bytes += swapped(static_cast<float>(i));
  write_bytes(path, bytes);
}

TEST(TipsyArrays, TextBesideTheFileIsRead) {
  const TemporaryFolder folder;
  write_tipsy(folder / "snap");
  write_bytes(folder / "snap.HI", "4\n0.5\n1.5\n2.5\n3.5\n");
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_THAT(values_of(snapshot->read(0, "HI")), ElementsAre(0.5F));
  EXPECT_THAT(values_of(snapshot->read(1, "HI")), ElementsAre(1.5F));
  EXPECT_THAT(values_of(snapshot->read(4, "HI")), ElementsAre(2.5F, 3.5F));
}

TEST(TipsyArrays, NumbersOfTheFilesEndiannessAreRead) {
  const TemporaryFolder folder;
  write_tipsy(folder / "snap");
  std::string bytes = swapped(std::int32_t{4});
  for (const float value : {0.5F, 1.5F, 2.5F, 3.5F})
    bytes += swapped(value);
  write_bytes(folder / "snap.den", bytes);
  std::string ids = swapped(std::int32_t{4});
  for (const std::int32_t id : {16777217, 16777219, 16777221, 16777223})
    ids += swapped(id);
  write_bytes(folder / "snap.iord", ids);
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_THAT(values_of(snapshot->read(4, "density")), ElementsAre(2.5F, 3.5F));
  EXPECT_THAT(snapshot->read_ids(4), ElementsAre(16777221U, 16777223U));
}

TEST(TipsyArrays, SmoothingLengthsReachTheEndOfTheKernel) {
  const TemporaryFolder folder;
  write_tipsy(folder / "snap");
  for (const char* array : {"snap.smoothlength", "snap.smooth"}) {  // ChaNGa's, pynbody's
    write_bytes(folder / array, "4\n1\n2\n3\n4\n");
    const auto snapshot = open_snapshot(folder / "snap");
    EXPECT_THAT(values_of(snapshot->read(4, "smoothing_length")), ElementsAre(6, 8)) << array;
    std::filesystem::remove(folder / array);
  }
}

TEST(TipsyArrays, OtherFilesBesideItAreNoArrays) {
  const TemporaryFolder folder;
  write_tipsy(folder / "snap");
  write_bytes(folder / "snap.param", "dTheta = 0.7\n");
  write_bytes(folder / "snap.other", "5\n1\n2\n3\n4\n5\n");
  write_bytes(folder / "snap.smooth", "3\n1\n2\n3\n");
  write_bytes(folder / "snap.vector", swapped(std::int32_t{4}) + std::string(48, 'x'));
  const auto snapshot = open_snapshot(folder / "snap");
  for (const char* name : {"param", "other", "vector"})
    EXPECT_FALSE(has_field(*snapshot, 0, name)) << name;
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("snap.vector left out")));
  EXPECT_THAT(snapshot->info().notes,
              Contains(HasSubstr("snap.smooth left out: it does not begin with the number of "
                                 "particles, 4")));
}

TEST(TipsyArrays, OfThreeValuesPerParticleAreLeftOutOfTextToo) {
  const TemporaryFolder folder;
  write_tipsy(folder / "snap");
  write_bytes(folder / "snap.acc", "4\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n");
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_FALSE(has_field(*snapshot, 0, "acc"));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("snap.acc left out")));
}

TEST(TipsyArrays, ATruncatedArrayIsRefused) {
  const TemporaryFolder folder;
  write_tipsy(folder / "snap");
  write_bytes(folder / "snap.HI", "4\n0.5\n1.5\n2.5\n");
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_THAT([&] { snapshot->read(4, "HI"); },
              ThrowsMessage<DataError>(HasSubstr("the end of the file as value 4")));
}

}  // namespace
}  // namespace splotchcl::test
