// What people have on disk, in files of numbers; of texts sessions tell.
#include "cli/program.h"
#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_writer.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class EverydayFiles : public ::testing::Test {
 protected:
  ProgramResult run(const std::string& arguments) const { return splotchcl_in(folder_, arguments); }
  TemporaryFolder folder_;
};

// P-Gadget keeps other things there, in the first file of a set alone.
TEST_F(EverydayFiles, OfGadgetMayHaveHighWordsThatAreNoCounts) {
  auto members = split(small_snapshot(), 2);
  members[0].high_words = {0, 0, 228, 0, 0, 0};
  write_gadget_set(folder_ / "snap", members, 2);
  const ProgramResult result = run("info snap.0");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("gas: 37 particles"));
}

TEST_F(EverydayFiles, OfH5pyHaveNoHeader) {
  write_values(create_hdf5(folder_ / "t.hdf5"), "pos", {1, 2, 3, 4, 5, 6, 7, 8, 9}, 3);
  const ProgramResult result = run("info t.hdf5");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("3 particles"));
}

// What swiftsimio writes names no code, and has the kernel's scale for its radius.
TEST_F(EverydayFiles, OfSwiftsimioStartSimulations) {
  {
    const Hdf5Output file = create_hdf5(folder_ / "t.hdf5");
    make_group(file, "Header");
    make_group(file, "Units");
    write_attribute(file, "Header", "NumPart_ThisFile", {2, 0, 0, 0, 0, 0});
    write_attribute(file, "Units", "Unit length in cgs (U_L)", {3.08567758e24});
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "PartType0/SmoothingLength", {0.5, 0.5});
  }
  EXPECT_THAT(run("info t.hdf5").out,
              AllOf(HasSubstr("SWIFT initial conditions"), HasSubstr("0.912871")));
}

}  // namespace
}  // namespace splotchcl::test
