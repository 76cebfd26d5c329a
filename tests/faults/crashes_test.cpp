// Every command whose library crashes on a file: one line, exit code 1, and nothing is half
// written.
#include "cli/program.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class Crashes : public ::testing::Test {
 protected:
  void SetUp() override {
    Image spot(32, 32);
    for (int i = 0; i < 3; ++i)
      spot.at(16, 16)[i] = 1;
    write_image(folder_ / "spot.png", spot);
    write_image(folder_ / "other.exr", spot);
    const std::string few = " --disk-stars 50 --bulge-stars 50 --clusters 1 --cluster-stars 10";
    ASSERT_EQ(splotchcl_in(folder_, "galaxy spot.png -o g.hdf5" + few).exit_code, 0);
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o h --particles 1000").exit_code, 0);
    std::ofstream(folder_ / "film.toml") << "snapshot = 'g.hdf5'\n[image]\nsize = [16, 12]\n"
                                            "[path.orbit]\ndegrees = 90\n[movie]\nframes = 2\n"
                                            "[[component]]\n";
    std::ofstream(folder_ / "other.toml") << "snapshot = 'g.hdf5'\n[[component]]\n";
    std::ofstream(folder_ / "old.par") << "infile=g.hdf5\nsimtype=7\nperiodic=T\npalette0=p.pal\n";
    std::ofstream(folder_ / "p.pal") << "0 0 0\n1 1 1\n";
  }

  // But for what says of which film the frames are that there will be.
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (entry.path().extension() != ".txt") names.insert(entry.path().filename().string());
    return names;
  }

  void expect_one_line(const std::string& call, const std::string& arguments) const {
    SCOPED_TRACE(arguments);
    const std::set<std::string> before = names();
    const ProgramResult result =
        run_in(folder_, "LD_PRELOAD=" SPLOTCHCL_CRASHING_CALLS " SPLOTCHCL_CRASH=" + call +
                            " \"$splotchcl\" " + arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr("a library failed"));
    EXPECT_EQ(names(), before);
  }
  TemporaryFolder folder_;
};

TEST_F(Crashes, OfHdf5AreOneLineInEveryCommand) {
  const std::string small = " --reference --set image.size=[16,12]";
  for (const std::string& arguments :
       {std::string("info g.hdf5"), std::string("info g.hdf5 --header"),
        std::string("fields g.hdf5"), "render g.hdf5 -o o.png" + small,
        std::string("render g.hdf5 --explain"), std::string("movie film.toml -o o_%d.png"),
        std::string("movie film.toml -o o.mp4"), std::string("path film.toml -o o.png"),
        "render h -q -o o.png --set component.0.snapshot=g.hdf5" + small,
        "render h -o o.png --set finish.cross_fade.amount=0.5 --set "
        "finish.cross_fade.scene=other.toml" +
            small,
        std::string("evolve g.hdf5 --snapshots s_%d.hdf5 --frames 1"),
        std::string("evolve g.hdf5 other.toml -o o_%d.png --frames 1"),
        std::string("convert old.par -o o.toml")}) {
    expect_one_line("H5Fopen", arguments);
  }
}

TEST_F(Crashes, OfHdf5WhereItReadsParticlesAreOneLine) {
  for (const std::string arguments :
       {"info g.hdf5", "fields g.hdf5", "render g.hdf5 -o o.png --reference",
        "movie film.toml -o o_%d.png", "evolve g.hdf5 --snapshots s_%d.hdf5 --frames 1"}) {
    expect_one_line("H5Dopen2", arguments);
  }
}

TEST_F(Crashes, OfLibrariesOfPicturesAreOneLineInEveryCommand) {
  for (const std::string arguments :
       {"compare other.exr spot.png", "compare spot.png other.exr --diff o.png",
        "galaxy spot.png -o o.hdf5",
        "render h -o o.png --reference --set image.background_image=spot.png",
        "movie film.toml -o o_%d.png --reference --set image.background_image=spot.png"}) {
    expect_one_line("png_create_read_struct", arguments);
  }
}

}  // namespace
}  // namespace splotchcl::test
