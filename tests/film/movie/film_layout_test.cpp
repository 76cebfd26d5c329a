// What players are told of a film, as ffprobe reads it back, and the codecs of this ffmpeg.
#include "film/movie/film_layout.h"

#include <cstdio>

#include "film/movie/encoder.h"
#include "testing.h"

namespace splotchcl {
namespace {

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

}  // namespace
}  // namespace splotchcl
