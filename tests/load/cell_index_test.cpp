// The table of cells in SWIFT's files, which serves as an index.
#include "formats/hdf5/hdf5_values.h"
#include "load/component_boxes.h"
#include "load/particles.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using namespace test;

constexpr std::size_t cells = 4, particles_of_cell = 5000, particles = cells * particles_of_cell;
constexpr double side = 100, cell_width = side / cells;

// A snapshot of gas as SWIFT writes it: cells along x, one after the other, of which each particle
// has drifted a little.
struct SwiftFile {
  std::vector<double> positions, lengths, counts, offsets, files, centers, lower, upper;
  std::string lossy;

  SwiftFile() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0.5, cell_width + 0.5), other(1, side - 1);
    for (std::size_t c = 0; c < cells; ++c) {
      counts.push_back(particles_of_cell);
      offsets.push_back(static_cast<double>(c * particles_of_cell));
      files.push_back(0);
      for (std::size_t i = 0; i < particles_of_cell; ++i) {
        const double x = std::min(static_cast<double>(c) * cell_width + place(random), side - 0.5);
        positions.insert(positions.end(), {x, other(random), other(random)});
        lengths.push_back(0.1 + 0.1 * static_cast<double>(c));
      }
    }
    take_extents();
  }

  void take_extents() {
    lower.assign(3 * cells, std::numeric_limits<double>::infinity());
    upper.assign(3 * cells, -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const std::size_t place = i / (3 * particles_of_cell) * 3 + i % 3;
      lower[place] = std::min(lower[place], positions[i]);
      upper[place] = std::max(upper[place], positions[i]);
    }
  }

  void write(const std::filesystem::path& path, hid_t position_type = H5T_IEEE_F64LE) const {
    const auto file = splotchcl::test::create_hdf5(path);
    for (const char* const group : {"Header", "HydroScheme"})
      splotchcl::test::make_group(file, group);
    write_attribute(file, "Header", "NumPart_ThisFile", {particles, 0, 0, 0, 0, 0});
    write_attribute(file, "Header", "NumPart_Total", {particles, 0, 0, 0, 0, 0});
    write_attribute(file, "Header", "BoxSize", {side, side, side});
    splotchcl::test::write_text(file, "Header", "Code", "SWIFT");
    write_attribute(file, "HydroScheme", "Kernel gamma", {2});
    write_values(file, "PartType0/Coordinates", positions, 3, position_type);
    if (!lossy.empty()) {
      splotchcl::test::write_text(file, "PartType0/Coordinates", "Lossy compression filter", lossy);
    }
    write_values(file, "PartType0/SmoothingLengths", lengths, 1, H5T_IEEE_F32LE);
    write_values(file, "PartType0/Masses", std::vector<double>(particles, 1), 1, H5T_IEEE_F32LE);
    write_values(file, "Cells/Counts/PartType0", counts, 1, H5T_STD_I64LE);
    write_values(file, "Cells/OffsetsInFile/PartType0", offsets, 1, H5T_STD_I64LE);
    write_values(file, "Cells/Files/PartType0", files, 1, H5T_STD_I32LE);
    if (lower.empty()) return;
    write_values(file, "Cells/MinPositions/PartType0", lower, 3);
    write_values(file, "Cells/MaxPositions/PartType0", upper, 3);
  }
};

class CellIndex : public ::testing::Test {
 protected:
  std::shared_ptr<const Snapshot> open(const SwiftFile& file,
                                       hid_t position_type = H5T_IEEE_F64LE) {
    file.write(folder_ / "swift.hdf5", position_type);
    return open_snapshot(folder_ / "swift.hdf5");
  }
  bool is_trusted(const SwiftFile& file) {
    return !read_swift_cells(open(file)->info(), 0).empty();
  }
  static void expect_all_within(const Snapshot& snapshot, const SnapshotIndex& index) {
    const SnapshotIndex::Type* const type = index.find(0);
    ASSERT_NE(type, nullptr);
    const Column positions = snapshot.read(0, "position");
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const ParticleBox& box = type->boxes[i / 3 / SnapshotIndex::block_particles];
      ASSERT_GE(positions[i], box.lower[i % 3]) << i;
      ASSERT_LE(positions[i], box.upper[i % 3]) << i;
    }
  }

  splotchcl::test::TemporaryFolder folder_;
};

TEST_F(CellIndex, HoldsAllParticles) {
  const auto snapshot = open(SwiftFile());
  expect_all_within(*snapshot, index_of_cells(*snapshot));
}

TEST_F(CellIndex, HoldsPositionsThatWereRounded) {
  const auto snapshot = open(SwiftFile(), H5T_IEEE_F32LE);
  expect_all_within(*snapshot, index_of_cells(*snapshot));
}

TEST_F(CellIndex, IsNoWiderThanTheCellsOfABlock) {
  const auto snapshot = open(SwiftFile());
  const SnapshotIndex index = index_of_cells(*snapshot);
  // The last block's particles are of the last cell alone.
  EXPECT_GT(
      static_cast<double>(index.find(0)->boxes.back().lower[0]) + snapshot->position_origin().a[0],
      (cells - 1) * cell_width);
}

TEST_F(CellIndex, HasTheLargestSmoothingLengths) {
  const auto snapshot = open(SwiftFile());
  const SnapshotIndex index = index_of_cells(*snapshot);
  SnapshotIndex::Type type = *index.find(0);
  add_smoothing_lengths(snapshot->read(0, "smoothing_length"), type);
  ASSERT_EQ(type.boxes.size(), 3U);
  EXPECT_TRUE(type.has_smoothing_lengths);
  EXPECT_FLOAT_EQ(type.boxes[0].largest_smoothing_length, 2 * 0.2F);
  EXPECT_FLOAT_EQ(type.boxes[2].largest_smoothing_length, 2 * 0.4F);
}

TEST_F(CellIndex, HasNoEndWhereASmoothingLengthIsBad) {
  SwiftFile file;
  file.lengths[0] = -1;
  const auto snapshot = open(file);
  const SnapshotIndex index = index_of_cells(*snapshot);
  SnapshotIndex::Type type = *index.find(0);
  add_smoothing_lengths(snapshot->read(0, "smoothing_length"), type);
  EXPECT_EQ(type.boxes[0].upper[0], std::numeric_limits<float>::infinity());
  EXPECT_LT(type.boxes[1].upper[0], std::numeric_limits<float>::infinity());
}

// A particle that has left the box is written on the other side, and its cell's extents are not.
TEST_F(CellIndex, HasNoEndsWhereParticlesHaveLeftTheBox) {
  SwiftFile file;
  file.positions[1] = -0.25;
  file.take_extents();
  file.positions[1] = side - 0.25;
  const auto snapshot = open(file);
  expect_all_within(*snapshot, index_of_cells(*snapshot));
}

TEST_F(CellIndex, ServesComponentsOfAFixedSize) {
  const auto snapshot = open(SwiftFile());
  Component component = gas();
  EXPECT_FALSE(component_boxes(component, *snapshot, {0})) << "lengths of so few are not read";
  component.size_fixed = 3;
  const auto boxes = component_boxes(component, *snapshot, {0});
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->boxes.front().largest_smoothing_length, 3);
}

TEST_F(CellIndex, IsNotMadeWithoutExtents) {
  SwiftFile file;
  EXPECT_TRUE(is_trusted(file));
  file.lower.clear();
  EXPECT_FALSE(is_trusted(file));
}

TEST_F(CellIndex, IsNotMadeOfCellsInOtherFiles) {
  SwiftFile file;
  file.files.back() = 1;
  EXPECT_FALSE(is_trusted(file));
}

TEST_F(CellIndex, IsNotMadeOfCellsThatDoNotHoldAllParticles) {
  SwiftFile few, gap;
  few.counts.back() -= 1;
  EXPECT_FALSE(is_trusted(few));
  gap.offsets[1] += 1;
  EXPECT_FALSE(is_trusted(gap));
}

TEST_F(CellIndex, IsNotMadeOfParticlesInAnotherOrder) {
  SwiftFile file;
  const auto end_of_first = file.positions.begin() + 3 * particles_of_cell;
  std::swap_ranges(file.positions.begin(), end_of_first, end_of_first);
  EXPECT_FALSE(is_trusted(file));
}

TEST_F(CellIndex, IsNotMadeOfPositionsThatWereCompressedWithLoss) {
  SwiftFile file;
  file.lossy = "None";
  EXPECT_TRUE(is_trusted(file));
  file.lossy = "DScale5";
  EXPECT_FALSE(is_trusted(file));
}

TEST_F(CellIndex, IsNotMadeOfATableOfAnotherShape) {
  SwiftFile file;
  file.lower.resize(3);
  EXPECT_FALSE(is_trusted(file));
}

TEST(RealCellIndex, HoldsAllParticles) {
  const std::filesystem::path path = data_folder() / "swift/swift_lcdm_0000.hdf5";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const auto snapshot = open_snapshot(path);
  const SnapshotIndex index = index_of_cells(*snapshot);
  ASSERT_EQ(index.types().size(), snapshot->info().types.size());
  for (const SnapshotIndex::Type& type : index.types()) {
    const Column positions = snapshot->read(type.type, "position");
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const ParticleBox& box = type.boxes[i / 3 / SnapshotIndex::block_particles];
      ASSERT_GE(positions[i], box.lower[i % 3]) << i;
      ASSERT_LE(positions[i], box.upper[i % 3]) << i;
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
