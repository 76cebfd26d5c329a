#include "load/select_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "select/condition.h"
#include "select/id_list.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Ids = std::vector<std::uint64_t>;

// Which particles of a type still belong to a set, while its conditions are applied one after the
// other.
class Membership {
 public:
  Membership(const TypeFields& fields, const Snapshot& snapshot)
      : fields_(fields), snapshot_(snapshot), is_member_(fields.count(), true) {}

  void keep(const ParticleSet& set, const std::string& key) {
    for (const std::string& text : set.where)
      keep_where(text, key + ".where");
    if (set.box_minimum && set.box_maximum) keep_box(*set.box_minimum, *set.box_maximum);
    if (set.sphere_center && set.sphere_radius) {
      keep_sphere(*set.sphere_center, *set.sphere_radius);
    }
    if (!set.id_file.empty()) keep_ids(set.id_file);
  }

  const std::vector<bool>& flags() const { return is_member_; }

 private:
  template <class Holds>
  void keep_if(Holds&& holds) {
    for (std::size_t i = 0; i < is_member_.size(); ++i) {
      if (is_member_[i] && !holds(i)) is_member_[i] = false;
    }
  }

  void keep_where(const std::string& text, const std::string& key) {
    const std::optional<Condition> condition = parse_condition(text);
    if (!condition) {
      throw UsageError(fmt::format("{}: found \"{}\", expected {}", key, text, condition_form));
    }
    std::vector<bool> holds(is_member_.size(), false);
    for (const Comparison& comparison : *condition) {
      const Column values = fields_.scalars(comparison.field, key);
      for (std::size_t i = 0; i < holds.size(); ++i) {
        if (!holds[i]) holds[i] = comparison.holds(static_cast<double>(values[i]));
      }
    }
    keep_if([&holds](std::size_t i) { return holds[i]; });
  }

  void keep_box(const Vec3& minimum, const Vec3& maximum) {
    keep_places([&](const Vec3& x) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(x.a[axis] >= minimum.a[axis] && x.a[axis] <= maximum.a[axis])) return false;
      }
      return true;
    });
  }

  void keep_sphere(const Vec3& center, double radius) {
    keep_places([&](const Vec3& x) {
      return std::hypot(x.a[0] - center.a[0], x.a[1] - center.a[1], x.a[2] - center.a[2]) <= radius;
    });
  }

  template <class Holds>
  void keep_places(Holds&& holds) {
    const Column position = fields_.positions();
    const Vec3 origin = snapshot_.position_origin();
    keep_if([&](std::size_t i) {
      const Vec3 offset = {{static_cast<double>(position[3 * i]),
                            static_cast<double>(position[3 * i + 1]),
                            static_cast<double>(position[3 * i + 2])}};
      return holds(Vec3(origin + offset));
    });
  }

  void keep_ids(const std::string& file) {
    const Ids& wanted = snapshot_.memory().get_for_all_times<Ids>(
        "ids " + file, [&] { return read_id_list(file); });
    const Ids own = fields_.ids();
    keep_if(
        [&](std::size_t i) { return std::binary_search(wanted.begin(), wanted.end(), own[i]); });
  }

  const TypeFields& fields_;
  const Snapshot& snapshot_;
  std::vector<bool> is_member_;
};

ParticleIndices find_indices(const Component& component, const TypeFields& fields,
                             const Snapshot& snapshot) {
  Membership selected(fields, snapshot);
  selected.keep(component.select, "select");
  Membership excluded(fields, snapshot);
  if (component.exclude.is_given()) excluded.keep(component.exclude, "exclude");
  ParticleIndices indices;
  for (std::size_t i = 0; i < fields.count(); ++i) {
    const bool is_left_out = component.exclude.is_given() && excluded.flags()[i];
    if (selected.flags()[i] && !is_left_out) indices.push_back(i);
  }
  return indices;
}

std::string text_of(const std::optional<Vec3>& v) {
  return v ? fmt::format("{} {} {}", v->a[0], v->a[1], v->a[2]) : "-";
}

std::string text_of(const ParticleSet& set) {
  return fmt::format("where {} ids {} box {} {} sphere {} {}", fmt::join(set.where, "; "),
                     set.id_file, text_of(set.box_minimum), text_of(set.box_maximum),
                     text_of(set.sphere_center),
                     set.sphere_radius ? fmt::format("{}", *set.sphere_radius) : "-");
}

void check_set(const ParticleSet& set, const std::string& key, const TypeFields& fields,
               const Snapshot& snapshot) {
  for (const std::string& text : set.where) {
    for (const Comparison& comparison : parse_condition(text).value_or(Condition())) {
      if (canonical_field_name(comparison.field) == "id") {
        throw UsageError(fmt::format(
            "component with {}.where \"{}\": found a condition on ids, which may be too long for "
            "a number, expected {}.ids, a file that lists them",
            key, text, key));
      }
      fields.check_scalars(comparison.field, key + ".where");
    }
  }
  if (set.id_file.empty()) return;
  snapshot.memory().get_for_all_times<Ids>("ids " + set.id_file,
                                           [&set] { return read_id_list(set.id_file); });
  if (find_field(fields.info(), "id") == nullptr) snapshot.read_ids(fields.info().type);
}

}  // namespace

std::shared_ptr<const ParticleIndices> select_particles(const Component& component,
                                                        const TypeFields& fields,
                                                        const Snapshot& snapshot) {
  if (!component.select.is_given() && !component.exclude.is_given()) return nullptr;
  using Selected = std::shared_ptr<const ParticleIndices>;
  return snapshot.memory().get<Selected>(
      fmt::format("type {}: {}", fields.info().type, selection_key(component)), [&]() -> Selected {
        return std::make_shared<ParticleIndices>(find_indices(component, fields, snapshot));
      });
}

void check_selection(const Component& component, const TypeFields& fields,
                     const Snapshot& snapshot) {
  check_set(component.select, "select", fields, snapshot);
  check_set(component.exclude, "exclude", fields, snapshot);
}

std::string selection_key(const Component& component) {
  const auto& center = component.center.a;
  return fmt::format("center {} {} {} select {} exclude {}", center[0], center[1], center[2],
                     text_of(component.select), text_of(component.exclude));
}

Column gather(const Column& column, const ParticleIndices* selected, std::size_t width) {
  if (selected == nullptr || !column.is_array()) return column;
  std::vector<float> values;
  values.reserve(selected->size() * width);
  for (const std::size_t i : *selected) {
    values.insert(values.end(), column.data() + i * width, column.data() + (i + 1) * width);
  }
  return Column::owning(std::move(values));
}

}  // namespace splotchcl
