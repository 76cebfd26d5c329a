// Films made by the library, without the command line.
#include <chrono>

#include "splotchcl/film.h"
#include "splotchcl/generate.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

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
                                            "[[component]]\nname = 'gas'\npalette = 'white'\n";
    options_.scene = folder_ / "film.toml";
    options_.output = folder_ / "frame_%d.png";
    options_.by_reference = true;
    report_.note = [this](const std::string& text) { notes_.push_back(text); };
    report_.frame = [this](int frame, std::size_t, std::size_t) { frames_.push_back(frame); };
  }
  std::string refusal() const {
    return test::refusal_by<UsageError>([&] { make_film(options_, report_); });
  }
  // The second half is to come.
  void draw_half_before_a_change_of(const std::string& name) {
    options_.part = "1/2";
    EXPECT_EQ(make_film(options_, report_).state, FilmState::part_is_drawn);
    const auto file = folder_ / name;
    std::filesystem::last_write_time(
        file, std::filesystem::last_write_time(file) + std::chrono::seconds(2));
    options_.part = "2/2";
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  test::TemporaryFolder folder_;
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

TEST_F(Films, HaveNoFramesOfAnotherPaletteOfTheUsersOwn) {
  const auto palettes = folder_ / "palettes";
  std::filesystem::create_directory(palettes);
  std::ofstream(palettes / "mine.txt") << "0 0 0\n1 0 0\n";
  ::setenv("SPLOTCHCL_PALETTES", palettes.c_str(), 1);
  options_.settings = {"component.gas.palette=mine_r"};
  options_.part = "1/2";
  EXPECT_EQ(make_film(options_, report_).state, FilmState::part_is_drawn);
  std::ofstream(palettes / "mine.txt") << "0 0 0\n0 1 0\n";
  options_.part = "2/2";
  EXPECT_THAT(refusal(), HasSubstr("mine.txt"));
  ::unsetenv("SPLOTCHCL_PALETTES");
}

// As "cp -p" writes over a file: its size and time are those of before.
TEST_F(Films, HaveNoFramesOfOtherDataOfTheSameTime) {
  options_.part = "1/2";
  make_film(options_, report_);
  const auto file = folder_ / "halo.gadget";
  const auto time = std::filesystem::last_write_time(file);
  halo_.gas.position[0] += 1;
  write_gadget2(file, halo_);
  std::filesystem::last_write_time(file, time);
  options_.part = "2/2";
  EXPECT_THAT(refusal(), HasSubstr("halo.gadget"));
}

TEST_F(Films, EndWhereTheirDataIsWrittenAnewWhileTheyAreDrawn) {
  report_.frame = [this](int frame, std::size_t, std::size_t) {
    frames_.push_back(frame);
    if (frame == 2) write_gadget2(folder_ / "halo.gadget", halo_);
  };
  EXPECT_THAT([&] { make_film(options_, report_); },
              ThrowsMessage<DataError>(HasSubstr("halo.gadget: changed while it was used")));
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2));
  EXPECT_TRUE(has("frame_1.png"));
  EXPECT_FALSE(has("frame_2.png"));
}

TEST_F(Films, DoNotDependOnTheirSceneFileOnceItIsRead) {
  report_.frame = [this](int, std::size_t, std::size_t) {
    std::ofstream(folder_ / "film.toml", std::ios::app) << "# another line\n";
  };
  EXPECT_EQ(make_film(options_, report_).state, FilmState::complete);
}

TEST_F(Films, TakeNoOlderImagesWhoseTimesLieInTheFuture) {
  make_film(options_, report_);
  for (int frame = 0; frame < 4; ++frame) {
    const auto file = folder_ / ("frame_" + std::to_string(frame) + ".png");
    std::filesystem::last_write_time(
        file, std::filesystem::last_write_time(file) + std::chrono::hours(1));
  }
  frames_.clear();
  options_.settings = {"component.gas.palette=magma"};
  make_film(options_, report_);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
}

TEST_F(Films, KnowTheirOwnImagesWhateverTheClockSays) {
  report_.is_stopped = [this] { return frames_.size() == 2; };
  EXPECT_THROW(make_film(options_, report_), DataError);
  std::filesystem::last_write_time(
      folder_ / "frame_0.png",
      std::filesystem::file_time_type::clock::now() - std::chrono::hours(24 * 365));
  report_.is_stopped = {};
  make_film(options_, report_);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
}

TEST_F(Films, TakeNoForeignPicturesInTheFolderOfTheirFrames) {
  if (std::system("command -v ffmpeg > /dev/null") != 0) GTEST_SKIP() << "no ffmpeg";
  options_.output = folder_ / "film.mp4";
  const auto frames = folder_ / "film.mp4.frames";
  std::filesystem::create_directory(frames);
  std::ofstream(frames / "frame_000002.png") << "a picture of somebody else";
  std::ofstream(frames / "frame_000009.png") << "one that is no frame of the film";
  EXPECT_EQ(make_film(options_, report_).state, FilmState::complete);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
  EXPECT_FALSE(has("film.mp4.frames/frame_000002.png"));
  EXPECT_TRUE(has("film.mp4.frames/frame_000009.png"));
}

TEST_F(Films, WriteThroughNoLinksInTheFolderOfTheirFrames) {
  if (std::system("command -v ffmpeg > /dev/null") != 0) GTEST_SKIP() << "no ffmpeg";
  options_.output = folder_ / "film.mp4";
  std::ofstream(folder_ / "mine") << "mine";
  std::filesystem::create_directory(folder_ / "film.mp4.frames");
  std::filesystem::create_symlink(folder_ / "mine",
                                  folder_ / "film.mp4.frames" / "frame_000000.png");
  EXPECT_EQ(make_film(options_, report_).state, FilmState::complete);
  EXPECT_EQ(std::filesystem::file_size(folder_ / "mine"), 4U);
}

// Frames 0 and 1 are drawn of a film that was stopped, then 0 alone is asked for.
class FilmsOfAnInterruptedOne : public Films {
 protected:
  void draw_two_frames_then_the_first() {
    report_.is_stopped = [this] { return frames_.size() == 2; };
    EXPECT_THROW(make_film(options_, report_), DataError);
    report_.is_stopped = {};
    options_.frames = "0";
    EXPECT_EQ(make_film(options_, report_).state, FilmState::complete);
    options_.frames = "";
  }
};

TEST_F(FilmsOfAnInterruptedOne, LeaveItItsFrames) {
  if (std::system("command -v ffmpeg > /dev/null") != 0) GTEST_SKIP() << "no ffmpeg";
  options_.output = folder_ / "film.mp4";
  draw_two_frames_then_the_first();
  EXPECT_TRUE(has("film.mp4"));
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("film.mp4.frames stays")));
  EXPECT_EQ(make_film(options_, report_).frames, 4U);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
  EXPECT_FALSE(has("film.mp4.frames"));
}

TEST_F(FilmsOfAnInterruptedOne, LeaveItItsNumberedImages) {
  draw_two_frames_then_the_first();
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("movie.txt stays")));
  make_film(options_, report_);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
  EXPECT_FALSE(has("frame_%d.png.movie.txt"));
}

TEST_F(FilmsOfAnInterruptedOne, LeaveNothingBesideAllNumberedImages) {
  draw_two_frames_then_the_first();
  options_.frames = "2:4";
  make_film(options_, report_);
  EXPECT_THAT(frames_, ElementsAre(0, 1, 2, 3));
  EXPECT_FALSE(has("frame_%d.png.movie.txt"));
}

// A film of two snapshots whose pattern leaves out the number of their files.
class FilmsOfASequence : public Films {
 protected:
  FilmsOfASequence() {
    write_gadget2(folder_ / "s_000.0", halo_);
    write_gadget2(folder_ / "s_001.0", halo_);
    std::ofstream(folder_ / "film.toml") << "[image]\nsize = [16, 12]\n"
                                            "[camera]\nposition = [0, 0, 400]\n"
                                            "look_at = [0, 0, 0]\n"
                                            "[time]\nsnapshots = 's_%03d'\n"
                                            "interpolation = 'none'\n"
                                            "[[path.keyframes]]\nframe = 0\n'time.index' = 0\n"
                                            "[[path.keyframes]]\nframe = 1\n'time.index' = 1\n"
                                            "[[component]]\nname = 'gas'\n";
  }
};

TEST_F(FilmsOfASequence, HaveNoFramesOfOtherData) {
  draw_half_before_a_change_of("s_000.0");
  EXPECT_THAT(refusal(), HasSubstr("s_000.0"));
}

TEST_F(Films, HaveNoFramesOfOtherDataOfASingleComponent) {
  write_gadget2(folder_ / "other.0", halo_);
  std::ofstream(folder_ / "film.toml", std::ios::app)
      << "[[component]]\nname = 'other'\ntypes = ['gas']\nsnapshot = 'other'\n";
  draw_half_before_a_change_of("other.0");
  EXPECT_THAT(refusal(), HasSubstr("other.0"));
}

// A film whose light fades to an eighth, which an exposure that follows it makes up for.
class DarkeningFilms : public Films {
 protected:
  DarkeningFilms() {
    write_scene("auto");
    options_.as_displayed = true;
    options_.output = folder_ / "frame_%d.exr";
  }
  void write_scene(const std::string& exposure) const {
    std::ofstream(folder_ / "film.toml") << "snapshot = 'halo.gadget'\n"
                                            "[image]\nsize = [16, 12]\n"
                                            "[finish]\nexposure = '"
                                         << exposure
                                         << "'\n"
                                            "[[path.keyframes]]\nframe = 0\n"
                                            "'component.gas.brightness' = 1\n"
                                            "[[path.keyframes]]\nframe = 3\n"
                                            "'component.gas.brightness' = 0.125\n"
                                            "[[component]]\nname = 'gas'\nabsorption = 'none'\n";
  }
  float light(int frame) const {
    const Image image = read_image(folder_ / ("frame_" + std::to_string(frame) + ".exr"));
    float brightest = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 4)
      brightest = std::max({brightest, image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
    return brightest;
  }
};

TEST_F(DarkeningFilms, AreExposedAsTheirBrightestFrameIs) {
  make_film(options_, report_);
  EXPECT_GT(light(0), 0.9F);
  EXPECT_NEAR(light(3) / light(0), 0.125, 1e-5);
}

TEST_F(DarkeningFilms, StayBrightWhereExposureFollows) {
  write_scene("follow");
  make_film(options_, report_);
  EXPECT_GT(light(3), 0.6F);
  for (int frame = 1; frame < 4; ++frame)
    EXPECT_LT(std::abs(std::log2(light(frame) / light(frame - 1))), 1.2F) << frame;
}

TEST_F(DarkeningFilms, AreExposedAlikeInAllParts) {
  make_film(options_, report_);
  const float whole = light(3);
  options_.output = folder_ / "part" / "frame_%d.exr";
  std::filesystem::create_directory(folder_ / "part");
  options_.part = "2/2";
  make_film(options_, report_);
  std::filesystem::rename(folder_ / "part/frame_3.exr", folder_ / "frame_3.exr");
  EXPECT_EQ(light(3), whole);
}

TEST_F(Films, AreRefusedBeforeAnythingIsRead) {
  options_.part = "3/2";
  EXPECT_THROW(make_film(options_, report_), UsageError);
  options_.part = "";
  options_.output = folder_ / "film.unknown";
  EXPECT_THROW(make_film(options_, report_), UsageError);
  EXPECT_EQ(folder_.count_files(), 2U);
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST_F(Films, OfNumberedImagesHaveNoSound) {
  options_.settings = {"movie.audio=music.wav"};
  EXPECT_THAT(refusal(), HasSubstr("movie.audio"));
}

TEST_F(Films, OfNumberedExrHaveATimecode) {
  options_.output = folder_ / "frame_%d.exr";
  make_film(options_, report_);
  const std::string start = std::string("timeCode") + '\0' + "timecode" + '\0';
  EXPECT_THAT(bytes_of(folder_ / "frame_3.exr"), HasSubstr(start));
  EXPECT_THAT(bytes_of(folder_ / "frame_3.exr"), HasSubstr("00:00:00:03"));
}

class BlurredFilms : public Films {
 protected:
  // Of an ever brighter component: 1 at frame 0, 3 at frame 2.
  void film_with(const std::string& output, const std::string& movie) {
    std::ofstream(folder_ / "film.toml") << "snapshot = 'halo.gadget'\n"
                                            "[image]\nsize = [16, 12]\n"
                                            "[path]\ninterpolation = 'linear'\n"
                                            "[[path.keyframes]]\nframe = 0\n"
                                            "component.gas.brightness = 1\n"
                                            "[[path.keyframes]]\nframe = 2\n"
                                            "component.gas.brightness = 3\n"
                                            "[movie]\n"
                                         << movie
                                         << "[[component]]\nname = 'gas'\npalette = 'white'\n"
                                            "absorption = 'none'\n";
    options_.output = folder_ / output;
    make_film(options_, report_);
  }
  double middle_of(const std::string& name) const {
    return static_cast<double>(read_image(folder_ / name).pixels.at(4 * (16 * 6 + 8)));
  }

  const std::string blur_ = "frames = 3\nmotion_blur = { shutter = 0.5, samples = 2 }\n";
};

// At the first frame from when it is 1 to when it is 1.25 times as bright, in two pictures.
TEST_F(BlurredFilms, AreMeansOfTheirTime) {
  film_with("sharp_%d.exr", "frames = 3\n");
  film_with("blurred_%d.exr", blur_);
  EXPECT_NEAR(middle_of("blurred_0.exr") / middle_of("sharp_0.exr"), 0.5 * (1 + 1.125), 1e-4);
  EXPECT_NEAR(middle_of("blurred_1.exr") / middle_of("sharp_1.exr"), 1, 1e-4);
}

// What a shutter collects is light, of which the tone makes what is shown.
TEST_F(BlurredFilms, AreMeansOfLightBeforeItsTone) {
  options_.settings = {"finish.tone=filmic", "finish.exposure=-1", "finish.white=4",
                       "image.bits=16", "image.dither=false"};
  film_with("blurred_%d.png", blur_);
  const double blurred = middle_of("blurred_0.png");
  film_with("sharp_%d.png", "frames = 3\n");
  EXPECT_LT(blurred, 0.9);
  EXPECT_GT(blurred, 1.001 * middle_of("sharp_0.png"));
  options_.settings.push_back(
      "path.keyframes=[{frame = 0, \"component.gas.brightness\" = 1.0625}]");
  film_with("constant_%d.png", "frames = 3\n");
  EXPECT_NEAR(blurred, middle_of("constant_0.png"), 3e-5);
}

}  // namespace
}  // namespace splotchcl
