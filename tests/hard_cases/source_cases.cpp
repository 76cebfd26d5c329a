// Sources that matter of another brightness, or another color, hides from the picture's own light:
// what shines behind a layer may be brighter than any pixel (docs/dev/accuracy.md, "Checked after
// drawing").
#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"

namespace splotchcl::test {
namespace {

const std::vector<LightPlan> ordered = {LightPlan::ordered};
constexpr int picture_side = 64;

DrawnComponent matter(const std::vector<Cloud>& clouds, double brightness, double absorption) {
  DrawnComponent component = component_of(clouds, one_color(1, 1, 1));
  component.brightness = brightness;
  component.absorption = {Absorption::Kind::factor, absorption};
  return component;
}

// Gas of a faint source, which is most of what absorbs; in the middle between two pixels.
DrawnComponent faint_gas() {
  return matter({{-19.5, -19.5, 1000, 2, 2}}, 0.01, 1);
}

void use_kernel_of_original(Frame& frame) {
  frame.kernel.cut = 1.8153;
  frame.kernel.sampling = Sampling::center;
}

Frame thin_matter_of_a_bright_source() {
  std::vector<Cloud> stars;
  for (const double z : {1000.0, 1001.0, 1002.0, 1003.0})
    stars.push_back({12.5, 12.5, z, 1.5, 0.342});
  Frame frame = frame_of(picture_side, picture_side, {faint_gas(), matter(stars, 1, 1.0 / 30)});
  use_kernel_of_original(frame);
  return frame;
}

Frame tinted_matter(double background) {
  DrawnComponent tinted = component_of({}, one_color(0.01f, 0.01f, 0.01f));
  std::vector<Cloud> clouds;
  for (int i = 0; i < 8; ++i)
    clouds.push_back({0.5, 0.5, 1000, 4, 0.5});
  tinted = component_of(clouds, one_color(0.01f, 0.01f, 0.01f));
  tinted.palette.absorption = {Rgb{1, 0.01f, 0.01f}};
  tinted.absorption = {Absorption::Kind::factor, 1};
  Frame frame = frame_of(picture_side, picture_side, {tinted});
  frame.background = {background, background, background};
  return frame;
}

Frame tinted_matter_of_original() {
  Frame frame = tinted_matter(100);
  use_kernel_of_original(frame);
  return frame;
}

// One wide cloud whose opacity is a thousandth of its light.
Frame wide_cloud_of_a_bright_source(double column) {
  Frame frame = frame_of(picture_side, picture_side,
                         {faint_gas(), matter({{12.5, 12.5, 1000, 12, column}}, 1, 1e-3)});
  frame.tolerance = 3e-3;
  return frame;
}

Frame wide_disc_of_a_bright_source() {
  Frame frame = wide_cloud_of_a_bright_source(1.62);
  use_kernel_of_original(frame);
  return frame;
}

HardCase in_order(const std::string& name, const std::string& why, Frame (*frame)()) {
  return {name, why, [frame](LightPlan) { return frame(); }, ordered};
}

}  // namespace

std::vector<HardCase> source_cases() {
  return {
      in_order("ThinMatterOfABrightSource",
               "its source is thirty times as bright as any pixel that shows it",
               thin_matter_of_a_bright_source),
      in_order("TintedMatterBeforeABackground",
               "one channel is opaque, but the mean of all is hardly so",
               [] { return tinted_matter(100); }),
      in_order("TintedMatterOfTheOriginal", "the same with the original program's kernel",
               tinted_matter_of_original),
      in_order("WideCloudOfABrightSource", "terms of phi's series err by what it is made of",
               [] { return wide_cloud_of_a_bright_source(0.2524); }),
      in_order("WideDiscOfABrightSource", "the same with the original program's kernel",
               wide_disc_of_a_bright_source),
  };
}

}  // namespace splotchcl::test
