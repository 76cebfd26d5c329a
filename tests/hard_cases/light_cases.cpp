// Extremes of emission and absorption.
#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Clouds of columns around 1 that absorb `factor` times what they emit.
Frame clouds_absorbing(double factor, LightPlan plan) {
  CloudSetup setup;
  setup.count = 300;
  setup.column_high = 3;
  DrawnComponent clouds = random_clouds(setup);
  clouds.absorption = {Absorption::Kind::factor, factor};
  const Frame frame = frame_of(setup.width, setup.height, {clouds});
  return plan == LightPlan::ordered ? ordered_by_two_components(frame) : frame;
}

HardCase faint_absorption(const std::string& name, double factor) {
  return {name, "E / A overflows single precision when it is formed, and 1 - exp(-A X) is lost",
          [factor](LightPlan plan) { return clouds_absorbing(factor, plan); }, absorbing_plans};
}

Frame without_absorption_beside_clouds(LightPlan plan) {
  CloudSetup setup;
  setup.count = 200;
  DrawnComponent stars = random_clouds(setup);
  stars.absorption = {Absorption::Kind::none, 0};
  setup.seed = 2;
  DrawnComponent clouds = random_clouds(setup);
  if (plan == LightPlan::emission) clouds.absorption = {Absorption::Kind::none, 0};
  return frame_of(setup.width, setup.height, {stars, clouds});
}

Frame one_opaque_particle(LightPlan plan) {
  CloudSetup setup;
  setup.count = 100;
  DrawnComponent clouds = random_clouds(setup);
  const DrawnComponent opaque = component_of({{3.3, -5.1, 50, 8, 1e4}}, one_color(1, 0.5f, 0.1f));
  return lit(frame_of(setup.width, setup.height, {clouds, opaque}), plan);
}

Frame clouds_of_brightness(double brightness, double factor, LightPlan plan) {
  Frame frame = clouds_absorbing(factor, plan);
  for (DrawnComponent& component : frame.components)
    component.brightness *= brightness;
  return frame;
}

// A star of this brightness right behind a cloud of this optical depth.
Frame star_behind_cloud(double brightness, double depth) {
  DrawnComponent star = component_of({{0.2, 0.4, 2, 3, 1}}, one_color(1, 1, 1));
  star.brightness = brightness;
  star.absorption = {Absorption::Kind::none, 0};
  DrawnComponent cloud = component_of({{0, 0, 1, 20, depth}}, one_color(0.1f, 0.2f, 0.3f));
  cloud.palette.absorption = {Rgb{1, 1, 1}};
  return frame_of(40, 40, {star, cloud});
}

Frame background_behind_cloud(double background, double depth, LightPlan plan) {
  DrawnComponent cloud = component_of({{0, 0, 1, 20, depth}}, one_color(1, 1, 1));
  Frame frame = lit(frame_of(40, 40, {cloud}), plan);
  frame.background = {background, background, background};
  return frame;
}

}  // namespace

std::vector<HardCase> light_cases() {
  return {
      {"NoAbsorptionBesideClouds",
       "E / A does not exist for a part of the particles",
       without_absorption_beside_clouds,
       {LightPlan::emission, LightPlan::ordered}},
      faint_absorption("Absorption1e_8", 1e-8),
      faint_absorption("Absorption1e_30", 1e-30),
      {"OpticalDepth1e4InOneParticle",
       "exp(-1e4) underflows, and the cloud's edge, where the depth falls to 1, lies far out",
       one_opaque_particle},
      {"EmissionFarAboveAbsorption", "the picture's values reach 1e6 while depths stay near 1",
       [](LightPlan plan) { return clouds_of_brightness(1e6, 1, plan); }, absorbing_plans},
      {"AbsorptionFarAboveEmission",
       "light of 1e-4 of the absorption: what is lost in the depth would show nowhere else",
       [](LightPlan plan) { return clouds_of_brightness(1, 1e4, plan); }, absorbing_plans},
      {"BrightStarBehindThickCloud",
       "the star is 1e6 times white and the cloud lets 1e-6 of it through: transmittance must "
       "keep its own digits, not those of 1 - opacity",
       [](LightPlan) { return star_behind_cloud(1e6, 14); },
       {LightPlan::ordered}},
      {"BrightBackgroundBehindCloud",
       "the background is 1e4 times white and what comes through the cloud about white",
       [](LightPlan plan) { return background_behind_cloud(1e4, 9, plan); }, absorbing_plans},
  };
}

}  // namespace splotchcl::test
