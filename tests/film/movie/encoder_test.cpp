// Films are made by another program, which may do anything: here by scripts in its place.
#include "film/movie/encoder.h"

#include <thread>

#include "testing.h"

namespace splotchcl {
namespace {

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
    try {
      Encoder encoder(folder_ / "film.mp4", {}, 640, 480, {}, std::chrono::milliseconds(300));
      for (int i = 0; i < frames; ++i)
        encoder.add(std::vector<std::uint8_t>(3 * 640 * 480));
      encoder.finish();
    } catch (const DataError& error) {
      return error.what();
    }
    return "none";
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
