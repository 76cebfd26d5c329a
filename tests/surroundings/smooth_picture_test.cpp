#include "surroundings/smooth_picture.h"

#include <atomic>
#include <boost/qvm/vec_operations.hpp>

#include "frames/random_frames.h"
#include "scene/projection.h"
#include "surroundings/cloud_around.h"
#include "surroundings/columns_around.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Pictures that are worked out at a few pixels and interpolated between them.

SmoothPictureSettings settings_of(int width, int height, double allowed) {
  SmoothPictureSettings settings;
  settings.width = width;
  settings.height = height;
  settings.crop = {0, 0, width, height};
  settings.channels = 1;
  settings.allowed = allowed;
  settings.error_of = [](const double* exact, const double* foretold) {
    return std::abs(*exact - *foretold);
  };
  return settings;
}

// The second is far from all nodes that are 8 pixels apart, or 16.
struct Place {
  double x, y;
};
constexpr Place on_a_node = {80, 31.5}, between_nodes = {84.5, 36.5};

double gaussian(int x, int y, double sigma, Place place = on_a_node) {
  const double dx = (x - place.x) / sigma, dy = (y - place.y) / sigma;
  return std::exp(-dx * dx - dy * dy);
}

using PixelFunction = std::function<void(int x, int y, int spacing, double* value)>;

PixelsFunction one_by_one(const PixelFunction& pixel) {
  return [pixel](const std::vector<int>& x, int y, int spacing, double* values) {
    for (std::size_t k = 0; k < x.size(); ++k)
      pixel(x[k], y, spacing, values + k);
  };
}

// Row by row.
std::vector<double> pixels_of(const SmoothPictureSettings& settings, const PixelFunction& pixel) {
  const SmoothPicture picture(settings, one_by_one(pixel));
  std::vector<double> pixels, row;
  for (int y = 0; y < settings.crop.height; ++y) {
    picture.row(y, row);
    pixels.insert(pixels.end(), row.begin(), row.end());
  }
  return pixels;
}

double largest_error(SmoothPictureSettings settings, double sigma, Place place) {
  settings.narrowest = sigma;
  const std::vector<double> pixels = pixels_of(
      settings,
      [sigma, place](int x, int y, int, double* value) { *value = gaussian(x, y, sigma, place); });
  double largest = 0;
  std::size_t i = 0;
  for (int y = settings.crop.y; y < settings.crop.y + settings.crop.height; ++y) {
    for (int x = settings.crop.x; x < settings.crop.x + settings.crop.width; ++x)
      largest = std::max(largest, std::abs(pixels[i++] - gaussian(x, y, sigma, place)));
  }
  return largest;
}

TEST(SmoothPicture, ErrsByNoMoreThanIsAllowed) {
  for (const double sigma : {1.0, 3.0, 10.0, 40.0, 300.0}) {
    for (const double allowed : {1e-3, 1e-6, 1e-9}) {
      for (const Place place : {on_a_node, between_nodes})
        EXPECT_LE(largest_error(settings_of(200, 120, allowed), sigma, place), allowed) << sigma;
    }
  }
}

TEST(SmoothPicture, WorksOutFewPixelsOfWhatIsSmooth) {
  std::atomic<int> count = 0;
  SmoothPictureSettings settings = settings_of(512, 512, 1e-5);
  settings.narrowest = 200;
  pixels_of(settings, [&count](int x, int y, int, double* value) {
    ++count;
    *value = gaussian(x, y, 200);
  });
  EXPECT_LT(count, 512 * 512 / 20);
}

TEST(SmoothPicture, OfACropHasTheBitsOfTheWholeOne) {
  SmoothPictureSettings settings = settings_of(200, 120, 1e-6);
  settings.narrowest = 30;
  const PixelFunction pixel = [](int x, int y, int, double* value) { *value = gaussian(x, y, 30); };
  const std::vector<double> whole = pixels_of(settings, pixel);
  settings.crop = {37, 11, 90, 70};
  const std::vector<double> crop = pixels_of(settings, pixel);
  for (std::size_t y = 0; y < 70; ++y) {
    for (std::size_t x = 0; x < 90; ++x)
      ASSERT_EQ(crop[y * 90 + x], whole[(y + 11) * 200 + x + 37]);
  }
}

// Clouds around the camera, found where they show.

std::vector<CloudAround> clouds_of(const Frame& frame, double farthest2) {
  std::vector<CloudAround> clouds;
  for (const DrawnComponent& component : frame.components) {
    for (std::size_t i = 0; i < component.particles.count; ++i) {
      clouds.push_back(cloud_around(component, frame, i));
      clouds.back().farthest2 = farthest2;
    }
  }
  return clouds;
}

TEST(CloudsInBlocks, AreAllThatShowInAPixel) {
  constexpr double wide_sigma = 16;
  std::size_t listed = 0, all = 0;
  for (const std::uint64_t seed : seeds(1, 60)) {
    const Frame frame = AroundSceneMaker(seed, 200).make();
    constexpr double farthest2 = 20;
    const std::vector<CloudAround> clouds = clouds_of(frame, farthest2);
    const CloudsInBlocks in_blocks(clouds, 0, clouds.size(), frame);
    for (int y = -70; y < frame.height + 70; y += 7) {
      for (int x = -70; x < frame.width + 70; x += 7) {
        const PixelsOfRow pixel(&x, 1, y, frame);
        const auto column = [&](std::size_t k) {
          PixelsOfRow::OfPixels<double> columns;
          columns_around(clouds[k], pixel, frame.kernel, wide_sigma, columns);
          return columns[0];
        };
        double of_all = 0, of_listed = 0;
        for (std::size_t k = 0; k < clouds.size(); ++k)
          of_all += column(k);
        for (const std::uint32_t k : in_blocks.at(x, y, 1))
          of_listed += column(k);
        ASSERT_NEAR(of_listed, of_all, static_cast<double>(clouds.size()) * std::exp(-farthest2))
            << "seed " << seed << ", pixel " << x << ", " << y;
        listed += in_blocks.at(x, y, 1).size();
        all += clouds.size();
      }
    }
  }
  EXPECT_LT(3 * listed, 2 * all) << "most clouds should be in some blocks only";
}

// The formulas of docs/projections.md, written out.
double column_by_formulas(const CloudAround& cloud, int x, int y, const Frame& frame) {
  using namespace boost::qvm;
  const Vec3 ray = direction_at(x + 0.5, y + 0.5, frame.camera, frame.projection);
  const double beside2 = mag_sqr(cross(cloud.center, ray)), before = dot(cloud.center, ray);
  double column =
      beside2 <= cloud.farthest2 ? 0.5 * cloud.ray * std::exp(-beside2) * std::erfc(-before) : 0;
  for (const SplatAround& splat : cloud.splats) {
    const double dx = (x + 0.5 - splat.x) / splat.sigma_x, dy = (y + 0.5 - splat.y) / splat.sigma_y;
    const double square = dx * dx + dy * dy;
    if (square <= cloud.farthest2) column += cloud.splat * std::exp(-square);
  }
  return column;
}

TEST(ColumnsAround, AreThoseOfTheFormulasWhateverOtherPixelsAreAskedFor) {
  double largest = 0;
  for (const std::uint64_t seed : seeds(1, 60)) {
    Frame frame = AroundSceneMaker(seed, 50).make();
    frame.kernel.sampling = Sampling::center;
    frame.kernel.cut = std::nullopt;
    std::vector<int> columns;
    for (int x = 0; x < frame.width && x < 11; ++x)
      columns.push_back(3 * x);
    const int row = frame.height / 2;
    const PixelsOfRow pixels(columns.data(), columns.size(), row, frame);
    for (const CloudAround& cloud : clouds_of(frame, 20)) {
      PixelsOfRow::OfPixels<double> found;
      columns_around(cloud, pixels, frame.kernel, 16, found);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const double exact = column_by_formulas(cloud, columns[k], row, frame);
        ASSERT_NEAR(found[k], exact, 1e-12 * exact) << "seed " << seed << ", pixel " << columns[k];
        largest = std::max(largest, exact);
        PixelsOfRow::OfPixels<double> alone;
        columns_around(cloud, PixelsOfRow(&columns[k], 1, row, frame), frame.kernel, 16, alone);
        ASSERT_EQ(found[k], alone[0]);
      }
    }
  }
  EXPECT_GT(largest, 0.1);
}

TEST(CloudsInBlocks, AreAllOfThemWherePixelsLieFarApart) {
  const Frame frame = AroundSceneMaker(7, 200).make();
  const std::vector<CloudAround> clouds = clouds_of(frame, 20);
  const CloudsInBlocks in_blocks(clouds, 3, clouds.size(), frame);
  EXPECT_EQ(in_blocks.at(0, 0, 64).size(), clouds.size() - 3);
  EXPECT_EQ(in_blocks.at(0, 0, 64).front(), 3u);
}

// '-' a cloud that is smooth all over the picture, 'E' one whose kernel ends in it.
std::vector<std::size_t> ends_of(const std::string& kinds, std::size_t first = 0) {
  Frame frame;
  frame.width = frame.height = 100;
  frame.kernel.cut = 1.8;
  std::vector<CloudAround> clouds(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i)
    clouds[i].splats = {{kinds[i] == 'E' ? 50.0 : 50000.0, 50, 200, 200}};
  return ends_of_stretches(clouds, first, clouds.size(), frame);
}

TEST(StretchesOfClouds, AreOneWhereNoKernelEndsInThePicture) {
  EXPECT_THAT(ends_of("--------"), testing::ElementsAre(8));
}

TEST(StretchesOfClouds, PartManySmoothOnesFromThoseWhoseKernelEndsInThePicture) {
  EXPECT_THAT(ends_of("------E-----"), testing::ElementsAre(6, 7, 12));
  EXPECT_THAT(ends_of("EE-----E"), testing::ElementsAre(2, 7, 8));
  EXPECT_THAT(ends_of("------E"), testing::ElementsAre(6, 7));
}

TEST(StretchesOfClouds, TakeFewSmoothOnesTogetherWithTheirNeighbors) {
  EXPECT_THAT(ends_of("-E--E---E-"), testing::ElementsAre(10));
  EXPECT_THAT(ends_of("-----E--E-----"), testing::ElementsAre(5, 9, 14));
}

TEST(StretchesOfClouds, BeginWhereTheLayerDoes) {
  EXPECT_THAT(ends_of("------E-----", 4), testing::ElementsAre(7, 12));
  EXPECT_THAT(ends_of("------E-----", 7), testing::ElementsAre(12));
}

}  // namespace
}  // namespace splotchcl::test
