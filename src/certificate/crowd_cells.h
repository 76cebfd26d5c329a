#pragma once

#include <cstdint>
#include <vector>

namespace splotchcl {

// Splats in square cells, to see where many lie upon one another.
class CrowdCells {
 public:
  // Cells are 2^shift pixels wide.
  explicit CrowdCells(int shift) : shift_(shift) {}

  // At a place in pixels.
  void add(double x, double y, double light);

  // The most light of two cells by two, beyond what an even field as full as those around them has
  // there. Of a sample, squares of few splats tell nothing, and others may be as full by chance.
  double crowded_light(bool is_sample);

 private:
  // Or several: their left and top one's place.
  struct Cell {
    std::int32_t x, y;
    double light, count;

    Cell& operator+=(const Cell& other) {
      light += other.light;
      count += other.count;
      return *this;
    }
  };
  struct Row {
    const Cell *begin = nullptr, *end = nullptr;
  };

  void join_equal_cells();
  std::vector<Row> rows() const;
  double light_within(std::int32_t left, std::int32_t top, std::int32_t side) const;
  // Or `least`, where it is less.
  double light_of_square(const Cell& square, bool is_sample, double least) const;
  double light_of_rows(const Row& upper, const Row& lower, std::int32_t top, bool is_sample,
                       double least) const;

  int shift_;
  std::vector<Cell> cells_;  // once joined, row by row
};

}  // namespace splotchcl
