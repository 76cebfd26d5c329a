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
class GadgetBinary : public ::testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(FormatAndEndianness, GadgetBinary,
                         ::testing::Values(Variant{1, false}, Variant{1, true}, Variant{2, false},
                                           Variant{2, true}),
                         [](const auto& info) {
                           return std::string("Format") + (info.param.format == 1 ? "1" : "2") +
                                  (info.param.is_swapped ? "Swapped" : "Native");
                         });

// The blocks that format 1 can name.
TestSnapshot snapshot_for(int format) {
  TestSnapshot snapshot = small_snapshot();
  if (format == 1) {
    for (const char* label : {"POT", "ACCE", "HSMS", "AGE"})
      snapshot.remove(label);
  }
  return snapshot;
}

TEST_P(GadgetBinary, HasTheValuesThatWereWritten) {
  const TemporaryFolder folder;
  const TestSnapshot written = snapshot_for(GetParam().format);
  write_gadget(folder / "snap", written, GetParam().format, GetParam().is_swapped);
  const auto snapshot = open_snapshot(folder / "snap");
  expect_columns_of(*snapshot, written);
  EXPECT_THAT(snapshot->info().notes, IsEmpty());
}

TEST_P(GadgetBinary, DescribesTheHeader) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", snapshot_for(GetParam().format), GetParam().format,
               GetParam().is_swapped);
  const auto snapshot = open_snapshot(folder / "snap");
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
  const TemporaryFolder folder;
  const BinaryFile whole =
      to_gadget(snapshot_for(GetParam().format), GetParam().format, GetParam().is_swapped);
  for (std::size_t size = 0; size < whole.bytes.size(); ++size) {
    // A file that ends with a block is one that never had the others; a header alone is not.
    const auto end = std::find(whole.block_ends.begin() + 1, whole.block_ends.end(), size);
    if (end != whole.block_ends.end()) continue;
    write_bytes(folder / "snap", whole.bytes.substr(0, size));
    ASSERT_NE(refusal(folder / "snap"), "") << "cut to " << size << " bytes";
  }
}

TEST_P(GadgetBinary, RecordMarksThatDisagreeAreRefused) {
  const TemporaryFolder folder;
  const BinaryFile whole =
      to_gadget(snapshot_for(GetParam().format), GetParam().format, GetParam().is_swapped);
  for (const std::size_t end : whole.block_ends) {
    std::string damaged = whole.bytes;
    damaged[end - 1] = static_cast<char>(damaged[end - 1] ^ 1);
    damaged[end - 4] = static_cast<char>(damaged[end - 4] ^ 1);
    write_bytes(folder / "snap", damaged);
    EXPECT_THAT(refusal(folder / "snap"), HasSubstr("but closes with"));
  }
}

TEST_P(GadgetBinary, HeaderThatClaimsOtherNumbersOfParticlesIsRefused) {
  const TemporaryFolder folder;
  for (const int change : {-1, 1, 1000000}) {
    TestSnapshot snapshot = snapshot_for(GetParam().format);
    snapshot.counts[0] = static_cast<std::uint32_t>(37 + change);
    write_gadget(folder / "snap", snapshot, GetParam().format, GetParam().is_swapped);
    EXPECT_THAT(refusal(folder / "snap"), HasSubstr("contradicts the header's numbers")) << change;
  }
}

TEST_P(GadgetBinary, DoublePositionsKeepTheirDigits) {
  const TemporaryFolder folder;
  TestSnapshot written = snapshot_for(GetParam().format);
  written.set_kind("POS", ValueKind::float64);
  for (auto& of_type : written.block("POS").values) {
    for (double& x : of_type)
      x += 1e6 + 1e-7;
  }
  write_gadget(folder / "snap", written, GetParam().format, GetParam().is_swapped);
  const auto snapshot = open_snapshot(folder / "snap");
  const Vec3 origin = snapshot->position_origin();
  for (const int type : {0, 1, 4}) {
    const auto& expected = written.block("POS").values[static_cast<std::size_t>(type)];
    const Column positions = snapshot->read(type, "position");
    ASSERT_EQ(positions.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // Offsets from the median are below 64, where floats lie 2^-18 apart. As a float the
      // position itself would only be known to 2^-5.
      EXPECT_NEAR(origin.a[i % 3] + static_cast<double>(positions[i]), expected[i], 0x1p-18);
    }
  }
}

TEST_P(GadgetBinary, SixtyFourBitIdentifiersAreRead) {
  const TemporaryFolder folder;
  TestSnapshot written = snapshot_for(GetParam().format);
  written.set_kind("ID", ValueKind::uint64);
  for (auto& of_type : written.block("ID").values) {
    for (double& id : of_type)
      id = id * 0x1p33;  // still exact in single precision
  }
  write_gadget(folder / "snap", written, GetParam().format, GetParam().is_swapped);
  expect_columns_of(*open_snapshot(folder / "snap"), written);
}

TEST_P(GadgetBinary, AFileWithPositionsAloneIsEnough) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  written.blocks.erase(written.blocks.begin() + 1, written.blocks.end());
  write_gadget(folder / "snap", written, GetParam().format, GetParam().is_swapped);
  const auto snapshot = open_snapshot(folder / "snap");
  expect_columns_of(*snapshot, written);
  EXPECT_FALSE(has_field(*snapshot, 0, "velocity"));
  EXPECT_FALSE(has_field(*snapshot, 0, "mass"));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("particles of type 0 have no masses")));
}

TEST_P(GadgetBinary, TotalsOfZeroInTheHeaderDoNotMatter) {
  const TemporaryFolder folder;
  TestSnapshot written = snapshot_for(GetParam().format);
  written.total_counts.assign(6, 0);
  written.files = 0;
  write_gadget(folder / "snap", written, GetParam().format, GetParam().is_swapped);
  expect_columns_of(*open_snapshot(folder / "snap"), written);
}

TEST(GadgetBinaryFields, BoxSizeOfZeroMeansNone) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  written.box_size = 0;
  write_gadget(folder / "snap", written, 2);
  EXPECT_EQ(open_snapshot(folder / "snap")->info().box_size, std::nullopt);
}

TEST(GadgetBinaryFields, RedshiftOfZeroWithoutCosmologyMeansNone) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  written.redshift = 0;
  written.omega_matter = 0;
  write_gadget(folder / "snap", written, 2);
  EXPECT_EQ(open_snapshot(folder / "snap")->info().redshift, std::nullopt);
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

TEST(GadgetBinaryFields, StarsFindTheirSmoothingLengthUnderBothNames) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  write_gadget(folder / "snap", written, 2);
  const auto snapshot = open_snapshot(folder / "snap");
  const auto expected = as_floats(written.block("HSMS").values[4]);
  EXPECT_EQ(values_of(snapshot->read(4, "smoothing_length")), expected);
  EXPECT_EQ(values_of(snapshot->read(4, "star_smoothing_length")), expected);
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

TEST(GadgetBinaryFields, TypesOfAnUnknownBlockFollowFromItsLength) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  add_block(written, "GASX", 1U, 1);
  add_block(written, "STRV", 16U, 3);
  add_block(written, "TWOX", 1U | 16U, 1);
  write_gadget(folder / "snap", written, 2);
  const auto snapshot = open_snapshot(folder / "snap");
  expect_columns_of(*snapshot, written);
  EXPECT_FALSE(has_field(*snapshot, 1, "GASX"));
  EXPECT_FALSE(has_field(*snapshot, 0, "STRV"));
  EXPECT_FALSE(has_field(*snapshot, 1, "TWOX"));
}

TEST(GadgetBinaryFields, ABlockThatFitsNoTypesIsLeftOutWithANote) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  TestBlock odd = {"ODD", 0, 1, ValueKind::float32, {{1, 2, 3, 4, 5}}};
  written.blocks.push_back(odd);
  write_gadget(folder / "snap", written, 2);
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("block ODD left out: its 20 bytes")));
  EXPECT_FALSE(has_field(*snapshot, 0, "ODD"));
}

TEST(GadgetBinaryFields, AnAmbiguousBlockIsNoted) {
  const TemporaryFolder folder;
  TestSnapshot written;
  written.counts = {8, 8, 0, 0, 0, 0};
  add_block(written, "POS", 3U, 3);
  add_block(written, "NEW", 1U, 1);
  write_gadget(folder / "snap", written, 2);
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_TRUE(has_field(*snapshot, 0, "NEW"));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("NEW fits several sets")));
}

std::string record(const std::string& content) {
  const auto length = static_cast<std::uint32_t>(content.size());
  const std::string mark(reinterpret_cast<const char*>(&length), 4);
  return mark + content + mark;
}

// An INFO block about one block of floats: values per particle, a flag for each type.
std::string info_block(const std::string& label, std::uint32_t values,
                       const std::array<std::uint32_t, 6>& types) {
  std::string info = label + "FLOAT   ";
  info.append(reinterpret_cast<const char*>(&values), 4);
  info.append(reinterpret_cast<const char*>(types.data()), sizeof types);
  return record(std::string("INFO") + std::string("\x30\0\0\0", 4)) + record(info);
}

TEST(GadgetBinaryFields, ABlockOfOtherWidthsIsLeftOutWithANote) {
  const TemporaryFolder folder;
  TestSnapshot written;
  written.counts = {8, 8, 0, 0, 0, 0};
  add_block(written, "POS", 3U, 3);
  add_block(written, "ZS", 3U, 1);  // one for each of 16 particles, or two for each of 8
  const std::string bytes = to_gadget(written, 2).bytes;
  write_bytes(folder / "snap", bytes + info_block("ZS  ", 2, {1, 0, 0, 0, 0, 0}));
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_FALSE(has_field(*snapshot, 0, "ZS"));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("ZS left out: it has 2 values")));
}

TEST(GadgetBinaryFields, AnInfoBlockSaysWhichTypesABlockIsFor) {
  const TemporaryFolder folder;
  TestSnapshot written;
  written.counts = {8, 8, 0, 0, 0, 0};
  add_block(written, "POS", 3U, 3);
  add_block(written, "NEW", 2U, 1);
  const std::string bytes = to_gadget(written, 2).bytes;
  write_bytes(folder / "snap", bytes + info_block("NEW ", 1, {0, 1, 0, 0, 0, 0}));
  const auto snapshot = open_snapshot(folder / "snap");
  EXPECT_EQ(values_of(snapshot->read(1, "NEW")), as_floats(written.block("NEW").values[1]));
  EXPECT_FALSE(has_field(*snapshot, 0, "NEW"));
}

TEST(GadgetBinaryFields, Format1NamesFurtherBlocksByTheirPlace) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  write_gadget(folder / "snap", written, 1);
  const auto snapshot = open_snapshot(folder / "snap");
  // POS VEL ID MASS U RHO HSML are blocks 1 to 7.
  EXPECT_EQ(values_of(snapshot->read(1, "block_8")), as_floats(written.block("POT").values[1]));
  EXPECT_EQ(values_of(snapshot->read(4, "block_9")), as_floats(written.block("ACCE").values[4]));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("block_8, block_9")));
}

TEST(GadgetBinaryFields, Format1WithoutVelocitiesIsToldByLengths) {
  const TemporaryFolder folder;
  TestSnapshot written = snapshot_for(1);
  written.remove("VEL");
  write_gadget(folder / "snap", written, 1);
  const auto snapshot = open_snapshot(folder / "snap");
  expect_columns_of(*snapshot, written);
  EXPECT_FALSE(has_field(*snapshot, 0, "velocity"));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("VEL is missing")));
}

TEST(GadgetBinaryFields, Format1WithCoolingHasAbundancesBeforeTheSmoothingLength) {
  const TemporaryFolder folder;
  TestSnapshot written = snapshot_for(1);
  written.flag_cooling = 1;
  written.remove("HSML");
  add_block(written, "NE", 1U, 1);
  add_block(written, "NH", 1U, 1);
  add_block(written, "HSML", 1U, 1);
  write_gadget(folder / "snap", written, 1);
  expect_columns_of(*open_snapshot(folder / "snap"), written);
}

TEST(GadgetBinaryFields, Format1WithTheCoolingFlagAloneKeepsTheUsualOrder) {
  const TemporaryFolder folder;
  TestSnapshot written = snapshot_for(1);
  written.flag_cooling = 1;
  write_gadget(folder / "snap", written, 1);
  expect_columns_of(*open_snapshot(folder / "snap"), written);
}

TEST(GadgetBinaryLarge, RecordsBeyondFourGibibytesAreFollowed) {
  const TemporaryFolder folder;
  // 4.8 GB of positions, nearly all of them a hole in the file.
  constexpr std::uint64_t particles = 400000000, bytes = 12 * particles;
  TestSnapshot empty;
  empty.counts[1] = static_cast<std::uint32_t>(particles);
  empty.table_masses[1] = 1;
  const std::string header = to_gadget(empty, 2).bytes;
  const auto wrapped = static_cast<std::uint32_t>(bytes);
  const std::string mark(reinterpret_cast<const char*>(&wrapped), 4);
  const float last = 42;
  {
    std::ofstream file(folder / "snap", std::ios::binary);
    file << header << std::string("\x08\0\0\0POS \0\0\0\0\x08\0\0\0", 16) << mark;
    file.seekp(static_cast<std::streamoff>(header.size() + 20 + bytes - sizeof last));
    file.write(reinterpret_cast<const char*>(&last), sizeof last) << mark;
    if (!file.flush()) GTEST_SKIP() << "the file system has no room for a file of 4.8 GB";
  }
  const auto snapshot = open_snapshot(folder / "snap");
  const Column positions = snapshot->read(1, "position");
  ASSERT_EQ(positions.size(), 3 * particles);
  EXPECT_EQ(positions[3 * particles - 1], 42);
}

}  // namespace
}  // namespace splotchcl::test
