#include <algorithm>
#include <cstring>

#include "formats/snapshot_checks.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
  write_bytes(folder / "snap.vector", swapped(std::int32_t{4}) + std::string(48, 'x'));
  const auto snapshot = open_snapshot(folder / "snap");
  for (const char* name : {"param", "other", "vector"})
    EXPECT_FALSE(has_field(*snapshot, 0, name)) << name;
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("snap.vector left out")));
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
              ::testing::ThrowsMessage<DataError>(HasSubstr("the end of the file as value 4")));
}

}  // namespace
}  // namespace splotchcl
