#include "splotchcl/generate.h"

#include "generate/random.h"
#include "generate/web.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using ::testing::Ge;
using ::testing::Gt;
using ::testing::Le;
using ::testing::Lt;

GenerateSettings small(std::uint64_t seed = 1) {
  return {5000, 0.2, seed};
}

using Generator = GeneratedSnapshot (*)(const GenerateSettings&);
class Generators : public ::testing::TestWithParam<Generator> {};
INSTANTIATE_TEST_SUITE_P(Generate, Generators,
                         ::testing::Values(&generate_universe, &generate_cluster, &generate_halo));

TEST_P(Generators, MakeAsManyParticlesAsAskedFor) {
  const GeneratedSnapshot snapshot = GetParam()(small());
  EXPECT_EQ(snapshot.gas.count(), 4000U);
  EXPECT_EQ(snapshot.stars.count(), 1000U);
}

TEST_P(Generators, FillInEveryField) {
  const GeneratedSnapshot snapshot = GetParam()(small());
  const GeneratedParticles& gas = snapshot.gas;
  EXPECT_EQ(gas.velocity.size(), gas.position.size());
  EXPECT_EQ(gas.density.size(), gas.count());
  EXPECT_EQ(gas.internal_energy.size(), gas.count());
  EXPECT_EQ(gas.smoothing_length.size(), gas.count());
  EXPECT_GT(gas.mass, 0);
  EXPECT_THAT(gas.density, Each(Gt(0)));
  EXPECT_THAT(gas.internal_energy, Each(Gt(0)));
  EXPECT_THAT(gas.smoothing_length, Each(Gt(0)));
  EXPECT_EQ(snapshot.stars.age.size(), snapshot.stars.count());
  EXPECT_EQ(snapshot.stars.smoothing_length.size(), snapshot.stars.count());
  EXPECT_GT(snapshot.stars.mass, 0);
  EXPECT_THAT(snapshot.stars.age, Each(AllOf(Ge(0), Le(1))));
}

TEST_P(Generators, MakeTheSameParticlesFromTheSameSeed) {
  const GeneratedSnapshot first = GetParam()(small(7));
  const GeneratedSnapshot second = GetParam()(small(7));
  EXPECT_EQ(first.gas.position, second.gas.position);
  EXPECT_EQ(first.gas.internal_energy, second.gas.internal_energy);
  EXPECT_EQ(first.stars.position, second.stars.position);
}

TEST_P(Generators, MakeOtherParticlesFromAnotherSeed) {
  EXPECT_NE(GetParam()(small(1)).gas.position, GetParam()(small(2)).gas.position);
}

TEST_P(Generators, MakeGasWithoutStars) {
  const GeneratedSnapshot snapshot = GetParam()({2000, 0, 1});
  EXPECT_EQ(snapshot.gas.count(), 2000U);
  EXPECT_EQ(snapshot.stars.count(), 0U);
}

TEST_P(Generators, RefuseSettingsOutOfRange) {
  EXPECT_THAT(
      [] {
        (void)GetParam()({10, 0.1, 1});
      },
      ThrowsMessage<UsageError>(AllOf(HasSubstr("particles"), HasSubstr("10"))));
  EXPECT_THAT(
      [] {
        (void)GetParam()({5000, 1.5, 1});
      },
      ThrowsMessage<UsageError>(HasSubstr("stars")));
  EXPECT_THROW((void)GetParam()({5000, std::nan(""), 1}), UsageError);
}

TEST(GenerateUniverse, StaysInItsBox) {
  const GeneratedSnapshot snapshot = generate_universe(small());
  const auto box = static_cast<float>(snapshot.box_size);
  EXPECT_GT(box, 0);
  EXPECT_THAT(snapshot.gas.position, Each(AllOf(Ge(0), Lt(box))));
  EXPECT_THAT(snapshot.stars.position, Each(AllOf(Ge(0), Lt(box))));
}

TEST(GenerateUniverse, IsClustered) {
  // Even gas would have the mean density everywhere.
  std::vector<float> density = generate_universe({20000, 0, 1}).gas.density;
  std::sort(density.begin(), density.end());
  EXPECT_GT(density[density.size() * 95 / 100], 20 * density[density.size() / 20]);
}

// A wave of the field alone, so that nothing random is left but its amplitude.
TEST(RandomWaves, AreSmoothWavesOfTheirLength) {
  Random random(3);
  const RandomWaves waves(
      4, [](double) { return 1.0; }, random);
  const PeriodicGrid field = waves.evaluate(16, [](WaveNumber n) {
    return std::complex<double>(n.x == 2 && n.y == 1 && n.z == 3 ? 1 : 0);
  });
  // Half a wave further along x (4 of 16 points for n = 2), the sign has changed.
  for (int i = 0; i < 16; ++i) {
    EXPECT_NEAR(field.at(i, 3, 5), -field.at(i + 4, 3, 5), 1e-5);
    EXPECT_NEAR(field.at(3, i, 5), -field.at(3, i + 8, 5), 1e-5);
  }
  EXPECT_NE(field.at(0, 0, 0), field.at(1, 0, 0));
}

TEST(RandomWaves, HaveTheVarianceThatIsStated) {
  Random random(3);
  const RandomWaves waves(
      5, [](double n) { return 1 / n; }, random);
  const PeriodicGrid field = waves.evaluate(12, [](WaveNumber) { return std::complex<double>(1); });
  double sum = 0;
  for (int i = 0; i < 12 * 12 * 12; ++i) {
    const double value = field.at(i % 12, i / 12 % 12, i / 144);
    sum += value * value;
  }
  // Exact up to single precision: 12 points resolve every wave up to 5.
  const double expected = waves.variance([](double) { return 1.0; });
  EXPECT_NEAR(sum / (12 * 12 * 12), expected, 1e-5 * expected);
}

TEST(WriteGadget2, WritesWhatTheReaderReads) {
  const TemporaryFolder folder;
  const GeneratedSnapshot made = generate_universe(small());
  write_gadget2(folder / "universe", made);
  const auto snapshot = open_snapshot(folder / "universe");
  const SnapshotInfo& info = snapshot->info();
  EXPECT_EQ(info.box_size, made.box_size);
  ASSERT_NE(info.find_type(0), nullptr);
  ASSERT_NE(info.find_type(4), nullptr);
  EXPECT_EQ(info.find_type(0)->count, made.gas.count());
  EXPECT_EQ(info.find_type(4)->count, made.stars.count());
  EXPECT_TRUE(info.notes.empty()) << info.notes.front();
  const auto expect_values = [&](int type, const char* field, const std::vector<float>& values) {
    const Column column = snapshot->read(type, field);
    ASSERT_EQ(column.size(), values.size()) << field;
    EXPECT_TRUE(std::equal(values.begin(), values.end(), column.data())) << field;
  };
  expect_values(0, "position", made.gas.position);
  expect_values(0, "velocity", made.gas.velocity);
  expect_values(0, "U", made.gas.internal_energy);
  expect_values(0, "RHO", made.gas.density);
  expect_values(0, "HSML", made.gas.smoothing_length);
  expect_values(4, "position", made.stars.position);
  expect_values(4, "HSMS", made.stars.smoothing_length);
  expect_values(4, "AGE", made.stars.age);
  EXPECT_EQ(snapshot->read(4, "mass")[0], made.stars.mass);
}

TEST(WriteGadget2, WritesTheSameBytesFromTheSameSeed) {
  const TemporaryFolder folder;
  write_gadget2(folder / "a", generate_halo(small(5)));
  write_gadget2(folder / "b", generate_halo(small(5)));
  EXPECT_EQ(read_text(folder / "a"), read_text(folder / "b"));
}

TEST(WriteGadget2, NamesAFolderThatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { write_gadget2(folder / "nowhere/a", {}); },
              ThrowsMessage<DataError>(HasSubstr("nowhere")));
}

}  // namespace
}  // namespace splotchcl::test
