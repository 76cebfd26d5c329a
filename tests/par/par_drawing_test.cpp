// Pictures of parameter files against an independent restatement of what the original draws.
#include <fmt/format.h>

#include "film/path/film_path.h"
#include "original_drawing.h"
#include "snapshot/memory_snapshot.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/par_file.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

struct Case {
  const char* name;
  OriginalPicture picture;
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.name;
}

OriginalPicture seen_from_afar() {
  OriginalPicture picture;
  picture.xres = 40;
  picture.yres = 28;
  picture.fov = 30;
  const double camera[3] = {-20, 3, 2}, lookat[3] = {0, 0.5, 0}, sky[3] = {0.1, 0.2, 1};
  std::copy(camera, camera + 3, picture.camera);
  std::copy(lookat, lookat + 3, picture.lookat);
  std::copy(sky, sky + 3, picture.sky);
  picture.palette = {0, 20, 255, 128, 255, 128, 255, 40, 0};
  picture.brightness = 3;
  return picture;
}

std::vector<Case> cases() {
  std::vector<Case> all = {{"plain", seen_from_afar()}};
  OriginalPicture picture = seen_from_afar();
  picture.a_eq_e = false;
  picture.gray_absorption = 0.05;
  all.push_back({"ordered", picture});
  picture = seen_from_afar();
  picture.is_flat = true;
  picture.size_fac = 0.5;
  all.push_back({"flat", picture});
  picture = seen_from_afar();
  picture.smooth_factor = 1.7;
  picture.minrad_pix = 3;
  all.push_back({"smoothed", picture});
  return all;
}

// Particles from far below a pixel to a quarter of the picture.
std::vector<OriginalParticle> random_particles() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-4, 4), unit(0, 1);
  std::vector<OriginalParticle> particles(60);
  for (OriginalParticle& particle : particles) {
    // Rounded as a snapshot holds them.
    const auto stored = [](double value) { return static_cast<double>(static_cast<float>(value)); };
    particle.x = stored(place(random));
    particle.y = stored(place(random));
    particle.z = stored(place(random));
    particle.h = stored(0.02 * std::pow(50.0, unit(random)));
    particle.color = stored(unit(random));
  }
  return particles;
}

MemorySnapshot snapshot_of(const std::vector<OriginalParticle>& particles) {
  std::vector<float> positions, sizes, temperatures;
  for (const OriginalParticle& particle : particles) {
    for (const double x : {particle.x, particle.y, particle.z})
      positions.push_back(static_cast<float>(x));
    sizes.push_back(static_cast<float>(particle.h));
    // A field whose tenfold logarithm from 2 to 6 is the colour.
    temperatures.push_back(static_cast<float>(std::pow(10, 2 + 4 * particle.color) / 10));
  }
  MemorySnapshot snapshot;
  snapshot.add(0, "position", positions, 3);
  snapshot.add(0, "smoothing_length", sizes);
  snapshot.add(0, "temperature", temperatures);
  return snapshot;
}

std::string par_text(const OriginalPicture& p) {
  return fmt::format(
      "infile=snap_\nperiodic=F\nptypes=1\nsize_label0=HSML\nsize_fac0={}\nsmooth_factor0={}\n"
      "color_label0=TEMP\ncolor_log0=T\ncolor_fac0=10\ncolor_min0=2\ncolor_max0=6\n"
      "palette0=test.pal\nbrightness0={}\nxres={}\nyres={}\nfov={}\nprojection={}\n"
      "camera_x={}\ncamera_y={}\ncamera_z={}\nlookat_x={}\nlookat_y={}\nlookat_z={}\n"
      "sky_x={}\nsky_y={}\nsky_z={}\na_eq_e={}\ngray_absorption={}\nminrad_pix={}\n",
      p.size_fac, p.smooth_factor, p.brightness, p.xres, p.yres, p.fov, p.is_flat ? "F" : "T",
      p.camera[0], p.camera[1], p.camera[2], p.lookat[0], p.lookat[1], p.lookat[2], p.sky[0],
      p.sky[1], p.sky[2], p.a_eq_e ? "T" : "F", p.gray_absorption, p.minrad_pix);
}

std::string palette_text(const OriginalPicture& p) {
  std::string text = fmt::format("test\n0100\n{}\n", p.palette.size() / 3);
  for (std::size_t i = 0; i < p.palette.size(); i += 3)
    text += fmt::format("{} {} {}\n", p.palette[i], p.palette[i + 1], p.palette[i + 2]);
  return text;
}

// The picture as it is written, against what the original draws.
//
// 2 of 255 is what is promised. With the reference, whose arithmetic is double precision too,
// bytes differ by 1 where rounding carries a value across a step, and by more only where a
// sample lies on the edge of a cloud; none does here.
void expect_as_original(const Scene& scene, const OriginalPicture& picture,
                        const TemporaryFolder& folder) {
  const std::vector<OriginalParticle> particles = random_particles();
  std::vector<std::string> notes;
  const MemorySnapshot snapshot = snapshot_of(particles);
  const Frame frame = load_frame(scene, snapshot, notes);
  ImageFileOptions options;
  options.gamma = scene.image.gamma;
  options.truncates = scene.image.convention == PixelConvention::original;
  write_image(folder / "picture.png", reference::render(frame).to_float(), options);
  const Image drawn = read_image(folder / "picture.png");

  const std::vector<std::uint8_t> expected = draw_as_original(picture, particles);
  ASSERT_EQ(drawn.pixels.size(), expected.size() / 3 * 4);
  int brightest = 0;
  for (std::size_t pixel = 0; pixel < expected.size() / 3; ++pixel) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int is = static_cast<int>(std::lround(255 * drawn.pixels[4 * pixel + channel]));
      const int should_be = expected[3 * pixel + channel];
      brightest = std::max(brightest, should_be);
      ASSERT_NEAR(is, should_be, 1) << "pixel " << pixel << ", channel " << channel;
    }
  }
  EXPECT_GT(brightest, 100) << "a picture that is almost black tests little";
}

Scene read_par(const OriginalPicture& picture, const std::string& more,
               const TemporaryFolder& folder) {
  std::ofstream(folder / "picture.par") << par_text(picture) << more;
  std::ofstream(folder / "test.pal") << palette_text(picture);
  std::vector<std::string> notes;
  const Scene scene = read_par_file(folder / "picture.par", {}, notes);
  EXPECT_TRUE(notes.empty()) << notes.front();
  return scene;
}

class ParPictures : public ::testing::TestWithParam<Case> {};

TEST_P(ParPictures, AreThoseOfTheOriginal) {
  const TemporaryFolder folder("par");
  const OriginalPicture& picture = GetParam().picture;
  expect_as_original(read_par(picture, "", folder), picture, folder);
}

// A path with a header moves the camera and changes other parameters with each frame.
TEST(ParFilms, AreThoseOfTheOriginal) {
  const TemporaryFolder folder("par");
  OriginalPicture picture = seen_from_afar();
  std::ofstream path(folder / "flight.path");
  path << "camera_x camera_y camera_z lookat_x lookat_y lookat_z sky_x sky_y sky_z fov minrad_pix "
          "brightness0\n";
  std::vector<OriginalPicture> expected;
  for (int frame = 0; frame < 3; ++frame) {
    picture.camera[1] = 4 - 5 * frame;
    picture.lookat[2] = 0.3 * frame;
    picture.fov = 30 - 4 * frame;
    picture.minrad_pix = frame;
    picture.brightness = 3 - 0.5 * frame;
    expected.push_back(picture);
    for (const double* vector : {picture.camera, picture.lookat, picture.sky})
      path << vector[0] << " " << vector[1] << " " << vector[2] << " ";
    path << picture.fov << " " << picture.minrad_pix << " " << picture.brightness << "\n";
  }
  path.close();
  const Scene scene = read_par(seen_from_afar(), "scene_file=flight.path\n", folder);
  std::vector<std::string> notes;
  const FilmPath film(scene, notes);
  ASSERT_EQ(film.frame_count(), 3);
  for (int frame = 0; frame < 3; ++frame) {
    SCOPED_TRACE(frame);
    expect_as_original(film.scene_at(scene, frame), expected[static_cast<std::size_t>(frame)],
                       folder);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, ParPictures, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace splotchcl::test
