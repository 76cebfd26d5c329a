// Films that follow real matter. Where it truly is, is measured here in a way of its own: where
// most of the same particles are, from the mean of all on.
#include <boost/qvm/vec_operations.hpp>

#include "film/follow/followed_particles.h"
#include "film/frames/film_scene.h"
#include "splotchcl/camera.h"
#include "splotchcl/generate.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using boost::qvm::mag;

// By type and id.
using Identities = std::set<std::pair<int, std::uint64_t>>;

Vec3 nearest(Vec3 offset, double box) {
  for (double& axis : offset.a)
    axis -= box > 0 ? box * std::round(axis / box) : 0;
  return offset;
}

struct Placed {
  std::pair<int, std::uint64_t> identity;
  Vec3 place;
};

std::vector<Placed> particles_of(const Snapshot& snapshot) {
  std::vector<Placed> all;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    const Column position = snapshot.read(type.type, "position");
    const auto ids = snapshot.read_ids(type.type);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Vec3 place = {{position[3 * i], position[3 * i + 1], position[3 * i + 2]}};
      all.push_back({{type.type, ids[i]}, snapshot.position_origin() + place});
    }
  }
  return all;
}

Identities chosen_in(const Scene& scene, const Snapshot& snapshot) {
  Identities chosen;
  for (const auto& [type, ids] : choose_followed(scene, snapshot, true).ids) {
    for (const std::uint64_t id : ids)
      chosen.insert({type, id});
  }
  return chosen;
}

// From `from` to where most of these particles are: always nearer the mean of ever fewer.
Vec3 to_most(const Snapshot& snapshot, const Identities& wanted, const Vec3& from, double box) {
  std::vector<Vec3> offsets;
  for (const Placed& particle : particles_of(snapshot)) {
    if (wanted.count(particle.identity) > 0) offsets.push_back(nearest(particle.place - from, box));
  }
  const auto least = static_cast<std::ptrdiff_t>(wanted.size() / 10);
  for (auto end = offsets.end(); end - offsets.begin() > least;
       end = offsets.begin() + (end - offsets.begin()) * 9 / 10) {
    Vec3 mean = {{0, 0, 0}};
    for (auto offset = offsets.begin(); offset != end; ++offset)
      mean += *offset / static_cast<double>(end - offsets.begin());
    std::sort(offsets.begin(), offsets.end(), [&](const Vec3& a, const Vec3& b) {
      return mag(Vec3(a - mean)) < mag(Vec3(b - mean));
    });
  }
  Vec3 mean = {{0, 0, 0}};
  for (std::ptrdiff_t i = 0; i < least; ++i)
    mean += offsets[static_cast<std::size_t>(i)] / static_cast<double>(least);
  return mean;
}

// Of the picture's shorter side, at the look-at point.
double part_of_picture(const Scene& scene, const Vec3& offset) {
  const CameraFrame camera =
      make_camera_frame(*scene.camera, scene.image.width, scene.image.height);
  return mag(offset) * camera.pixels_per_length / std::min(scene.image.width, scene.image.height);
}

struct FollowedFilm {
  std::string snapshots;  // a pattern
  double first = 0, last = 0;
  double box = 0;
  int chosen_in_frame = 0;
  std::string follow;
  double radius = 0;
};

constexpr int film_frames = 13;

void write_scene(const std::filesystem::path& file, const FollowedFilm& film) {
  std::ofstream(file) << "look = 'press'\n[image]\nsize = [160, 120]\n[time]\nsnapshots = '"
                      << film.snapshots << "'\nindex = " << film.last << "\n[path.follow]\n"
                      << film.follow << "\nsphere.radius = " << film.radius
                      << "\n[[path.keyframes]]\nframe = 0\ntime.index = " << film.first
                      << "\n[[path.keyframes]]\nframe = " << film_frames - 1
                      << "\ntime.index = " << film.last << "\n";
}

// At every frame, also between snapshots.
double farthest_from_truth(const FollowedFilm& film) {
  const test::TemporaryFolder folder;
  write_scene(folder / "film.toml", film);
  FilmScene scenes(folder / "film.toml", {});
  const Scene chosen = scenes.scene_at(film.chosen_in_frame);
  const Identities followed = chosen_in(chosen, *scenes.snapshot_at(chosen));
  EXPECT_GT(followed.size(), 100U);
  double farthest = 0;
  for (int frame = 0; frame < film_frames; ++frame) {
    const Scene scene = scenes.scene_at(frame);
    const Vec3 missed =
        to_most(*scenes.snapshot_at(scene), followed, scene.camera->look_at, film.box);
    farthest = std::max(farthest, part_of_picture(scene, missed));
  }
  return farthest;
}

class RealMatter : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::data_folder() / "lcdm"))
      GTEST_SKIP() << "no test data in " << test::data_folder();
  }
};

TEST_F(RealMatter, KeepsTheDensestHaloOfAUniverseInTheMiddle) {
  FollowedFilm film;
  film.snapshots = (test::data_folder() / "lcdm/fmt2_snapshot_%03d").string();
  film.first = 2;
  film.last = 6;
  film.box = 50000;
  film.chosen_in_frame = film_frames - 1;
  film.follow = "sphere.center = 'densest'";
  film.radius = 2000;
  EXPECT_LT(farthest_from_truth(film), 0.02);
}

TEST_F(RealMatter, KeepsAGalaxyOfACollisionInTheMiddle) {
  FollowedFilm film;
  film.snapshots = (test::data_folder() / "galaxy_collision/snapshot_%03d.hdf5").string();
  film.first = 0;
  film.last = 10;
  film.follow = "sphere.center = 'densest'\nsnapshot = 0";
  film.radius = 15;
  EXPECT_LT(farthest_from_truth(film), 0.02);
}

// A ball of particles, the first of a box that others fill evenly.
void write_ball(const std::filesystem::path& file, double x) {
  GeneratedSnapshot snapshot;
  snapshot.box_size = 100;
  const auto add = [&](const Vec3& place) {
    Vec3 inside = place;
    for (double& axis : inside.a)
      axis -= 100 * std::floor(axis / 100);
    snapshot.gas.add(inside, {{0, 0, 0}});
    snapshot.gas.smoothing_length.push_back(1);
    snapshot.gas.density.push_back(1);
    snapshot.gas.internal_energy.push_back(1);
  };
  for (int i = 0; i < 343; ++i)
    add({{x + i % 7 - 3, 50.0 + i / 7 % 7 - 3, 50.0 + i / 49 - 3}});
  for (int i = 0; i < 512; ++i)
    add({{6 + 12.5 * (i % 8), 6 + 12.5 * (i / 8 % 8), 6 + 12.5 * (i / 64)}});
  snapshot.gas.mass = 1;
  write_gadget2(file, snapshot);
}

TEST(FollowedBall, GoesOnBeyondTheBoxesFaces) {
  const test::TemporaryFolder folder;
  write_ball(folder / "snapshot_0", 95);
  write_ball(folder / "snapshot_1", 105);
  write_ball(folder / "snapshot_2", 115);
  FollowedFilm film;
  film.snapshots = "snapshot_%d";
  film.last = 2;
  film.follow = "sphere.center = [115, 50, 50]";
  film.radius = 6;
  write_scene(folder / "film.toml", film);
  const FilmScene scenes(folder / "film.toml", {});
  const Vec3 first = scenes.scene_at(0).camera->look_at;
  for (int frame = 0; frame < film_frames; ++frame) {
    const Vec3 way = scenes.scene_at(frame).camera->look_at - first;
    EXPECT_NEAR(way.a[0], 20.0 * frame / (film_frames - 1), 0.2) << frame;
    EXPECT_NEAR(mag(way) - std::abs(way.a[0]), 0, 0.2) << frame;
  }
}

TEST(FollowedBall, IsFoundAsTheDensestPlaceWithAFittingRadius) {
  const test::TemporaryFolder folder;
  write_ball(folder / "snapshot_0", 98);
  FilmScene film(folder / "snapshot_0", {"movie.frames=10", "image.size=[64, 64]"}, nullptr,
                 {"densest", true});
  const Scene end = film.scene_at(9);
  EXPECT_TRUE(end.periodic.wrap);
  EXPECT_NEAR(mag(nearest(end.camera->look_at - Vec3{{98, 50, 50}}, 100)), 0, 1);
  const CameraFrame camera = make_camera_frame(*end.camera, 64, 64);
  EXPECT_GT(64 / camera.pixels_per_length, 8);
  EXPECT_LT(64 / camera.pixels_per_length, 40);
  // Nothing comes in at the faces of the box while the camera goes there.
  EXPECT_NEAR(mag(film.scene_at(0).camera->look_at - end.camera->look_at), 0, 1e-6);
}

TEST(FollowedBall, IsRefusedWhereThereIsNone) {
  const test::TemporaryFolder folder;
  write_ball(folder / "snapshot_0", 50);
  const std::vector<std::string> far = {"movie.frames=2", "path.follow.sphere.center=[1, 1, 1]",
                                        "path.follow.sphere.radius=0.5"};
  EXPECT_THAT([&] { FilmScene(folder / "snapshot_0", far); },
              ThrowsMessage<UsageError>(HasSubstr("found no particle")));
  EXPECT_THAT(
      [&] {
        FilmScene(folder / "snapshot_0", {}, nullptr, {"sparsest", true});
      },
      ThrowsMessage<UsageError>(HasSubstr("--dive")));
}

// A table of particles that know their halo: the second is a ball about (40, 50, 60).
TEST(FollowedHalo, IsFoundByTheNumbersOfItsParticles) {
  const test::TemporaryFolder folder;
  std::ofstream table(folder / "particles.txt");
  table << "x y z smoothing_length halo_id\n";
  for (int i = 0; i < 1000; ++i) {
    table << i % 10 * 10 << ' ' << i / 10 % 10 * 10 << ' ' << i / 100 * 10 << " 5 0\n";
    if (i < 343) table << 37 + i % 7 << ' ' << 47 + i / 7 % 7 << ' ' << 57 + i / 49 << " 1 2\n";
  }
  table.close();
  const FilmScene film(folder / "particles.txt",
                       {"movie.frames=2", "path.follow.halo=2", "image.size=[64, 64]"});
  const Scene scene = film.scene_at(0);
  EXPECT_NEAR(mag(scene.camera->look_at - Vec3{{40, 50, 60}}), 0, 0.5);
  const CameraFrame camera = make_camera_frame(*scene.camera, 64, 64);
  EXPECT_NEAR(64 / camera.pixels_per_length, 4 * 4, 4);
}

TEST(SuggestedFilm, OfASnapshotIsAnOrbitThatEasesInAndOut) {
  const test::TemporaryFolder folder;
  write_ball(folder / "snapshot_0", 50);
  const FilmScene film(folder / "snapshot_0", {});
  ASSERT_TRUE(film.scene().path.orbit.has_value());
  EXPECT_TRUE(film.scene().path.orbit->is_eased);
  EXPECT_EQ(film.path().frame_count(), 250);
}

TEST(SuggestedFilm, OfADomeStandsAmidTheMatter) {
  const test::TemporaryFolder folder;
  write_ball(folder / "snapshot_0", 50);
  const auto distance = [&](std::vector<std::string> settings) {
    settings.emplace_back("image.size=[64, 64]");
    const Camera camera = *FilmScene(folder / "snapshot_0", settings).scene_at(0).camera;
    return mag(camera.look_at - camera.position);
  };
  EXPECT_GT(distance({}), 60) << "from afar";
  EXPECT_LT(distance({"camera.projection=fisheye"}), 40) << "within the box of 100";
  const std::vector<std::string> own = {"camera.projection=fisheye", "camera.position=[50,50,500]",
                                        "camera.look_at=[50,50,50]"};
  EXPECT_NEAR(distance(own), 450, 1e-9);
  const FilmScene film(folder / "snapshot_0", {"camera.projection=fisheye"});
  EXPECT_GT(film.scene_at(0).camera->fade.near_length, 1) << "what comes close fades";
  const std::vector<std::string> dome = {"camera.projection=fisheye", "movie.frames=3"};
  for (const bool is_approached : {false, true}) {
    const FilmScene to_ball(folder / "snapshot_0", dome, nullptr, {"densest", is_approached});
    const Camera end = *to_ball.scene_at(2).camera;
    EXPECT_LE(end.fade.near_length, 0.51 * mag(end.look_at - end.position)) << "but no target";
  }
}

TEST(SuggestedFilm, OfASequenceGoesThroughItsTime) {
  const test::TemporaryFolder folder;
  for (int i = 3; i < 6; ++i)
    write_ball(folder / ("snapshot_" + std::to_string(i)), 50 + i);
  const FilmScene film(folder / "snapshot_%d", {"movie.frames=5"});
  EXPECT_EQ(film.scene_at(0).time.index, 3);
  EXPECT_EQ(film.scene_at(2).time.index, 4);
  EXPECT_EQ(film.scene_at(4).time.index, 5);
}

TEST(SuggestedFilm, OrbitsAroundWhatItFollows) {
  const test::TemporaryFolder folder;
  for (int i = 0; i < 2; ++i)
    write_ball(folder / ("snapshot_" + std::to_string(i)), 50 + 5 * i);
  const FilmScene film(folder / "snapshot_%d", {"movie.frames=5"}, nullptr, {"densest", false});
  for (int frame = 0; frame < 5; ++frame) {
    const Vec3 place = {{50.0 + 5 * *film.scene_at(frame).time.index, 50, 50}};
    EXPECT_NEAR(mag(film.scene_at(frame).camera->look_at - place), 0, 1) << frame;
  }
  EXPECT_GT(mag(film.scene_at(4).camera->position - film.scene_at(0).camera->position), 1);
  const Camera camera = *film.scene_at(0).camera;
  const double distance = mag(camera.look_at - camera.position);
  EXPECT_NEAR(camera.fade.near_length, 0.5 * distance, 1e-6 * distance);
}

// A round cloud about x, denser in its middle, without a box.
void write_cloud(const std::filesystem::path& file, double x, double size) {
  std::ofstream table(file);
  table << "x y z id smoothing_length density\n";
  for (int i = 0; i < 343; ++i) {
    const Vec3 from_middle = {{i % 7 - 3.0, i / 7 % 7 - 3.0, i / 49 - 3.0}};
    const double distance = mag(from_middle);
    if (distance > 3) continue;
    const Vec3 place = Vec3{{x, 0, 0}} + size * distance * distance * from_middle;
    table << place.a[0] << ' ' << place.a[1] << ' ' << place.a[2] << ' ' << i << ' ' << size
          << " 1\n";
  }
}

double shown_length(const Scene& scene) {
  return 1 / part_of_picture(scene, {{1, 0, 0}});
}

// Of an object that is all that there is, a film begins with all, and comes nearer.
TEST(SuggestedFilm, ThatDivesComesNearer) {
  const test::TemporaryFolder folder;
  write_cloud(folder / "cloud_0.txt", 0, 10);
  write_cloud(folder / "cloud_1.txt", 100, 1);
  for (const std::string name : {"cloud_0.txt", "cloud_1.txt", "cloud_%d.txt"}) {
    const std::vector<std::string> settings = {"movie.frames=5", "image.size=[64, 64]"};
    const FilmScene film(folder / name, settings, nullptr, {"densest", true});
    for (int frame = 1; frame < 5; ++frame) {
      EXPECT_LT(shown_length(film.scene_at(frame)), shown_length(film.scene_at(frame - 1)))
          << name << " " << frame;
    }
    EXPECT_LE(shown_length(film.scene_at(4)), 0.2501 * shown_length(film.scene_at(0))) << name;
  }
  const FilmScene film(folder / "cloud_%d.txt", {"movie.frames=5"}, nullptr, {"densest", true});
  EXPECT_GT(shown_length(film.scene_at(0)), 200) << "the first of the clouds is as large";
}

TEST(SuggestedFilm, CanBeWrittenAsASceneAndIsTheSame) {
  const test::TemporaryFolder folder;
  for (int i = 0; i < 2; ++i)
    write_ball(folder / ("snapshot_" + std::to_string(i)), 50 + i);
  const FilmScene film(folder / "snapshot_%d", {"movie.frames=5"}, nullptr, {"densest", true});
  std::ofstream(folder / "again.toml") << format_scene(film.scene());
  const FilmScene again(folder / "again.toml", {});
  for (int frame = 0; frame < 5; ++frame)
    EXPECT_EQ(format_scene(again.scene_at(frame)), format_scene(film.scene_at(frame))) << frame;
}

}  // namespace
}  // namespace splotchcl
