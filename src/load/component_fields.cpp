#include "load/component_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "between/interpolation.h"
#include "load/component_boxes.h"
#include "load/component_tree.h"
#include "load/passes.h"
#include "parallel/available_memory.h"
#include "parallel/for_blocks.h"
#include "ranks/spread_particles.h"
#include "scene/particle_columns.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::string number_and_name(int type) {
  return fmt::format("{} ({})", type, particle_type_name(type));
}

}  // namespace

Column joined(const std::vector<ColumnOfType>& parts, std::size_t width, bool is_shared) {
  if (parts.size() == 1) return parts.front().column;
  const Column& first = parts.front().column;
  const bool all_the_same =
      std::all_of(parts.begin(), parts.end(), [&first](const ColumnOfType& part) {
        return part.column.is_uniform() && part.column.uniform_value() == first.uniform_value();
      });
  if (all_the_same) return first;
  std::size_t total = 0;
  for (const ColumnOfType& part : parts)
    total += part.count;
  const bool streams = is_shared || is_too_large_to_copy(total * width * sizeof(float)) ||
                       std::any_of(parts.begin(), parts.end(), [](const ColumnOfType& part) {
                         return is_streamed(part.column);
                       });
  const auto make = [parts, width](std::size_t begin, std::size_t end, float* out) {
    std::size_t first = 0;  // value of the part
    for (const ColumnOfType& part : parts) {
      const std::size_t size = part.count * width;
      const std::size_t from = std::max(begin, first), to = std::min(end, first + size);
      if (from < to) {
        copy_values(part.column, from - first, to - first, out);
        out += to - from;
      }
      first += size;
    }
  };
  return make_column(total * width, streams, make);
}

ComponentFields::ComponentFields(const Component& component, std::size_t number,
                                 const Snapshot& snapshot, const MissingSizes& sizes,
                                 std::vector<std::string>& notes,
                                 const std::optional<BoxSides>& periodic_box)
    : component_(component),
      number_(number),
      snapshot_(snapshot),
      notes_(notes),
      periodic_box_(periodic_box),
      spread_(snapshot.spread()) {
  const Snapshot& own = snapshot.own_part();
  for (const int type : component.types) {
    const ParticleTypeInfo* const info = own.info().find_type(type);
    if (info != nullptr) {
      types_.emplace_back(
          own, *info, label(), component.center, [this](const std::string& text) { note(text); },
          sizes);
    } else if (component.types.size() > 1) {
      note(fmt::format("the snapshot has no particles of type {}", number_and_name(type)));
    }
  }
  if (types_.empty()) refuse_types();
  selected_.resize(types_.size());
}

void ComponentFields::refuse_types() const {
  std::vector<std::string> wanted, present;
  for (const int type : component_.types)
    wanted.push_back(number_and_name(type));
  for (const ParticleTypeInfo& type : snapshot_.info().types)
    present.push_back(number_and_name(type.type));
  throw UsageError(
      fmt::format("{}: {} has no particles of type {}, expected types with particles: {}", label(),
                  snapshot_.info().files.front().string(), fmt::join(wanted, " or "),
                  fmt::join(present, ", ")));
}

void ComponentFields::check(const SortOrder& sort) const {
  const auto check_scalars = [this](const std::string& field, const char* key) {
    for (const TypeFields& type : types_) {
      if (!field.empty()) type.check_scalars(field, key);
    }
  };
  for (const TypeFields& type : types_) {
    check_selection(component_, type, snapshot_.own_part());
    const std::string catalog = tell_found_catalog(component_, type, snapshot_.own_part());
    if (!catalog.empty()) note(catalog);
    if (const FieldInfo* const wind = find_wind(component_, type.info())) {
      note(
          fmt::format("wind among the stars ({0} not above 0) is left out; a condition on it, as "
                      "select.where = \"{0} <= 0\", has it",
                      wind->file_name));
    }
    if (!component_.color_vector.empty()) {
      type.check_vectors(component_.color_vector, "color.vector");
    }
  }
  if (!component_.size_fixed) check_scalars(component_.size_field, "size.field");
  check_scalars(component_.color.field, "color.field");
  check_scalars(component_.intensity.field, "intensity.field");
  if (sort.by == SortOrder::By::field) check_scalars(sort.field, "sort.by");
}

void ComponentFields::select() {
  counts_.clear();
  own_begins_.clear();
  for (std::size_t t = 0; t < types_.size(); ++t) {
    selected_[t] = select_particles(component_, types_[t], snapshot_.own_part(), periodic_box_);
    if (spread_) add_up_counts(t);
  }
  note_lost_ids();
  if (count() > 0) return;
  note(fmt::format("select and exclude leave none of its {} particles; nothing of it is drawn",
                   count_before_selecting()));
}

// Of a part of the particles most are elsewhere.
void ComponentFields::note_lost_ids() {
  const bool is_whole = std::all_of(types_.begin(), types_.end(), [](const TypeFields& type) {
    return type.info().particles_per_drawn == 1;
  });
  if (spread_ || !is_whole) return;
  const std::string lost = tell_lost_ids(component_, types_, snapshot_);
  if (!lost.empty()) note(lost);
}

void ComponentFields::add_up_counts(std::size_t type) {
  const std::vector<std::uint64_t> counts = spread_->gather(own_count_of(type));
  const auto own = counts.begin() + spread_->ranks().rank();
  own_begins_.push_back(std::accumulate(counts.begin(), own, std::size_t{0}));
  counts_.push_back(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
}

ParticlePass ComponentFields::pass() const {
  if (!spread_) return pass_over_made(snapshot_, count());
  std::vector<ParticleRun> runs;
  std::size_t first = 0;  // particle of the type
  for (std::size_t t = 0; t < types_.size(); ++t) {
    const std::size_t begin = first + own_begins_.at(t);
    runs.push_back({begin, begin + own_count_of(t)});
    first += count_of(t);
  }
  return ParticlePass(std::move(runs), std::make_shared<const RankPass>(spread_));
}

std::size_t ComponentFields::own_count_of(std::size_t type) const {
  return selected_[type] ? selected_[type]->size() : types_[type].count();
}

std::size_t ComponentFields::count_of(std::size_t type) const {
  return spread_ ? counts_.at(type) : own_count_of(type);
}

std::size_t ComponentFields::count_before_selecting() const {
  std::size_t total = 0;
  for (const TypeFields& type : types_)
    total += static_cast<std::size_t>(snapshot_.info().find_type(type.info().type)->count);
  return total;
}

std::size_t ComponentFields::count() const {
  std::size_t count = 0;
  for (std::size_t t = 0; t < types_.size(); ++t)
    count += count_of(t);
  return count;
}

// What had to be put together stays in the snapshot's memory; what is one type's as the
// file has it is not copied at all.
Column ComponentFields::collected(const std::string& what, const Read& read,
                                  std::size_t width) const {
  if (types_.size() == 1 && !selected_.front() && !spread_) return read(types_.front());
  const std::string key = fmt::format("{}: {}", particles_key(), what);
  // Of what ranks share each makes what it asks for.
  const bool is_shared = has_shared_passes(snapshot_);
  return snapshot_.memory().get<Column>(key, [&] {
    std::vector<ColumnOfType> parts;
    for (std::size_t t = 0; t < types_.size(); ++t) {
      Column column = gather(read(types_[t]), selected_[t], width, is_shared);
      if (spread_) column = spread_->spread(column, own_count_of(t), width);
      parts.push_back({std::move(column), count_of(t)});
    }
    return joined(parts, width, is_shared);
  });
}

// Stands for the component's particles in the snapshot's memory.
std::string ComponentFields::particles_key() const {
  std::string key = "particles of types";
  for (const TypeFields& type : types_)
    key += fmt::format(" {}", type.info().type);
  return fmt::format("{}, {}", key, selection_key(component_, periodic_box_));
}

std::string ComponentFields::placed_key() const {
  const Placement& placement = component_.placement;
  return fmt::format("{}: placed about {} {} {} by {} scaled {}", particles_key(),
                     placement.axis.a[0], placement.axis.a[1], placement.axis.a[2],
                     placement.angle_degrees, placement.scale);
}

Vec3 ComponentFields::origin() const {
  return placed_origin(component_.placement, component_.center, snapshot_.position_origin());
}

Column ComponentFields::positions() const {
  const auto as_stored = [this] {
    return collected(
        "position", [](const TypeFields& type) { return type.positions(); }, 3);
  };
  const Placement& placement = component_.placement;
  if (only_moves(placement)) return as_stored();
  return snapshot_.memory().get<Column>(placed_key(), [&] {
    return placed_positions(placement, component_.center, snapshot_.position_origin(), as_stored(),
                            has_shared_passes(snapshot_));
  });
}

namespace {

struct WrappedPositions {
  Vec3 shift;
  BoxSides box;
  Column positions;
};

}  // namespace

// They serve all frames of a film around the same center. Those around another one go at once:
// they may be a large part of the memory.
void ComponentFields::wrap_around(const Vec3& center, Particles& particles) const {
  using namespace boost::qvm;
  if (!periodic_box_) return;
  const Vec3 shift = particles.origin - center;
  const std::string key = particles_key() + ": wrapped";
  const auto wrapped = [&]() -> WrappedPositions {
    return {
        shift, *periodic_box_,
        wrapped_positions(shift, *periodic_box_, particles.position, has_shared_passes(snapshot_))};
  };
  LoadMemory& memory = snapshot_.memory();
  const auto& known = memory.get<WrappedPositions>(key, wrapped);
  if (known.shift != shift || known.box != *periodic_box_) {
    memory.set(key, WrappedPositions{shift, *periodic_box_, {}});
    memory.set(key, wrapped());
  }
  particles.position = memory.get<WrappedPositions>(key, wrapped).positions;
  if (particles.boxes) particles.boxes = wrapped_boxes(*particles.boxes, shift, *periodic_box_);
  if (particles.tree) particles.tree = wrapped_tree(*particles.tree, center, *periodic_box_);
  particles.origin = center;
}

// All particles are looked at for each frame only where some may have to be told of. Wrapped ones
// lie within half a box.
std::optional<std::string> ComponentFields::rounded_positions(const DrawnComponent& drawn) const {
  if (!are_offsets(drawn.particles)) return std::nullopt;
  const std::string size = component_.size_fixed ? std::string("fixed") : component_.size_field;
  PlaceExtremes extremes =
      snapshot_.memory().get<PlaceExtremes>(fmt::format("{}: extremes{}, sizes {}", placed_key(),
                                                        periodic_box_ ? " when wrapped" : "", size),
                                            [&] { return find_extremes(drawn.particles, pass()); });
  if (periodic_box_) extremes.largest_offset = static_cast<float>(periodic_box_->longest() / 2);
  if (!may_be_rounded(extremes, drawn.size_factor)) return std::nullopt;
  return tell_rounded_positions(drawn, pass());
}

Column ComponentFields::scalars(const std::string& field, const std::string& key) const {
  return collected("scalar " + field,
                   [&](const TypeFields& type) { return type.scalars(field, key); });
}

Column ComponentFields::vectors(const std::string& field, const std::string& key) const {
  return collected(
      "vector " + field, [&](const TypeFields& type) { return type.vectors(field, key); }, 3);
}

bool ComponentFields::masses_are_known() const {
  return std::all_of(types_.begin(), types_.end(),
                     [](const TypeFields& type) { return has_masses(type.info()); });
}

Column ComponentFields::masses() const {
  return collected("mass", [](const TypeFields& type) { return type.masses(); });
}

Column ComponentFields::volumes(const std::string& key, double unit) const {
  return collected("volume of mass and density",
                   [&](const TypeFields& type) { return type.volumes(key, unit); });
}

bool ComponentFields::stand_for_the_same() const {
  const double first = types_.front().info().particles_per_drawn;
  return std::all_of(types_.begin(), types_.end(), [first](const TypeFields& type) {
    return type.info().particles_per_drawn == first;
  });
}

double ComponentFields::particles_per_drawn() const {
  if (stand_for_the_same()) return types_.front().info().particles_per_drawn;
  double all = 0, drawn = 0;
  for (const TypeFields& type : types_) {
    const auto count = static_cast<double>(type.count());
    all += count * type.info().particles_per_drawn;
    drawn += count;
  }
  return drawn > 0 ? all / drawn : 1;
}

// Of particles that are there as a whole.
float ComponentFields::factor_of(const TypeFields& type) const {
  return static_cast<float>(type.info().particles_per_drawn / particles_per_drawn());
}

Column ComponentFields::weight_factors() const {
  const auto fades = [](const TypeFields& type) {
    const FieldInfo* const field = find_field(type.info(), fade_field);
    // A file may have a field of that name, which means something else.
    return field != nullptr && field->file_name.empty();
  };
  const bool some_fade = std::any_of(types_.begin(), types_.end(), fades);
  const bool has_rim = component_.select.sphere_rim.has_value();
  if (!some_fade && !has_rim && stand_for_the_same()) return {};
  return collected("weight factors", [&](const TypeFields& type) {
    const float factor = factor_of(type);
    Column factors = Column::uniform(factor);
    if (fades(type)) {
      const Column fade = type.scalars(fade_field, "fade");
      factors = factor == 1 ? fade : faded(factors, fade, type.count());
    }
    return has_rim ? faded(factors, rim_factors(type), type.count()) : factors;
  });
}

// 1 within the rim, and 0 at the sphere's surface and beyond.
Column ComponentFields::rim_factors(const TypeFields& type) const {
  const ParticleSet& set = component_.select;
  const Vec3 to_center = snapshot_.position_origin() - *set.sphere_center;
  const Column position = type.positions();
  std::vector<float> factors(type.count());
  for_blocks(factors.size(), streamed_particles, [&](std::size_t first, std::size_t last) {
    const ColumnStretch stretch(position, 3 * first, 3 * last);
    for (std::size_t i = first; i < last; ++i) {
      double offset[3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        offset[axis] = to_center.a[axis] + static_cast<double>(stretch[3 * i + axis]);
        if (periodic_box_) offset[axis] = nearest_image(offset[axis], (*periodic_box_)[axis]);
      }
      const double inwards = *set.sphere_radius - std::hypot(offset[0], offset[1], offset[2]);
      const double part = std::clamp(inwards / *set.sphere_rim, 0.0, 1.0);
      factors[i] = static_cast<float>(part * part * (3 - 2 * part));
    }
  });
  return Column::owning(std::move(factors));
}

Column ComponentFields::with_factors(const Column& weights) const {
  const Column factors = weight_factors();
  return factors.is_absent() ? weights : faded(weights, factors, count());
}

Column ComponentFields::smoothing_lengths() const {
  if (component_.size_fixed) return Column::uniform(static_cast<float>(*component_.size_fixed));
  if (canonical_field_name(component_.size_field) == "smoothing_length") {
    return collected("smoothing_length",
                     [](const TypeFields& type) { return type.smoothing_lengths(); });
  }
  return scalars(component_.size_field, "size.field");
}

std::shared_ptr<const TreeOfComponent> ComponentFields::tree(WeightModel weight) const {
  const std::string stale = tell_stale_tree(snapshot_);
  if (!stale.empty()) note(stale);
  std::vector<int> types;
  for (std::size_t t = 0; t < types_.size(); ++t) {
    if (selected_[t] || spread_) return nullptr;
    types.push_back(types_[t].info().type);
  }
  return component_tree(component_, snapshot_, types, weight);
}

std::shared_ptr<const ParticleBoxes> ComponentFields::boxes() const {
  const std::string stale = tell_stale_index(snapshot_);
  if (!stale.empty()) note(stale);
  std::vector<int> types;
  for (std::size_t t = 0; t < types_.size(); ++t) {
    if (selected_[t]) return nullptr;
    types.push_back(types_[t].info().type);
  }
  return component_boxes(component_, snapshot_, types);
}

void ComponentFields::note(const std::string& text) const {
  const std::string line = label() + ": " + text;
  // Two of a component's values may give the same reason for a note.
  if (std::find(notes_.begin(), notes_.end(), line) == notes_.end()) notes_.push_back(line);
}

std::string ComponentFields::name() const {
  return component_.name.empty() ? std::to_string(number_) : component_.name;
}

std::string ComponentFields::label() const {
  return "component " + name();
}

}  // namespace splotchcl
