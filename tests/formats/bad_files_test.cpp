#include <sys/stat.h>
#include <unistd.h>

#include "common/guards.h"
#include "formats/snapshot_checks.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Whatever is given as a snapshot and is none, or is damaged, is refused with one line that
// says so. Damage within a format has its tests beside the format.

class BadFiles : public ::testing::Test {
 protected:
  // One line that names the file.
  std::string refusal_of(const std::string& bytes) const {
    write_bytes(path_, bytes);
    const std::string text = refusal(path_);
    EXPECT_THAT(text, HasSubstr(path_.string() + ": "));
    EXPECT_THAT(text, Not(HasSubstr("\n")));
    return text;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snap";
};

TEST_F(BadFiles, AnEmptyFileIsRefused) {
  EXPECT_THAT(refusal_of(""), HasSubstr("the file is empty"));
}

TEST_F(BadFiles, ImagesAndArchivesAreNamed) {
  using std::string;
  EXPECT_THAT(refusal_of("\x89PNG\r\n\x1a\n and so on"), HasSubstr("a PNG image"));
  EXPECT_THAT(refusal_of("\xff\xd8\xff\xe0 and so on"), HasSubstr("a JPEG image; expected"));
  EXPECT_THAT(refusal_of(string("\x1f\x8b\x08\0", 4) + " and so on"),
              HasSubstr("a gzip archive; unpack it first"));
  EXPECT_THAT(refusal_of(string("\xfd\x37zXZ\0", 6) + " and so on"), HasSubstr("an xz archive"));
  EXPECT_THAT(refusal_of(string(257, '\0') + "ustar\0 and so on"), HasSubstr("a tar archive"));
}

// Numbers before the first line ends, as bytes of an image may be.
TEST_F(BadFiles, AFileOfAKnownKindIsNoTableWhateverNumbersItHolds) {
  EXPECT_THAT(refusal_of("SIMPLE  = T / NAXIS1 = 64 NAXIS2 = 64 BITPIX = -32\n"),
              HasSubstr("a FITS file; convert"));
}

TEST_F(BadFiles, TextIsRefused) {
  EXPECT_THAT(refusal_of("It was a dark and stormy night.\n"), HasSubstr("text, but no table"));
}

TEST_F(BadFiles, OtherBytesAreShown) {
  EXPECT_THAT(refusal_of(std::string("\x01\x02\x03\0\x05", 5)), HasSubstr("01 02 03 00 05"));
}

TEST_F(BadFiles, AnEmptyFolderIsRefused) {
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("no snapshot in this folder"));
}

TEST_F(BadFiles, APipeIsRefusedWithoutWaiting) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THAT(refusal(path_), HasSubstr("not a regular file"));
}

TEST_F(BadFiles, AFileThatMayNotBeReadIsRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  write_bytes(path_, "anything");
  std::filesystem::permissions(path_, std::filesystem::perms::none);
  EXPECT_THAT(refusal(path_), HasSubstr("Permission denied; check the path and its permissions"));
}

// What load_frame says of the particles that are left.
class BadParticles : public ::testing::Test {
 protected:
  static TestSnapshot gas() {
    TestSnapshot written;
    written.counts = {8, 0, 0, 0, 0, 0};
    for (const auto& [label, width] :
         {std::pair<const char*, int>{"POS", 3}, {"MASS", 1}, {"RHO", 1}, {"HSML", 1}}) {
      add_block(written, label, 1U, width);
    }
    return written;
  }
  std::string load(const TestSnapshot& written) const {
    write_gadget(folder_ / "snap", written, 2);
    const Scene scene = parse_scene(
        "snapshot = 'snap'\n[camera]\nposition = [0,0,-9]\nlook_at = [0,0,0]\n[[component]]\n"
        "name = 'gas'\n",
        "scene");
    std::vector<std::string> notes;
    return refusal_by<DataError>(
        [&] { load_frame(scene, *open_snapshot(folder_ / "snap"), notes); });
  }
  const TemporaryFolder folder_;
};

TEST_F(BadParticles, SomeAreLeftToTheCount) {
  TestSnapshot written = gas();
  written.block("POS").values[0][4] = std::numeric_limits<double>::quiet_NaN();
  written.block("HSML").values[0][3] = -1;
  EXPECT_EQ(load(written), "");
}

TEST_F(BadParticles, AllOfThemAreRefused) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TestSnapshot written = gas();
    for (std::size_t i = 0; i < written.block("POS").values[0].size(); i += 3)
      written.block("POS").values[0][i] = bad;
    EXPECT_THAT(load(written), HasSubstr("none of its 8 particles can be drawn"));
  }
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    TestSnapshot written = gas();
    for (double& h : written.block("HSML").values[0])
      h = bad;
    EXPECT_THAT(load(written), HasSubstr("none of its 8 particles can be drawn"));
  }
}

TestSnapshot long_snapshot() {
  TestSnapshot written;
  written.counts = {0, 20000, 0, 0, 0, 0};
  add_block(written, "POS", 2U, 3);
  add_block(written, "ID", 2U, 1);
  written.set_kind("ID", ValueKind::uint32);
  return written;
}

TEST(ShrinkingFiles, AreRefusedWhenTheNextFieldIsRead) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", long_snapshot(), 2);
  const auto snapshot = open_snapshot(folder / "snap");
  std::filesystem::resize_file(folder / "snap", 5000);
  EXPECT_THAT([&] { snapshot->read(1, "position"); },
              ThrowsMessage<DataError>(
                  HasSubstr("became shorter while it was read: found 5000 bytes, expected")));
  EXPECT_THROW(snapshot->read_ids(1), DataError);
}

TEST(ShrinkingFiles, ThatAreReplacedStayAsTheyWere) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", long_snapshot(), 2);
  const auto snapshot = open_snapshot(folder / "snap");
  write_bytes(folder / "new", "short");
  std::filesystem::rename(folder / "new", folder / "snap");
  EXPECT_EQ(snapshot->read(1, "position").size(), 60000U);
}

void read_what_is_gone(const std::filesystem::path& path) {
  guard_mapped_files();
  const Column positions = open_snapshot(path)->read(1, "position");
  std::filesystem::resize_file(path, 5000);
  volatile float last = positions[positions.size() - 1];
  static_cast<void>(last);
}

TEST(ShrinkingFilesDeathTest, EndTheProgramWithAMessageWhenTheyAreInUse) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", long_snapshot(), 2);
  EXPECT_EXIT(read_what_is_gone(folder / "snap"), ::testing::ExitedWithCode(1),
              "snap: became shorter while it was read: found 5000 bytes, expected [0-9]+; wait");
}

}  // namespace
}  // namespace splotchcl::test
