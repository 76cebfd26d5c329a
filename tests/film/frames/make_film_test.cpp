// Films made by the library, without the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <vector>

#include "splotchcl/error.h"
#include "splotchcl/film.h"
#include "splotchcl/generate.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Films : public ::testing::Test {
 protected:
  Films() {
    GenerateSettings settings;
    settings.particles = 1000;
    halo_ = generate_halo(settings);
    write_gadget2(folder_ / "halo.gadget", halo_);
    std::ofstream(folder_ / "film.toml") << "snapshot = 'halo.gadget'\n"
                                            "[image]\nsize = [16, 12]\n"
                                            "[path.orbit]\ndegrees = 90\n"
                                            "[movie]\nframes = 4\n"
                                            "[[component]]\nname = 'gas'\n";
    options_.scene = folder_ / "film.toml";
    options_.output = folder_ / "frame_%d.png";
    options_.by_reference = true;
    report_.note = [this](const std::string& text) { notes_.push_back(text); };
    report_.frame = [this](int frame, std::size_t, std::size_t) { frames_.push_back(frame); };
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  testing::TemporaryFolder folder_;
  GeneratedSnapshot halo_;
  FilmOptions options_;
  FilmReport report_;
  std::vector<std::string> notes_;
  std::vector<int> frames_;
};

TEST_F(Films, AreMadeFrameByFrame) {
  const FilmResult result = make_film(options_, report_);
  EXPECT_EQ(result.state, FilmState::complete);
  EXPECT_EQ(result.frames, 4U);
  EXPECT_EQ(result.width, 16);
  EXPECT_EQ(result.height, 12);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_TRUE(has("frame_3.png"));
}

TEST_F(Films, NeedNobodyWhoListens) {
  EXPECT_EQ(make_film(options_).state, FilmState::complete);
}

TEST_F(Films, CountBadParticlesInOneNote) {
  halo_.gas.position[3] = std::numeric_limits<float>::quiet_NaN();
  write_gadget2(folder_ / "halo.gadget", halo_);
  make_film(options_, report_);
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("1 of ")));
}

TEST_F(Films, GoOnAfterTheyWereStopped) {
  report_.is_stopped = [this] { return frames_.size() == 2; };
  EXPECT_THROW(make_film(options_, report_), DataError);
  EXPECT_THAT(frames_, ElementsAre(0, 1));
  EXPECT_TRUE(has("frame_1.png"));
  report_.is_stopped = {};
  EXPECT_EQ(make_film(options_, report_).state, FilmState::complete);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
}

TEST_F(Films, AreMadeInParts) {
  options_.part = "2/2";
  EXPECT_EQ(make_film(options_, report_).state, FilmState::part_is_drawn);
  EXPECT_THAT(frames_, ElementsAre(2, 3));
  options_.part = "1/2";
  EXPECT_EQ(make_film(options_, report_).state, FilmState::complete);
  options_.only_join = true;
  EXPECT_EQ(make_film(options_, report_).state, FilmState::complete_before);
}

TEST_F(Films, AreRefusedBeforeAnythingIsRead) {
  options_.part = "3/2";
  EXPECT_THROW(make_film(options_, report_), UsageError);
  options_.part = "";
  options_.output = folder_ / "film.unknown";
  EXPECT_THROW(make_film(options_, report_), UsageError);
  EXPECT_EQ(folder_.count_files(), 2U);
}

}  // namespace
}  // namespace splotchcl
