// What users' files vary in, where it is more than a matter of one format.
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_checks.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

void append_record(std::string& bytes, const std::string& content) {
  const auto length = static_cast<std::uint32_t>(content.size());
  const std::string mark(reinterpret_cast<const char*>(&length), 4);
  bytes += mark + content + mark;
}

std::string gadget_header(const std::array<std::uint32_t, 6>& counts) {
  std::string header(256, '\0');
  std::memcpy(header.data(), counts.data(), sizeof counts);
  return header;
}

TEST(GadgetVariations, SixByteIdentifiersAreExact) {
  for (const bool is_swapped : {false, true}) {
    const TemporaryFolder folder;
    TestSnapshot written = small_snapshot();
    BinaryFile file = to_gadget(written, 2, is_swapped);
    // The identifiers again, in six bytes each.
    std::string ids;
    for (std::uint64_t i = 0; i < 68; ++i) {
      const std::uint64_t id = (std::uint64_t{1} << 47) + i;
      std::string bytes(reinterpret_cast<const char*>(&id), 6);
      if (is_swapped) std::reverse(bytes.begin(), bytes.end());
      ids += bytes;
    }
    const auto mark = [&](std::uint32_t length) {
      std::string bytes(reinterpret_cast<const char*>(&length), 4);
      if (is_swapped) std::reverse(bytes.begin(), bytes.end());
      return bytes;
    };
    const std::size_t label = file.bytes.find("ID  ");
    ASSERT_NE(label, std::string::npos);
    const std::size_t start = label + 12;  // the rest of the label's record
    const std::size_t old_length = 4 + 68 * 4 + 4;
    const auto length = static_cast<std::uint32_t>(ids.size());
    file.bytes.replace(start, old_length, mark(length) + ids + mark(length));
    write_bytes(folder / "snap", file.bytes);
    const auto snapshot = open_snapshot(folder / "snap");
    const std::vector<std::uint64_t> found = snapshot->read_ids(1);
    ASSERT_EQ(found.size(), 20U);
    EXPECT_EQ(found.front(), (std::uint64_t{1} << 47) + 37);
    EXPECT_EQ(found.back(), (std::uint64_t{1} << 47) + 56);
    EXPECT_EQ(values_of(snapshot->read(0, "mass")), as_floats(written.block("MASS").values[0]));
  }
}

TEST(GadgetVariations, AHeaderThatCountsNothingIsMadeUpForByTheBlocks) {
  for (const int format : {1, 2}) {
    const TemporaryFolder folder;
    TestSnapshot written;
    written.counts = {0, 30, 0, 0, 0, 0};
    add_block(written, "POS", 2U, 3);
    add_block(written, "VEL", 2U, 3);
    add_block(written, "ID", 2U, 1);
    BinaryFile file = to_gadget(written, format);
    const std::size_t counts = format == 1 ? 4 : 20;
    file.bytes.replace(counts, 24, std::string(24, '\0'));
    write_bytes(folder / "snap", file.bytes);
    const auto snapshot = open_snapshot(folder / "snap");
    EXPECT_EQ(snapshot->info().find_type(1)->count, 30U);
    EXPECT_EQ(values_of(snapshot->read(1, "position")), as_floats(written.block("POS").values[1]));
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("by their positions there are 30")));
  }
}

// Gas alone: every block of a value for each particle has the same length.
TestSnapshot gas(const std::vector<std::string>& labels) {
  TestSnapshot written;
  written.counts = {40, 0, 0, 0, 0, 0};
  for (const std::string& label : labels)
    add_block(written, label, 1U, label == "POS" || label == "VEL" ? 3 : 1);
  for (TestBlock& block : written.blocks) {
    if (block.label == "ID") block.kind = ValueKind::uint32;
  }
  return written;
}

void expect_field(const Snapshot& snapshot, const std::string& field, TestSnapshot& written,
                  const std::string& label) {
  EXPECT_EQ(values_of(snapshot.read(0, field)), as_floats(written.block(label).values[0])) << field;
}

TEST(GadgetVariations, Format1HasNoMassesWhereTheTableHasThemAll) {
  const TemporaryFolder folder;
  TestSnapshot written = gas({"POS", "VEL", "ID", "U", "RHO", "HSML"});
  written.table_masses[0] = 2;
  write_gadget(folder / "snap", written, 1);
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_EQ(snapshot->info().find_type(0)->table_mass, 2);
  expect_field(*snapshot, "internal_energy", written, "U");
  expect_field(*snapshot, "smoothing_length", written, "HSML");
  EXPECT_THAT(snapshot->info().notes, IsEmpty());
}

TEST(GadgetVariations, Format1WithoutIdentifiersIsToldByTheValues) {
  for (const bool is_swapped : {false, true}) {
    const TemporaryFolder folder;
    TestSnapshot written = gas({"POS", "VEL", "MASS", "U", "RHO", "HSML"});
    write_gadget(folder / "snap", written, 1, is_swapped);
    const auto snapshot = open_snapshot(folder / "snap");
    EXPECT_FALSE(has_field(*snapshot, 0, "id"));
    expect_field(*snapshot, "mass", written, "MASS");
    expect_field(*snapshot, "smoothing_length", written, "HSML");
    EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("ID is missing")));
  }
}

TEST(GadgetVariations, Format1SaysWhatItsBlocksAreTakenForWhereTheLastAreMissing) {
  const TemporaryFolder folder;
  TestSnapshot written = gas({"POS", "VEL", "ID", "MASS", "U"});
  write_gadget(folder / "snap", written, 1);
  const auto snapshot = open_snapshot(folder / "snap");
  expect_field(*snapshot, "internal_energy", written, "U");
  EXPECT_THAT(snapshot->info().notes,
              Contains(HasSubstr("POS, VEL, ID, MASS, U, and RHO, HSML are missing")));
}

TEST(GadgetVariations, ATailOfZerosIsRefusedBeforeItFillsMemory) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", gas({"POS"}), 1);
  std::filesystem::resize_file(folder / "snap", 1U << 24);
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("more than 10000 blocks"));
}

TEST(GadgetVariations, CountsThatOverflowAreRefused) {
  const TemporaryFolder folder;
  std::string bytes;
  append_record(bytes, gadget_header({0xffffffff, 0xffffffff, 0xffffffff, 0, 0, 0}));
  append_record(bytes, std::string(36, 'x'));
  write_bytes(folder / "snap", bytes);
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("contradicts the header's numbers"));
}

// A file with holes instead of the values in between: `ends` is all that is on the disk.
class SparseFile {
 public:
  explicit SparseFile(const std::filesystem::path& path) : file_(path, std::ios::binary) {}
  void write(const std::string& bytes) { file_.write(bytes.data(), size(bytes)); }
  void hole(std::uint64_t bytes) { file_.seekp(static_cast<std::streamoff>(bytes), std::ios::cur); }
  bool is_good() { return file_.flush().good(); }

 private:
  static std::streamsize size(const std::string& bytes) {
    return static_cast<std::streamsize>(bytes.size());
  }
  std::ofstream file_;
};

std::string mark_of(std::uint64_t length) {
  const auto wrapped = static_cast<std::uint32_t>(length);  // as codes write it
  return {reinterpret_cast<const char*>(&wrapped), 4};
}

TEST(GadgetVariations, RecordsBeyondTwoAndFourGigabytesAreRead) {
  for (const std::uint32_t count : {200000000U, 400000000U}) {  // 2.4 and 4.8 GB of positions
    const TemporaryFolder folder;
    {
      SparseFile file(folder / "snap");
      std::string start;
      append_record(start, gadget_header({0, count, 0, 0, 0, 0}));
      const std::uint64_t bytes = std::uint64_t{12} * count;
      file.write(start + mark_of(bytes));
      file.hole(bytes - 12);
      const float last[3] = {1, 2, 3};
      file.write(std::string(reinterpret_cast<const char*>(last), 12) + mark_of(bytes));
      if (!file.is_good()) GTEST_SKIP() << "no files of " << bytes << " bytes here";
    }
    const auto snapshot = open_snapshot(folder / "snap");
    EXPECT_EQ(snapshot->info().find_type(1)->count, count);
    const Column positions = snapshot->read(1, "position");
    ASSERT_EQ(positions.size(), std::size_t{3} * count);
    EXPECT_EQ(positions[positions.size() - 3], 1);
    EXPECT_EQ(positions[positions.size() - 1], 3);
  }
}

class SetsWithAnEmptyType : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Formats, SetsWithAnEmptyType, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "Hdf5" : "Binary"; });

TEST_P(SetsWithAnEmptyType, AreReadByAnyNameOfTheSet) {
  const TemporaryFolder folder;
  TestSnapshot whole = small_snapshot();
  const std::vector<TestSnapshot> parts = split(whole, 3);
  // All stars into the last file.
  std::vector<TestSnapshot> members = parts;
  for (std::size_t member = 0; member < 3; ++member) {
    members[member].counts[4] = member == 2 ? whole.counts[4] : 0;
    for (TestBlock& block : members[member].blocks) {
      block.values[4] = member == 2 ? whole.block(block.label).values[4] : std::vector<double>();
    }
  }
  for (std::size_t member = 0; member < 3; ++member) {
    const std::string name = "snap." + std::to_string(member);
    if (GetParam()) {
      write_hdf5(folder / (name + ".hdf5"), members[member]);
    } else {
      write_gadget(folder / name, members[member], 2);
    }
  }
  const std::string ending = GetParam() ? ".hdf5" : "";
  for (const std::string& name : {"snap.0" + ending, "snap.1" + ending, "snap.2" + ending,
                                  std::string("snap"), std::string()}) {
    const auto snapshot = open_snapshot(folder / name);
    EXPECT_EQ(snapshot->info().files.size(), 3U) << name;
    expect_columns_of(*snapshot, whole);
  }
}

}  // namespace
}  // namespace splotchcl::test
