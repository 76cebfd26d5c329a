// What a command reads is never overwritten by what it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <map>

#include "cli/program.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

class KeptInputs : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o h.png --particles 1000").exit_code, 0);
    write_image(folder_ / "sky.png", Image(8, 8));
    std::ofstream(folder_ / "ids.json") << "1\n2\n3\n";
    std::ofstream(folder_ / "own.txt") << "0 0 0\n1 1 1\n";
    std::ofstream(folder_ / "scene.toml") << "snapshot = 'h.png'\n"
                                             "[image]\nsize = [16, 12]\n"
                                             "background_image = 'sky.png'\n"
                                             "[path.orbit]\ndegrees = 90\n"
                                             "[movie]\nframes = 3\n"
                                             "[[component]]\nselect.ids = 'ids.json'\n"
                                             "palette = './own.txt'\n";
    std::ofstream(folder_ / "fades.toml") << "snapshot = 'h.png'\n"
                                             "[image]\nsize = [16, 12]\n"
                                             "[finish.cross_fade]\nscene = 'scene.toml'\n"
                                             "amount = 0.5\n[[component]]\n";
  }

  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (entry.is_regular_file())
        texts[entry.path().filename().string()] = read_text(entry.path());
    return texts;
  }
  // Exit code 2 with one line that names the option, and no file is another than before.
  void expect_refused(const std::string& arguments, const std::string& option) const {
    const auto before = contents();
    const ProgramResult result = splotchcl_in(folder_, arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << arguments << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr(option)) << arguments;
    EXPECT_EQ(contents(), before) << arguments;
  }
  void run(const std::string& command) const {
    ASSERT_EQ(run_in(folder_, command).exit_code, 0) << command;
  }

  TemporaryFolder folder_;
};

TEST_F(KeptInputs, OfRenderAreTheSceneAndAllThatItNames) {
  expect_refused("render h.png -o h.png --reference", "--output");
  expect_refused("render scene.toml -o ./h.png --reference", "--output");
  expect_refused("render scene.toml -o sky.png --reference", "--output");
  for (const std::string stats : {"h.png", "scene.toml", "ids.json", "own.txt", "sky.png"})
    expect_refused("render scene.toml -o a.png --reference --stats " + stats, "--stats");
}

TEST_F(KeptInputs, AreKnownThroughLinks) {
  run("ln -s h.png soft.png; ln h.png hard.png; mkdir there; ln -s .. there/back");
  for (const std::string output : {"soft.png", "hard.png", "there/back/h.png"})
    expect_refused("render scene.toml --reference -o " + output, "--output");
}

TEST_F(KeptInputs, AreThoseOfTheSceneThatIsFadedTo) {
  expect_refused("render fades.toml -o sky.png --reference", "--output");
  expect_refused("render fades.toml -o a.png --reference --stats ids.json", "--stats");
  expect_refused("render fades.toml -o a.png --reference --stats scene.toml", "--stats");
}

TEST_F(KeptInputs, AreAllFilesOfASetAndOfASequence) {
  run("cp h.png s_0.png; cp h.png s_1.png");
  std::ofstream(folder_ / "run.toml") << "[time]\nsnapshots = 's_%d.png'\nindex = 0\n"
                                         "[[component]]\n";
  expect_refused("render run.toml -o s_1.png --reference", "--output");
}

TEST_F(KeptInputs, AreTheUsersOwnPalettes) {
  run("mkdir palettes; cp own.txt palettes/mine.txt");
  const ProgramResult result =
      run_in(folder_,
             "SPLOTCHCL_PALETTES=palettes \"$splotchcl\" render scene.toml -o a.png --reference "
             "--set component.0.palette=mine --stats palettes/mine.txt");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(read_text(folder_ / "palettes/mine.txt"), read_text(folder_ / "own.txt"));
}

TEST_F(KeptInputs, OfPalettesAreTheFilesThatAreShown) {
  run("cp own.txt own.png");
  expect_refused("palettes ./own.png --preview own.png", "--preview");
}

TEST_F(KeptInputs, OfAFilmAreKeptByItsFramesAndItsFolder) {
  run("cp sky.png frame_1.png");
  expect_refused(
      "movie scene.toml --reference -o frame_%d.png --set "
      "image.background_image=frame_1.png",
      "--output");
  expect_refused("movie scene.toml --reference -o f_%d.png --stats ids.json", "--stats");
  expect_refused("movie scene.toml --reference -o f_%d.png --stats f_2.png", "--stats");
  run("mkdir film.mp4.frames; cp sky.png film.mp4.frames/sky.png");
  const std::string before = read_text(folder_ / "film.mp4.frames/sky.png");
  const ProgramResult result = splotchcl_in(folder_,
                                            "movie scene.toml --reference -o film.mp4 --set "
                                            "image.background_image=film.mp4.frames/sky.png");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(read_text(folder_ / "film.mp4.frames/sky.png"), before);
  expect_refused("path scene.toml -o sky.png", "--output");
}

TEST_F(KeptInputs, OfCompareAndConvertAndGalaxy) {
  run("cp sky.png other.png");
  expect_refused("compare sky.png other.png --diff other.png", "--diff");
  run("printf 'simtype=2\\ninfile=h.png\\npalette0=old.toml\\n' > old.par; ln old.par new.toml");
  expect_refused("convert old.par -o new.toml", "--output");
  expect_refused("galaxy sky.png -o sky.png", "--output");
  run("printf '0 0\\n1 100\\n' > curve.txt");
  expect_refused("galaxy sky.png -o curve.txt --rotation-curve curve.txt", "--output");
}

TEST_F(KeptInputs, OfEvolveAreTheGalaxyAndItsScene) {
  Image spot(32, 32);
  for (int i = 0; i < 3; ++i)
    spot.at(16, 16)[i] = 1;
  write_image(folder_ / "spot.exr", spot);
  run("\"$splotchcl\" galaxy spot.exr -o g_0.hdf5 --disk-stars 50 --bulge-stars 50 --clusters 1 "
      "--cluster-stars 10");
  expect_refused("evolve g_0.hdf5 --snapshots g_%d.hdf5 --frames 2", "--snapshots");
  std::ofstream(folder_ / "g.toml") << "snapshot = 'g_0.hdf5'\n"
                                       "[image]\nsize = [16, 12]\n"
                                       "background_image = 'sky_1.png'\n[[component]]\n";
  run("cp sky.png sky_1.png");
  expect_refused("evolve g_0.hdf5 g.toml -o sky_%d.png --frames 2", "--output");
  expect_refused("evolve g_0.hdf5 g.toml -o n_%d.png --snapshots n_%d.png --frames 2", "--output");
}

TEST_F(KeptInputs, ExcludeTwoOutputsToOneFile) {
  expect_refused("render scene.toml -o a.png --stats a.png --reference", "--stats");
  expect_refused("render scene.toml -o a.png --stats ./a.png --reference", "--stats");
  run("touch b.png; ln -s b.png c.png");
  expect_refused("render scene.toml -o b.png --stats c.png --reference", "--stats");
}

TEST_F(KeptInputs, MayBeBesideAnOlderOutput) {
  run("\"$splotchcl\" render scene.toml -o a.png --reference");
  run("\"$splotchcl\" render scene.toml -o a.png --reference");
}

TEST_F(KeptInputs, KeepWhatLiesInTheFolderOfTheFrames) {
  if (run_in(folder_, "which ffmpeg").exit_code != 0) GTEST_SKIP() << "no ffmpeg";
  run("mkdir film.mp4.frames; echo mine > film.mp4.frames/notes.txt");
  run("\"$splotchcl\" movie scene.toml --reference -o film.mp4");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "film.mp4"));
  EXPECT_EQ(read_text(folder_ / "film.mp4.frames/notes.txt"), "mine\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.mp4.frames/frame_000000.png"));
}

TEST_F(KeptInputs, FifosAreWrittenInto) {
  run("mkfifo pipe.png; \"$splotchcl\" render scene.toml -o pipe.png --reference & "
      "cat pipe.png > copy.png; wait; "
      "\"$splotchcl\" render scene.toml -o file.png --reference; cmp copy.png file.png");
  struct stat status = {};
  ASSERT_EQ(::lstat((folder_ / "pipe.png").c_str(), &status), 0);
  EXPECT_TRUE(S_ISFIFO(status.st_mode));
}

TEST_F(KeptInputs, DevicesAreWrittenInto) {
  const ProgramResult result = splotchcl_in(folder_, "generate halo --particles 1000 -o /dev/full");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("/dev/full"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  run("\"$splotchcl\" generate halo --particles 1000 -o /dev/stdout | cmp - h.png");
}

}  // namespace
}  // namespace splotchcl::test
