#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "splotchcl/image_file.h"

namespace splotchcl::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

// A thousand particles, some small frames, and the renderer that needs no device.
class Movie : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(splotchcl_in(folder_, "generate halo -o halo.gadget --particles 1000").exit_code, 0);
    write("film.toml",
          "snapshot = 'halo.gadget'\n"
          "[image]\nsize = [32, 18]\n"
          "[path.orbit]\ndegrees = 90\n"
          "[movie]\nframes = 6\n"
          "[[component]]\nname = 'gas'\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  ProgramResult movie(const std::string& arguments) const {
    return splotchcl_in(folder_, "movie film.toml --reference " + arguments);
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::string content(const std::string& name) const { return read_text(folder_ / name); }

  TemporaryFolder folder_;
};

bool has_ffmpeg() {
  static const bool found = std::system("ffmpeg -version > /dev/null 2>&1") == 0;
  return found;
}
#define SKIP_WITHOUT_FFMPEG() \
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg"

TEST_F(Movie, WritesNumberedImagesSilently) {
  const ProgramResult result = movie("-o frame_%03d.png --frames 1:6:2");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  for (const char* name : {"frame_001.png", "frame_003.png", "frame_005.png"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_EQ(folder_.count_files(), 2U + 3U);  // and no manifest
}

TEST_F(Movie, TakesRendersOptionsForLessData) {
  ASSERT_EQ(movie("-o frame_%d.png --frames 0 --max-particles 100 --stats s.json").exit_code, 0);
  const auto stats = nlohmann::json::parse(content("s.json"));
  EXPECT_LE(stats["frames"][0]["particles"]["total"], 100);  // of which some are stars
  ASSERT_EQ(movie("-o every_%d.png --frames 0 --every 5 --stats t.json").exit_code, 0);
  const int total = nlohmann::json::parse(content("t.json"))["frames"][0]["particles"]["total"];
  EXPECT_LT(total, 300);
}

TEST_F(Movie, TellsOfEachFrameThatWasDrawnAsJson) {
  ASSERT_EQ(movie("-o frame_%d.png --frames 1:6:2 --stats s.json").exit_code, 0);
  const auto stats = nlohmann::json::parse(content("s.json"));
  EXPECT_EQ(stats["output"], "frame_%d.png");
  EXPECT_EQ(stats["width"], 32);
  EXPECT_EQ(stats["frames_of_film"], 3);
  ASSERT_EQ(stats["frames"].size(), 3U);
  EXPECT_EQ(stats["frames"][1]["frame"], 3);
  EXPECT_GT(stats["frames"][1]["seconds"]["draw"], 0);
  EXPECT_EQ(stats["renderer"], "reference");
}

TEST_F(Movie, ChecksWhereItsStatisticsGoBeforeItReads) {
  const ProgramResult result = movie("-o frame_%d.png --stats nowhere/s.json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("nowhere"));
  EXPECT_FALSE(has("frame_0.png"));
}

TEST_F(Movie, NeedsAnOutputUnlessItExplains) {
  const ProgramResult result = movie("");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--output"));
  EXPECT_EQ(movie("--explain").exit_code, 0);
}

TEST_F(Movie, DrawsEachFrameAsRenderDoes) {
  write("still.toml",
        "snapshot = 'halo.gadget'\n[image]\nsize = [32, 18]\n"
        "[camera]\nposition = [60, 0, 10]\nlook_at = [0, 0, 0]\nsky = [0, 0, 1]\n"
        "[[component]]\nname = 'gas'\nreference_column = 1e-3\n");
  // Eight bits are rounded in the one and truncated in the other.
  for (const std::string convention : {"upright", "original"}) {
    const std::string options = ".toml --reference --set image.convention=" + convention;
    EXPECT_EQ(splotchcl_in(folder_, "render still" + options + " -o still.png").exit_code, 0);
    EXPECT_EQ(
        splotchcl_in(folder_, "movie still" + options + " -o frame_%d.png --set movie.frames=2")
            .exit_code,
        0);
    EXPECT_EQ(content("frame_0.png"), content("still.png"));
    EXPECT_EQ(content("frame_1.png"), content("still.png"));
  }
}

TEST_F(Movie, IsTheSameWhenItWasDrawnInPartsAndJoined) {
  SKIP_WITHOUT_FFMPEG();
  ASSERT_EQ(movie("-o whole.mp4").exit_code, 0);
  EXPECT_FALSE(has("whole.mp4.frames"));
  for (const std::string part : {"2/3", "1/3"}) {
    ASSERT_EQ(movie("-o parts.mp4 --part " + part).exit_code, 0);
    EXPECT_FALSE(has("parts.mp4"));
  }
  const ProgramResult early = movie("-o parts.mp4 --join");
  EXPECT_EQ(early.exit_code, 1);
  EXPECT_THAT(early.err, HasSubstr("2 of 6 frames are missing"));
  ASSERT_EQ(movie("-o parts.mp4 --part 3/3").exit_code, 0);
  EXPECT_FALSE(has("parts.mp4.frames"));
  EXPECT_EQ(content("parts.mp4"), content("whole.mp4"));
}

// Whenever it is stopped, and however: the frames that are there are whole, and the film made
// with them is the same to the last bit.
TEST_F(Movie, IsTheSameWhenItWasInterruptedAndContinued) {
  SKIP_WITHOUT_FFMPEG();
  ASSERT_EQ(movie("-o whole.mp4").exit_code, 0);
  for (const std::string signal : {"TERM", "KILL"}) {
    const std::string name = signal + ".mp4";
    const ProgramResult stopped = run_in(folder_, "\"$splotchcl\" movie film.toml --reference -o " +
                                                      name + " & film=$!; until [ -e " + name +
                                                      ".frames/frame_000001.png ] || "
                                                      "[ -e " +
                                                      name + " ]; do sleep 0.002; done; kill -" +
                                                      signal + " $film; wait $film");
    if (signal == "TERM" && stopped.exit_code != 0) {
      EXPECT_EQ(stopped.exit_code, 1);
      EXPECT_THAT(stopped.err, HasSubstr("the same command goes on"));
    }
    ASSERT_EQ(movie("-o " + name).exit_code, 0);
    EXPECT_FALSE(has(name + ".frames"));
    EXPECT_EQ(content(name), content("whole.mp4")) << signal;
  }
}

TEST_F(Movie, OfImagesIsTheSameWhenItWasKilledAndContinued) {
  ASSERT_EQ(movie("-o whole_%d.png").exit_code, 0);
  run_in(folder_,
         "\"$splotchcl\" movie film.toml --reference -o killed_%d.png & film=$!; "
         "until [ -e killed_1.png ]; do sleep 0.002; done; kill -KILL $film; wait $film");
  write(".killed_5.png.999999999-7.part", "what a killed process had written");
  ASSERT_EQ(movie("-o killed_%d.png").exit_code, 0);
  for (const char frame : {'0', '1', '2', '3', '4', '5'})
    EXPECT_EQ(content(std::string("killed_") + frame + ".png"),
              content(std::string("whole_") + frame + ".png"));
  EXPECT_EQ(folder_.count_files(), 2U + 2 * 6U);  // and nothing unfinished
}

TEST_F(Movie, MayBeJoinedAfterItsLastPartHasDoneIt) {
  SKIP_WITHOUT_FFMPEG();
  const ProgramResult early = movie("-o film.mp4 --join");
  EXPECT_EQ(early.exit_code, 1);
  EXPECT_THAT(early.err, HasSubstr("no frames to join"));
  ASSERT_EQ(movie("-o film.mp4").exit_code, 0);
  const std::string film = content("film.mp4");
  EXPECT_EQ(movie("-o film.mp4 --join").exit_code, 0);
  EXPECT_EQ(content("film.mp4"), film);
  EXPECT_FALSE(has("film.mp4.frames"));
}

TEST_F(Movie, OfTwoEyesIsTwoFilmsOrOneOfTwiceTheSize) {
  SKIP_WITHOUT_FFMPEG();
  ASSERT_EQ(movie("-o film.mp4 --set stereo.angle=3 --set movie.frames=2").exit_code, 0);
  EXPECT_TRUE(has("film_left.mp4") && has("film_right.mp4"));
  EXPECT_NE(content("film_left.mp4"), content("film_right.mp4"));
  ASSERT_EQ(movie("-o eyes_%d.png --frames 0 --set stereo.angle=3 --set stereo.layout=side_by_side")
                .exit_code,
            0);
  EXPECT_EQ(read_image(folder_ / "eyes_0.png").width, 64);
}

// A component may come into view late; then that frame decides, not one in which it is absent.
TEST_F(Movie, DecidesByTheFirstFrameThatShowsSomething) {
  write("away.txt",
        "camera_x camera_y camera_z lookat_x lookat_y lookat_z\n"
        "60 0 10 120 0 10\n60 0 10 0 0 0\n60 0 10 0 0 0\n");
  const ProgramResult result =
      movie("-o frame_%d.png --set path.file=away.txt --set movie.frames=3");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(content("frame_1.png"), content("frame_2.png"));
  EXPECT_GT(read_image(folder_ / "frame_1.png").at(16, 9)[0], 0.2F);
}

// Whatever a later frame names is looked at before the first is drawn.
TEST_F(Movie, ChecksTheWordsOfAllFramesBeforeItDraws) {
  for (const std::string wrong :
       {"palette='nosuch'", "color.field='nosuch'", "select.where='nosuch > 1'"}) {
    const ProgramResult result = movie(
        "-o f_%d.png --set \"path.keyframes=[{frame=0,component.gas.brightness=1},"
        "{frame=5,component.gas." +
        wrong + "}]\"");
    EXPECT_EQ(result.exit_code, 2) << wrong;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr("nosuch"));
    EXPECT_EQ(folder_.count_files(), 2U);
  }
}

TEST_F(Movie, DrawsAnewWhenAPaletteHasChanged) {
  SKIP_WITHOUT_FFMPEG();
  write("a.pal", "a\n0100\n2\n0 0 0\n255 255 255\n");
  const std::string film = "-o film.mp4 --set component.gas.palette=a.pal";
  ASSERT_EQ(movie(film + " --part 1/2").exit_code, 0);
  write("a.pal", "a\n0100\n3\n0 0 0\n9 9 9\n255 255 255\n");
  const ProgramResult other = movie(film);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("a.pal, "));
}

TEST_F(Movie, KeepsFramesThatAreThere) {
  ASSERT_EQ(movie("-o film.mp4 --part 1/6").exit_code, has_ffmpeg() ? 0 : 1);
  SKIP_WITHOUT_FFMPEG();
  const auto first = folder_ / "film.mp4.frames/frame_000000.png";
  const auto time = std::filesystem::last_write_time(first);
  ASSERT_EQ(movie("-o film.mp4 --part 1/3").exit_code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(first), time);
  EXPECT_TRUE(has("film.mp4.frames/frame_000001.png"));
}

TEST_F(Movie, RefusesToMixFramesOfTwoFilms) {
  SKIP_WITHOUT_FFMPEG();
  ASSERT_EQ(movie("-o film.mp4 --part 1/2").exit_code, 0);
  const ProgramResult other = movie("-o film.mp4 --set component.gas.brightness=2");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(is_one_line(other.err));
  EXPECT_THAT(other.err, HasSubstr("film.mp4.frames/movie.txt: found frames of another film"));
  std::filesystem::last_write_time(folder_ / "halo.gadget", {});
  EXPECT_THAT(movie("-o film.mp4").err, ContainsRegex(" bytes, written 2[0-9]+-.*:.* UTC"));
  EXPECT_THAT(other.err, HasSubstr("brightness = 1"));
}

TEST_F(Movie, MayChangeHowItIsEncodedWhenItIsContinued) {
  SKIP_WITHOUT_FFMPEG();
  ASSERT_EQ(movie("-o film.mp4 --part 1/2").exit_code, 0);
  EXPECT_EQ(movie("-o film.mp4 --set movie.rate_factor=30").exit_code, 0);
}

TEST_F(Movie, DrawsImagesAnewThatAreLeftFromAnother) {
  ASSERT_EQ(movie("-o frame_%d.png --set component.gas.brightness=0").exit_code, 0);
  const std::string black = content("frame_2.png");
  ASSERT_EQ(movie("-o frame_%d.png").exit_code, 0);
  EXPECT_NE(content("frame_2.png"), black);
}

class MovieOfOneColor : public Movie {
 protected:
  void expect_color(const std::string& film, const std::string& settings, double error) {
    ASSERT_EQ(movie("-o " + film +
                    " --set image.background=[0.8,0.3,0.1] --set image.size=[64,32] "
                    "--set component.gas.brightness=0 " +
                    settings)
                  .exit_code,
              0);
    ASSERT_EQ(
        run_in(folder_, "ffmpeg -loglevel error -i " + film + " -frames:v 1 first.png").exit_code,
        0);
    const Image image = read_image(folder_ / "first.png");
    EXPECT_NEAR(image.at(32, 16)[0], 0.8, error);
    EXPECT_NEAR(image.at(32, 16)[1], 0.3, error);
    EXPECT_NEAR(image.at(32, 16)[2], 0.1, error);
  }
};

// Half of the colour's resolution and 8 bits of luma and chroma are lost.
TEST_F(MovieOfOneColor, IsNotMuchOtherThanItsFrames) {
  SKIP_WITHOUT_FFMPEG();
  expect_color("film.mp4", "", 0.02);
}

TEST_F(MovieOfOneColor, HasTheLightOfItsFramesInTenBits) {
  SKIP_WITHOUT_FFMPEG();
  expect_color("film.mkv", "--set movie.bits=10 --set movie.codec=h265", 0.01);
}

TEST_F(Movie, RefusesOutputsThatAreNeitherFilmNorNumbered) {
  for (const std::string name : {"film.png", "film_%s.png", "film", "a_%d_%d.png"}) {
    const ProgramResult result = movie("-o " + name);
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_THAT(result.err, HasSubstr("such as frame_%04d.png")) << name;
  }
}

TEST_F(Movie, RefusesWhatAFilmCannotHold) {
  const ProgramResult odd = movie("-o film.mp4 --set image.width=33");
  EXPECT_EQ(odd.exit_code, 2);
  EXPECT_THAT(odd.err, HasSubstr("even numbers"));
  EXPECT_EQ(movie("-o film.webm --set movie.codec=h264").exit_code, 2);
}

TEST_F(Movie, TellsWhatToInstallWithoutFfmpeg) {
  const ProgramResult result =
      run_in(folder_, "PATH=/nowhere \"$splotchcl\" movie film.toml -o film.mp4");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err));
  EXPECT_THAT(result.err, HasSubstr("apt-get install ffmpeg"));
}

TEST_F(Movie, IsNotBegunWithoutAFolderForTemporaryFiles) {
  const ProgramResult result =
      run_in(folder_, "TMPDIR=/nonexistent \"$splotchcl\" movie film.toml -o film.mp4");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err));
  EXPECT_THAT(result.err, HasSubstr("TMPDIR"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.mp4.frames"));
}

// One line, exit code 2, and nothing drawn.
TEST_F(Movie, RefusesWhatCannotBeDrawn) {
  write("empty.txt", "");
  write("lacking.txt", "camera_x camera_y\n1 2\n");
  write("film.toml",
        "snapshot = 'halo.gadget'\n[camera]\nposition = [60, 0, 10]\nlook_at = [0, 0, 0]\n"
        "sky = [0, 0, 1]\n[path.orbit]\ndegrees = 90\n[movie]\nframes = 6\n"
        "[[component]]\nname = 'gas'\n");
  const std::pair<std::string, std::string> cases[] = {
      {"path.file=empty.txt", "no row of values"},
      {"path.file=lacking.txt", "camera.position.z as well"},
      {"component.gas.color.field=nosuch", "nosuch"},
      {"camera.look_at=[60,0,10]", "the camera's own position"},
      {"camera.sky=[-60,0,-10]", "parallel to the view"},
      {"camera.field_of_view=0", "> 0"},
      {"camera.field_of_view=180", "less than 180"},
  };
  for (const auto& [setting, expected] : cases) {
    const ProgramResult result = movie("-o f_%d.png --set " + setting);
    EXPECT_EQ(result.exit_code, 2) << setting;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr(expected));
  }
  EXPECT_EQ(folder_.count_files(), 4U);
}

TEST_F(Movie, ChecksItsPathBeforeItDraws) {
  write("path.txt", "fov\n30\n180\n");
  const ProgramResult result = splotchcl_in(
      folder_, "movie film.toml -o f_%d.png --set path.file=path.txt --set movie.frames=2");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("path.txt:3: column 1 (fov)"));
  EXPECT_EQ(folder_.count_files(), 3U);
}

}  // namespace
}  // namespace splotchcl::test
