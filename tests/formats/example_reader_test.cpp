// The reader of docs/dev/add-a-reader.md.
#include "formats/snapshot_checks.h"
#include "formats/snapshot_format.h"

namespace splotchcl {

const SnapshotFormat& points_format();

namespace {

using namespace splotchcl::test;

std::string points_file() {
  const std::uint32_t count = 2;
  const float values[8] = {1, 2, 3, 0.5F, 4, 5, 6, 0.25F};
  return "POINTS01" + std::string(reinterpret_cast<const char*>(&count), sizeof count) +
         std::string(reinterpret_cast<const char*>(values), sizeof values);
}

TEST(ExampleReader, ReadsWhatItRecognizes) {
  const TemporaryFolder folder;
  write_bytes(folder / "points", points_file());
  ASSERT_TRUE(points_format().recognizes(MappedFile::open(folder / "points")));
  const auto snapshot = points_format().open(folder / "points", {});
  EXPECT_THAT(values_of(snapshot->read(4, "position")), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(4, "mass")), ElementsAre(0.5F, 0.25F));
}

TEST(ExampleReader, RefusesWhatIsTruncated) {
  const TemporaryFolder folder;
  for (std::size_t size = 0; size < points_file().size(); ++size) {
    write_bytes(folder / "points", points_file().substr(0, size));
    EXPECT_THROW(points_format().open(folder / "points", {}), DataError) << size;
  }
}

}  // namespace
}  // namespace splotchcl
