// Frames of a film on their way through the host and the device.
#include "film/frames/film_drawer.h"

#include <chrono>
#include <future>
#include <map>

#include "pictures/other_scenes.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/image_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

// Where one thread waits for another, but not for ever.
class Gate {
 public:
  void open() {
    if (!is_open()) opened_.set_value();
  }
  bool wait() const { return open_.wait_for(std::chrono::minutes(2)) == std::future_status::ready; }

 private:
  bool is_open() const {
    return open_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }
  std::promise<void> opened_;
  std::shared_future<void> open_ = opened_.get_future().share();
};

// Two components, which are two parts of a frame.
class TwoClouds : public test::MemorySnapshot {
 public:
  TwoClouds() {
    add(0, "position", {0, 0, 0, 1, 0.5F, 0.3F}, 3);
    add(1, "position", {-1, 0, 0, 0, -0.5F, 0.3F}, 3);
  }
};

// While it is read, the frame before has to be drawn.
class ReadWhileAnotherIsDrawn final : public TwoClouds {
 public:
  ReadWhileAnotherIsDrawn(Gate& reading, const Gate& drawn) : reading_(reading), drawn_(drawn) {}
  Column read(int type, const std::string& field) const override {
    reading_.open();
    EXPECT_TRUE(drawn_.wait()) << "the device draws nothing while a frame is read";
    return TwoClouds::read(type, field);
  }

 private:
  Gate& reading_;
  const Gate& drawn_;
};

class FramesOfAFilm : public ::testing::Test {
 protected:
  static Scene scene() {
    return parse_scene(R"(
snapshot = "memory"
[image]
size = [16, 12]
[camera]
position = [0, 0, -5]
look_at = [0, 0, 0]
[[component]]
types = ["gas"]
size = { fixed = 0.5 }
weight = "constant"
absorption = "none"
palette = "white"
[[component]]
types = ["halo"]
size = { fixed = 0.5 }
weight = "constant"
absorption = "none"
palette = "white"
)",
                       "scene");
  }
  FilmDrawer::Report report() {
    FilmDrawer::Report report;
    report.span = [this](int frame, const TimeSpan& span) {
      spans_[frame].push_back(span);
      if (span.what == "write") written_.push_back(frame);
    };
    return report;
  }
  void end(FilmDrawer& drawer) {
    drawer.end([this](int frame) { return folder_ / ("frame_" + std::to_string(frame) + ".png"); },
               [] {});
  }

  test::TemporaryFolder folder_;
  OtherScenes other_scenes_;
  std::map<int, std::vector<TimeSpan>> spans_;
  std::vector<int> written_;
};

// The device begins the first frame when the second is being read, and that one is read no further
// until the device has drawn a part of the first.
TEST_F(FramesOfAFilm, AreReadWhileTheDeviceDrawsTheOneBefore) {
  Gate reading, drawn;
  FrameDrawerOptions options;
  options.progress = [&](const std::string& what, double fraction) {
    if (what != "drawing") return;
    if (fraction > 0) {
      drawn.open();
    } else {
      EXPECT_TRUE(reading.wait()) << "no frame is read while another is drawn";
    }
  };
  FilmDrawer drawer(options, report());
  drawer.begin(drawer.load(0, scene(), std::make_shared<TwoClouds>(), {}), other_scenes_);
  ASSERT_TRUE(drawer.may_go_on());
  LoadedFrame second =
      drawer.load(1, scene(), std::make_shared<ReadWhileAnotherIsDrawn>(reading, drawn), {});
  drawer.begin(std::move(second), other_scenes_);
  end(drawer);
  end(drawer);
  drawer.finish();
  const TimeSpan read = spans_[1].front();
  ASSERT_EQ(read.what, "load");
  const auto is_drawn_meanwhile = [&](const TimeSpan& span) {
    return span.is_on_device && span.begin > read.begin && span.end < read.end;
  };
  EXPECT_TRUE(std::any_of(spans_[0].begin(), spans_[0].end(), is_drawn_meanwhile));
  EXPECT_THAT(written_, ElementsAre(0, 1));
}

TEST_F(FramesOfAFilm, HaveTheSameLightAsAlone) {
  constexpr int frames = 6;
  const auto snapshot = std::make_shared<TwoClouds>();
  const auto scene_at = [](int frame) {
    Scene moved = scene();
    moved.camera->position = {{0.2 * frame, 0, -5}};
    return moved;
  };
  FilmDrawer drawer({}, report());
  for (int frame = 0; frame < frames; ++frame) {
    drawer.begin(drawer.load(frame, scene_at(frame), snapshot, {}), other_scenes_);
    if (frame > 0) end(drawer);
  }
  end(drawer);
  drawer.finish();
  for (int frame = 0; frame < frames; ++frame) {
    const auto alone = folder_ / "alone.png";
    write_pictures(alone, FrameDrawer().draw(scene_at(frame), *snapshot).pictures,
                   image_file_options(scene_at(frame)));
    EXPECT_EQ(read_image(folder_ / ("frame_" + std::to_string(frame) + ".png")).pixels,
              read_image(alone).pixels)
        << frame;
  }
}

TEST_F(FramesOfAFilm, AreDrawnAloneByTheOracleAndWhereTheyReadMore) {
  FrameDrawerOptions by_reference;
  by_reference.by_reference = true;
  const auto snapshot = std::make_shared<TwoClouds>();
  FilmDrawer oracle(by_reference, report());
  oracle.begin(oracle.load(0, scene(), snapshot, {}), other_scenes_);
  EXPECT_FALSE(oracle.may_go_on());
  end(oracle);
  FilmDrawer drawer({}, report());
  const std::vector<Moment> moments = {{scene(), [snapshot] { return snapshot; }}};
  drawer.begin(drawer.load(1, scene(), snapshot, moments), other_scenes_);
  EXPECT_FALSE(drawer.may_go_on());
  end(drawer);
}

}  // namespace
}  // namespace splotchcl
