#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "ranks/thread_ranks.h"
#include "splotchcl/array_snapshot.h"
#include "splotchcl/communicator.h"
#include "splotchcl/spread_snapshot.h"

namespace splotchcl::test {

constexpr int gas = 0, stars = 4;

// What scenes of a simulation begin with.
inline const std::string scene_head = "snapshot = \"memory\"\n[image]\nsize = [96, 64]\n";

// The arrays of one type.
struct TypeArrays {
  std::size_t count = 0;
  std::map<std::string, std::vector<float>> scalars, vectors;

  // Those of particles [begin, end).
  TypeArrays part(std::size_t begin, std::size_t end) const {
    TypeArrays some;
    some.count = end - begin;
    const auto cut = [&](const std::vector<float>& all, std::size_t width) {
      return std::vector<float>(all.begin() + static_cast<std::ptrdiff_t>(begin * width),
                                all.begin() + static_cast<std::ptrdiff_t>(end * width));
    };
    for (const auto& [name, values] : scalars)
      some.scalars[name] = cut(values, 1);
    for (const auto& [name, values] : vectors)
      some.vectors[name] = cut(values, 3);
    return some;
  }
};

using Arrays = std::map<int, TypeArrays>;

// A blob of gas and a smaller one of stars in it.
inline Arrays gas_and_stars(std::size_t gas_count, std::size_t star_count) {
  std::mt19937 engine(7);
  const auto uniform = [&engine] { return static_cast<float>(engine() >> 8) / 16777216.0F; };
  const auto make = [&](std::size_t count, float size) {
    TypeArrays type;
    type.count = count;
    for (std::size_t i = 0; i < count; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        type.vectors["position"].push_back(size * (uniform() + uniform() + uniform() - 1.5F));
        type.vectors["velocity"].push_back(uniform() - 0.5F);
      }
      type.scalars["mass"].push_back(0.5F + uniform());
      type.scalars["smoothing_length"].push_back(0.05F + 0.1F * uniform());
      type.scalars["density"].push_back(1 + 100 * uniform());
      type.scalars["internal_energy"].push_back(1 + 1000 * uniform() * uniform());
    }
    return type;
  };
  return {{gas, make(gas_count, 1)}, {stars, make(star_count, 0.5F)}};
}

// What is left out where none are there: a rank without particles need not name its fields.
inline void set_fields(const Arrays& arrays, ArraySnapshot& snapshot) {
  for (const auto& [type, of_type] : arrays) {
    if (of_type.count == 0) continue;
    for (const auto& [name, values] : of_type.scalars)
      snapshot.set_field(type, name, values.data(), of_type.count);
    for (const auto& [name, values] : of_type.vectors)
      snapshot.set_field(type, name, values.data(), of_type.count, 3);
  }
}

// Which part of each type's particles ends with each rank.
using Ends = std::vector<std::map<int, double>>;

// Ranks with much, with little, and with nothing.
inline Ends uneven(int ranks) {
  if (ranks == 1) return {{{gas, 1}, {stars, 1}}};
  if (ranks == 2) return {{{gas, 0.3}, {stars, 1}}, {{gas, 1}, {stars, 1}}};
  return {{{gas, 0.9}, {stars, 0}}, {{gas, 0.9}, {stars, 0}}, {{gas, 1}, {stars, 1}}};
}

inline Arrays part_of_rank(const Arrays& all, const Ends& ends, int rank) {
  const auto r = static_cast<std::size_t>(rank);
  Arrays part;
  for (const auto& [type, of_type] : all) {
    const auto place = [&, type = type, count = of_type.count](double fraction) {
      return static_cast<std::size_t>(fraction * static_cast<double>(count));
    };
    part[type] = of_type.part(r == 0 ? 0 : place(ends[r - 1].at(type)), place(ends[r].at(type)));
  }
  return part;
}

inline std::shared_ptr<Communicator> borrowed(Communicator& ranks) {
  return {std::shared_ptr<Communicator>(), &ranks};
}

// One rank of a simulation: its own particles, and the snapshot of those of all ranks together.
class RankOfSimulation {
 public:
  // Collective.
  RankOfSimulation(const Arrays& arrays, const Ends& ends, Communicator& ranks)
      : part_(part_of_rank(arrays, ends, ranks.rank())), own_(part_), all(own_, borrowed(ranks)) {}

 private:
  struct OwnSnapshot : ArraySnapshot {
    explicit OwnSnapshot(const Arrays& part) { set_fields(part, *this); }
  };
  const Arrays part_;
  const OwnSnapshot own_;

 public:
  const SpreadSnapshot all;
};

}  // namespace splotchcl::test
