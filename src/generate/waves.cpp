#include "generate/waves.h"

#include <cmath>

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

}  // namespace splotchcl
