#pragma once

#include <array>
#include <cstddef>

namespace splotchcl {

// Of the few unknowns that filters and stencils are worked out from.
template <std::size_t size>
using SmallVector = std::array<double, size>;
template <std::size_t size>
using SmallMatrix = std::array<SmallVector<size>, size>;

// Of a symmetric, positive definite matrix, by Gauss and Jordan.
template <std::size_t size>
SmallMatrix<size> inverse_of(SmallMatrix<size> matrix) {
  SmallMatrix<size> inverse{};
  for (std::size_t i = 0; i < size; ++i)
    inverse[i][i] = 1;
  for (std::size_t pivot = 0; pivot < size; ++pivot) {
    const double scale = 1 / matrix[pivot][pivot];
    for (std::size_t k = 0; k < size; ++k) {
      matrix[pivot][k] *= scale;
      inverse[pivot][k] *= scale;
    }
    for (std::size_t row = 0; row < size; ++row) {
      if (row == pivot) continue;
      const double part = matrix[row][pivot];
      for (std::size_t k = 0; k < size; ++k) {
        matrix[row][k] -= part * matrix[pivot][k];
        inverse[row][k] -= part * inverse[pivot][k];
      }
    }
  }
  return inverse;
}

template <std::size_t size>
SmallVector<size> times(const SmallMatrix<size>& matrix, const SmallVector<size>& vector) {
  SmallVector<size> product{};
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < size; ++k)
      product[i] += matrix[i][k] * vector[k];
  }
  return product;
}

}  // namespace splotchcl
