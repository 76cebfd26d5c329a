#include "formats/snapshot_checks.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// The path of the file that is mapped at an address; empty when none is.
std::string file_mapped_at(const void* address) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    unsigned long first = 0, last = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx", &first, &last) != 2) continue;
    const auto wanted = reinterpret_cast<std::uintptr_t>(address);
    const std::size_t path = line.find('/');
    if (wanted >= first && wanted < last && path != std::string::npos) return line.substr(path);
  }
  return {};
}

struct Variant {
  int format;
  bool is_swapped;
};
class GadgetBinary : public ::testing::TestWithParam<Variant> {
 protected:
  // Of the blocks that format 1 can name.
  static TestSnapshot small() {
    TestSnapshot snapshot = small_snapshot();
    if (GetParam().format == 1) snapshot.blocks.resize(7);
    return snapshot;
  }
  static BinaryFile bytes_of(const TestSnapshot& written) {
    return to_gadget(written, GetParam().format, GetParam().is_swapped);
  }
  std::unique_ptr<Snapshot> open(const TestSnapshot& written) const {
    write_bytes(path_, bytes_of(written).bytes);
    return open_snapshot(path_);
  }
  std::string refusal_of(const std::string& bytes) const {
    write_bytes(path_, bytes);
    return refusal(path_);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap";
};
INSTANTIATE_TEST_SUITE_P(FormatAndEndianness, GadgetBinary,
                         ::testing::Values(Variant{1, false}, Variant{1, true}, Variant{2, false},
                                           Variant{2, true}),
                         [](const auto& info) {
                           return std::string("Format") + (info.param.format == 1 ? "1" : "2") +
                                  (info.param.is_swapped ? "Swapped" : "Native");
                         });

TEST_P(GadgetBinary, HasTheValuesThatWereWritten) {
  const auto snapshot = open(small());
  expect_columns_of(*snapshot, small());
  EXPECT_THAT(snapshot->info().notes, IsEmpty());
}

TEST_P(GadgetBinary, DescribesTheHeader) {
  const auto snapshot = open(small());
  const SnapshotInfo& info = snapshot->info();
  EXPECT_EQ(
      info.format,
      std::string("Gadget format ") + (GetParam().format == 1 ? "1" : "2") +
          (GetParam().is_swapped == is_little_endian_host() ? ", big-endian" : ", little-endian"));
  EXPECT_EQ(info.time, 0.5);
  EXPECT_EQ(info.redshift, 1);
  EXPECT_EQ(info.box_size, 100);
  EXPECT_EQ(info.hubble_parameter, 0.7);
  ASSERT_EQ(info.types.size(), 3U);
  EXPECT_EQ(info.types[0].count, 37U);
  EXPECT_EQ(info.types[0].table_mass, std::nullopt);
  EXPECT_EQ(info.types[1].count, 20U);
  EXPECT_EQ(info.types[1].table_mass, 2.625);
  EXPECT_EQ(info.types[2].type, 4);
  EXPECT_EQ(info.find_type(2), nullptr);
}

TEST_P(GadgetBinary, TruncatedAtAnyByteIsRefused) {
  const BinaryFile whole = bytes_of(small());
  for (std::size_t size = 0; size < whole.bytes.size(); ++size) {
    // A file that ends with a block is one that never had the others; a header alone is not.
    const auto end = std::find(whole.block_ends.begin() + 1, whole.block_ends.end(), size);
    if (end != whole.block_ends.end()) continue;
    ASSERT_NE(refusal_of(whole.bytes.substr(0, size)), "") << "cut to " << size << " bytes";
  }
}

TEST_P(GadgetBinary, RecordMarksThatDisagreeAreRefused) {
  const BinaryFile whole = bytes_of(small());
  for (const std::size_t end : whole.block_ends) {
    std::string damaged = whole.bytes;
    damaged[end - 1] = static_cast<char>(damaged[end - 1] ^ 1);
    damaged[end - 4] = static_cast<char>(damaged[end - 4] ^ 1);
    EXPECT_THAT(refusal_of(damaged), HasSubstr("but closes with"));
  }
}

TEST_P(GadgetBinary, HeaderThatClaimsOtherNumbersOfParticlesIsRefused) {
  for (const int change : {-1, 1, 1000000}) {
    TestSnapshot written = small();
    written.counts[0] = static_cast<std::uint32_t>(37 + change);
    EXPECT_THAT(refusal_of(bytes_of(written).bytes), HasSubstr("contradicts the header's numbers"))
        << change;
  }
}

TEST_P(GadgetBinary, DoublePositionsKeepTheirDigits) {
  const TestSnapshot written = of_doubles_far_away(small());
  expect_positions_of(*open(written), written);
}

TEST_P(GadgetBinary, SixtyFourBitIdentifiersAreRead) {
  TestSnapshot written = small();
  written.set_kind("ID", ValueKind::uint64);
  for (auto& of_type : written.block("ID").values) {
    for (double& id : of_type)
      id = id * 0x1p33;  // still exact in single precision
  }
  expect_columns_of(*open(written), written);
}

TEST_P(GadgetBinary, AFileWithPositionsAloneIsEnough) {
  TestSnapshot written = small();
  written.blocks.resize(1);
  const auto snapshot = open(written);
  expect_columns_of(*snapshot, written);
  EXPECT_FALSE(has_field(*snapshot, 0, "velocity"));
  EXPECT_FALSE(has_field(*snapshot, 0, "mass"));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("particles of type 0 have no masses")));
}

TEST_P(GadgetBinary, TotalsOfZeroInTheHeaderDoNotMatter) {
  TestSnapshot written = small();
  written.total_counts.assign(6, 0);
  written.files = 0;
  expect_columns_of(*open(written), written);
}

TEST_P(GadgetBinary, AHeaderThatCountsNothingIsMadeUpForByTheBlocks) {
  TestSnapshot written;
  written.counts = {0, 30, 0, 0, 0, 0};
  add_block(written, "POS", 2U, 3);
  add_block(written, "VEL", 2U, 3);
  add_block(written, "ID", 2U, 1);
  BinaryFile file = bytes_of(written);
  file.bytes.replace(GetParam().format == 1 ? 4 : 20, 24, std::string(24, '\0'));
  EXPECT_EQ(refusal_of(file.bytes), "");
  const auto snapshot = open_snapshot(path());
  EXPECT_EQ(snapshot->info().find_type(1)->count, 30U);
  EXPECT_EQ(values_of(snapshot->read(1, "position")), as_floats(written.block("POS").values[1]));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("by their positions there are 30")));
}

TEST(GadgetBinaryFields, NativeFloatBlocksPointIntoTheFile) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", small_snapshot(), 2);
  Column positions, masses;
  {
    const auto snapshot = open_snapshot(folder / "snap");
    positions = snapshot->read(1, "position");
    masses = snapshot->read(4, "mass");
  }  // the columns alone keep the file mapped
  EXPECT_EQ(file_mapped_at(positions.data()), (folder / "snap").string());
  EXPECT_EQ(file_mapped_at(masses.data()), (folder / "snap").string());
  EXPECT_EQ(positions[0], as_floats(small_snapshot().block("POS").values[1])[0]);
}

TEST(GadgetBinaryFields, OtherBlocksAreCopied) {
  const TemporaryFolder folder;
  write_gadget(folder / "swapped", small_snapshot(), 2, true);
  write_gadget(folder / "snap", small_snapshot(), 2);
  const Column swapped = open_snapshot(folder / "swapped")->read(0, "position");
  const Column ids = open_snapshot(folder / "snap")->read(0, "id");
  EXPECT_EQ(file_mapped_at(swapped.data()), "");
  EXPECT_EQ(file_mapped_at(ids.data()), "");
}

TEST(GadgetBinaryFields, MassFromTheTableIsUniform) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", small_snapshot(), 2);
  const Column mass = open_snapshot(folder / "snap")->read(1, "mass");
  ASSERT_TRUE(mass.is_uniform());
  EXPECT_EQ(mass.uniform_value(), 2.625F);
}

TEST(GadgetBinaryFields, AMissingFieldIsNamedWithThoseThatAreThere) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", small_snapshot(), 2);
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_THAT(
      [&] { snapshot->read(1, "temperature"); },
      ThrowsMessage<DataError>(AllOf(HasSubstr("no field 'temperature'"), HasSubstr("potential"))));
  EXPECT_THAT([&] { snapshot->read(3, "position"); },
              ThrowsMessage<DataError>(HasSubstr("types with particles are 0, 1, 4")));
}

TEST(GadgetBinaryFields, SixByteIdentifiersAreExact) {
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

std::string wrapped_mark(std::uint64_t length) {
  const auto wrapped = static_cast<std::uint32_t>(length);  // as codes write it
  return {reinterpret_cast<const char*>(&wrapped), 4};
}

TEST(GadgetBinaryLarge, RecordsBeyondTwoAndFourGigabytesAreRead) {
  // 2.4 and 4.8 GB of positions; format 2 has a record of the label before them.
  const std::string label("\x08\0\0\0POS \0\0\0\0\x08\0\0\0", 16);
  for (const auto& [format, count] : {std::pair(1, 200000000U), {1, 400000000U}, {2, 400000000U}}) {
    const TemporaryFolder folder;
    {
      SparseFile file(folder / "snap");
      TestSnapshot empty;
      empty.counts[1] = count;
      empty.table_masses[1] = 1;
      const std::uint64_t bytes = std::uint64_t{12} * count;
      file.write(to_gadget(empty, format).bytes + (format == 2 ? label : "") + wrapped_mark(bytes));
      file.hole(bytes - 12);
      const float last[3] = {1, 2, 3};
      file.write(std::string(reinterpret_cast<const char*>(last), 12) + wrapped_mark(bytes));
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

}  // namespace
}  // namespace splotchcl::test
