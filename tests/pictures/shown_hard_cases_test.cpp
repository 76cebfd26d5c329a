// Finished pictures that the adversary found to break their promise once.
#include "adversary/shown_judge.h"
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class ShownHardCases : public PictureTest {
 protected:
  // Of what is promised, for a trial as the adversary writes it.
  static double error_of_promise(const char* text) {
    return adversary::measure_shown(adversary::trial_of(text), renderer()).ratio();
  }
};

TEST_F(ShownHardCases, RelativeErrorsOfBrightLightGrowWithContrast) {
  EXPECT_LE(
      error_of_promise("light emission turned 1 knots 5 min_radius 1.24814 shown 1 exposure 5 "
                       "white 0.284773 highlights 0.6 saturation 0.5 contrast 2.2 pivot 0.74 "
                       "group ring places 152 copies 111 x -19.5712 y -3.301 spread 4.77176 "
                       "sigma 7.56261 width_range 1.6323 peak 112.869 hue 0.288261"),
      1);
}

TEST_F(ShownHardCases, TheBalanceOfWhiteLiftsBlueErrors) {
  EXPECT_LE(error_of_promise("light gray min_radius 1.2 shown 1 exposure -1.14816 balance 1933.91 "
                             "highlights 1 group corner copies 22 sigma 2.4 width_range 3 "
                             "peak 67000 hue 0.86"),
            1);
}

TEST_F(ShownHardCases, LightThatNobodyPromisesIsNotExposedFor) {
  EXPECT_LE(error_of_promise("light emission tone filmic tolerance 0.01 turned 1 min_radius 3 "
                             "shown 1 automatic 1 group line places 200 y -100 sigma 13 peak 40"),
            1);
}

TEST_F(ShownHardCases, CoarseEstimatesKeepNoDrawing) {
  EXPECT_LE(error_of_promise("light factor tone asinh turned 1 source 0.73 min_radius 1.3 shown 1 "
                             "automatic 1 contrast 2 pivot 0.35 group line places 190 copies 200 "
                             "x -50 y -14.3544 spread 0.3 sigma 6.1 width_range 1.1 peak 250000"),
            1);
}

TEST_F(ShownHardCases, CoarseEstimatesKeepNoDrawingOfGrayAbsorption) {
  EXPECT_LE(error_of_promise("light gray tone filmic min_radius 2.7 shown 1 automatic 1 "
                             "balance 3300 contrast 1.57368 pivot 0.3 group point places 2 "
                             "copies 300 sigma 5 width_range 1.15824 peak 80000 hue 0.5 star 1"),
            1);
}

}  // namespace
}  // namespace splotchcl::test
