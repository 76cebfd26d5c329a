#include "formats/stored_values.h"

#include "formats/snapshot_writer.h"
#include "scene/particle_columns.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

std::vector<float> values_of(const Column& column) {
  return {column.data(), column.data() + column.size()};
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

class StoredValuesTest : public ::testing::Test {
 protected:
  std::shared_ptr<const MappedFile> map(const std::string& bytes) const {
    write_bytes(folder_ / "values", bytes);
    return MappedFile::open(folder_ / "values");
  }

 private:
  const TemporaryFolder folder_;
};

TEST_F(StoredValuesTest, AlignedNativeFloatsAreNotCopied) {
  const auto file = map(bytes_of<float>({9, 1, 2, 3}));
  const Column column = make_column({{file, 4, 3}});
  EXPECT_EQ(static_cast<const void*>(column.data()), file->data() + 4);
  EXPECT_THAT(values_of(column), ElementsAre(1, 2, 3));
}

TEST_F(StoredValuesTest, UnalignedFloatsAreCopied) {
  const auto file = map("x" + bytes_of<float>({1, 2, 3}));
  const Column column = make_column({{file, 1, 3}});
  EXPECT_NE(static_cast<const void*>(column.data()), file->data() + 1);
  EXPECT_THAT(values_of(column), ElementsAre(1, 2, 3));
}

TEST_F(StoredValuesTest, PartsAreJoinedInOrder) {
  const auto file = map(bytes_of<float>({1, 2, 3, 4}));
  EXPECT_THAT(values_of(make_column({{file, 8, 2}, {file, 0, 0}, {file, 0, 1}})),
              ElementsAre(3, 4, 1));
}

TEST_F(StoredValuesTest, AnEmptyPartDoesNotForceACopy) {
  const auto file = map(bytes_of<float>({1, 2}));
  const Column column = make_column({{file, 0, 0}, {file, 0, 2}});
  EXPECT_EQ(static_cast<const void*>(column.data()), file->data());
}

// Values are asked for in any stretch, whole vectors or not.
TEST_F(StoredValuesTest, StreamedPartsHaveTheValuesOfCopies) {
  const auto doubles = map(bytes_of<double>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  const std::vector<StoredValues> parts = {
      {doubles, 0, 2, 3, 0, ValueKind::float64},
      {doubles, 0, 0, 3, 0, ValueKind::float64},
      {doubles, 48, 1, 3, 48, ValueKind::float64},
  };
  for (const Vec3& origin : {Vec3{{0, 0, 0}}, Vec3{{1, -2, 0.5}}}) {
    const Column held = make_column(parts, origin), streamed = make_streamed_column(parts, origin);
    EXPECT_FALSE(is_streamed(held));
    ASSERT_TRUE(is_streamed(streamed));
    ASSERT_EQ(streamed.size(), 9u);
    for (std::size_t begin = 0; begin < 9; ++begin) {
      for (std::size_t end = begin + 1; end <= 9; ++end) {
        const ColumnStretch stretch(streamed, begin, end);
        for (std::size_t i = begin; i < end; ++i)
          EXPECT_EQ(stretch[i], held[i]);
      }
    }
    EXPECT_EQ(values_of(streamed), values_of(held));
  }
}

TEST_F(StoredValuesTest, IntegersAndDoublesBecomeFloats) {
  EXPECT_THAT(values_of(make_column(
                  {{map(bytes_of<double>({0.5, 1e300})), 0, 2, 1, 0, ValueKind::float64}})),
              ElementsAre(0.5F, std::numeric_limits<float>::infinity()));
  EXPECT_THAT(values_of(make_column({{map(bytes_of<std::uint32_t>({7, 0xffffffffU})), 0, 2, 1, 0,
                                      ValueKind::uint32}})),
              ElementsAre(7, 4294967296.0F));
  EXPECT_THAT(values_of(make_column(
                  {{map(bytes_of<std::uint64_t>({1ULL << 40})), 0, 1, 1, 0, ValueKind::uint64}})),
              ElementsAre(1099511627776.0F));
}

TEST_F(StoredValuesTest, SwappedBytesAreTurned) {
  std::string bytes = bytes_of<float>({1.5F});
  std::reverse(bytes.begin(), bytes.end());
  EXPECT_THAT(values_of(make_column({{map(bytes), 0, 1, 1, 0, ValueKind::float32, true}})),
              ElementsAre(1.5F));
}

TEST_F(StoredValuesTest, StrideSkipsWhatLiesBetween) {
  const auto file = map(bytes_of<float>({1, 2, 3, -1, 4, 5, 6, -1}));
  EXPECT_THAT(values_of(make_column({{file, 0, 2, 3, 16}})), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(StoredValuesTest, OriginIsTakenFromVectorsBeforeRounding) {
  const auto file = map(bytes_of<double>({1e9 + 0.125, 2, 3}));
  const Vec3 origin = {{1e9, 0, 1}};
  EXPECT_THAT(values_of(make_column({{file, 0, 1, 3, 0, ValueKind::float64}}, origin)),
              ElementsAre(0.125F, 2, 2));
}

// The sampled particles, numbered through all parts.
std::vector<std::uint64_t> sampled(const std::vector<std::uint64_t>& part_sizes) {
  std::vector<std::uint64_t> particles;
  for (const SampleRange& range : sample_ranges(part_sizes)) {
    std::uint64_t start = 0;
    for (std::size_t part = 0; part < range.part; ++part)
      start += part_sizes[part];
    EXPECT_LE(range.first + range.count, part_sizes[range.part]);
    for (std::uint64_t i = 0; i < range.count; ++i)
      particles.push_back(start + range.first + i);
  }
  return particles;
}

TEST(PositionOrigin, SampleDoesNotDependOnHowParticlesAreSplit) {
  EXPECT_EQ(sampled({1000003}), sampled({5, 0, 400000, 17, 599981, 0}));
  EXPECT_EQ(sampled({100}), sampled({30, 30, 0, 40}));
}

TEST(PositionOrigin, SampleIsSpreadOverAllParticlesWithoutRepeating) {
  const auto particles = sampled({1000003});
  const std::set<std::uint64_t> different(particles.begin(), particles.end());
  EXPECT_EQ(different.size(), particles.size());
  EXPECT_GE(particles.size(), 4096U);
  EXPECT_LT(particles.size(), 5000U);
  for (std::uint64_t tenth = 0; tenth < 10; ++tenth) {
    EXPECT_LT(*different.lower_bound(tenth * 100000), (tenth + 1) * 100000);
  }
}

TEST(PositionOrigin, SmallSnapshotsAreSampledWhole) {
  EXPECT_EQ(sampled({60, 40}).size(), 100U);
  EXPECT_EQ(sampled({}).size(), 0U);
}

TEST(PositionOrigin, IsTheMedianOfEachAxisAsAFloat) {
  const Vec3 origin = choose_position_origin({{{1, 30, 0.1}}, {{2, 10, 0.1}}, {{100, 20, 0.1}}});
  EXPECT_EQ(origin.a[0], 2);
  EXPECT_EQ(origin.a[1], 20);
  EXPECT_EQ(origin.a[2], static_cast<double>(0.1F));
}

TEST(PositionOrigin, IgnoresPositionsThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 origin = choose_position_origin({{{nan, 1, 1e300}}, {{7, 1, 5}}, {{nan, 1, 1e300}}});
  EXPECT_EQ(origin.a[0], 7);
  EXPECT_EQ(origin.a[1], 1);
  EXPECT_EQ(origin.a[2], 5);
}

TEST(PositionOrigin, IsZeroWhenNoPositionIsFinite) {
  EXPECT_EQ(choose_position_origin({}).a[0], 0);
}

}  // namespace
}  // namespace splotchcl::test
