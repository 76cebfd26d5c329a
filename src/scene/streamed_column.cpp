#include "scene/streamed_column.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace splotchcl {
namespace {

class FunctionColumn final : public ColumnSource {
 public:
  FunctionColumn(std::size_t size, MakeValues make) : size_(size), make_(std::move(make)) {}
  std::size_t size() const override { return size_; }
  bool is_streamed() const override { return true; }
  void make(std::size_t begin, std::size_t end, float* values) const override {
    make_(begin, end, values);
  }

 private:
  std::size_t size_;
  MakeValues make_;
};

}  // namespace

ColumnStretch::ColumnStretch(const Column& column, std::size_t begin, std::size_t end)
    : begin_(begin) {
  if (!column.is_array()) {
    same_ = column[0];
  } else if (const auto source = column.source(); source && source->is_streamed()) {
    made_.resize(end - begin);
    source->make(begin, end, made_.data());
    values_ = made_.data();
  } else {
    values_ = column.data() + begin;
  }
}

bool is_streamed(const Column& column) {
  const auto source = column.source();
  return source && source->is_streamed();
}

bool has_streamed_column(const Particles& particles) {
  const auto columns = particles.columns();
  return std::any_of(columns.begin(), columns.end(),
                     [](const Column* column) { return is_streamed(*column); });
}

Column make_column(std::size_t size, bool is_streamed, MakeValues make) {
  if (is_streamed) return Column::made_by(std::make_shared<FunctionColumn>(size, std::move(make)));
  std::vector<float> values(size);
  make(0, size, values.data());
  return Column::owning(std::move(values));
}

Column make_vectors(const Column& vectors, bool is_streamed,
                    const std::function<void(const double* from, double* to)>& make) {
  // Sources are asked for whole vectors and for single values.
  const auto make_values = [=](std::size_t begin, std::size_t end, float* out) {
    const std::size_t first = begin / 3 * 3, last = (end + 2) / 3 * 3;
    const ColumnStretch stretch(vectors, first, last);
    for (std::size_t i = first; i < last; i += 3) {
      const double from[3] = {static_cast<double>(stretch[i]), static_cast<double>(stretch[i + 1]),
                              static_cast<double>(stretch[i + 2])};
      double to[3];
      make(from, to);
      for (std::size_t k = 0; k < 3; ++k) {
        if (i + k >= begin && i + k < end) *out++ = static_cast<float>(to[k]);
      }
    }
  };
  return make_column(vectors.size(), is_streamed, make_values);
}

Column gather_in_order(const Column& column, std::size_t width, std::size_t count,
                       const std::function<std::size_t(std::size_t)>& place) {
  std::vector<float> values(count * width);
  float* out = values.data();
  const std::size_t behind = count == 0 ? 0 : place(count - 1) + 1;
  std::size_t next = 0;
  while (next < count) {
    const std::size_t first = place(next);
    const std::size_t end = std::min(behind, first + streamed_particles);
    const ColumnStretch stretch(column, first * width, end * width);
    for (; next < count; ++next) {
      const std::size_t at = place(next);
      if (at >= end) break;
      for (std::size_t k = 0; k < width; ++k)
        *out++ = stretch[at * width + k];
    }
  }
  return Column::owning(std::move(values));
}

}  // namespace splotchcl
