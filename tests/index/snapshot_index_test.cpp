#include "index/snapshot_index.h"

#include <chrono>

#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr std::uint32_t gas_particles = 20000;  // two blocks, and a part of one

// Gas in a row along x, of smoothing lengths that grow along it.
TestSnapshot long_row() {
  TestSnapshot snapshot;
  snapshot.counts[0] = gas_particles;
  snapshot.total_counts[0] = gas_particles;
  snapshot.table_masses[0] = 1;
  TestBlock positions, lengths;
  positions.label = "POS ";
  lengths.label = "HSML";
  positions.values_per_particle = 3;
  positions.types = lengths.types = 1;
  positions.values.resize(6);
  lengths.values.resize(6);
  for (std::uint32_t i = 0; i < gas_particles; ++i) {
    positions.values[0].insert(positions.values[0].end(), {static_cast<double>(i), -2, 3});
    lengths.values[0].push_back(i + 1);
  }
  snapshot.blocks = {positions, lengths};
  return snapshot;
}

class Index : public ::testing::Test {
 protected:
  std::shared_ptr<const Snapshot> write(const TestSnapshot& content) const {
    write_gadget(folder_ / "row", content, 2);
    return open_snapshot(folder_ / "row");
  }
  std::filesystem::path path() const { return folder_ / "row.splotchcl_index"; }

  TemporaryFolder folder_;
};

TEST_F(Index, SurroundsEachBlock) {
  const auto snapshot = write(long_row());
  const SnapshotIndex index = SnapshotIndex::make(*snapshot, {});
  ASSERT_EQ(index.types().size(), 1u);
  const SnapshotIndex::Type& gas = index.types().front();
  EXPECT_EQ(gas.count, gas_particles);
  EXPECT_TRUE(gas.has_smoothing_lengths);
  ASSERT_EQ(gas.boxes.size(), 3u);
  EXPECT_EQ(gas.boxes[0].lower[0], 0);
  EXPECT_EQ(gas.boxes[0].upper[0], 8191);
  EXPECT_EQ(gas.boxes[1].lower[0], 8192);
  EXPECT_EQ(gas.boxes[2].upper[0], gas_particles - 1);
  EXPECT_EQ(gas.boxes[2].largest_smoothing_length, gas_particles);
  EXPECT_EQ(gas.boxes[1].lower[1], -2);
  EXPECT_EQ(gas.boxes[1].upper[2], 3);
}

TEST_F(Index, GivesABlockWithABadParticleNoEnd) {
  TestSnapshot content = long_row();
  content.blocks[0].values[0][3 * 9000 + 1] = std::numeric_limits<double>::quiet_NaN();
  content.blocks[1].values[0][17000] = 0;
  const auto snapshot = write(content);
  const SnapshotIndex index = SnapshotIndex::make(*snapshot, {});
  const std::vector<ParticleBox>& boxes = index.types().front().boxes;
  EXPECT_TRUE(std::isfinite(boxes[0].upper[0]));
  EXPECT_TRUE(std::isinf(boxes[1].upper[0]));
  EXPECT_TRUE(std::isinf(boxes[2].lower[2]));
}

TEST_F(Index, IsReadAsItWasWritten) {
  const auto snapshot = write(long_row());
  const SnapshotIndex made = SnapshotIndex::make(*snapshot, {});
  EXPECT_FALSE(SnapshotIndex::is_there(snapshot->info()));
  made.write(snapshot->info());
  const auto read = SnapshotIndex::read(snapshot->info());
  ASSERT_TRUE(read);
  EXPECT_TRUE(SnapshotIndex::is_there(snapshot->info()));
  const SnapshotIndex::Type* const gas = read->find(0);
  ASSERT_NE(gas, nullptr);
  EXPECT_EQ(read->find(4), nullptr);
  ASSERT_EQ(gas->boxes.size(), 3u);
  EXPECT_EQ(gas->boxes[2].lower[0], made.types().front().boxes[2].lower[0]);
}

TEST_F(Index, IsNotUsedOnceAFileHasChanged) {
  const auto snapshot = write(long_row());
  SnapshotIndex::make(*snapshot, {}).write(snapshot->info());
  const auto time = std::filesystem::last_write_time(folder_ / "row");
  std::filesystem::last_write_time(folder_ / "row", time + std::chrono::seconds(1));
  EXPECT_FALSE(SnapshotIndex::read(snapshot->info()));
  EXPECT_TRUE(SnapshotIndex::is_there(snapshot->info()));
  std::filesystem::last_write_time(folder_ / "row", time);
  EXPECT_TRUE(SnapshotIndex::read(snapshot->info()));
}

TEST_F(Index, IsNotUsedWhereItIsDamaged) {
  const auto snapshot = write(long_row());
  EXPECT_FALSE(SnapshotIndex::read(snapshot->info()));
  SnapshotIndex::make(*snapshot, {}).write(snapshot->info());
  const auto size = std::filesystem::file_size(path());
  for (const std::uintmax_t kept : {size - 1, std::uintmax_t{40}, std::uintmax_t{0}}) {
    std::filesystem::resize_file(path(), kept);
    EXPECT_FALSE(SnapshotIndex::read(snapshot->info())) << kept;
  }
}

TEST_F(Index, IsNotKeptWhereItsSnapshotIsWrittenAnewMeanwhile) {
  const auto snapshot = write(long_row());
  const SnapshotIndex index = SnapshotIndex::make(*snapshot, {});
  std::filesystem::last_write_time(
      folder_ / "row", std::filesystem::last_write_time(folder_ / "row") + std::chrono::seconds(1));
  EXPECT_THROW(index.write(snapshot->info()), DataError);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(Index, OfAFileThatHasTakenThePlaceOfTheOneThatIsOpenIsNotTaken) {
  const auto held = write(long_row());
  TestSnapshot moved = long_row();
  for (double& x : moved.blocks[0].values[0])
    x += 1e6;
  write_gadget(folder_ / "other", moved, 2);
  std::filesystem::rename(folder_ / "other", folder_ / "row");
  const auto anew = open_snapshot(folder_ / "row");
  SnapshotIndex::make(*anew, {}).write(anew->info());
  EXPECT_TRUE(SnapshotIndex::read(anew->info()));
  EXPECT_FALSE(SnapshotIndex::read(held->info()));
  EXPECT_THROW(SnapshotIndex::make(*held, {}).write(held->info()), DataError);
}

TEST_F(Index, IsNotReadWhereItHasGrown) {
  const auto snapshot = write(long_row());
  SnapshotIndex::make(*snapshot, {}).write(snapshot->info());
  std::filesystem::resize_file(path(), std::uintmax_t{1} << 40);
  EXPECT_FALSE(SnapshotIndex::read(snapshot->info()));
}

TEST_F(Index, IsNotUsedWithAnyByteOfABoxChanged) {
  const auto snapshot = write(long_row());
  SnapshotIndex::make(*snapshot, {}).write(snapshot->info());
  const auto size = std::filesystem::file_size(path());
  std::string bytes(size, '\0');
  std::ifstream(path(), std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(size));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 4);
    write_bytes(path(), changed);
    EXPECT_FALSE(SnapshotIndex::read(snapshot->info())) << "byte " << i;
  }
  write_bytes(path(), bytes);
  EXPECT_TRUE(SnapshotIndex::read(snapshot->info()));
}

TEST_F(Index, DoesNotOverwriteAnotherFile) {
  const auto snapshot = write(long_row());
  write_bytes(path(), "notes of a user");
  EXPECT_THAT([&] { SnapshotIndex::make(*snapshot, {}).write(snapshot->info()); },
              ThrowsMessage<UsageError>(HasSubstr("found a file that is no index")));
}

TEST_F(Index, IsNotMadeOfTables) {
  write_bytes(folder_ / "table.txt", "1 2 3\n4 5 6\n");
  const auto snapshot = open_snapshot(folder_ / "table.txt", {{"x", "y", "z"}});
  EXPECT_THROW(SnapshotIndex::make(*snapshot, {}), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
