#include "between/interpolated_column.h"

#include <optional>
#include <utility>

#include "parallel/for_blocks.h"

namespace splotchcl {
namespace {

constexpr std::size_t values_per_block = 49152;

// Where particles fade, what they fade with their values.
std::optional<ColumnBetween> fading(const ColumnBetween& column, const ColumnBetween& fade) {
  const bool is_alike = column.match == fade.match && column.fraction == fade.fraction &&
                        column.kind != ColumnBetween::Kind::position && !column.fades;
  if (!is_alike) return std::nullopt;
  ColumnBetween both = column;
  both.fades = true;
  both.vanishing = fade.vanishing;
  both.appearing = fade.appearing;
  return both;
}

// The factor is its own values' alone: 1 for those that stay.
bool only_fades(const ColumnBetween& column) {
  const auto is_one = [](const Column& c) { return c.is_uniform() && c.uniform_value() == 1; };
  return column.fades && is_one(column.first) && is_one(column.second);
}

}  // namespace

std::size_t InterpolatedColumn::size() const {
  return interpolation_.match->particles() *
         static_cast<std::size_t>(interpolation_.values_per_particle);
}

void InterpolatedColumn::make(std::size_t begin, std::size_t end, float* values) const {
  interpolate(interpolation_, begin, end, values);
}

std::vector<float> InterpolatedColumn::make_all() const {
  std::vector<float> values(size());
  for_blocks(values.size(), values_per_block,
             [&](std::size_t begin, std::size_t end) { make(begin, end, values.data() + begin); });
  return values;
}

Column column_between(ColumnBetween interpolation) {
  const Column &a = interpolation.first, &b = interpolation.second;
  const bool is_one_value = a.is_uniform() && b.is_uniform() &&
                            a.uniform_value() == b.uniform_value() && !interpolation.fades;
  if (is_one_value) return a;
  return Column::made_by(std::make_shared<const InterpolatedColumn>(std::move(interpolation)));
}

std::shared_ptr<const InterpolatedColumn> interpolated(const Column& column) {
  return std::dynamic_pointer_cast<const InterpolatedColumn>(column.source());
}

Column faded(const Column& column, const Column& fade, std::size_t count) {
  const auto fades = interpolated(fade);
  if (fades && only_fades(fades->interpolation())) {
    if (!column.is_array()) {
      ColumnBetween both = fades->interpolation();
      both.first = both.second = Column::uniform(column.is_absent() ? 1 : column.uniform_value());
      return column_between(std::move(both));
    }
    if (const auto values = interpolated(column)) {
      auto both = fading(values->interpolation(), fades->interpolation());
      if (both) return column_between(std::move(*both));
    }
  }
  std::vector<float> product(count);
  for (std::size_t i = 0; i < count; ++i)
    product[i] = fade[i] * (column.is_absent() ? 1 : column[i]);
  return Column::owning(std::move(product));
}

}  // namespace splotchcl
