// What becomes of each key of a parameter file.
#include "splotchcl/camera.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

const std::string least =
    "infile=snap_\nfidx=92\nperiodic=F\nsize_label0=HSML\ncolor_label0=U\npalette0=a.pal\n"
    "camera_x=1\ncamera_y=2\ncamera_z=3\nlookat_x=4\nlookat_y=5\nlookat_z=6\nsky_z=1\n";

class ParScenes : public ::testing::Test {
 protected:
  Scene read(const std::string& more = "", const std::vector<std::string>& settings = {}) {
    std::ofstream(folder_ / "a.pal") << "a\n0100\n2\n0 0 0\n255 255 255\n";
    std::ofstream(folder_ / "x.par") << least << more;
    notes_.clear();
    return read_par_file(folder_ / "x.par", settings, notes_);
  }
  std::string error(const std::string& more) {
    return test::refusal_by<UsageError>([&] { read(more); });
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  test::TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(ParScenes, HaveTheCameraOfTheFile) {
  const Scene scene = read("fov=30\nzmin=2\nzmax=7\n");
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_EQ(scene.camera->position.a[2], 3);
  EXPECT_EQ(scene.camera->look_at.a[0], 4);
  EXPECT_EQ(scene.camera->near_limit, 2);
  EXPECT_EQ(scene.camera->far_limit, 7);
  EXPECT_EQ(read("projection=F\n").camera->projection, Projection::orthographic);
}

TEST_F(ParScenes, LookForTheNumberedSnapshotBesideTheFile) {
  EXPECT_EQ(read().snapshot, path("snap_092"));
  EXPECT_EQ(read("fidx=7\n").snapshot, path("snap_007"));
}

TEST_F(ParScenes, AreRefusedWithIndicesThatNoSnapshotHas) {
  for (const std::string index : {"1e10", "-1"})
    EXPECT_THAT(error("fidx=" + index + "\n"), HasSubstr("expected a number from 0 to 999999999"));
}

TEST_F(ParScenes, TakeAWholeNameWhereOnlyThatExists) {
  std::ofstream(folder_ / "snap_") << "a snapshot";
  EXPECT_EQ(read().snapshot, path("snap_"));
  std::ofstream(folder_ / "snap_092") << "a snapshot";
  EXPECT_EQ(read().snapshot, path("snap_092"));
}

TEST_F(ParScenes, BetweenSnapshotsAreSequences) {
  const Scene scene = read(
      "fidx=92.25\ninterpolation_mode=2\nomega=0.3\nlambda=0.7\nl_unit=3.0856775814913673e24\nv_"
      "unit=1e5\nhubble=0.7\n");
  EXPECT_EQ(scene.time.pattern, path("snap_%03d"));
  EXPECT_EQ(scene.time.index, 92.25);
  EXPECT_EQ(scene.time.interpolation, Interpolation::hermite);
  EXPECT_EQ(scene.time.omega_matter, 0.3);
  EXPECT_NEAR(*scene.time.hubble_rate, 100, 1e-9);  // lengths in Mpc/h
  EXPECT_TRUE(scene.snapshot.empty());
}

TEST_F(ParScenes, HaveRangesBeforeScaling) {
  const Component component = read("color_min0=2\ncolor_max0=6\ncolor_fac0=100\n").components[0];
  EXPECT_EQ(component.color.scaling, Scaling::log);
  EXPECT_NEAR(*component.color.minimum, 1, 1e-12);
  EXPECT_NEAR(*component.color.maximum, 1e4, 1e-8);
  const Component linear = read("color_log0=F\ncolor_min0=-2\ncolor_max0=6\n").components[0];
  EXPECT_EQ(linear.color.scaling, Scaling::linear);
  EXPECT_EQ(linear.color.minimum, -2);
  const Component asinh =
      read("color_log0=F\ncolor_asinh0=T\ncolor_min0=0\ncolor_max0=3\n").components[0];
  EXPECT_EQ(asinh.color.scaling, Scaling::asinh);
  EXPECT_NEAR(*asinh.color.maximum, std::sinh(3), 1e-12);
}

TEST_F(ParScenes, HaveTheWholeRangeOfTheDataWhereTheFileHasNone) {
  EXPECT_EQ(read().components[0].color.minimum, std::nullopt);
  EXPECT_THAT(format_scene(read()), HasSubstr("percentiles = [0, 100]"));
}

TEST_F(ParScenes, HaveTheIntensityOfABlockAndOneWithout) {
  EXPECT_EQ(read("intensity_label0=XXXX\n").components[0].intensity.field, "");
  EXPECT_EQ(read("intensity_label0=RHO\n").components[0].intensity.field, "RHO");
}

TEST_F(ParScenes, HaveAComponentForEachType) {
  const Scene scene = read(
      "ptypes=2\nptype0=0\nptype1=4\nsize_fix1=20\nsize_label1=XXXX\ncolor_label1=AGE\n"
      "palette1=a.pal\nbrightness1=1.5\n");
  ASSERT_EQ(scene.components.size(), 2U);
  EXPECT_EQ(scene.components[1].types, std::vector<int>{4});
  EXPECT_EQ(scene.components[1].size_fixed, 20);
  EXPECT_EQ(scene.components[1].brightness, 1.5);
}

TEST_F(ParScenes, HaveTwoEyesThatConverge) {
  EXPECT_FALSE(read("EyeSeparation=0\n").stereo);
  const Stereo eyes = *read("EyeSeparation=0.8\n").stereo;
  EXPECT_EQ(eyes.angle_degrees, 0.8);
  EXPECT_EQ(eyes.mode, StereoMode::off_axis);
  EXPECT_EQ(eyes.eyes, StereoEyes::centered);
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_EQ(read("EyeSeparation=0.8\ndome=T\n").stereo->mode, StereoMode::off_axis);
  EXPECT_EQ(read("EyeSeparation=0.8\nprojection=F\n").stereo->mode, StereoMode::toe_in);
  EXPECT_THAT(notes_, Contains(HasSubstr("EyeSeparation")));
}

TEST_F(ParScenes, HaveDomesAndPanoramas) {
  const Camera dome = *read("dome=T\nfov=30\n").camera;
  EXPECT_EQ(dome.projection, Projection::fisheye);
  EXPECT_EQ(field_of_view_degrees(dome), 180);
  const Camera panorama = *read("panorama=T\nfov=30\nzmax=7\n").camera;
  EXPECT_EQ(panorama.projection, Projection::cube);
  EXPECT_EQ(panorama.cube_layout, CubeLayout::files);
  EXPECT_EQ(panorama.far_limit, 7);
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_THAT(error("dome=T\npanorama=T\n"), HasSubstr("key panorama"));
  EXPECT_THAT(error("panorama=T\nyres=400\n"), HasSubstr("image.size"));
}

// The first frame's, with what the file says of the camera beside it.
TEST_F(ParScenes, HaveTheCameraOfTheirPath) {
  std::ofstream(folder_ / "x.path") << "camera_x camera_y camera_z lookat_x lookat_y lookat_z\n"
                                       "7 8 9 0 0 0\n1 1 1 0 0 0\n";
  const Scene scene = read(
      "camera_x=\ncamera_y=\ncamera_z=\nlookat_x=\nlookat_y=\nlookat_z=\nfov=30\nzmin=2\n"
      "scene_file=x.path\n");
  EXPECT_EQ(scene.camera->position.a[0], 7);
  EXPECT_EQ(scene.camera->look_at.a[0], 0);
  EXPECT_EQ(scene.camera->sky.a[2], 1);
  EXPECT_EQ(scene.camera->field_of_view_degrees, 30);
  EXPECT_EQ(scene.camera->near_limit, 2);
  EXPECT_EQ(scene.path.file, path("x.path"));
}

TEST_F(ParScenes, NameFactorsThatTheirPathsColumnsDoNotHave) {
  std::ofstream(folder_ / "x.path") << "size_fac0 color_min0\n1 2\n";
  read("scene_file=x.path\nsmooth_factor0=2\ncolor_fac0=10\n");
  EXPECT_THAT(notes_, Contains(HasSubstr("smooth_factor0 is not carried over")));
  EXPECT_THAT(notes_, Contains(HasSubstr("color_fac0 is not carried over")));
}

TEST_F(ParScenes, AbsorbAsTheFileSays) {
  EXPECT_EQ(read().components[0].absorption.kind, Absorption::Kind::as_emission);
  const Absorption gray = read("a_eq_e=F\n").components[0].absorption;
  EXPECT_EQ(gray.kind, Absorption::Kind::gray);
  EXPECT_EQ(gray.factor, 0.2);
}

TEST_F(ParScenes, SayWhereTheirOrderDiffers) {
  read("a_eq_e=F\nsort_type=0\n");
  EXPECT_THAT(notes_, Contains(HasSubstr("sort_type 0")));
  const Scene scene = read("a_eq_e=F\nsort_type=3\n");
  EXPECT_EQ(scene.sort.field, "U");
  EXPECT_TRUE(scene.sort.descending);
  EXPECT_THAT(notes_, Contains(HasSubstr("sort_type")));
  read("a_eq_e=T\nsort_type=0\n");
  EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(ParScenes, AreOrderedByDepthWhereComponentsHaveOtherFields) {
  const std::string stars =
      "a_eq_e=F\nptypes=2\nptype1=4\nsize_fix1=1\ncolor_label1=AGE\npalette1=a.pal\n";
  for (const std::string order : {"2", "3", "4"}) {
    EXPECT_EQ(read(stars + "sort_type=" + order + "\n").sort.field, "");
    EXPECT_THAT(notes_, Contains(HasSubstr("sort_type " + order + ", ")));
    EXPECT_THAT(notes_, Contains(HasSubstr("the nearest lies in front")));
  }
}

TEST_F(ParScenes, AreOrderedByDepthWhereColorsAreVectors) {
  EXPECT_EQ(read("a_eq_e=F\nsort_type=2\ncolor_is_vector0=T\n").sort.field, "");
}

TEST_F(ParScenes, FindPalettesBesideTheFile) {
  EXPECT_EQ(read("palette0=palettes/a.pal\n").components[0].palette, path("a.pal"));
}

TEST_F(ParScenes, NameKeysThatHaveNoCounterpart) {
  read("boostcolors=T\ngpu_number=1\ncolor_lable0=RHO\n");
  EXPECT_THAT(notes_, Contains(HasSubstr("boostcolors has no counterpart")));
  EXPECT_THAT(notes_, Contains(HasSubstr("does not need: gpu_number")));
  EXPECT_THAT(notes_, Contains(HasSubstr("did you mean color_labelN")));
}

TEST_F(ParScenes, TakeSettings) {
  EXPECT_EQ(read("", {"image.width=99"}).image.width, 99);
}

TEST_F(ParScenes, AreRefusedWithTheKeyThatIsWrong) {
  EXPECT_THAT(error("fov=wide\n"), HasSubstr("key fov"));
  EXPECT_THAT(error("fov=0\n"), HasSubstr("x.par: as a scene: key camera.field_of_view"));
  EXPECT_THAT(error("color_asinh0=T\ncolor_log0=T\n"), HasSubstr("color_asinh0"));
  EXPECT_THAT(error("size_fac0=-1\n"), HasSubstr("size_fac0"));
  EXPECT_THAT(error("lookat_x=1\nlookat_y=2\nlookat_z=3\n"), HasSubstr("look_at"));
}

TEST_F(ParScenes, AreTheSameAsTheSceneFilesTheyAreConvertedTo) {
  const Scene scene = read("fov=30\nptypes=1\nbrightness0=10.5\n");
  std::filesystem::create_directory(folder_ / "scenes");
  std::ofstream(folder_ / "scenes/x.toml")
      << format_scene(with_paths_from(scene, folder_ / "scenes"));
  const Scene converted = read_scene_file(folder_ / "scenes/x.toml");
  EXPECT_EQ(std::filesystem::path(converted.snapshot).lexically_normal(),
            std::filesystem::path(scene.snapshot).lexically_normal());
  EXPECT_EQ(converted.components[0].reference_column, scene.components[0].reference_column);
  EXPECT_EQ(converted.kernel.cut, scene.kernel.cut);
}

TEST(RealParFiles, BecomeScenes) {
  const std::filesystem::path data = test::data_folder();
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << "no real files in " << data;
  for (const char* const name : {"demo.par", "g51.par", "sample.par"}) {
    SCOPED_TRACE(name);
    std::vector<std::string> notes;
    const Scene scene = read_par_file(data / "splotch_par" / name, {}, notes);
    EXPECT_EQ(scene.components.size(), 2U);
    EXPECT_THAT(scene.snapshot, HasSubstr("snap_092"));
    EXPECT_NO_THROW(load_palette(scene.components[0].palette));
    EXPECT_THAT(notes, Not(Contains(HasSubstr("is not known"))));
  }
}

}  // namespace
}  // namespace splotchcl
