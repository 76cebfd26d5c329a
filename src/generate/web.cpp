#include "generate/web.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "generate/halo_profile.h"
#include "parallel/for_blocks.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

using Complex = std::complex<double>;

// exp(2 pi i n x / side) for n = -longest..longest and x = 0..side-1, x fastest.
std::vector<Complex> make_phases(int longest, int side) {
  std::vector<Complex> phases;
  for (int n = -longest; n <= longest; ++n) {
    for (int x = 0; x < side; ++x) {
      phases.push_back(std::polar(1.0, 2 * pi * n * x / side));
    }
  }
  return phases;
}

// Sums over the first index of in[n][rest], n = -longest..longest:
// out[rest][x] = sum_n in[n][rest] exp(2 pi i n x / side).
std::vector<Complex> sum_first_index(const std::vector<Complex>& in,
                                     const std::vector<Complex>& phases, std::size_t side) {
  const std::size_t waves = phases.size() / side;
  const std::size_t rest = in.size() / waves;
  std::vector<Complex> out(rest * side);
  const auto sum_row = [&](std::size_t r) {
    Complex* row = &out[r * side];
    for (std::size_t n = 0; n < waves; ++n) {
      const Complex amplitude = in[n * rest + r];
      if (amplitude == Complex()) continue;
      const Complex* phase = &phases[n * side];
      for (std::size_t x = 0; x < side; ++x) {
        row[x] += Complex(amplitude.real() * phase[x].real() - amplitude.imag() * phase[x].imag(),
                          amplitude.real() * phase[x].imag() + amplitude.imag() * phase[x].real());
      }
    }
  };
  constexpr std::size_t rows_at_once = 64;
  for_blocks(rest, rows_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r)
      sum_row(r);
  });
  return out;
}

}  // namespace

// In a fixed order, which is also the order of amplitudes_: x and y from -longest, z
// from 0 (of z = 0, only the half that is not the mirror of the other).
template <typename Visit>
void RandomWaves::for_each_wave(Visit&& visit) const {
  for (int x = -longest_; x <= longest_; ++x) {
    for (int y = -longest_; y <= longest_; ++y) {
      for (int z = 0; z <= longest_; ++z) {
        const WaveNumber wave = {x, y, z};
        const bool mirrored = z == 0 && (x < 0 || (x == 0 && y <= 0));
        if (!mirrored && wave.length() <= longest_) visit(wave);
      }
    }
  }
}

RandomWaves::RandomWaves(int longest, const std::function<double(double)>& power, Random& random)
    : longest_(longest) {
  for_each_wave([&](WaveNumber wave) {
    const double sigma = std::sqrt(power(wave.length()) / 2);
    const double real = sigma * random.normal();
    amplitudes_.emplace_back(real, sigma * random.normal());
  });
}

PeriodicGrid RandomWaves::evaluate(
    int side, const std::function<std::complex<double>(WaveNumber)>& filter) const {
  const auto across = static_cast<std::size_t>(2 * longest_ + 1);
  std::vector<Complex> waves(across * across * across);
  std::size_t next = 0;
  for_each_wave([&](WaveNumber wave) {
    const auto place = [&](int n) { return static_cast<std::size_t>(n + longest_); };
    const auto index = (place(wave.x) * across + place(wave.y)) * across + place(wave.z);
    waves[index] = amplitudes_[next++] * filter(wave);
  });
  // The cube [n_x][n_y][n_z] becomes [n_y][n_z][x], [n_z][x][y], [x][y][z].
  const std::vector<Complex> phases = make_phases(longest_, side);
  for (int axis = 0; axis < 3; ++axis) {
    waves = sum_first_index(waves, phases, static_cast<std::size_t>(side));
  }
  // A wave and its mirror add up to twice the real part.
  std::vector<float> values(waves.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<float>(2 * waves[i].real());
  }
  return {side, std::move(values)};
}

double RandomWaves::variance(const std::function<double(double)>& filter) const {
  double sum = 0;
  std::size_t next = 0;
  for_each_wave(
      [&](WaveNumber wave) { sum += 2 * std::norm(amplitudes_[next++] * filter(wave.length())); });
  return sum;
}

namespace {

// Contrast, in linear theory, of a ball that has collapsed.
constexpr double collapse_contrast = 1.686;
constexpr double ratio_of_radii = 1.2;

bool is_peak(const PeriodicGrid& grid, int x, int y, int z) {
  const float value = grid.at(x, y, z);
  for (int i = 0; i < 27; ++i) {
    const int dx = i % 3 - 1;
    const int dy = i / 3 % 3 - 1;
    const int dz = i / 9 - 1;
    if (i != 13 && grid.at(x + dx, y + dy, z + dz) >= value) return false;
  }
  return true;
}

struct Peak {
  float contrast;
  Vec3 place;
};

std::vector<Peak> find_peaks(const PeriodicGrid& grid) {
  std::vector<Peak> peaks;
  const int side = grid.side();
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        if (grid.at(x, y, z) < collapse_contrast || !is_peak(grid, x, y, z)) continue;
        const double cell = 1.0 / side;
        peaks.push_back({grid.at(x, y, z), {{x * cell, y * cell, z * cell}}});
      }
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.contrast > b.contrast; });
  return peaks;
}

bool lies_in_one_of(const std::vector<Halo>& haloes, const Vec3& place) {
  return std::any_of(haloes.begin(), haloes.end(), [&](const Halo& halo) {
    return boost::qvm::mag(periodic_difference(place, halo.birthplace)) < halo.birth_radius;
  });
}

}  // namespace

Vec3 periodic_difference(const Vec3& a, const Vec3& b) {
  Vec3 difference;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b.a[axis] - a.a[axis];
    difference.a[axis] = d - std::round(d);
  }
  return difference;
}

std::vector<Halo> find_haloes(const SmoothedContrast& contrast, double largest_radius,
                              double smallest_radius) {
  std::vector<Halo> haloes;
  for (double radius = largest_radius; radius >= smallest_radius; radius /= ratio_of_radii) {
    for (const Peak& peak : find_peaks(contrast(radius))) {
      if (lies_in_one_of(haloes, peak.place)) continue;
      // A peak that is higher than needed would still do in a larger ball.
      const double excess = static_cast<double>(peak.contrast) / collapse_contrast;
      haloes.push_back({peak.place, radius * std::min(excess, ratio_of_radii), peak.place});
    }
  }
  return haloes;
}

HaloMap::HaloMap(const std::vector<Halo>& haloes, int side)
    : side_(side),
      halo_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) *
                static_cast<std::size_t>(side),
            none) {
  // Backwards, so that larger haloes, which come first, take what they overlap.
  for (std::size_t index = haloes.size(); index-- > 0;) {
    const Halo& halo = haloes[index];
    const int reach = static_cast<int>(std::ceil(halo.birth_radius * side)) + 1;
    int center[3];
    for (int axis = 0; axis < 3; ++axis) {
      center[axis] = static_cast<int>(std::floor(halo.birthplace.a[axis] * side));
    }
    for (int dx = -reach; dx <= reach; ++dx) {
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dz = -reach; dz <= reach; ++dz) {
          const Vec3 cell = {{(center[0] + dx + 0.5) / side, (center[1] + dy + 0.5) / side,
                              (center[2] + dz + 0.5) / side}};
          const Vec3 offset = periodic_difference(halo.birthplace, cell);
          if (boost::qvm::mag(offset) >= halo.birth_radius) continue;
          halo_[cell_of(cell)] = static_cast<int>(index);
        }
      }
    }
  }
}

int HaloMap::at(const Vec3& birthplace) const {
  return halo_[cell_of(birthplace)];
}

std::size_t HaloMap::cell_of(const Vec3& place) const {
  std::size_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int cell = static_cast<int>(std::floor(place.a[axis] * side_));
    index = index * static_cast<std::size_t>(side_) +
            static_cast<std::size_t>((cell % side_ + side_) % side_);
  }
  return index;
}

namespace {

// Along each axis in turn: a quarter, a half, a quarter. Adds 1/2 to the variance. Neighbors along
// an axis are `stride` apart; whole rows of them are blurred together, in the order of memory.
void blur_once(std::vector<float>& values, std::size_t side) {
  for (std::size_t stride = 1; stride < values.size(); stride *= side) {
    const std::vector<float> old = values;
    for (std::size_t first = 0; first < values.size(); first += stride * side) {
      for (std::size_t i = 0; i < side; ++i) {
        const float* const here = &old[first + i * stride];
        const float* const before = &old[first + (i + side - 1) % side * stride];
        const float* const after = &old[first + (i + 1) % side * stride];
        float* const blurred = &values[first + i * stride];
        for (std::size_t j = 0; j < stride; ++j)
          blurred[j] = 0.5F * here[j] + 0.25F * (before[j] + after[j]);
      }
    }
  }
}

// How many of `places` (in the periodic unit cube) lie near each point of a grid, evenly
// shared between the eight nearest, then averaged over a Gaussian of this width in cells.
PeriodicGrid smoothed_density(const std::vector<Vec3>& places, int side, double width) {
  const auto across = static_cast<std::size_t>(side);
  std::vector<float> values(across * across * across);
  for (const Vec3& place : places) {
    const CellCorners corners(place, side);
    for (int corner = 0; corner < 8; ++corner) {
      values[corners.index(corner)] += static_cast<float>(corners.weight(corner));
    }
  }
  for (int pass = 0; pass < std::lround(2 * width * width); ++pass)
    blur_once(values, across);
  return {side, std::move(values)};
}

// A step from `place` towards denser matter: where a Gaussian of `width` cells around it
// has its centre of mass. Sheets become filaments and filaments sharper.
Vec3 step_uphill(const PeriodicGrid& density, const Vec3& place, double width) {
  const double cell = 1.0 / density.side();
  const double here = density.interpolate(place);
  Vec3 step = {{0, 0, 0}};
  if (!(here > 0)) return step;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 before = place, after = place;
    before.a[axis] -= cell;
    after.a[axis] += cell;
    const double slope = (density.interpolate(after) - density.interpolate(before)) / 2;
    step.a[axis] = std::clamp(width * width * slope / here, -width, width) * cell;
  }
  return step;
}

constexpr int longest_wave = 24;
constexpr int grid_side = 96;
constexpr std::size_t places_at_once = 4096;
constexpr double web_wave = 6.5;    // waves per box; shorter ones do not move the web
constexpr double strand_wave = 13;  // shorter ones do not make strands
constexpr double straying = 0.45;   // part of linear theory's displacement
constexpr double collapsed_radius = 0.025;
constexpr int sharpened_side = 128;
constexpr std::array<double, 3> sharpened_widths = {1.6, 1.3, 1};  // in cells

// Bent where radiation ruled: Bardeen et al. (1986), by waves per box.
double power(double wave, double box_size) {
  constexpr double shape = 0.2;
  const double q = 2 * pi * wave / (box_size / 1000) / shape;
  const double polynomial =
      1 + 3.89 * q + std::pow(16.1 * q, 2) + std::pow(5.46 * q, 3) + std::pow(6.71 * q, 4);
  const double transfer = std::log1p(2.34 * q) / (2.34 * q) / std::pow(polynomial, 0.25);
  return wave * transfer * transfer;
}

// The mean of a wave over a ball.
double ball(double wave, double radius) {
  const double x = 2 * pi * wave * radius;
  return x < 1e-3 ? 1 : 3 * (std::sin(x) - x * std::cos(x)) / (x * x * x);
}

}  // namespace

Web::Web(double box_size, Random& random)
    : waves_(
          longest_wave, [box_size](double wave) { return power(wave, box_size); }, random),
      amplitude_(cosmology::sigma_8 / std::sqrt(waves_.variance([box_size](double wave) {
                   return ball(wave, 8000 / box_size);
                 }))),
      displacement_{displacement(0, 0, web_wave), displacement(1, 0, web_wave),
                    displacement(2, 0, web_wave)},
      straying_{displacement(0, web_wave, strand_wave), displacement(1, web_wave, strand_wave),
                displacement(2, web_wave, strand_wave)},
      collapsed_(contrast(collapsed_radius)) {}

Vec3 Web::displaced(const Vec3& birthplace) const {
  Vec3 place = birthplace;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place.a[axis] += displacement_[axis].interpolate(birthplace);
  }
  return place;
}

Vec3 Web::strayed(const Vec3& birthplace) const {
  Vec3 by;
  for (std::size_t axis = 0; axis < 3; ++axis)
    by.a[axis] = straying * straying_[axis].interpolate(birthplace);
  return by;
}

double Web::sharpness(const Vec3& birthplace) const {
  constexpr double least = 0.3, none = -1, all = 1.5;
  const double collapsed = smoothstep((collapsed_.interpolate(birthplace) - none) / (all - none));
  return least + (1 - least) * collapsed;
}

PeriodicGrid Web::contrast(double radius) const {
  return waves_.evaluate(grid_side, [&](WaveNumber n) {
    return std::complex<double>(amplitude_ * ball(n.length(), radius));
  });
}

// Its divergence is minus the contrast. Short waves, which have collapsed long ago, would
// only blur the web.
PeriodicGrid Web::displacement(int axis, double shortest, double longest) const {
  const auto low_pass = [](double length, double limit) {
    return limit > 0 ? std::exp(-0.5 * std::pow(length / limit, 2)) : 0;
  };
  return waves_.evaluate(grid_side, [&](WaveNumber n) {
    const int component[3] = {n.x, n.y, n.z};
    const double length = n.length();
    const double kept = low_pass(length, longest) - low_pass(length, shortest);
    return std::complex<double>(0,
                                amplitude_ * kept * component[axis] / (2 * pi * length * length));
  });
}

SharpenedWeb::SharpenedWeb(std::vector<Vec3> places, const std::vector<double>& parts) {
  for (const double width : sharpened_widths) {
    densities_.push_back(smoothed_density(places, sharpened_side, width));
    if (densities_.size() == sharpened_widths.size()) break;  // nobody asks for where they end
    for_blocks(places.size(), places_at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        places[i] += step_uphill(densities_.back(), places[i], width) * parts[i];
    });
  }
}

Vec3 SharpenedWeb::moved(Vec3 place, double part) const {
  for (std::size_t step = 0; step < densities_.size(); ++step)
    place += step_uphill(densities_[step], place, sharpened_widths[step]) * part;
  return place;
}

}  // namespace splotchcl
