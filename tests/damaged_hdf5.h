#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

namespace splotchcl::test {

// Copies of an HDF5 file of which bytes are changed where HDF5 keeps its structure: in each another
// few.
class DamagedHdf5 {
 public:
  DamagedHdf5(std::string whole, unsigned seed) : whole_(std::move(whole)), random_(seed) {
    for (const std::string mark : {"TREE", "HEAP", "SNOD"}) {
      for (auto at = whole_.find(mark); at != std::string::npos; at = whole_.find(mark, at + 1))
        places_.push_back(at);
    }
  }

  std::string next() {
    std::string damaged = whole_;
    const int changes = 1 << copies_++ % 5;
    for (int change = 0; change < changes; ++change) {
      const std::size_t at = places_[random_() % places_.size()] + random_() % 600;
      damaged[at % damaged.size()] = static_cast<char>(random_() % 3 == 0 ? random_() : 0);
    }
    return damaged;
  }

 private:
  std::string whole_;
  std::vector<std::size_t> places_;
  std::mt19937 random_;
  int copies_ = 0;
};

}  // namespace splotchcl::test
