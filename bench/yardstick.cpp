#include "yardstick.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

#include "measure.h"

namespace splotchcl::bench {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Integers = std::int32_t __attribute__((vector_size(32)));
constexpr int lanes = 8;

constexpr Floats ramp = {0, 1, 2, 3, 4, 5, 6, 7};

// exp(x) for -80 < x <= 0: 2^n by the exponent's bits, 2^f on [-1/2, 1/2] by its series.
Floats exp_negative(Floats x) {
  const Floats t = x * 1.44269504f;
  constexpr float to_integer = 12582912.0f;  // 1.5 * 2^23
  const Floats shifted = t + to_integer;
  const Floats f = t - (shifted - to_integer);
  Floats p = f * 1.3333558e-3f + 9.6181291e-3f;
  p = p * f + 5.5504109e-2f;
  p = p * f + 2.4022651e-1f;
  p = p * f + 6.9314718e-1f;
  p = p * f + 1.0f;
  Integers bits, exponent;
  std::memcpy(&bits, &p, sizeof(bits));
  std::memcpy(&exponent, &shifted, sizeof(exponent));
  bits += exponent << 23;
  std::memcpy(&p, &bits, sizeof(p));
  return p;
}

struct Disc {
  float x, y, radius, inverse_sigma2;
  float absorption[3], emission[3];
  float source;
};

constexpr int tile_width = 32, tile_height = 16;
constexpr int image_width = 1408, image_height = 1056;
constexpr int tiles_x = image_width / tile_width, tiles_y = image_height / tile_height;
constexpr int tile_count = tiles_x * tiles_y;
constexpr int blocks = tile_width / lanes;  // of eight pixels, per row

struct Range {
  int first, last;
};

// Pixels (centre at i + 1/2) within `radius` of `centre`.
Range pixels_within(float center, float radius, int size) {
  return {std::max(0, static_cast<int>(std::ceil(center - radius - 0.5f))),
          std::min(size - 1, static_cast<int>(std::floor(center + radius - 0.5f)))};
}

template <class Visit>
void for_each_tile(const Disc& disc, Visit visit) {
  const Range columns = pixels_within(disc.x, disc.radius, image_width);
  const Range rows = pixels_within(disc.y, disc.radius, image_height);
  if (columns.first > columns.last || rows.first > rows.last) return;
  for (int y = rows.first / tile_height; y <= rows.last / tile_height; ++y) {
    for (int x = columns.first / tile_width; x <= columns.last / tile_width; ++x) {
      visit(static_cast<std::size_t>(y * tiles_x + x));
    }
  }
}

std::vector<Disc> random_discs(float mean_radius, int count) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<Disc> discs(static_cast<std::size_t>(count));
  for (Disc& disc : discs) {
    disc.radius = mean_radius * (0.5f + uniform(engine));
    const float sigma = disc.radius / 1.8f;
    disc.inverse_sigma2 = 1 / (sigma * sigma);
    disc.x = uniform(engine) * image_width;
    disc.y = uniform(engine) * image_height;
    disc.source = 1;
    for (int c = 0; c < 3; ++c) {
      disc.absorption[c] = 0.05f * uniform(engine);
      disc.emission[c] = disc.source * disc.absorption[c];
    }
  }
  return discs;
}

double updates_of(const std::vector<Disc>& discs) {
  double updates = 0;
  for (const Disc& disc : discs) {
    const auto radius = static_cast<double>(disc.radius);
    updates += 3.14159265358979323846 * radius * radius;
  }
  return updates;
}

constexpr std::size_t planes_of(YardstickPlan plan) {
  return plan == YardstickPlan::layers ? 6 : 3;
}

// The planes of eight pixels side by side.
template <YardstickPlan plan>
using Tile = std::array<Floats, tile_height * blocks * planes_of(plan)>;

// Over the depth: (1 - exp(-depth)) / depth.
Floats phi(Floats depth) {
  return 1.0f - depth * (0.5f - depth * (0.16666667f - depth * 0.041666667f));
}

// Channel c of eight pixels.
template <YardstickPlan plan>
void add_channel(Floats* pixels, int c, Floats shape, const Disc& disc) {
  if constexpr (plan == YardstickPlan::sums) {
    pixels[c] += shape * disc.absorption[c];
  } else if constexpr (plan == YardstickPlan::ordered) {
    const Floats depth = shape * disc.absorption[c];
    pixels[c] += depth * phi(depth) * (disc.source - pixels[c]);
  } else {
    Floats& opacity = pixels[c + 3];
    const Floats covered = (1.0f - opacity) * shape * phi(shape * disc.absorption[c]);
    pixels[c] += covered * disc.emission[c];
    opacity += covered * disc.absorption[c];
  }
}

struct Corner {
  float x, y;
};

Corner corner_of(std::size_t tile) {
  return {static_cast<float>(static_cast<int>(tile) % tiles_x * tile_width),
          static_cast<float>(static_cast<int>(tile) / tiles_x * tile_height)};
}

template <YardstickPlan plan>
void add_disc(Tile<plan>& tile, const Disc& disc, Corner corner) {
  const float x = disc.x - corner.x, y = disc.y - corner.y;
  const Range columns = pixels_within(x, disc.radius, tile_width);
  const Range rows = pixels_within(y, disc.radius, tile_height);
  const float scale = -disc.inverse_sigma2;
  alignas(32) float along_y[tile_height + lanes];
  for (int row = rows.first; row <= rows.last; row += lanes) {
    const Floats dy = ramp + (static_cast<float>(row) + 0.5f - y);
    const Floats profile = exp_negative(dy * dy * scale);
    std::memcpy(along_y + (row - rows.first), &profile, sizeof(profile));
  }
  for (int block = columns.first / lanes; block <= columns.last / lanes; ++block) {
    const Floats dx = ramp + (static_cast<float>(block * lanes) + 0.5f - x);
    const Floats along_x = exp_negative(dx * dx * scale);
    for (int row = rows.first; row <= rows.last; ++row) {
      Floats* pixels =
          tile.data() + static_cast<std::size_t>(row * blocks + block) * planes_of(plan);
      const Floats shape = along_x * along_y[row - rows.first];
      for (int c = 0; c < 3; ++c)
        add_channel<plan>(pixels, c, shape, disc);
    }
  }
}

}  // namespace

struct YardstickScene::Lists {
  std::vector<std::uint32_t> starts;  // tile_count + 1
  std::vector<Disc> discs;            // tile by tile
  std::vector<float> image;
  double updates = 0;

  explicit Lists(const std::vector<Disc>& all_discs);

  template <YardstickPlan plan>
  void draw_tile(std::size_t index) {
    Tile<plan> tile;
    tile.fill(Floats{});
    const Corner corner = corner_of(index);
    for (std::uint32_t i = starts[index]; i < starts[index + 1]; ++i)
      add_disc<plan>(tile, discs[i], corner);
    std::memcpy(image.data() + index * tile.size() * lanes, tile.data(), sizeof(tile));
  }

  // Threads take the next four tiles until none is left.
  template <YardstickPlan plan>
  void draw(int thread_count) {
    constexpr std::size_t at_once = 4;
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t first; (first = next.fetch_add(at_once)) < tile_count;) {
        const std::size_t end = std::min<std::size_t>(first + at_once, tile_count);
        for (std::size_t tile = first; tile < end; ++tile)
          draw_tile<plan>(tile);
      }
    };
    std::vector<std::thread> others;
    for (int t = 1; t < thread_count; ++t)
      others.emplace_back(work);
    work();
    for (std::thread& other : others)
      other.join();
  }
};

YardstickScene::Lists::Lists(const std::vector<Disc>& all_discs)
    : starts(tile_count + 1, 0),
      image(planes_of(YardstickPlan::layers) * image_width * image_height) {
  for (const Disc& disc : all_discs)
    for_each_tile(disc, [&](std::size_t tile) { ++starts[tile + 1]; });
  for (std::size_t t = 0; t < tile_count; ++t)
    starts[t + 1] += starts[t];
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  discs.resize(starts.back());
  for (const Disc& disc : all_discs)
    for_each_tile(disc, [&](std::size_t tile) { discs[next[tile]++] = disc; });
  updates = updates_of(all_discs);
}

YardstickScene::YardstickScene(float mean_radius_pixels, int splat_count)
    : lists_(std::make_unique<Lists>(random_discs(mean_radius_pixels, splat_count))) {}
YardstickScene::~YardstickScene() = default;
YardstickScene::YardstickScene(YardstickScene&&) noexcept = default;

double YardstickScene::updates() const {
  return lists_->updates;
}

void YardstickScene::draw(YardstickPlan plan, int threads) {
  switch (plan) {
    case YardstickPlan::sums:
      return lists_->draw<YardstickPlan::sums>(threads);
    case YardstickPlan::ordered:
      return lists_->draw<YardstickPlan::ordered>(threads);
    case YardstickPlan::layers:
      return lists_->draw<YardstickPlan::layers>(threads);
  }
}

namespace {

double best_seconds(YardstickScene& scene, YardstickPlan plan, int threads) {
  constexpr int runs = 5;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < runs; ++i) {
    const Stopwatch stopwatch;
    scene.draw(plan, threads);
    best = std::min(best, stopwatch.elapsed().wall_seconds);
  }
  return best;
}

YardstickCost measure_size(float radius_pixels, int splat_count, int threads) {
  YardstickScene scene(radius_pixels, splat_count);
  const auto cost = [&](YardstickPlan plan) {
    return 1e9 * best_seconds(scene, plan, threads) / scene.updates();
  };
  return {cost(YardstickPlan::sums), cost(YardstickPlan::ordered), cost(YardstickPlan::layers)};
}

}  // namespace

double Yardstick::additive_ns() const {
  return std::sqrt(small.additive_ns * large.additive_ns);
}

double Yardstick::ordered_ns() const {
  return std::sqrt(small.ordered_ns * large.ordered_ns);
}

Yardstick measure_yardstick(int threads) {
  return {measure_size(5, 1000000, threads), measure_size(20, 200000, threads), threads};
}

Yardstick mean_of(const Yardstick& first, const Yardstick& second) {
  const auto mean = [](const YardstickCost& a, const YardstickCost& b) -> YardstickCost {
    return {0.5 * (a.additive_ns + b.additive_ns), 0.5 * (a.ordered_ns + b.ordered_ns),
            0.5 * (a.layers_ns + b.layers_ns)};
  };
  return {mean(first.small, second.small), mean(first.large, second.large), first.threads};
}

std::string describe(const Yardstick& yardstick) {
  char text[200];
  std::snprintf(text, sizeof(text),
                "yardstick, ns per pixel update, %d threads: additive %.3f (5 px) %.3f (20 px), "
                "ordered %.3f (5 px) %.3f (20 px), in six planes %.3f (5 px) %.3f (20 px)",
                yardstick.threads, yardstick.small.additive_ns, yardstick.large.additive_ns,
                yardstick.small.ordered_ns, yardstick.large.ordered_ns, yardstick.small.layers_ns,
                yardstick.large.layers_ns);
  return text;
}

}  // namespace splotchcl::bench
