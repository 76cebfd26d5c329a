#include "formats/snapshot_checks.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

TEST(GadgetBinaryDamage, NoPositionsIsRefused) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  written.remove("POS");
  write_gadget(folder / "snap", written, 2);
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("no positions: the file has only VEL"));
}

TEST(GadgetBinaryDamage, AStandardBlockOfTheWrongLengthIsRefused) {
  for (const char* label : {"POS", "VEL", "ID", "MASS", "U", "RHO", "HSML"}) {
    const TemporaryFolder folder;
    TestSnapshot written = small_snapshot();
    written.block(label).values[0].pop_back();
    write_gadget(folder / "snap", written, 2);
    EXPECT_THAT(refusal(folder / "snap"), HasSubstr(std::string("block ") + label + " has"));
  }
}

TEST(GadgetBinaryDamage, NegativeMassesInTheHeaderAreRefused) {
  const TemporaryFolder folder;
  TestSnapshot written = small_snapshot();
  written.table_masses[1] = -24;
  write_gadget(folder / "snap", written, 2);
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("mass table holds -24 for type 1"));
}

TEST(GadgetBinaryDamage, NoParticlesAtAllIsRefused) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", TestSnapshot(), 2);
  EXPECT_THAT(refusal(folder / "snap"), HasSubstr("counts no particles"));
}

TEST(GadgetBinaryDamage, ArbitraryBytesNeverCrash) {
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
