// The flight of scripts/fly_in through a universe, without the galaxy at its end.
#include "cli/lit_pictures.h"
#include "cli/program.h"
#include "galaxy/galaxy_picture.h"
#include "splotchcl/image_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Mean linear light.
double brightness(const std::filesystem::path& path) {
  const Image image = read_image(path);
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) sum += static_cast<double>(image.pixels[i]);
  }
  return sum / (static_cast<double>(image.pixels.size()) * 3 / 4);
}

// What the film needs.
ProgramResult prepare_flight(const TemporaryFolder& folder) {
  write_image(folder / "spiral.exr", SpiralPicture().draw());
  const std::string source = test::source_folder().string();
  return run_in(
      folder, "mkdir examples demo && cp '" + source + "/examples/fly_in.toml' examples && '" +
                  source +
                  "/scripts/fly_in' --path > demo/fly_in.path && "
                  "\"$splotchcl\" generate universe --particles 100000 -o demo/universe.gadget && "
                  "\"$splotchcl\" galaxy spiral.exr -o demo/galaxy.hdf5 --disk-stars 100 "
                  "--bulge-stars 100 --clusters 1 --cloud-points 1 && "
                  "sed -i 's/ component.galaxy.brightness//; s/ [0-9.]*$//' demo/fly_in.path");
}

ProgramResult fly(const TemporaryFolder& folder, const std::string& frames) {
  return splotchcl_in(folder, "movie examples/fly_in.toml --set image.size=[160,90] " + frames +
                                  " --set component.galaxy.brightness=0 "
                                  "--set component.dust.absorption=0");
}

// The universe alone, around the place where the galaxy would be.
TEST(Flight, IsLitFromBeginningToEndWithTheWebsBackgroundAsBrightAsAtTheStart) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  const ProgramResult prepared = prepare_flight(folder);
  ASSERT_EQ(prepared.exit_code, 0) << prepared.err;
  const ProgramResult shown = fly(folder, "-o f_%d.png --frames 0:300:66");
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  for (int i = 0; i < 300; i += 66)
    expect_lit(read_image(folder / ("f_" + std::to_string(i) + ".png")), i);
  const ProgramResult light = fly(folder, "-o f_%03d.exr --frames 0:300:299");
  ASSERT_EQ(light.exit_code, 0) << light.err;
  const double start = brightness(folder / "f_000.exr"), end = brightness(folder / "f_299.exr");
  EXPECT_GT(end, 0.7 * start);
  EXPECT_LT(end, 1.5 * start);
}

}  // namespace
}  // namespace splotchcl::test
