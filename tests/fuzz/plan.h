#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace splotchcl::fuzz {

// Bytes as choices, one after the other; 0 from their end on.
class Plan {
 public:
  Plan(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool is_at_end() const { return place_ >= size_; }
  std::size_t below(std::size_t limit) { return byte() % limit; }
  template <class T, std::size_t N>
  const T& one_of(const std::array<T, N>& choices) {
    return choices[below(N)];
  }

 private:
  std::uint8_t byte() { return is_at_end() ? std::uint8_t{0} : data_[place_++]; }
  const std::uint8_t* data_;
  std::size_t size_, place_ = 0;
};

}  // namespace splotchcl::fuzz
