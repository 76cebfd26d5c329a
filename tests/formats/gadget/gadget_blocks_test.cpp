// Which blocks Gadget's files have, of which types and lengths, and what tells so.
#include <fmt/format.h>

#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

std::string mark_of(std::size_t length) {
  const auto mark = static_cast<std::uint32_t>(length);
  return {reinterpret_cast<const char*>(&mark), 4};
}

std::string record(const std::string& content) {
  return mark_of(content.size()) + content + mark_of(content.size());
}

// An INFO block about one block: values per particle, a flag for each type.
std::string info_block(const std::string& label, std::uint32_t values,
                       const std::array<std::uint32_t, 6>& types,
                       const std::string& kind = "FLOAT   ") {
  std::string info = label + kind;
  info.append(reinterpret_cast<const char*>(&values), 4);
  info.append(reinterpret_cast<const char*>(types.data()), sizeof types);
  return record(std::string("INFO") + std::string("\x30\0\0\0", 4)) + record(info);
}

// Of two types with as many particles.
TestSnapshot two_types(const std::string& label, unsigned types, double mass_of_second = 0,
                       bool has_double_positions = false) {
  TestSnapshot written;
  written.counts = {8, 8, 0, 0, 0, 0};
  written.table_masses[1] = mass_of_second;
  add_block(written, "POS", 3U, 3);
  if (has_double_positions) {
    written.block("POS").kind = ValueKind::float64;
    add_block(written, "VEL", 3U, 3);
  }
  add_block(written, label, types, 1);
  return written;
}

// Gas alone: every block of a value for each particle has the same length.
TestSnapshot gas(const std::vector<std::string>& labels) {
  TestSnapshot written;
  written.counts = {40, 0, 0, 0, 0, 0};
  for (const std::string& label : labels)
    add_block(written, label, 1U, label == "POS" || label == "VEL" ? 3 : 1);
  for (TestBlock& block : written.blocks) {
    if (block.label != "ID") continue;
    block.kind = ValueKind::uint32;
    for (double& id : block.values[0])
      id = std::floor(id);
  }
  return written;
}

// The small snapshot, changed.
template <class Change>
TestSnapshot small(const Change& change) {
  TestSnapshot written = small_snapshot();
  change(written);
  return written;
}

// Of the blocks that format 1 can name.
template <class Change>
TestSnapshot small_of_format_1(const Change& change) {
  return small([&](TestSnapshot& written) {
    written.blocks.resize(7);
    change(written);
  });
}

struct BlocksRow {
  const char* name;
  int format;
  TestSnapshot written;
  const char* expected;  // as of SnapshotRow
  bool are_all_read = true;
  std::string further = {};  // bytes behind it
};
void PrintTo(const BlocksRow& row, std::ostream* out) {
  *out << row.name;
}

class GadgetBlocks : public ::testing::TestWithParam<BlocksRow> {};

TEST_P(GadgetBlocks, AreReadOrRefused) {
  const BlocksRow& row = GetParam();
  const TemporaryFolder folder;
  for (const bool is_swapped : {false, true}) {
    if (is_swapped && !row.further.empty()) continue;
    write_bytes(folder / "snap",
                to_gadget(row.written, row.format, is_swapped).bytes + row.further);
    expect_snapshot(folder / "snap", {}, row.expected);
    if (row.are_all_read) expect_columns_of(*open_snapshot(folder / "snap"), row.written);
  }
}

constexpr bool in_part = false;  // or not at all

const std::string whole_of_stars = [] {
  const std::vector<int> numbers(small_snapshot().counts[4], 16777217);
  return fmt::format("whole/4 TRID {}", fmt::join(numbers, " "));
}();

INSTANTIATE_TEST_SUITE_P(
    Header, GadgetBlocks,
    ::testing::ValuesIn(std::vector<BlocksRow>{
        {"ABoxSizeOfZeroIsNone", 2, small([](auto& written) { written.box_size = 0; }), "no box"},
        {"ABoxSizeBelowZeroIsNoneWithANote", 2, small([](auto& written) { written.box_size = -5; }),
         "no box | note the box in the file, -5, is not"},
        {"HubbleParametersBeyondAnyHAreTakenForH0", 2,
         small([](auto& written) { written.hubble_parameter = 70; }),
         "hubble 0.7 | note 70, is taken for H0"},
        {"ARedshiftOfZeroWithoutCosmologyIsNone", 2,
         small([](auto& written) { written.redshift = written.omega_matter = 0; }), "no redshift"},
        {"NegativeMassesAreRefused", 2, small([](auto& written) { written.table_masses[1] = -24; }),
         "refused mass table holds -24 for type 1", in_part},
        {"NoParticlesAreRefused", 2, TestSnapshot(), "refused counts no particles", in_part}}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Types, GadgetBlocks,
    ::testing::ValuesIn(std::vector<BlocksRow>{
        {"FollowFromTheLengthOfAnUnknownBlock", 2, small([](auto& written) {
           add_block(written, "GASX", 1U, 1);
           add_block(written, "STRV", 16U, 3);
           add_block(written, "TWOX", 1U | 16U, 1);
         }),
         "no GASX/1 | no STRV/0 | no TWOX/1"},
        {"OfABlockThatFitsNoneAreNoted", 2, small([](auto& written) {
           written.blocks.push_back({"ODD", 0, 1, ValueKind::float32, {{1, 2, 3, 4, 5}}});
         }),
         "note block ODD left out: its 20 bytes | no ODD/0", in_part},
        {"AreNotedWhereSeveralFit", 2, two_types("NEW", 1U), "note NEW fits several sets"},
        {"AreThoseOfAnInfoBlock", 2, two_types("NEW", 2U), "no NEW/0", true,
         info_block("NEW ", 1, {0, 1, 0, 0, 0, 0})},
        {"AreExactAsWholeNumbersWhereAnInfoBlockSaysSo", 2, small([](auto& written) {
           const std::vector<double> numbers(written.counts[4], 16777217);
           written.blocks.push_back({"TRID", 16U, 1, ValueKind::uint32, {{}, {}, {}, {}, numbers}});
         }),
         whole_of_stars.c_str(), in_part, info_block("TRID", 1, {0, 0, 0, 0, 1, 0}, "LONG    ")},
        // As long as doubles of gas alone.
        {"AreAllOfMassesWhereTheTableHasSomeToo", 2, two_types("MASS", 3U, 7),
         "note MASS fits several sets"},
        {"AreAllOfABlockOfGasInThePrecisionOfPositions", 2, two_types("U", 3U),
         "note U fits several sets"},
        {"AreAllOfSmoothingLengthsInThePrecisionOfPositions", 2, two_types("HSML", 3U),
         "note HSML fits several sets"},
        {"AreAllOfSmoothingLengthsInThePrecisionOfVelocities", 2, two_types("HSML", 3U, 0, true),
         "note HSML fits several sets of particle types by its length; taken for type 0 and 1",
         in_part},
        // One for each of 16 particles, or two for each of 8.
        {"OfOtherWidthsThanAnInfoBlockSaysAreLeftOut", 2, two_types("ZS", 3U),
         "no ZS/0 | note ZS left out: it has 2 values", in_part,
         info_block("ZS  ", 2, {1, 0, 0, 0, 0, 0})}}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Format1, GadgetBlocks,
    ::testing::ValuesIn(std::vector<BlocksRow>{
        {"IsToldByLengthsWithoutVelocities", 1,
         small_of_format_1([](auto& written) { written.remove("VEL"); }),
         "no velocity/0 | note VEL is missing"},
        {"HasAbundancesBeforeTheSmoothingLengthWithCooling", 1,
         small_of_format_1([](auto& written) {
           written.flag_cooling = 1;
           written.remove("HSML");
           for (const char* const label : {"NE", "NH", "HSML"})
             add_block(written, label, 1U, 1);
         }),
         "types 3"},
        {"KeepsTheUsualOrderWithTheCoolingFlagAlone", 1,
         small_of_format_1([](auto& written) { written.flag_cooling = 1; }), "types 3"},
        {"HasNoMassesWhereTheTableHasThemAll", 1,
         [] {
           TestSnapshot written = gas({"POS", "VEL", "ID", "U", "RHO", "HSML"});
           written.table_masses[0] = 2;
           return written;
         }(),
         "no notes | table_mass 2"},
        {"WithoutIdentifiersIsToldByTheValues", 1, gas({"POS", "VEL", "MASS", "U", "RHO", "HSML"}),
         "no id | note ID is missing"},
        {"SaysWhatItsBlocksAreTakenForWhereTheLastAreMissing", 1,
         gas({"POS", "VEL", "ID", "MASS", "U"}),
         "note POS, VEL, ID, MASS, U, and RHO, HSML are missing"}}),
    [](const auto& info) { return info.param.name; });

TEST(GadgetBlocks, OfStarsHaveTheirSmoothingLengthUnderBothNames) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", small_snapshot(), 2);
  const auto snapshot = open_snapshot(folder / "snap");
  const auto expected = as_floats(small_snapshot().block("HSMS").values[4]);
  EXPECT_EQ(values_of(snapshot->read(4, "smoothing_length")), expected);
  EXPECT_EQ(values_of(snapshot->read(4, "star_smoothing_length")), expected);
}

TEST(GadgetBlocks, OfFormat1HaveTheNumbersOfTheirPlacesBehindThoseWithNames) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  write_gadget(folder / "snap", written, 1);
  const auto snapshot = open_snapshot(folder / "snap");
  // POS VEL ID MASS U RHO HSML are blocks 1 to 7.
  EXPECT_EQ(values_of(snapshot->read(1, "block_8")), as_floats(written.block("POT").values[1]));
  EXPECT_EQ(values_of(snapshot->read(4, "block_9")), as_floats(written.block("ACCE").values[4]));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("block_8, block_9")));
}

TEST(GadgetDamage, OfPositionsOrLengthsIsRefused) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", small([](auto& written) { written.remove("POS"); }), 2);
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("no positions: the file has only VEL"));
  for (const std::string label : {"POS", "VEL", "ID", "MASS", "U", "RHO", "HSML"}) {
    write_gadget(folder / "snap",
                 small([&](auto& written) { written.block(label).values[0].pop_back(); }), 2);
    EXPECT_THAT(refusal(folder / "snap"), HasSubstr("block " + label + " has"));
  }
}

TEST(GadgetDamage, ATailOfZerosIsRefusedBeforeItFillsMemory) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", gas({"POS"}), 1);
  std::filesystem::resize_file(folder / "snap", 1U << 24);
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("more than 10000 blocks"));
}

TEST(GadgetDamage, CountsThatOverflowAreRefused) {
  const TemporaryFolder folder;
  std::string header(256, '\0');
  std::fill_n(header.begin(), 12, '\xff');
  write_bytes(folder / "snap", record(header) + record(std::string(36, 'x')));
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("contradicts the header's numbers"));
}

TEST(GadgetDamage, OfArbitraryBytesNeverCrashes) {
  const TemporaryFolder folder;
  const std::string whole = to_gadget(small_snapshot(), 2).bytes;
  std::uint32_t random = 12345;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string damaged = whole;
    for (int change = 0; change < 4; ++change) {
      random = random * 1664525U + 1013904223U;
      // Mostly in the first 400 bytes, where the header and the first marks are.
      const std::size_t at = (random >> 8) % (trial % 4 == 0 ? damaged.size() : 400);
      damaged[at] = static_cast<char>(random >> 24);
    }
    write_bytes(folder / "snap", damaged);
    try {
      const auto snapshot = open_snapshot(folder / "snap");
      for (const ParticleTypeInfo& type : snapshot->info().types) {
        for (const FieldInfo& field : type.fields)
          snapshot->read(type.type, field.name);
      }
    } catch (const DataError&) {
      // refused: as good as read
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
