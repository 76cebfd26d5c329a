#include "scene/particle_columns.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "scene/memory_advice.h"
#include "splotchcl/particles.h"

namespace splotchcl {
namespace {

using Bytes = PassRanks::Bytes;

// A rank's runs, behind the places in bytes where they end.
Bytes packed(const Bytes& runs, const std::vector<std::size_t>& ends) {
  std::vector<std::uint64_t> table(ends.begin(), ends.end());
  Bytes all(table.size() * sizeof(std::uint64_t) + runs.size());
  std::memcpy(all.data(), table.data(), table.size() * sizeof(std::uint64_t));
  if (!runs.empty())
    std::memcpy(all.data() + table.size() * sizeof(std::uint64_t), runs.data(), runs.size());
  return all;
}

struct PackedRuns {
  std::vector<std::uint64_t> ends;
  const std::byte* bytes;

  PackedRuns(const Bytes& all, std::size_t runs)
      : ends(runs), bytes(all.data() + runs * sizeof(std::uint64_t)) {
    std::memcpy(ends.data(), all.data(), runs * sizeof(std::uint64_t));
  }
  void append_run(std::size_t run, Bytes& to) const {
    to.insert(to.end(), bytes + (run == 0 ? 0 : ends[run - 1]), bytes + ends[run]);
  }
};

}  // namespace

Bytes ParticlePass::in_order(Bytes own, const std::vector<std::size_t>& ends) const {
  const std::vector<Bytes> all = ranks_->gather(packed(own, ends));
  own = {};
  std::vector<PackedRuns> ranks;
  std::size_t size = 0;
  for (const Bytes& of_rank : all) {
    ranks.emplace_back(of_rank, ends.size());
    size += of_rank.size() - ends.size() * sizeof(std::uint64_t);
  }
  Bytes joined;
  joined.reserve(size);
  for (std::size_t run = 0; run < ends.size(); ++run) {
    for (const PackedRuns& of_rank : ranks)
      of_rank.append_run(run, joined);
  }
  return joined;
}

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
  } else if (const auto source = column.source();
             source && (source->is_streamed() || source->is_copy())) {
    made_.reset(new float[end - begin]);  // not cleared before
    source->make(begin, end, made_.get());
    values_ = made_.get();
  } else {
    values_ = column.data() + begin;
  }
}

void copy_values(const Column& column, std::size_t begin, std::size_t end, float* out) {
  if (const auto source = column.source(); source && source->is_streamed()) {
    source->make(begin, end, out);
    return;
  }
  const ColumnStretch stretch(column, begin, end);
  for (std::size_t i = begin; i < end; ++i)
    *out++ = stretch[i];
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

namespace {

bool is_same(const Column& a, const Column& b) {
  if (a.source() || b.source()) return a.source() == b.source();
  if (a.is_array() || b.is_array()) return a.data() == b.data() && a.size() == b.size();
  return a.is_uniform() == b.is_uniform() && a.uniform_value() == b.uniform_value();
}

}  // namespace

bool have_same_columns(const Particles& known, const Particles& particles) {
  const auto first = known.columns(), second = particles.columns();
  return known.count == particles.count &&
         std::equal(first.begin(), first.end(), second.begin(),
                    [](const Column* a, const Column* b) { return is_same(*a, *b); });
}

namespace {

// Of places from `first` on, those that are read together: many, and from the least to the largest
// of them it is no farther than a look at each of them takes. Else the first alone.
std::size_t end_of_run(const Places& places, std::size_t first, std::size_t last,
                       std::uint64_t& from, std::uint64_t& to) {
  constexpr std::uint64_t values_per_look = 16, longest = 65536;
  constexpr std::size_t fewest = 16;
  from = to = places[first];
  std::size_t end = first + 1;
  while (end < last) {
    const std::uint64_t least = std::min(from, places[end]), largest = std::max(to, places[end]);
    if (largest - least > std::min<std::uint64_t>(longest, values_per_look * (end - first))) break;
    from = least;
    to = largest;
    ++end;
  }
  if (end - first >= fewest) return end;
  from = to = places[first];
  return first + 1;
}

void pick_from_source(const ColumnSource& source, std::size_t width, const Places& places,
                      std::size_t first, std::size_t last, float* to) {
  std::vector<float> run;
  for (std::size_t next = first; next < last;) {
    std::uint64_t least = 0, largest = 0;
    const std::size_t end = end_of_run(places, next, last, least, largest);
    run.resize(width * static_cast<std::size_t>(largest - least + 1));
    source.make(width * static_cast<std::size_t>(least),
                width * static_cast<std::size_t>(largest + 1), run.data());
    for (; next < end; ++next)
      to = std::copy_n(&run[width * static_cast<std::size_t>(places[next] - least)], width, to);
  }
}

}  // namespace

Column picked_column(const Column& column, std::size_t width, const Places& places,
                     const RunBlocks& run) {
  if (!column.is_array() || column.size() == 0) return column;
  const auto source = column.source();
  LargeVector<float> values(width * places.size());
  constexpr std::size_t block = std::size_t{1} << 16;
  run(places.size(), block, [&](std::size_t first, std::size_t last) {
    float* to = values.data() + width * first;
    if (source) {
      pick_from_source(*source, width, places, first, last, to);
      return;
    }
    for (std::size_t i = first; i < last; ++i)
      to = std::copy_n(column.data() + width * static_cast<std::size_t>(places[i]), width, to);
  });
  return owning_column(std::move(values));
}

Particles picked_particles(const Particles& particles, const Places& places, const RunBlocks& run) {
  Particles some = particles;
  some.count = places.size();
  some.boxes = nullptr;
  some.tree = nullptr;
  for (Column* const column : {&some.position, &some.color_vector})
    *column = picked_column(*column, 3, places, run);
  for (Column* const column :
       {&some.smoothing_length, &some.weight, &some.color, &some.intensity, &some.sort_field})
    *column = picked_column(*column, 1, places, run);
  return some;
}

namespace {

// The values of a column that are made at most once, and what makes them.
class MadeOnce {
 public:
  explicit MadeOnce(std::shared_ptr<const ColumnSource> source) : source_(std::move(source)) {}

  const std::shared_ptr<const ColumnSource>& source() const { return source_; }
  const float* data() const {
    std::call_once(once_, [this] {
      all_ = source_->make_all();
      made_ = all_.data();
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
  mutable Column all_;
  mutable std::atomic<const float*> made_{nullptr};
  mutable std::atomic<std::size_t> asked_{0};
};

}  // namespace

Column ColumnSource::make_all() const {
  std::vector<float> values(size());
  make(0, values.size(), values.data());
  return Column::owning(std::move(values));
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

ParticleBox ParticleBoxes::around(std::size_t first, std::size_t end) const {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  ParticleBox all = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, 0};
  for (std::size_t b = first / block_particles; b * block_particles < end; ++b) {
    const ParticleBox& box = boxes.at(b);
    for (int axis = 0; axis < 3; ++axis) {
      all.lower[axis] = std::min(all.lower[axis], box.lower[axis]);
      all.upper[axis] = std::max(all.upper[axis], box.upper[axis]);
    }
    all.largest_smoothing_length =
        std::max(all.largest_smoothing_length, box.largest_smoothing_length);
  }
  return all;
}

}  // namespace splotchcl
