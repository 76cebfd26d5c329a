// A film as files: which frames, where they lie, and the encoder.
#include <cstdio>
#include <thread>

#include "film/movie/encoder.h"
#include "film/movie/film_layout.h"
#include "film/movie/frame_files.h"
#include "film/path/path_messages.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::refusal;
using ::testing::SizeIs;

TEST(SelectFrames, CountsFromTheFirstInStepsAndLeavesOutTheEnd) {
  EXPECT_THAT(select_frames("3:9:2", 10), ElementsAre(3, 5, 7));
  EXPECT_THAT(select_frames("8:", 10), ElementsAre(8, 9));
  EXPECT_THAT(select_frames(":2", 10), ElementsAre(0, 1));
  EXPECT_THAT(select_frames("::4", 10), ElementsAre(0, 4, 8));
  EXPECT_THAT(select_frames("7", 10), ElementsAre(7));
  EXPECT_THAT(select_frames("", 3), ElementsAre(0, 1, 2));
}

TEST(SelectFrames, RefusesWhatIsNoRangeOfTheFilm) {
  for (const std::string text : {"a", "1:2:3:4", "-1:3", "1:3:0", "1.5", "1,3", "99999999999"})
    EXPECT_THAT(refusal([&] { select_frames(text, 10); }), HasSubstr("expected FIRST:END:STEP"));
  for (const std::string text : {"3:3", "5:4", "0:11", "10"})
    EXPECT_THAT(refusal([&] { select_frames(text, 10); }), HasSubstr("frames from 0 to 9"));
}

TEST(SelectPart, SharesAllFramesOut) {
  const std::vector<int> frames = select_frames("", 17);
  std::vector<int> together;
  for (int part = 1; part <= 5; ++part) {
    const std::vector<int> share = select_part(std::to_string(part) + "/5", frames);
    EXPECT_GE(share.size(), 3U);
    EXPECT_LE(share.size(), 4U);
    together.insert(together.end(), share.begin(), share.end());
  }
  EXPECT_EQ(together, frames);
}

TEST(SelectPart, MayBeEmptyWithMorePartsThanFrames) {
  EXPECT_THAT(select_part("1/4", {5}), SizeIs(0));
  EXPECT_THAT(select_part("4/4", {5}), ElementsAre(5));
}

TEST(SelectPart, RefusesWhatIsNoPart) {
  for (const std::string text : {"0/3", "4/3", "1", "1/", "/3", "a/b", "1/2/3", "-1/3"})
    EXPECT_THAT(refusal([&] { select_part(text, {1, 2, 3}); }), HasSubstr("expected K/N"));
}

std::string file_at(const std::string& pattern, int number) {
  return NumberedFiles::require(pattern, "--output").at(number).string();
}

TEST(NumberedFiles, HaveTheNumberAsPrintfWritesIt) {
  EXPECT_EQ(file_at("turn_%d.png", 7), "turn_7.png");
  EXPECT_EQ(file_at("turn_%04d.png", 7), "turn_0007.png");
  EXPECT_EQ(file_at("turn_%3d.png", 7), "turn_  7.png");
  EXPECT_EQ(file_at("turn_%02d.png", 1234), "turn_1234.png");
}

TEST(NumberedFiles, KeepTheirFolder) {
  EXPECT_EQ(file_at("a/100%/t%d.png", 3), "a/100%/t3.png");
}

TEST(NumberedFiles, NeedOneNumberInTheName) {
  for (const char* const pattern : {"turn.png", "turn_%s.png", "%d_%d.png", "turn_%", "%04x.png",
                                    "turn_%d/frame.png", "turn_%0000000d.png", "100%_%d.png", ""}) {
    EXPECT_FALSE(NumberedFiles::find(pattern)) << pattern;
    EXPECT_THROW(NumberedFiles::require(pattern, "--output"), UsageError) << pattern;
  }
}

// What players are told of a film, as ffprobe reads it back, and the codecs of this ffmpeg.

std::string answer(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 256> part;
  while (pipe != nullptr && std::fgets(part.data(), part.size(), pipe) != nullptr)
    text += part.data();
  if (pipe != nullptr) ::pclose(pipe);
  return text;
}

bool has_encoder(const std::string& name) {
  const std::string help = answer("ffmpeg -hide_banner -h encoder=" + name);
  return help.find("Encoder " + name) != std::string::npos;
}

class ToldFilm : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_encoder("libx264") || answer("ffprobe -version").find("ffprobe") != 0)
      GTEST_SKIP() << "no ffmpeg, or no ffprobe";
  }
  std::string make(const std::string& name, const FilmLayout& layout,
                   const MovieSettings& settings = {}) const {
    check_film(folder_ / name, settings, 64, 32);
    Encoder encoder(folder_ / name, settings, 64, 32, layout);
    for (std::uint8_t i = 0; i < 5; ++i)
      encoder.add(std::vector<std::uint8_t>(3 * 64 * 32, static_cast<std::uint8_t>(50 * i)));
    encoder.finish();
    return answer("ffprobe -v error -show_streams '" + (folder_ / name).string() + "'");
  }
  std::string decoded(const std::string& name) const {
    return answer("ffmpeg -v error -i '" + (folder_ / name).string() + "' -f md5 -");
  }

  test::TemporaryFolder folder_;
};

TEST_F(ToldFilm, IsAPanoramaOfTwoEyes) {
  FilmLayout layout;
  layout.panorama.emplace();
  layout.eyes = FilmLayout::Eyes::top_bottom;
  const std::string found = make("film.mp4", layout);
  EXPECT_THAT(found, HasSubstr("Spherical Mapping"));
  EXPECT_THAT(found, HasSubstr("projection=equirectangular"));
  EXPECT_THAT(found, HasSubstr("type=top and bottom"));
}

TEST_F(ToldFilm, IsHalfAPanoramaSideBySide) {
  FilmLayout layout;
  layout.panorama = {180, 180};
  layout.eyes = FilmLayout::Eyes::side_by_side;
  const std::string found = make("film.mov", layout);
  EXPECT_THAT(found, HasSubstr("projection=tiled equirectangular"));
  EXPECT_THAT(found, HasSubstr("bound_top=0"));
  EXPECT_THAT(found, HasSubstr("type=side by side"));
}

TEST_F(ToldFilm, HasTheSamePicturesAsOneThatIsNotTold) {
  make("plain.mp4", {});
  FilmLayout layout;
  layout.panorama.emplace();
  make("panorama.mp4", layout);
  EXPECT_THAT(decoded("plain.mp4"), HasSubstr("MD5="));
  EXPECT_EQ(decoded("panorama.mp4"), decoded("plain.mp4"));
}

TEST_F(ToldFilm, OfMatroskaSaysItsEyes) {
  FilmLayout layout;
  layout.eyes = FilmLayout::Eyes::side_by_side;
  EXPECT_THAT(make("film.mkv", layout), HasSubstr("side by side"));
  EXPECT_THAT(make("plain.mkv", {}), Not(HasSubstr("side by side")));
}

TEST_F(ToldFilm, SaysItsEyesInEachPictureOfH264) {
  FilmLayout layout;
  layout.eyes = FilmLayout::Eyes::top_bottom;
  make("film.mp4", layout);
  EXPECT_THAT(answer("ffprobe -v error -show_frames '" + (folder_ / "film.mp4").string() + "'"),
              HasSubstr("side_data_type=Stereo 3D"));
  make("flat.mp4", {});  // of one eye
  EXPECT_THAT(answer("ffprobe -v error -show_frames '" + (folder_ / "flat.mp4").string() + "'"),
              Not(HasSubstr("Stereo 3D")));
}

TEST_F(ToldFilm, HasSoundOfItsOwnLength) {
  const std::string sound = (folder_ / "tone.wav").string();
  answer("ffmpeg -v error -f lavfi -i sine=duration=9 '" + sound + "'");
  MovieSettings settings;
  settings.audio = sound;
  const std::string found = make("film.mov", {}, settings);
  EXPECT_THAT(found, HasSubstr("codec_type=audio"));
  EXPECT_THAT(found, HasSubstr("nb_frames=5"));
  settings.audio = (folder_ / "film.mov").string() + ".none";
  EXPECT_THAT([&] { check_film(folder_ / "x.mov", settings, 64, 32); },
              ThrowsMessage<DataError>(HasSubstr("found no sound")));
}

struct Master {
  Codec codec;
  const char *encoder, *name, *found;
};

class Masters : public ToldFilm, public ::testing::WithParamInterface<Master> {};

TEST_P(Masters, AreMade) {
  if (!has_encoder(GetParam().encoder)) GTEST_SKIP() << "no " << GetParam().encoder;
  MovieSettings settings;
  settings.codec = GetParam().codec;
  check_film(folder_ / GetParam().name, settings, 256, 128);
  Encoder encoder(folder_ / GetParam().name, settings, 256, 128);
  const std::size_t bytes = GetParam().codec == Codec::prores ? 2 : 1;
  for (int i = 0; i < 2; ++i)
    encoder.add(std::vector<std::uint8_t>(bytes * 3 * 256 * 128, 99));
  encoder.finish();
  EXPECT_THAT(
      answer("ffprobe -v error -show_streams '" + (folder_ / GetParam().name).string() + "'"),
      HasSubstr(GetParam().found));
}

INSTANTIATE_TEST_SUITE_P(
    OfThisFfmpeg, Masters,
    ::testing::Values(Master{Codec::prores, "prores_ks", "film.mov", "yuv422p10le"},
                      Master{Codec::dnxhr, "dnxhd", "film.mov", "profile=DNXHR HQ"},
                      Master{Codec::hap, "hap", "film.mov", "codec_name=hap"},
                      Master{Codec::ffv1, "ffv1", "film.mkv", "codec_name=ffv1"},
                      Master{Codec::av1, "libaom-av1", "film.mp4", "codec_name=av1"}),
    [](const auto& info) { return std::string(info.param.encoder).substr(0, 4); });

TEST(FilmCodecs, AreRefusedWhereTheyDoNotFit) {
  MovieSettings settings;
  settings.codec = Codec::hap;
  EXPECT_THAT([&] { check_film("film.mp4", settings, 64, 64); },
              ThrowsMessage<UsageError>(HasSubstr("held by .mov")));
  EXPECT_THAT([&] { check_film("film.mov", settings, 66, 64); },
              ThrowsMessage<UsageError>(HasSubstr("multiples of 4")));
  settings.bits = 10;
  EXPECT_THAT([&] { check_film("film.mov", settings, 64, 64); },
              ThrowsMessage<UsageError>(HasSubstr("movie.bits")));
}

TEST(FilmLayouts, AreThoseOfTheScene) {
  Scene scene;
  scene.image.width = 200;
  scene.image.height = 100;
  scene.camera.emplace();
  EXPECT_TRUE(layout_of(scene).is_plain());
  scene.camera->projection = Projection::equirectangular;
  scene.camera->field_of_view_degrees = 180;
  scene.stereo.emplace();
  scene.stereo->layout = StereoLayout::top_bottom;
  EXPECT_EQ(layout_of(scene).panorama->height, 90);
  EXPECT_EQ(layout_of(scene).eyes, FilmLayout::Eyes::top_bottom);
  EXPECT_FALSE(can_tell("film.mkv", layout_of(scene)));
  EXPECT_TRUE(can_tell("film.mp4", layout_of(scene)));
}

// Films are made by another program, which may do anything: here by scripts in its place.

class FakeEncoder : public ::testing::Test {
 protected:
  FakeEncoder() : path_before_(std::getenv("PATH")) {
    std::filesystem::create_directory(folder_ / "bin");
    ::setenv("PATH", ((folder_ / "bin").string() + ":" + path_before_).c_str(), 1);
  }
  ~FakeEncoder() override { ::setenv("PATH", path_before_.c_str(), 1); }

  void make_ffmpeg(const std::string& script) const {
    const std::filesystem::path program = folder_ / "bin" / "ffmpeg";
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  // What the film's failure says.
  std::string failure(int frames = 1) const {
    return test::refusal_by<DataError>([&] {
      Encoder encoder(folder_ / "film.mp4", {}, 640, 480, {}, std::chrono::milliseconds(300));
      for (int i = 0; i < frames; ++i)
        encoder.add(std::vector<std::uint8_t>(3 * 640 * 480));
      encoder.finish();
    });
  }
  // Nothing but the folder with the script.
  bool left_nothing() const { return folder_.count_files() == 1; }

  test::TemporaryFolder folder_;
  std::string path_before_;
};

TEST_F(FakeEncoder, ThatNeverReadsIsEnded) {
  make_ffmpeg("exec sleep 1000");
  EXPECT_THAT(failure(10), HasSubstr("read nothing"));
  EXPECT_TRUE(left_nothing());
}

TEST_F(FakeEncoder, OfTheCurrentFolderIsNotRun) {
  make_ffmpeg("touch \"$(dirname \"$0\")/ran\"");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_ / "bin");
  for (const char* const path : {"", ".", ":/nowhere", "/nowhere:", "../bin:/nowhere"}) {
    ::setenv("PATH", path, 1);
    EXPECT_THAT(failure(), HasSubstr("cannot be started")) << path;
  }
  std::filesystem::current_path(before);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bin" / "ran"));
}

TEST_F(FakeEncoder, ThatNeverEndsIsEndedWithWhatItStarted) {
  make_ffmpeg("sleep 1000 & echo $! > \"$(dirname \"$0\")/child\"; cat > /dev/null; wait");
  EXPECT_THAT(failure(), HasSubstr("wrote nothing"));
  const std::string child = test::read_text(folder_ / "bin" / "child");
  const std::string status = "/proc/" + child.substr(0, child.find('\n')) + "/status";
  // Its end may take a moment, and then wait for somebody to take note of it.
  const auto has_ended = [&status] {
    const std::string text = test::read_text(status);
    return text.empty() || text.find("State:\tZ") != std::string::npos;
  };
  for (int i = 0; i < 500 && !has_ended(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_TRUE(has_ended());
  EXPECT_TRUE(left_nothing());
}

TEST_F(FakeEncoder, ThatWritesNothingMakesNoFilm) {
  make_ffmpeg("cat > /dev/null");
  EXPECT_THAT(failure(), HasSubstr("finds 0 frames, expected 1"));
  EXPECT_TRUE(left_nothing());
}

TEST_F(FakeEncoder, ThatFailsSaysWhy) {
  make_ffmpeg("echo no such codec >&2; exit 1");
  EXPECT_THAT(failure(10), HasSubstr("no such codec"));
  EXPECT_TRUE(left_nothing());
}

TEST_F(FakeEncoder, WithoutTenBitsIsRefusedBeforeAnythingIsDrawn) {
  make_ffmpeg("echo Supported pixel formats: yuv420p yuv444p");
  MovieSettings settings;
  settings.bits = 10;
  EXPECT_THAT([&] { check_film(folder_ / "film.mp4", settings, 64, 48); },
              ThrowsMessage<DataError>(HasSubstr("movie.bits")));
}

TEST(RealEncoder, MakesAFilmOfTenBits) {
  if (std::system("ffmpeg -hide_banner -h encoder=libx265 | grep -q yuv420p10le") != 0)
    GTEST_SKIP() << "no ffmpeg, or none with 10 bits";
  const test::TemporaryFolder folder;
  MovieSettings settings;
  settings.bits = 10;
  settings.codec = Codec::h265;
  check_film(folder / "film.mp4", settings, 64, 48);
  Encoder encoder(folder / "film.mp4", settings, 64, 48);
  for (int i = 0; i < 3; ++i)
    encoder.add(std::vector<std::uint8_t>(6 * 64 * 48));
  encoder.finish();
  const std::string probe =
      "ffmpeg -hide_banner -i " + (folder / "film.mp4").string() + " 2>&1 | grep -q yuv420p10le";
  EXPECT_EQ(std::system(probe.c_str()), 0);
}

TEST(RealEncoder, MakesAFilmWhoseNameLooksLikeAnAddress) {
  if (std::system("command -v ffmpeg > /dev/null") != 0) GTEST_SKIP() << "no ffmpeg";
  const test::TemporaryFolder folder;
  Encoder encoder(folder / "http:film.mp4", {}, 64, 48);
  for (int i = 0; i < 3; ++i)
    encoder.add(std::vector<std::uint8_t>(3 * 64 * 48));
  encoder.finish();
  EXPECT_EQ(folder.count_files(), 1U);
}

}  // namespace
}  // namespace splotchcl
