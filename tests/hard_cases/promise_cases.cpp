// Scenes that the adversary found, or that follow one of its findings: each broke the promise of
// the tolerance once (docs/dev/contributing.md).
#include "adversary/trial.h"
#include "adversary/trial_frame.h"
#include "hard_cases/hard_cases.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using adversary::Trial;

const std::vector<LightPlan> sums = {LightPlan::emission, LightPlan::proportional};

Trial in_light(Trial trial, LightPlan plan) {
  // A light that the case chooses itself stays.
  if (adversary::plan_of(trial.light) == plan) return trial;
  if (plan == LightPlan::emission) trial.light = adversary::Light::emission;
  if (plan == LightPlan::proportional) trial.light = adversary::Light::proportional;
  if (plan == LightPlan::ordered) trial.light = adversary::Light::ordered;
  return trial;
}

// `text` is what the adversary writes, or less (tests/adversary/trial.h).
HardCase found(const std::string& name, const std::string& why, const std::string& text,
               std::vector<LightPlan> plans = all_plans) {
  HardCase hard;
  hard.name = name;
  hard.why = why;
  hard.plans = std::move(plans);
  const Trial trial = adversary::trial_of(text);
  hard.frame = [trial](LightPlan plan) { return adversary::make_frame(in_light(trial, plan)); };
  hard.exact = [trial](const Frame& frame) {
    return reference::render(adversary::make_merged_frame(in_light(trial, choose_light(frame))));
  };
  // Wide angles have single precision only.
  hard.most_exactly = is_wide_angle(trial.projection) ? Drawn::never : Drawn::in_long_tests;
  return hard;
}

// All that is seen of these is what ends beside the picture.
HardCase dark(HardCase hard) {
  hard.dark = true;
  return hard;
}

// Nothing bounds what roundings of colors do.
HardCase without_bound(HardCase hard) {
  hard.has_bound = false;
  return hard;
}

HardCase slow_in_groups(HardCase hard) {
  hard.in_groups = Drawn::in_long_tests;
  return hard;
}

}  // namespace

std::vector<HardCase> promise_cases() {
  return {
      found("FewBrightClouds",
            "eight clouds are no crowd; what a coarse grid errs by is a part of their peak, and "
            "lands where nothing dims it",
            "group point copies 8 sigma 12 peak 8", {LightPlan::proportional}),
      found("TwentyBrightClouds", "the same of light that is 2000 times white",
            "group point copies 20 sigma 8 peak 100", {LightPlan::proportional}),
      found("TwentyBrightCloudsInPerspective", "the same where widths are quotients",
            "turned 1 projection perspective group point copies 20 sigma 8 peak 20",
            {LightPlan::proportional}),
      found("FewBrightCloudsAt1e_2", "a larger tolerance allows coarser grids",
            "tolerance 1e-2 group point copies 10 x 6 sigma 14.3879 peak 50",
            {LightPlan::emission}),
      found("FewBrightCloudsAt1e_4", "a smaller tolerance has other filters",
            "tolerance 1e-4 group point copies 20 y 20 sigma 16 peak 40", sums),
      found("FewBrightCloudsAt1e_5", "the same, and others again",
            "tolerance 1e-5 group point copies 20 sigma 4.8 peak 6.7"),
      found("BrightCloudsOfManyWidths",
            "ten clouds of ten widths at one place lie on several grids",
            "group point places 10 x -30 sigma 13 width_range 1.3 peak 30",
            {LightPlan::proportional}),
      found("CornerOfFourCells", "a crowd on a corner of four cells has less than a crowd in each",
            "group corner copies 20 sigma 4.61544 peak 1.4"),
      found("CornerOfFourNarrowCells", "the same of narrow clouds, ten in each cell",
            "group corner copies 10 y 12 sigma 1.97452 peak 7"),
      found("CrowdsInARing",
            "each crowd's surroundings are as bright as itself, for there lie the others",
            "group ring places 16 copies 300 y -19 spread 1.1 sigma 6.43947 width_range 1.14647"),
      found("NarrowCrowdsInARing", "the same of total light 7200",
            "group ring places 60 copies 400 spread 1.6 sigma 1.7 peak 0.3"),
      found("RingAroundADarkPixel",
            "clouds of all widths that end in one pixel and lie apart from one another",
            "tolerance 1e-2 group ring places 100 copies 2 y 20 spread 3 width_range 3 peak 30",
            {LightPlan::emission}),
      found("FaintRingAroundADarkPixel", "the same of faint clouds",
            "group ring places 138 copies 11 y 2 spread 5 sigma 5.6 peak 10"),
      found("LineOfCrowds",
            "along a filament all squares end in the same row of pixels, and no cell is brighter "
            "than the next",
            "group line places 14 copies 30 y -9.82452 spread 0.5 sigma 2.1 peak 4"),
      found("LineOfManyWidths", "the same of several widths",
            "group line places 20 copies 100 spread 0.5 sigma 2 width_range 1.4 peak 4"),
      found("EdgeOfEvenLight",
            "an even field of clouds is no crowd anywhere, but beside its edge it is dark",
            "group lattice places 200 copies 20 spread 0.3 sigma 2 peak 5"),
      found("Lattice", "initial conditions on a grid, seen along an axis",
            "group lattice places 90 copies 200 spread 0.8"),
      found("LatticeOfWideClouds",
            "the same where the points' clouds overlap and reach over the picture's edge",
            "group lattice places 50 copies 300 x 30 spread 0.4 sigma 11"),
      found("OwnColorsOfACrowd", "the light of a crowd is in its particles' own colours",
            "own_colors 1 group point copies 300 sigma 2.2 peak 2 color 300"),
      found("OwnColorsOfCrowds", "the same, some clouds' own colours being 4200",
            "own_colors 1 group point places 10 copies 400 y -5.6 sigma 2 peak 4 color 4200"),
      found("OwnColorsOfStars", "sharp stars whose palette is faint",
            "turned 1 projection perspective tolerance 1e-4 own_colors 1 field_of_view 10 group "
            "scatter places 20 y -1.79178 sigma 0.3 peak 1e4 color 1e4"),
      found("CrowdBetweenTheSamplesOfAFile",
            "a crowd of 2000 among 2e5 particles that a sample of every 13th never meets",
            "filler 198000 period 13 offset 4 group point copies 2000 sigma 5.2"),
      found("LargeCrowdBetweenTheSamples", "the same of 6000",
            "filler 194000 period 13 offset 5 group point copies 6000 y -9 sigma 5"),
      found("BrightBackgroundBehindManyClouds",
            "behind an optical depth of 43 at the centre lies light of 2000: a depth that errs by "
            "a part of itself changes what comes through by the depth times as much",
            "background 2000 group point copies 20 x 16.7694 y 12.2759 sigma 2.364 peak 2.12",
            absorbing_plans),
      found("BrightBackgroundAt1e_4", "the same at a smaller tolerance",
            "tolerance 1e-4 background 4000 group point places 2 copies 10 sigma 4 peak 6",
            absorbing_plans),
      found("BrightStarBehindManyClouds", "the same of a star",
            "light stars_among_gas group point copies 10 sigma 2.3 peak 6 group point peak 200000 "
            "star 1",
            {LightPlan::ordered}),
      found("CutEdgesOfACrowd",
            "cut edges that lie upon one another do not err independently on a coarse grid",
            "cut 2.7 group point copies 20 sigma 6 peak 0.8", {LightPlan::proportional}),
      found("CutEdgesOfABrightCrowd", "the same of fainter edges",
            "cut 4 group point copies 20 sigma 7.3 peak 10", {LightPlan::proportional}),
      found("CrowdBesideAPole",
            "near a pole clouds are much wider than high, and a crowd is as wide as its clouds",
            "projection equirectangular height 32 group point copies 300 y 14 sigma 1.46392 peak "
            "400"),
      found("CrowdFarBesideThePicture",
            "a crowd more than four sigma outside, so bright that it is seen; a search that ends "
            "nearer does not",
            "group point places 4 copies 340 x 82.3954 sigma 11.0476 width_range 1.017 peak 80000"),
      slow_in_groups(
          found("ManyLayersBeforeABackground",
                "each of 9000 layers multiplies what comes through by a number that errs by a part "
                "of itself",
                "background 200 group point places 45 copies 200", {LightPlan::ordered})),
      found("JustBelowBright",
            "twenty clouds that are not bright enough for means of more digits, each by itself",
            "tolerance 1e-4 group point copies 20 sigma 3.5 peak 7.9"),
      found("JustBelowBrightOnACorner", "the same of eighty",
            "tolerance 1e-4 group corner copies 20 peak 7.9"),
      found("FewBrightCloudsOnManyGrids",
            "each coarse grid interpolates what the one before erred by",
            "width 1024 height 32 group point copies 8 sigma 100 peak 8",
            {LightPlan::proportional}),
      found("FewBrightCloudsOnManyGridsAt1e_4", "the same at a smaller tolerance",
            "tolerance 1e-4 width 1024 height 32 group line copies 20 sigma 130 peak 30", sums),
      found("FewBrightCloudsOfAFisheye", "clouds at one place on coarse grids, seen in a dome",
            "projection fisheye group point copies 20 sigma 6 peak 14", {LightPlan::proportional}),
      found("FewBrightCloudsOfACubeFace", "the same on a face of a cube",
            "projection cube width 48 group line places 18 copies 7 x -20 spread 0.3 sigma 6.4 "
            "peak 5",
            {LightPlan::proportional}),
      found("SmallestRadiusOfACrowd",
            "widths and weights of a crowd's clouds are not those of its particles",
            "min_radius 0.8 tolerance 1e-2 group corner copies 20 sigma 7.4 peak 100", sums),
      found("BrightBackgroundBehindGrayClouds",
            "light of 5000 behind deep clouds, as in the original program",
            "light gray tolerance 1e-4 background 5000 group point copies 9 sigma 4.0175 peak 6",
            {LightPlan::ordered}),
      found("StarBetweenTheSamplesOfAFile", "one sharp star that the sample does not meet",
            "turned 1 projection perspective tolerance 1e-4 field_of_view 2 filler 199999 period "
            "13 offset 8 group point x 20.3 y 11.1 sigma 0.4 peak 1e6 depth 9.1",
            {LightPlan::emission}),
      found("PartOfALargePicture",
            "places have the digits of 16384 pixels, not of the 64 that are drawn",
            "turned 1 projection perspective picture_size 16384 field_of_view 50 group scatter "
            "places 50 sigma 0.4 peak 10"),
      found("PartOfALargeFlatPicture", "the same without a perspective",
            "turned 1 picture_size 16384 group scatter places 50 sigma 0.4 peak 10"),
      found("BrightPartOfALargePicture", "the same of stars of 1e4 times white",
            "turned 1 projection perspective picture_size 16384 field_of_view 50 group scatter "
            "places 50 sigma 0.4 peak 1e4"),
      dark(found("CrowdOfTwoColorsThatEndsBeforeTheFirstPixel",
                 "a part of no light that is infinite is no number",
                 "turned 1 knots 3 group corner copies 40 x 50 sigma 5 width_range 1.03642 peak 70",
                 {LightPlan::emission})),
      found("StarDeepInAnotherChannel",
            "where one channel is opaque, its light tells nothing of how deep it is",
            "light factor tolerance 0.01 turned 1 source 2.3 knots 15 decades 5.98947 group point "
            "peak 200000 hue 0.642853",
            {LightPlan::proportional}),
      without_bound(found(
          "LayersDeepInAnotherChannel", "the same of layers in order",
          "light two_sources sampling center tolerance 1e-05 turned 1 star_source 0.7 knots 15 "
          "group point places 10 copies 30 peak 3 hue 0.857166 star 1",
          {LightPlan::ordered})),
      found("StarsAtTheEdgeOfThe65536thPixel",
            "integers that hold so wide a picture have steps of 6e-5 pixels",
            "turned 1 tolerance 3.01e-4 picture_size 65536 crop_x 1 group scatter places 24 sigma "
            "0.3 peak 1e3",
            {LightPlan::emission}),
      found("StarsOf1e7TimesWhiteAtThe65536thPixel", "the same of bright ones",
            "turned 1 picture_size 65536 crop_x 1 crop_y 0.3 group scatter places 24 sigma 0.3 "
            "peak 1e7",
            {LightPlan::emission, LightPlan::proportional}),
      found("StarsOf30TimesWhiteIn1400Pixels", "a star's light beside it errs by its slope",
            "turned 1 projection perspective picture_size 1400 field_of_view 7.7 group scatter "
            "places 100 sigma 0.5 peak 30"),
      found("StarsOf5e4TimesWhiteIn1400Pixels", "the same of brighter stars",
            "turned 1 projection perspective picture_size 1400 field_of_view 7.7 jitter_seed 3 "
            "group scatter places 30 x -9 y -23 sigma 0.32 peak 5e4 depth 20"),
      found("StarsOf1e6TimesWhiteIn1400Pixels", "the same of a width that is not sharp",
            "turned 1 projection perspective picture_size 1400 field_of_view 7.7 group scatter "
            "places 100 sigma 1 peak 1e6"),
      found("StarsOfAFisheyeAt1e_5", "places are arcs in single precision",
            "projection fisheye tolerance 1e-5 field_of_view 42 turned 1 group scatter places 30 "
            "sigma 1 peak 20000 depth 50",
            {LightPlan::emission}),
      found("StarsOfAPanoramaAt1e_5", "the same of longitudes and latitudes",
            "projection equirectangular height 32 tolerance 1e-5 turned 1 group scatter places 30 "
            "sigma 1 peak 20000 depth 50",
            {LightPlan::emission}),
      found("WideCloudsOnTheHorizonOfAPanorama",
            "they are mirrored over both poles, of which a rounding would choose one",
            "projection equirectangular height 32 tolerance 1e-5 turned 1 group lattice places 9 "
            "sigma 20 depth 86"),
      found("CloudsAsWideAsAPanorama", "they have light all around the sky, many times over",
            "projection equirectangular height 32 turned 1 min_radius 3 group lattice places 9 "
            "sigma 90 peak 0.3"),
      found("StarsOfACubeFaceAt1e_5", "the same of quotients whose widths grow towards the corners",
            "projection cube width 48 tolerance 1e-5 turned 1 group scatter places 30 sigma 1 peak "
            "20000 depth 50",
            {LightPlan::emission}),
      found(
          "ThousandsOfLayersBeforeStars",
          "a polynomial of exp(-y) that is not 1 at 0 takes a part of the light away in each layer",
          "light stars_among_gas turned 1 group ring places 40 copies 300 spread 4 sigma 11.0406",
          {LightPlan::ordered}),
      dark(found(
          "CrowdThatEndsBeforeTheFirstPixel",
          "squares that reach the picture's edge, but no pixel's center, are in no list",
          "light stars_among_gas turned 1 group corner copies 400 x -80 sigma 5.09446 width_range "
          "3.28685 peak 0.09",
          {LightPlan::ordered})),
      found("RingOfStarsWiderThanThePicture", "all of its light comes from far beside the picture",
            "light stars_among_gas turned 1 group ring places 47 spread 2.86905 sigma 377.554 "
            "width_range 1.13964 peak 200 star 1",
            {LightPlan::ordered}),
      dark(found(
          "CrowdThatEndsBeforeACoarseGrid", "the same of a grid's guard band",
          "tolerance 1e-4 turned 1 group point places 200 copies 60 y 42.025 sigma 5.2 width_range "
          "1.00508 peak 0.55 star 1",
          {LightPlan::proportional})),
      found("CrowdTakenAsMeansOnACoarseGrid",
            "means of a crowd's clouds are those of the picture's pixels, not of a coarse grid's",
            "tolerance 1e-4 turned 1 filler 191346 period 13 offset 10 group point copies 20 x -80 "
            "sigma 10 peak 100 group point copies 6 sigma 9.5 peak 0.6 hue 0.4",
            {LightPlan::emission}),
      found(
          "ThousandsOfEqualClouds", "equal numbers err by equal roundings when they are added up",
          "tolerance 1e-5 turned 1 group point places 10 copies 400 y 40 sigma 20 peak 0.5 hue 0.8",
          sums),
      found("ThousandsOfEqualStarsBetweenLayers", "the same in order",
            "light stars_among_gas tolerance 1e-4 group point places 100 copies 30 sigma 90 peak "
            "3000 "
            "star 1 group point copies 60 sigma 90 peak 8e5 depth 7 star 1",
            {LightPlan::ordered}),
      found("CopiesOfFaintStarsInALargePicture",
            "copies are misplaced alike, however faint each of them is",
            "light stars_among_gas picture_size 16384 crop_x 0.9 turned 1 group lattice places 40 "
            "copies 400 y 21.5386 spread 0.598396 sigma 0.4 width_range 1.5 peak 0.001 star 1",
            {LightPlan::ordered}),
      found(
          "CopiesInALargePictureAt1e_5", "the same of what pairs of floats know of their places",
          "tolerance 1e-5 projection perspective picture_size 16384 turned 1 group scatter places "
          "10 copies 40 sigma 0.4 peak 0.08",
          {LightPlan::proportional}),
      found(
          "CutEdgesOfCopies", "edges of copies lie upon one another on every place of a lattice",
          "tolerance 1e-2 sampling center turned 1 cut 1.81871 group lattice places 20 copies 9 x "
          "-12 spread 3.67311 sigma 8 width_range 1.2 peak 0.137877 group lattice places 4 copies "
          "9 "
          "x -12 spread 4 sigma 8 width_range 1.2 peak 0.137835",
          {LightPlan::proportional}),
      found("PlacesOnAxesOfALargePicture",
            "places that one float holds have digits below the integers of places, too",
            "light ordered tolerance 1e-5 picture_size 16384 crop_x 0.5 source 0.3 jitter_seed 2 "
            "group scatter places 200 copies 10 sigma 0.3 peak 20 hue 1",
            {LightPlan::ordered}),
      found(
          "WideBrightMeansInACube", "differences of 1 - erf lose the digits of wide means",
          "light emission projection cube tolerance 1e-5 width 48 turned 1 jitter_seed 84 group "
          "point copies 16 x -21.5896 y 3.91496 sigma 15.7503 peak 10 depth 35.9499 hue 0.4 star 1",
          {LightPlan::emission}),
      found("CloudsBrighterThanTheirWidthCountsAs",
            "only the fainter ones of a width were drawn as bright splats",
            "light factor projection fisheye tolerance 1e-5 turned 1 source 4 group point group "
            "scatter places 2 y -13.6443 sigma 7.21602 width_range 1.01214 peak 7.3 depth 39.5714 "
            "star 1",
            {LightPlan::proportional}),
      found("EqualThinLayersBeforeABrightBackground",
            "equal roundings of 64 layers show before light of 4000",
            "light stars_among_gas tolerance 1e-5 background 4000 source 0.0049 group point copies "
            "382 x 80 y -0.2 sigma 158.298 peak 0.000361009 hue 0.72456",
            {LightPlan::ordered}),
      found("SheetAroundAFisheye",
            "where a cloud exactly behind the camera lies on the rim is a matter of roundings",
            "light stars_among_gas projection fisheye field_of_view 150 turned 1 source 40 group "
            "sheet "
            "copies 10 sigma 30 peak 0.02",
            {LightPlan::ordered}),
      dark(found(
          "BrightCloudsThatJustEndBesideThePicture",
          "brighter clouds end farther out than others of their width",
          "light factor tolerance 1e-2 turned 1 group point places 2 copies 20 x -25 y 36 sigma "
          "3.95968 peak 3.8 group point copies 40 x -20 y 36.5219 sigma 3.91905 peak 11.536",
          {LightPlan::proportional})),
      found("LatticeOfBrightCrowds", "crowds in regular places look like even light to wide cells",
            "light factor tolerance 1e-2 turned 1 source 5 group lattice places 25 copies 90 y 30 "
            "spread 5 sigma 8.4 peak 0.36 hue 0.2 group lattice places 30 copies 90 x 78 y 30 "
            "spread 5 "
            "sigma 8 peak 0.3",
            {LightPlan::proportional}),
      found(
          "SheetsInGrayLightOfACube", "a sheet that goes on beside the picture",
          "light gray projection cube tolerance 0.01 width 48 group sheet x 20 y -23 spread 0.5 "
          "sigma 15 peak 0.05 group point places 16 copies 17 y 39.7642 sigma 13.2481 peak 430000 "
          "star 1",
          {LightPlan::ordered}),
      found("SheetInGrayLightOfAFisheye", "the same in a dome",
            "light gray projection fisheye tolerance 0.01 field_of_view 100 source 0.002 group "
            "sheet y "
            "7 spread 0.5 sigma 36 peak 0.03 star 1",
            {LightPlan::ordered}),
      dark(found("BrightCrowdFarFromThePixel",
                 "roundings of erf are parts of a peak as far out as the splat is drawn",
                 "light factor tolerance 1e-05 turned 1 group point places 2 copies 400 y 37.1305 "
                 "sigma 3.35034 peak 7.99975",
                 {LightPlan::proportional})),
      found("CopiesInARingWiderThanThePicture",
            "the same of a ring whose clouds' centers lie far away",
            "light factor tolerance 1e-05 turned 1 source 20 group ring copies 400 spread 3 sigma "
            "82 peak 100",
            {LightPlan::proportional}),
      dark(found(
          "CrowdOfStarsFarFromThePixel", "the same beside 2e5 others",
          "tolerance 0.0001 filler 199999 period 13 offset 10 group point copies 300 x 80 sigma "
          "15 star 1",
          {LightPlan::proportional})),
      found("LineBesideACrop", "where a picture is few cells high, a line looks like even light",
            "picture_size 4096 crop_x 0.89 crop_y 0.1 group line places 100 copies 40 y -10 "
            "spread 0.05 sigma 10 peak 0.2",
            {LightPlan::ordered}),
      found("ThinLayersBehindAnOpaqueFront",
            "layers too thin for the rounding of an opacity still add light",
            "tolerance 0.0001 group point places 100 copies 200 y -100 sigma 30 peak 9000",
            {LightPlan::ordered}),
      found("MeansAlongOneAxisOfAPanorama",
            "the check took widened clouds for wider than they had been projected as",
            "light emission projection equirectangular tolerance 0.01 height 32 turned 1 group "
            "corner copies 400 x 30 y -3 sigma 1.88863 peak 1.8",
            {LightPlan::emission, LightPlan::proportional}),
      found("TailsOfNarrowCloudsBeforeASheet",
            "slabs divided what tails of 1e-32 take by a number that was larger",
            "light ordered tolerance 0.01 turned 1 group point places 4 x 6 sigma 2 width_range 2 "
            "star 1 group sheet copies 35 spread 0.9 sigma 200 width_range 1.2 peak 0.0005 hue 0.7 "
            "star 1",
            {LightPlan::ordered}),
      found("EqualLayersBetweenAnOpaqueOneAndABackground",
            "each errs by the same rounding of an opacity close to 1",
            "light ordered background 70 group point sigma 8 peak 60 group point places 10 copies "
            "80 sigma 4 hue 1",
            {LightPlan::ordered}),
      found("EqualLayersBeforeABackground",
            "equal layers err by equal roundings of their opacities",
            "light gray tolerance 1e-05 background 4 group corner copies 200 width_range 1.02506 "
            "peak 0.0111939 star 1",
            {LightPlan::ordered}),
      found("ThousandsOfLayersOfOneCrowd", "the same of a crowd in one place",
            "light stars_among_gas tolerance 1e-05 turned 1 group point places 60 copies 60 peak "
            "0.054 hue 0.6",
            {LightPlan::ordered}),
      found("ThousandsOfLayersInARing", "the same of a ring",
            "light stars_among_gas tolerance 1e-05 turned 1 group ring places 30 copies 300 spread "
            "2 peak 0.04",
            {LightPlan::ordered}),
      found("GasBeforeManyStars",
            "where gas lies before light that is hundreds of times white, its places show",
            "light stars_among_gas sampling center tolerance 1e-05 turned 1 source 0.3 group point "
            "copies 9 x -10.5291 y 12.4473 peak 30 depth 4.6 group scatter places 200 copies 2 "
            "sigma 30 peak 30 star 1",
            {LightPlan::ordered}),
      found("BrightCopiesBeforeABackground",
            "center values of deep clouds take away from the background where they have faded",
            "light stars_among_gas turned 1 background 80 source 0.2 group point copies 200 y -10 "
            "sigma 8 peak 400000",
            {LightPlan::ordered}),
      found("DeepCopiesBeforeStars",
            "two terms of a series err by more of what is behind than of the layer",
            "light stars_among_gas turned 1 source 0.0017 group point places 9 copies 3 sigma 50 "
            "peak 0.0006 group scatter places 100 sigma 60 peak 300 depth 20 star 1",
            {LightPlan::ordered}),
      found("DeepCopiesBeforeABrightBackground", "the same of a background of 10000",
            "turned 1 background 10000 source 1.8 group point copies 28 sigma 30 peak 0.59",
            {LightPlan::ordered}),
      found("LatticeACellFromTheEdge",
            "light that begins in the second cell from the picture's edge is not even beside it",
            "light factor tolerance 0.01 turned 1 source 0.2 group lattice places 47 copies 300 y "
            "16 spread 2.19397 sigma 4 peak 0.1 hue 0.7 group lattice places 47 copies 300 y 16 "
            "spread 2.19353 sigma 4 peak 0.14",
            {LightPlan::proportional}),
      slow_in_groups(
          found("CrowdOnACoarseGridFarFromThePixel",
                "what a coarse grid errs by reaches beyond two sigma where there are thousands",
                "group point places 60 copies 400 y -50 sigma 7.4 width_range 1.04414 peak 8",
                {LightPlan::emission})),
      found("HundredsOfCopiesInALargePicture", "the same of hundreds whose light is 1 together",
            "light factor tolerance 1e-5 projection perspective picture_size 16384 crop_x 0.5 "
            "field_of_view 90 turned 1 source 9 jitter_seed 3 group scatter places 11 copies 400 "
            "sigma 0.3 peak 0.009",
            {LightPlan::proportional}),
  };
}

}  // namespace splotchcl::test
