#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace splotchcl::test {

// A square tile of ranks, each once, that repeats without a seam: thresholds of blue noise by the
// void-and-cluster method (R. Ulichney, 1993, Proc. SPIE 1913, 332). Whole numbers throughout, so
// that every machine finds the same tile.
class VoidAndCluster {
 public:
  explicit VoidAndCluster(int side)
      : side_(side),
        count_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)),
        near_(count_),
        energy_(count_),
        is_set_(count_) {
    for (std::size_t i = 0; i < count_; ++i)
      near_[i] = closeness(i);
  }

  std::vector<std::uint16_t> ranks() {
    spread_first_points();
    std::vector<std::uint16_t> ranks(count_);
    const std::vector<bool> first = is_set_;
    const std::vector<std::int64_t> first_energy = energy_;
    std::size_t rank = static_cast<std::size_t>(std::count(first.begin(), first.end(), true));
    const std::size_t first_rank = rank;
    while (rank > 0) {
      const std::size_t place = tightest_cluster();
      set(place, false);
      ranks[place] = static_cast<std::uint16_t>(--rank);
    }
    is_set_ = first;
    energy_ = first_energy;
    for (rank = first_rank; rank < count_; ++rank) {
      const std::size_t place = largest_void();
      set(place, true);
      ranks[place] = static_cast<std::uint16_t>(rank);
    }
    return ranks;
  }

 private:
  // A Gaussian of 1.5 pixels around the tile's first place, across its edges.
  std::int64_t closeness(std::size_t place) const {
    const auto around = [this](std::size_t i) {
      const int along = static_cast<int>(i);
      return std::min(along, side_ - along);
    };
    const auto side = static_cast<std::size_t>(side_);
    const int x = around(place % side), y = around(place / side);
    return std::llround(std::ldexp(std::exp(-(x * x + y * y) / (2 * 1.5 * 1.5)), 20));
  }

  void set(std::size_t place, bool on) {
    is_set_[place] = on;
    const auto side = static_cast<std::size_t>(side_);
    const std::size_t x = place % side, y = place / side;
    for (std::size_t row = 0; row < side; ++row) {
      const std::size_t from_row = (row + side - y) % side;
      for (std::size_t column = 0; column < side; ++column) {
        const std::int64_t near = near_[from_row * side + (column + side - x) % side];
        energy_[row * side + column] += on ? near : -near;
      }
    }
  }

  std::size_t tightest_cluster() const {
    std::size_t best = count_;
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_set_[i] && (best == count_ || energy_[i] > energy_[best])) best = i;
    }
    return best;
  }

  std::size_t largest_void() const {
    std::size_t best = count_;
    for (std::size_t i = 0; i < count_; ++i) {
      if (!is_set_[i] && (best == count_ || energy_[i] < energy_[best])) best = i;
    }
    return best;
  }

  // A tenth of all places, at random and then moved from clusters to voids.
  void spread_first_points() {
    std::uint32_t random = 1;
    for (std::size_t set_places = 0; set_places < count_ / 10;) {
      random = random * 1664525U + 1013904223U;
      const std::size_t place = (random >> 8) % count_;
      if (is_set_[place]) continue;
      set(place, true);
      ++set_places;
    }
    for (;;) {
      const std::size_t cluster = tightest_cluster();
      set(cluster, false);
      const std::size_t hole = largest_void();
      set(hole, true);
      if (hole == cluster) return;
    }
  }

  int side_;
  std::size_t count_;
  std::vector<std::int64_t> near_, energy_;
  std::vector<bool> is_set_;
};

}  // namespace splotchcl::test
