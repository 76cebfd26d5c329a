// Outputs of render: checked before anything is read, whole or not there at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/program.h"
#include "matches.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// The snapshot does not even exist: an error about the output shows what was checked first.
TEST(RenderOutput, IsCheckedBeforeTheSnapshotIsRead) {
  const TemporaryFolder folder;
  for (const std::string output : {"-o nowhere/a.png", "-o a.png --stats nowhere/s.json"}) {
    const ProgramResult result = splotchcl_in(folder, "render missing_snapshot " + output);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("nowhere"), Not(HasSubstr("missing_snapshot"))));
  }
}

TEST(RenderOutput, MustHaveAnEndingThatNamesAFormat) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "render missing_snapshot -o picture.xyz");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("picture.xyz"), HasSubstr(".png")));
}

class RenderedOutput : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o h --particles 2000").exit_code, 0);
  }
  TemporaryFolder folder_;
};

constexpr const char* tiny_picture = " --set 'image.size=[64,48]'";

TEST_F(RenderedOutput, HasTheSnapshotsNameInTheCurrentFolderByDefault) {
  ASSERT_EQ(run_in(folder_, "mkdir there; cp h there/snap.gadget").exit_code, 0);
  const ProgramResult result =
      splotchcl_in(folder_, std::string("render there/snap.gadget") + tiny_picture);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_image(folder_ / "snap.png").width, 64);
}

TEST_F(RenderedOutput, IsSilentInAPipe) {
  const ProgramResult result =
      splotchcl_in(folder_, std::string("render h -o a.png") + tiny_picture);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST_F(RenderedOutput, LeavesNothingBehindWhenTheDiskIsFull) {
  // By the reference, since the limit on files would stop a device's compiler too.
  const ProgramResult result =
      run_in(folder_,
             "mkdir empty; ulimit -f 1; \"$splotchcl\" render h --reference -o empty/a.exr --set "
             "'image.size=[60,60]'; code=$?; ls -A empty; exit $code");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("empty/a.exr"));
}

TEST_F(RenderedOutput, NeverShowsAnUnfinishedPictureWhenKilled) {
  // Killed after ever longer times, the picture is whole or absent; the last run finishes.
  for (const char* delay : {"0.1", "0.3", "0.5", "60"}) {
    const std::string command = std::string("rm -f a.png; timeout -s KILL ") + delay +
                                " \"$splotchcl\" render h -o a.png --set 'image.size=[900,900]'; "
                                "true";
    run_in(folder_, command);
    if (std::filesystem::exists(folder_ / "a.png")) {
      EXPECT_EQ(read_image(folder_ / "a.png").height, 900);
    }
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a.png"));
}

// Without what is found from the picture when it is drawn.
std::string without_exposure(std::string scene) {
  for (const Match& line : matches_of(scene, "\n(exposure|white) = [^\n]*"))
    scene.erase(scene.find(line[0]), line[0].size());
  return scene;
}

TEST_F(RenderedOutput, KeepsLinearLightAndTheSceneInExr) {
  const ProgramResult result =
      splotchcl_in(folder_, std::string("render h -o a.exr") + tiny_picture);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const ImageFileInfo info = read_image_info(folder_ / "a.exr");
  EXPECT_TRUE(info.has_alpha);
  EXPECT_EQ(info.metadata.count("splotchcl:version"), 1U);
  const std::string explained =
      splotchcl_in(folder_, std::string("render h --explain") + tiny_picture).out;
  const std::string& scene = info.metadata.at("splotchcl:scene");
  EXPECT_EQ(without_exposure(scene),
            without_exposure(explained.substr(explained.find("snapshot = "))));
  EXPECT_EQ(scene.find("exposure = \"auto\""), std::string::npos) << scene;
}

// Its 250 libraries take longer to load than a small picture takes to draw.
TEST_F(RenderedOutput, NeedsNoOpenImageIoForTheUsualFormats) {
  for (const std::string ending : {"png", "exr", "tif", "hdr"}) {
    const ProgramResult result =
        run_in(folder_, "LD_DEBUG=files \"$splotchcl\" render h --reference -o a." + ending +
                            " --set 'image.size=[16,12]'");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("libpng"));
    EXPECT_THAT(result.err, Not(HasSubstr("OpenImageIO"))) << ending;
  }
}

TEST_F(RenderedOutput, OfTheSameCallIsTheSameFile) {
  for (const std::string name : {"a", "b"}) {
    ASSERT_EQ(splotchcl_in(folder_, "render h -o " + name + ".png" + tiny_picture).exit_code, 0);
  }
  EXPECT_EQ(read_text(folder_ / "a.png"), read_text(folder_ / "b.png"));
}

// 4194303 is no process.
TEST(Leftovers, OfAnIndexAreRemovedByTheNextOne) {
  const TemporaryFolder folder;
  splotchcl_in(folder, "generate halo --particles 2000 -o s");
  std::ofstream(folder / ".s.splotchcl_index.4194303-1.part") << "half";
  EXPECT_EQ(splotchcl_in(folder, "index s").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / ".s.splotchcl_index.4194303-1.part"));
}

TEST(Leftovers, OfKeptSmoothingLengthsAreRemovedByTheNextOnes) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  std::ofstream table(folder / "t.txt");
  table << "x y z\n";
  for (int i = 0; i < 300; ++i)
    table << i % 7 << ' ' << i % 11 << ' ' << i % 13 << '\n';
  table.close();
  const std::string left = ".t.txt.type0.smoothing_lengths.4194303-1.part";
  std::ofstream(folder / left) << "half";
  const std::string render = "render t.txt -o p.png --size 32x24 --cache-smoothing-lengths";
  EXPECT_EQ(splotchcl_in(folder, render).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / left));
}

class ClosedStreams : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    splotchcl_in(folder_, "generate halo --particles 2000 -o s");
  }
  const TemporaryFolder folder_;
};

TEST_F(ClosedStreams, ArePartsOfNoOutput) {
  splotchcl_in(folder_, "render s -o whole.png --size 32x24");
  const std::string whole = read_text(folder_ / "whole.png");
  for (const char* const closed :
       {"0<&-", "1>&-", "2>&-", "0<&- 1>&-", "1>&- 2>&-", "0<&- 1>&- 2>&-"}) {
    const ProgramResult render =
        splotchcl_in(folder_, std::string("render s -o a.png --size 32x24 ") + closed);
    EXPECT_EQ(render.exit_code, 0) << closed;
    EXPECT_EQ(read_text(folder_ / "a.png"), whole) << closed;
    EXPECT_EQ(splotchcl_in(folder_, std::string("index s ") + closed).exit_code, 0) << closed;
    EXPECT_EQ(splotchcl_in(folder_, std::string("render nothing -o b.png ") + closed).exit_code, 1)
        << closed;
  }
}

TEST_F(ClosedStreams, ArePartsOfNoFilmAndNoMap) {
  const std::string film =
      "movie s --size 32x24 --set path.orbit.degrees=10 --set movie.frames=2 -o ";
  splotchcl_in(folder_, film + "whole%d.png");
  splotchcl_in(folder_, "map s -o whole.fits --size 16x16");
  const std::string told = splotchcl_in(folder_, "info s").out;
  for (const char* const closed : {"0<&-", "1>&-", "2>&-", "0<&- 1>&- 2>&-"}) {
    EXPECT_EQ(splotchcl_in(folder_, film + "a%d.png " + closed).exit_code, 0) << closed;
    EXPECT_EQ(
        splotchcl_in(folder_, std::string("map s -o a.fits --size 16x16 ") + closed).exit_code, 0);
    for (const std::string name : {"0.png", "1.png", ".fits"})
      EXPECT_EQ(read_text(folder_ / ("a" + name)), read_text(folder_ / ("whole" + name))) << closed;
  }
  EXPECT_EQ(splotchcl_in(folder_, "info s 0<&-").out, told);
}

TEST_F(RenderedOutput, OfTheLiveViewIsItsAddressAndMissedAtOnce) {
  const ProgramResult result =
      run_in(folder_, "timeout 60 \"$splotchcl\" view h --size 16x12 > /dev/full");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("standard output could not be written"));
}

TEST_F(RenderedOutput, OfASnapshotThatIsWrittenToMeanwhileIsNotKept) {
  for (const std::string command :
       {"render h --reference --size 64x48 -o a.png", "map h --reference --size 16x16 -o a.fits"}) {
    const ProgramResult result =
        run_in(folder_, "(while :; do touch h; done) & busy=$!; \"$splotchcl\" " + command +
                            "; code=$?; kill $busy; exit $code");
    EXPECT_EQ(result.exit_code, 1) << command;
    EXPECT_THAT(result.err, HasSubstr("h: changed while it was used")) << command;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.fits"));
}

// Of a service, or of a container with another user.
TEST(HomeThatCannotBeWritten, IsDoneWithout) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  const std::string without =
      "unset SPLOTCHCL_CACHE XDG_CACHE_HOME POCL_CACHE_DIR; export TMPDIR=$PWD/tmp HOME=/proc; "
      "mkdir tmp; \"$splotchcl\" generate halo --particles 2000 -o s; ";
  EXPECT_EQ(run_in(folder, without + "\"$splotchcl\" render s -o a.png --size 32x24").exit_code, 0);
}

TEST(HomeThatCannotBeWritten, IsNamedWhereNothingElseCanBe) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_in(folder,
             "export POCL_CACHE_DIR=/proc/nothing; mkdir none; OCL_ICD_VENDORS=$PWD/none "
             "OPENCL_VENDOR_PATH=$PWD/none \"$splotchcl\" devices");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("/proc/nothing"));
}

TEST(HomeThatCannotBeWritten, IsNamedWhereKernelsAreNotCompiledInIt) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  const ProgramResult result =
      run_in(folder,
             "export POCL_CACHE_DIR=/dev/null SPLOTCHCL_CACHE=; \"$splotchcl\" generate halo "
             "--particles 2000 -o s; \"$splotchcl\" render s -o a.png --size 32x24");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("/dev/null"));
}

TEST(HomeThatCannotBeWritten, MayBeNoNameAtAll) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  for (const std::string variables : {"POCL_CACHE_DIR=", "XDG_CACHE_HOME=/proc"}) {
    const ProgramResult result = run_in(
        folder,
        "unset SPLOTCHCL_CACHE POCL_CACHE_DIR; mkdir -p tmp; export TMPDIR=$PWD/tmp; export " +
            variables +
            "; \"$splotchcl\" generate halo --particles 2000 -o s; \"$splotchcl\" render s "
            "-o a.png --size 32x24");
    EXPECT_EQ(result.exit_code, 0) << variables << "\n" << result.err;
  }
}

// What lies there, PoCL would run.
class KernelsOfOthers : public ::testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT_DEVICE(); }
  // The folder that PoCL has been given instead.
  bool are_kept_from(const std::string& environment) const {
    const std::string render =
        "unset SPLOTCHCL_CACHE XDG_CACHE_HOME POCL_CACHE_DIR HOME; export TMPDIR=$PWD/tmp; "
        "mkdir -p tmp; " +
        environment +
        "\"$splotchcl\" generate halo --particles 2000 -o s; \"$splotchcl\" render s -o a.png "
        "--size 32x24";
    EXPECT_EQ(run_in(folder_, render).exit_code, 0);
    return run_in(folder_, "ls tmp | grep -q splotchcl-pocl-").exit_code == 0;
  }
  const TemporaryFolder folder_;
};

TEST_F(KernelsOfOthers, AreNotTakenFromTheCurrentFolder) {
  EXPECT_TRUE(are_kept_from("export HOME=.; "));
  EXPECT_FALSE(std::filesystem::exists(folder_ / ".cache"));
}

TEST_F(KernelsOfOthers, AreNotTakenFromAFolderThatEverybodyKnows) {
  EXPECT_TRUE(are_kept_from(""));
}

TEST_F(KernelsOfOthers, AreNotTakenFromAFolderThatOthersMayWriteTo) {
  EXPECT_TRUE(
      are_kept_from("mkdir -p home/.cache/pocl; chmod 777 home/.cache/pocl; "
                    "export HOME=$PWD/home; "));
}

TEST_F(KernelsOfOthers, AreNoneInAFolderOfOnesOwn) {
  EXPECT_FALSE(are_kept_from("mkdir -p home/.cache; export HOME=$PWD/home; "));
}

}  // namespace
}  // namespace splotchcl::test
