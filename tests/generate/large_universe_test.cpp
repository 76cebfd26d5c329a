#include "generate/large_universe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

#include "smoothing/smoothing_lengths.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using splotchcl::test::read_text;
using splotchcl::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Lt;
using ::testing::ThrowsMessage;

constexpr int gas = 0, stars = 4;
const GenerateSettings settings = {60000, 0.2, 3};
const LargeUniverse parts = {15000, 30000};

std::vector<float> values_of(const Column& column) {
  return {column.data(), column.data() + column.size()};
}

// Of a universe in four files, made once.
class LargeUniverseFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    if (folder) return;
    folder = std::make_unique<TemporaryFolder>();
    written = write_large_universe(*folder / "u", settings, parts);
    snapshot = open_snapshot(*folder / "u");
  }
  static void TearDownTestSuite() {
    snapshot.reset();
    folder.reset();
  }
  static std::vector<float> values(int type, const char* field) {
    return values_of(snapshot->read(type, field));
  }

  static inline std::unique_ptr<TemporaryFolder> folder;
  static inline WrittenUniverse written;
  static inline std::shared_ptr<const Snapshot> snapshot;
};

TEST_F(LargeUniverseFiles, AreOneSnapshotOfAllParticles) {
  EXPECT_EQ(written.files.size(), 4U);
  EXPECT_EQ(snapshot->info().files.size(), 4U);
  EXPECT_TRUE(snapshot->info().notes.empty());
  EXPECT_EQ(snapshot->info().find_type(gas)->count, 48000U);
  EXPECT_EQ(snapshot->info().find_type(stars)->count, 12000U);
}

TEST_F(LargeUniverseFiles, HaveEveryField) {
  for (const int type : {gas, stars}) {
    EXPECT_THAT(values(type, "position"), Each(AllOf(Ge(0.0F), Lt(50000.0F))));
    EXPECT_THAT(values(type, "mass"), Each(Gt(0.0F)));
    EXPECT_EQ(values(type, "velocity").size(), values(type, "position").size());
  }
  EXPECT_THAT(values(gas, "U"), Each(Gt(0.0F)));
  EXPECT_THAT(values(gas, "RHO"), Each(Gt(0.0F)));
  EXPECT_THAT(values(stars, "HSMS"), Each(Gt(0.0F)));
  EXPECT_THAT(values(stars, "AGE"), Each(AllOf(Ge(0.0F), Le(1.0F))));
}

TEST_F(LargeUniverseFiles, NumberParticlesFromOneOn) {
  std::vector<float> ids = values(gas, "ID");
  const std::vector<float> of_stars = values(stars, "ID");
  ids.insert(ids.end(), of_stars.begin(), of_stars.end());
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < ids.size(); ++i)
    ASSERT_EQ(ids[i], static_cast<float>(i + 1));
}

TEST_F(LargeUniverseFiles, HaveLengthsNearThoseOfNeighbors) {
  const Column position = snapshot->read(gas, "position");
  const std::vector<float> found = values(gas, "HSML");
  const Column exact = find_smoothing_lengths(position, found.size(), snapshot->info().box_size);
  std::vector<float> ratios;
  for (std::size_t i = 0; i < found.size(); ++i)
    ratios.push_back(found[i] / exact[i]);
  std::sort(ratios.begin(), ratios.end());
  // So few particles have their neighbors as far away as structures are wide.
  EXPECT_NEAR(ratios[ratios.size() / 2], 1, 0.1);
  EXPECT_GT(ratios[ratios.size() / 10], 0.8);
  EXPECT_LT(ratios[ratios.size() * 9 / 10], 1.8);
}

TEST_F(LargeUniverseFiles, ShowTheWebThatTheSameSeedMakesInMemory) {
  constexpr int side = 12;
  const auto counts_of = [](const std::vector<float>& positions) {
    std::vector<double> counts(side * side * side, 0);
    for (std::size_t i = 0; i < positions.size(); i += 3) {
      int cell = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        cell = cell * side + static_cast<int>(positions[i + axis] / 50000 * side);
      ++counts[static_cast<std::size_t>(cell)];
    }
    return counts;
  };
  const std::vector<double> here = counts_of(values(gas, "position"));
  const std::vector<double> there = counts_of(generate_universe(settings).gas.position);
  const double mean = 48000.0 / static_cast<double>(here.size());
  double difference = 0, clustering = 0;
  for (std::size_t cell = 0; cell < here.size(); ++cell) {
    difference += std::pow(here[cell] - there[cell], 2);
    clustering += std::pow(there[cell] - mean, 2);
  }
  EXPECT_LT(difference, 0.05 * clustering);
}

TEST_F(LargeUniverseFiles, LeaveNothingElseBehind) {
  EXPECT_EQ(folder->count_files(), written.files.size());
}

TEST_F(LargeUniverseFiles, AreTheSameBytesFromTheSameSeed) {
  const TemporaryFolder other;
  const WrittenUniverse again = write_large_universe(other / "u", settings, parts);
  ASSERT_EQ(again.files.size(), written.files.size());
  for (std::size_t f = 0; f < again.files.size(); ++f)
    EXPECT_EQ(read_text(again.files[f]), read_text(written.files[f]));
}

TEST(LargeUniverseNames, AreNotMixedWithOtherFiles) {
  const TemporaryFolder folder;
  std::ofstream(folder / "u") << "another";
  EXPECT_THAT([&] { (void)write_large_universe(folder / "u", settings, parts); },
              ThrowsMessage<UsageError>(HasSubstr("remove it")));
}

}  // namespace
}  // namespace splotchcl
