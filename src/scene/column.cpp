#include <atomic>
#include <mutex>
#include <utility>

#include "splotchcl/particles.h"

namespace splotchcl {
namespace {

// The values of a column that are made at most once, and what makes them.
class MadeOnce {
 public:
  explicit MadeOnce(std::shared_ptr<const ColumnSource> source) : source_(std::move(source)) {}

  const std::shared_ptr<const ColumnSource>& source() const { return source_; }
  const float* data() const {
    std::call_once(once_, [this] {
      values_ = source_->make_all();
      made_ = values_.data();
    });
    return made_;
  }
  float value(std::size_t i) const {
    if (const float* const values = made_) return values[i];
    // A sample is cheaper value by value.
    const bool are_few = source_->is_streamed() ||
                         asked_.fetch_add(1, std::memory_order_relaxed) < source_->size() / 16;
    if (!are_few) return data()[i];
    float value = 0;
    source_->make(i, i + 1, &value);
    return value;
  }

 private:
  std::shared_ptr<const ColumnSource> source_;
  mutable std::once_flag once_;
  mutable std::vector<float> values_;
  mutable std::atomic<const float*> made_{nullptr};
  mutable std::atomic<std::size_t> asked_{0};
};

}  // namespace

std::vector<float> ColumnSource::make_all() const {
  std::vector<float> values(size());
  make(0, values.size(), values.data());
  return values;
}

Column Column::made_by(std::shared_ptr<const ColumnSource> source) {
  Column column;
  column.size_ = source->size();
  column.owner_ = std::make_shared<const MadeOnce>(std::move(source));
  column.is_array_ = true;
  column.is_made_ = true;
  return column;
}

const float* Column::made() const {
  return static_cast<const MadeOnce*>(owner_.get())->data();
}

float Column::made(std::size_t i) const {
  return static_cast<const MadeOnce*>(owner_.get())->value(i);
}

std::shared_ptr<const ColumnSource> Column::source() const {
  if (!is_made_) return nullptr;
  return static_cast<const MadeOnce*>(owner_.get())->source();
}

}  // namespace splotchcl
