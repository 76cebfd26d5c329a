#include "certificate/certificate.h"

#include "reference/frames.h"
#include "scene/plan/splat_limits.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr int size = 128;

Image dark_picture() {
  Image image;
  image.width = image.height = size;
  image.pixels.assign(static_cast<std::size_t>(4) * size * size, 0.0f);
  return image;
}

// One octave of splats with sigma from 1 to 2, nothing else. Values are of peaks and endings.
PeakCells empty_cells() {
  PeakCells cells;
  cells.octave = 1;
  for (CellSums* sums : {&cells.peaks, &cells.endings}) {
    sums->side = 4;
    sums->columns = sums->rows = size / 4;
    sums->values.assign(static_cast<std::size_t>(size / 4) * (size / 4), 0.0f);
  }
  return cells;
}

float& at(CellSums& sums, int x, int y) {
  return sums.values[static_cast<std::size_t>(y * sums.columns + x)];
}

// Light that nothing absorbs.
class CertificateTest : public testing::Test {
 protected:
  CertificateTest() {
    DrawnComponent component = component_of({Cloud{}}, one_color(1, 1, 1));
    component.absorption = {Absorption::Kind::none, 0};
    frame_ = frame_of(size, size, {component});
    plan_ = make_plan(frame_);
  }

  Certificate certify_cells(const PeakCells& cells) const {
    return certify({{cells}, 1, {}}, dark_picture(), frame_, plan_);
  }
  // Of a splat of sigma from 1 to 2, where it ends.
  double ending() const {
    const auto extent = static_cast<double>(plan_.splats.least_extent);
    return std::exp(-extent * extent - plan_.needs.widths[1].farther);
  }

  Frame frame_;
  FramePlan plan_;
};

TEST_F(CertificateTest, FindsNothingWhereThereAreNoSplats) {
  const Certificate certificate = certify({}, dark_picture(), frame_, plan_);
  EXPECT_TRUE(certificate.keeps_promise());
  EXPECT_LT(certificate.error_of_promise, 0.2);
}

TEST_F(CertificateTest, HasAnErrorForEachBlockOfThePicture) {
  const Certificate certificate = certify_cells(empty_cells());
  EXPECT_EQ(certificate.blocks.columns, size / 16);
  EXPECT_EQ(certificate.blocks.rows, size / 16);
  EXPECT_EQ(certificate.blocks.errors.size(), static_cast<std::size_t>(size / 16) * (size / 16));
}

TEST_F(CertificateTest, CountsWhatAClusterLeavesOutBesideIt) {
  PeakCells cells = empty_cells();
  const double light = 1.5 * frame_.tolerance / ending();
  at(cells.endings, 10, 10) = static_cast<float>(light);
  const Certificate certificate = certify_cells(cells);
  EXPECT_FALSE(certificate.keeps_promise());
  EXPECT_NEAR(certificate.worst.ends, 1.5, 0.01);
}

TEST_F(CertificateTest, CountsAClusterOnACornerOfCellsAsAWhole) {
  PeakCells cells = empty_cells();
  const double light = 1.5 * frame_.tolerance / ending();
  for (const int x : {10, 11}) {
    for (const int y : {10, 11})
      at(cells.endings, x, y) = static_cast<float>(light / 4);
  }
  EXPECT_NEAR(certify_cells(cells).worst.ends, 1.5, 0.01);
}

TEST_F(CertificateTest, CountsARingOfClustersAroundADarkPixel) {
  PeakCells cells = empty_cells();
  const double light = 1.5 * frame_.tolerance / ending();
  for (const int x : {8, 12}) {
    for (const int y : {8, 12})
      at(cells.endings, x, y) = static_cast<float>(light / 4);
  }
  EXPECT_NEAR(certify_cells(cells).worst.ends, 1.5, 0.01);
}

TEST_F(CertificateTest, TakesAnEvenFieldForEven) {
  PeakCells cells = empty_cells();
  std::fill(cells.endings.values.begin(), cells.endings.values.end(), 10.0f);
  std::fill(cells.peaks.values.begin(), cells.peaks.values.end(), 10.0f);
  const Certificate certificate = certify_cells(cells);
  const std::size_t middle = static_cast<std::size_t>(size / 16) * 4 + 4;
  EXPECT_LT(certificate.blocks.errors[middle], frame_.tolerance);
}

TEST_F(CertificateTest, DoesNotTakeTheEdgeOfAnEvenFieldForEven) {
  PeakCells cells = empty_cells();
  for (int y = 0; y < cells.endings.rows; ++y) {
    for (int x = 0; x < cells.endings.columns / 2; ++x)
      at(cells.endings, x, y) = static_cast<float>(frame_.tolerance / ending());
  }
  EXPECT_FALSE(certify_cells(cells).keeps_promise());
}

// Cells at the edge hold what lies beside the picture, too.
TEST_F(CertificateTest, DoesNotTakeLightThatBeginsACellFromTheEdgeForEven) {
  PeakCells cells = empty_cells();
  for (int y = 2; y < cells.endings.rows; ++y) {
    for (int x = 0; x < cells.endings.columns; ++x)
      at(cells.endings, x, y) = static_cast<float>(frame_.tolerance / ending());
  }
  const Certificate certificate = certify_cells(cells);
  EXPECT_GT(certificate.blocks.at(size / 2, 2), frame_.tolerance);
}

TEST_F(CertificateTest, TakesNothingForEvenInAPictureOfFewCells) {
  PeakCells cells = empty_cells();
  frame_.height = frame_.crop.height = 16;
  cells.endings.rows = cells.peaks.rows = 4;
  for (CellSums* sums : {&cells.peaks, &cells.endings})
    sums->values.resize(static_cast<std::size_t>(sums->columns) * 4);
  std::fill(cells.endings.values.begin(), cells.endings.values.end(),
            static_cast<float>(frame_.tolerance / ending()));
  Image image = dark_picture();
  image.height = 16;
  image.pixels.resize(static_cast<std::size_t>(4) * size * 16);
  EXPECT_FALSE(certify({{cells}, 1, {}}, image, frame_, plan_).keeps_promise());
}

TEST_F(CertificateTest, AsksForMoreOfTheOctaveThatErrs) {
  PeakCells cells = empty_cells();
  at(cells.endings, 10, 10) = static_cast<float>(5 * frame_.tolerance / ending());
  const SplatNeeds needs = certify_cells(cells).needs;
  EXPECT_GT(needs.widths[1].farther, std::log(5.0));
  EXPECT_EQ(needs.widths[0].farther, 0);
  EXPECT_EQ(needs.widths[2].farther, 0);
}

TEST_F(CertificateTest, IsContentWithAFrameThatWasDrawnAgainAsItAsked) {
  PeakCells cells = empty_cells();
  at(cells.endings, 10, 10) = static_cast<float>(50 * frame_.tolerance / ending());
  const Certificate first = certify_cells(cells);
  ASSERT_FALSE(first.keeps_promise());
  plan_ = refine_plan(frame_, plan_, first.needs);
  EXPECT_TRUE(certify_cells(cells).keeps_promise());
}

TEST_F(CertificateTest, AsksForFinerGridsWherePeaksLieUponOneAnother) {
  PeakCells cells = empty_cells();
  cells.level = 1;
  cells.octave = 3;
  at(cells.peaks, 10, 10) = 100;
  const Certificate first = certify_cells(cells);
  ASSERT_FALSE(first.keeps_promise());
  EXPECT_GE(first.needs.grid_light, 100);
  plan_ = refine_plan(frame_, plan_, first.needs);
  EXPECT_TRUE(certify_cells(cells).keeps_promise());
}

// What absorbs before a light picture errs by more than its own light.
TEST_F(CertificateTest, AsksForAsMuchLightOfPeaksAsABrightPictureAmplifiesThem) {
  frame_.components.front().absorption = {Absorption::Kind::gray, 1e6};
  plan_ = make_plan(frame_);
  Image image = dark_picture();
  std::fill(image.pixels.begin(), image.pixels.end(), 40.0f);
  for (std::size_t i = 0; i < image.pixels.size(); i += 64)
    image.pixels[i] = 0;
  for (const int octave : {0, 1, 2, 3}) {
    PeakCells cells = empty_cells();
    cells.octave = octave;
    at(cells.peaks, 10, 10) = 40;
    const Certificate first = certify({{cells}, 1, {}}, image, frame_, plan_);
    ASSERT_FALSE(first.keeps_promise()) << octave;
    const FramePlan refined = refine_plan(frame_, plan_, first.needs);
    EXPECT_TRUE(certify({{cells}, 1, {}}, image, frame_, refined).keeps_promise()) << octave;
  }
}

// What lies beyond a crop counts at its sides.
TEST_F(CertificateTest, LeavesOutBlocksAlongTheSidesOfACropWhereAskedTo) {
  PeakCells cells = empty_cells();
  at(cells.endings, 0, 8) = static_cast<float>(10 * plan_.shares.promise / ending());
  const auto keeps = [&](int edge) {
    return certify({{cells}, 1, {}}, dark_picture(), frame_, plan_, edge).keeps_promise();
  };
  EXPECT_FALSE(keeps(2)) << "a side of the picture";
  frame_.width = 2 * size;
  frame_.crop.x = size;
  cells.left = size;
  EXPECT_FALSE(keeps(0));
  EXPECT_TRUE(keeps(2));
}

// However many lie upon one another, they err by no more than a part of the pixel.
TEST_F(CertificateTest, KnowsThatMeansOfBrightSplatsKeepTheirDigits) {
  PeakCells cells = empty_cells();
  cells.octave = 2;
  at(cells.peaks, 10, 10) = 1e9f;
  ASSERT_GT(certify_cells(cells).worst.peaks, 1);
  plan_.needs.widths[2].light = light_of_bright_means(plan_.splats, 4);
  EXPECT_LT(certify_cells(cells).worst.peaks, 0.05);
}

TEST_F(CertificateTest, DoesNotTakeCenterValuesOfWiderSplatsForMeans) {
  PeakCells cells = empty_cells();
  cells.octave = 2;
  at(cells.peaks, 10, 10) = 1e9f;
  plan_.needs.widths[2].light = 0.5 * light_of_bright_means(plan_.splats, 4);
  EXPECT_GT(certify_cells(cells).worst.peaks, 1);
}

// An error of absorption takes away no more than the light that a pixel has.
TEST_F(CertificateTest, CountsLayersBeforeALightPixelForAsMuchAsItHas) {
  frame_.components.front().absorption = {Absorption::Kind::gray, 1e6};
  plan_ = make_plan(frame_);
  ASSERT_TRUE(plan_.needs_sort());
  ASSERT_LT(plan_.light_behind, 0.2);
  PeakCells cells = empty_cells();
  at(cells.endings, 10, 10) = static_cast<float>(0.5 * frame_.tolerance / ending());
  for (const double light : {0.0, plan_.light_behind, 5 * plan_.light_behind}) {
    Image image = dark_picture();
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<float>(light));
    const double expected = 0.5 * std::max(1.0, light / plan_.light_behind);
    EXPECT_NEAR(certify({{cells}, 1, {}}, image, frame_, plan_).worst.ends, expected, 0.01)
        << light;
  }
}

Image even_picture(double light, double opacity) {
  Image image = dark_picture();
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i % 4 == 3 ? opacity : light);
  return image;
}

// A picture without splats whose blocks are so deep.
CollectedSplats as_deep(double depth) {
  CollectedSplats splats;
  splats.depths.assign(static_cast<std::size_t>(size / 16) * (size / 16),
                       static_cast<float>(depth));
  return splats;
}

// Layers add no more than the light, and take no more away than as much for each depth of 1 that
// lies before it.
TEST_F(CertificateTest, CountsTheSeriesOfLayersByTheLightThatTheyShowIn) {
  frame_.components.front().absorption = {Absorption::Kind::gray, 1e6};
  plan_ = make_plan(frame_);
  const auto of_layers = [&](double light, double depth) {
    const Image image = even_picture(light, 0);
    const Certificate certificate = certify(as_deep(depth), image, frame_, plan_);
    return certificate.worst.rest * frame_.tolerance - plan_.shares.early_stop;
  };
  const double part = plan_.layers.part;
  EXPECT_NEAR(of_layers(0, 0.7), 0, 1e-8);
  EXPECT_NEAR(of_layers(0.05, 0.7), 0.05 * part, 1e-8);
  EXPECT_NEAR(of_layers(0.05, 3), 3 * 0.05 * part, 1e-8);
  EXPECT_NEAR(of_layers(0.05, 88), (1 + std::log(1 / 0.05)) * 0.05 * part, 1e-8);
  EXPECT_NEAR(of_layers(1, 88), part, 1e-8);
}

TEST_F(CertificateTest, AsksForMoreTermsOfThePhiOfLayersInALightPicture) {
  frame_.components.front().absorption = {Absorption::Kind::gray, 1e6};
  frame_.kernel.cut = 2.0;
  frame_.kernel.sampling = Sampling::center;
  plan_ = make_plan(frame_);
  const Image image = even_picture(0.5, 0.9);
  const Certificate certificate = certify({}, image, frame_, plan_);
  ASSERT_FALSE(certificate.keeps_promise());
  const FramePlan refined = refine_plan(frame_, plan_, certificate.needs);
  EXPECT_LT(refined.layers.phi_first, 0.5f * plan_.layers.phi_first);
  EXPECT_TRUE(certify({}, image, frame_, refined).keeps_promise());
}

// A star's pixel may err by as much more as it is brighter than white, whatever is beside it.
TEST_F(CertificateTest, CountsLayersBeforeAStarAsPartsOfItsLight) {
  DrawnComponent gas = component_of({Cloud{}}, one_color(1, 1, 1));
  gas.absorption = {Absorption::Kind::gray, 1};
  frame_.components.push_back(gas);
  frame_.kernel.cut = 2.0;
  frame_.kernel.sampling = Sampling::center;
  plan_ = make_plan(frame_);
  ASSERT_TRUE(plan_.needs_sort());
  Image image = even_picture(0.01, 0.5);
  const std::size_t star = image.pixels.size() / 2;
  std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(star), 3, 1000.0f);
  EXPECT_TRUE(certify(as_deep(0.7), image, frame_, plan_).keeps_promise());
  EXPECT_FALSE(certify(as_deep(70), image, frame_, plan_).keeps_promise());
}

Image colored_picture(float red, float green, float blue) {
  Image image = dark_picture();
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    image.pixels[i] = red;
    image.pixels[i + 1] = green;
    image.pixels[i + 2] = blue;
  }
  return image;
}

// A palette in which a place that is off by a rounding makes red light blue.
class ColorsTest : public CertificateTest {
 protected:
  ColorsTest() {
    DrawnComponent& star = frame_.components.front();
    star.palette.emission = {Rgb{1, 0, 0}, Rgb{0, 0, 1}};
    star.particles.color = Column::uniform(3000);
    star.color = {Scaling::log, 1, 8};
    plan_ = make_plan(frame_);
  }
};

TEST_F(ColorsTest, CountByTheBrightestChannelBesideADarkOne) {
  const auto error_of = [&](const Image& image) {
    return certify({}, image, frame_, plan_).error_of_promise;
  };
  const double dim = error_of(colored_picture(1, 0, 0));
  EXPECT_GT(error_of(colored_picture(1e5f, 0, 0)), 1);
  EXPECT_GT(error_of(colored_picture(1e3f, 0, 0)), 5 * dim);
  EXPECT_NEAR(error_of(colored_picture(1e5f, 1e5f, 1e5f)), dim, 1e-6) << "nothing is dark";
}

TEST_F(ColorsTest, HideNothingOfWhatEndsInADarkPicture) {
  PeakCells cells = empty_cells();
  at(cells.endings, 10, 10) = static_cast<float>(1.5 * frame_.tolerance / ending());
  const Certificate certificate = certify_cells(cells);
  EXPECT_FALSE(certificate.keeps_promise());
  for (const float error : certificate.blocks.errors)
    EXPECT_TRUE(std::isfinite(error));
}

TEST_F(ColorsTest, AskForExtendedPrecision) {
  EXPECT_TRUE(certify({}, colored_picture(1e5f, 0, 0), frame_, plan_).needs_extended);
  EXPECT_FALSE(certify({}, colored_picture(1, 0, 0), frame_, plan_).needs_extended);
}

TEST_F(ColorsTest, OfExtendedPrecisionAreBoundedAsWell) {
  const FramePlan extended = extend_plan(frame_, plan_);
  frame_.tolerance = 0;
  const auto error_of = [&](float red) {
    return certify_extended({}, colored_picture(red, 0, 0), frame_, extended).error_of_promise;
  };
  EXPECT_EQ(error_of(1), 1);
  EXPECT_GT(error_of(1e6f), 100);
}

// An opaque channel's light is its source's, however deep it is.
TEST_F(ColorsTest, CountByHowDeepAnOpaqueChannelIs) {
  frame_.components.front().absorption = {Absorption::Kind::as_emission, 0};
  plan_ = make_plan(frame_);
  ASSERT_EQ(plan_.light, LightPlan::proportional);
  const Image image = colored_picture(1, 0.5f, 0);
  EXPECT_TRUE(certify(as_deep(20), image, frame_, plan_).keeps_promise());
  EXPECT_FALSE(certify(as_deep(1e5), image, frame_, plan_).keeps_promise());
}

TEST_F(CertificateTest, FindsNothingLeftOutOfACutKernel) {
  frame_.kernel.cut = 2.0;
  plan_ = make_plan(frame_);
  PeakCells cells = empty_cells();
  at(cells.endings, 10, 10) = 1e6f;
  EXPECT_EQ(certify_cells(cells).worst.ends, 0);
}

TEST_F(CertificateTest, CountsOfBrightMeansOfSeveralWidthsTheLargestPartOfAll) {
  SplatNeeds needs;
  for (WidthNeed& need : needs.widths)
    need.light = 1000;
  plan_ = refine_plan(frame_, plan_, needs);
  PeakCells narrow = empty_cells(), wide = empty_cells();
  narrow.octave = 0;
  for (PeakCells* cells : {&narrow, &wide})
    at(cells->peaks, 16, 16) = 1e7f;
  const auto peaks_of = [&](const std::vector<PeakCells>& cells) {
    return certify({cells, 1, {}}, dark_picture(), frame_, plan_).worst.peaks;
  };
  EXPECT_GT(peaks_of({narrow}), 0);
  EXPECT_GT(peaks_of({wide}), peaks_of({narrow}));
  const double together = peaks_of({narrow, wide});
  at(wide.peaks, 16, 16) = 2e7f;
  EXPECT_NEAR(together, peaks_of({wide}), 1e-9 * together) << "as if all were of the wide ones";
}

}  // namespace
}  // namespace splotchcl::test
