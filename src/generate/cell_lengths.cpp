#include "generate/cell_lengths.h"

#include <algorithm>
#include <cmath>

#include "smoothing/smoothing_lengths.h"

namespace splotchcl {
namespace {

constexpr std::size_t most = particles_in_sphere;

// The radius of a sphere as large as a cube of side 1.
constexpr double radius_of_cube = 0.62035049089940009;

// A cell of the level holds more than `most`, its part around a particle at most so many: between
// them lies the cube that would hold just as many.
double length_between(int level, std::uint64_t count, std::uint64_t of_part) {
  const double wanted = static_cast<double>(most);
  const double part = std::log(static_cast<double>(count) / wanted) /
                      std::log(static_cast<double>(count) / static_cast<double>(of_part));
  return radius_of_cube * std::exp2(-(level + part));
}

}  // namespace

class CellLengths::Finder {
 public:
  Finder(const CellLengths& cells, const std::vector<KeyedParticle>& particles)
      : cells_(cells), particles_(particles), lengths_(particles.size()) {}

  std::vector<float> find() {
    for (std::size_t begin = 0; begin < particles_.size();) {
      const std::size_t cell = cell_at(particles_[begin].key, cells_.level_);
      const std::size_t end = end_of(begin, particles_.size(), cells_.level_);
      if (end - begin > most) {
        descend(begin, end, cells_.level_);
      } else {
        fill(begin, end, above(cell, end - begin));
      }
      begin = end;
    }
    return std::move(lengths_);
  }

 private:
  // Of the particles in the same cell of a level as the first one.
  std::size_t end_of(std::size_t begin, std::size_t end, int level) const {
    const std::size_t cell = cell_at(particles_[begin].key, level);
    const auto first = particles_.begin();
    const auto after = std::partition_point(
        first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
        [&](const KeyedParticle& p) { return cell_at(p.key, level) == cell; });
    return static_cast<std::size_t>(after - first);
  }

  // Of particles that fill a cell with more than `most`.
  void descend(std::size_t begin, std::size_t end, int level) {
    if (level == key_levels) return fill(begin, end, radius_of_cube * std::exp2(-level));
    const std::uint64_t count = end - begin;
    while (begin < end) {
      const std::size_t next = end_of(begin, end, level + 1);
      if (next - begin > most) {
        descend(begin, next, level + 1);
      } else {
        fill(begin, next, length_between(level, count, next - begin));
      }
      begin = next;
    }
  }

  // Of a cell of the counts' level that holds few.
  double above(std::size_t cell, std::uint64_t inside) const {
    for (int level = cells_.level_ - 1; level >= 0; --level) {
      cell /= octants;
      const std::uint64_t count = cells_.counts_[static_cast<std::size_t>(level)][cell];
      if (count > most) return length_between(level, count, inside);
      inside = count;
    }
    return radius_of_cube * std::cbrt(static_cast<double>(most) / static_cast<double>(inside));
  }

  void fill(std::size_t begin, std::size_t end, double length) {
    std::fill(lengths_.begin() + static_cast<std::ptrdiff_t>(begin),
              lengths_.begin() + static_cast<std::ptrdiff_t>(end), static_cast<float>(length));
  }

  const CellLengths& cells_;
  const std::vector<KeyedParticle>& particles_;
  std::vector<float> lengths_;
};

CellLengths::CellLengths(const std::vector<std::uint64_t>& counts, int level)
    : level_(level), counts_(static_cast<std::size_t>(level) + 1) {
  counts_.back() = counts;
  for (std::size_t l = counts_.size() - 1; l > 0; --l) {
    counts_[l - 1].assign(counts_[l].size() / octants, 0);
    for (std::size_t cell = 0; cell < counts_[l].size(); ++cell)
      counts_[l - 1][cell / octants] += counts_[l][cell];
  }
}

std::vector<float> CellLengths::find(const std::vector<KeyedParticle>& particles) const {
  return Finder(*this, particles).find();
}

}  // namespace splotchcl
