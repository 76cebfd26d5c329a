#include "load/select_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "formats/halo_catalog.h"
#include "formats/numpy/numpy_array.h"
#include "formula/selection.h"
#include "load/derived_fields.h"
#include "load/passes.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Ids = std::vector<std::uint64_t>;

// In increasing order, from a text or an array of NumPy.
Ids read_wanted_ids(const std::string& file) {
  std::error_code ignored;
  const bool is_array = std::filesystem::is_regular_file(file, ignored) && is_numpy_file(file);
  if (!is_array) return read_id_list(file);
  Ids ids = read_numpy_integers(file);
  if (ids.empty()) throw DataError(file + ": found no identifier, expected some");
  refuse_mask(ids, file);
  std::sort(ids.begin(), ids.end());
  return ids;
}

const Ids& wanted_ids(const Snapshot& snapshot, const std::string& file) {
  return snapshot.memory().get_for_all_times<Ids>("ids " + file,
                                                  [&file] { return read_wanted_ids(file); });
}

// Where a halo's particles are looked up: in a catalog, or in the field that has the number of
// each particle's halo.
std::optional<std::filesystem::path> catalog_of(const ParticleSet& set, const std::string& key,
                                                const TypeFields& fields,
                                                const Snapshot& snapshot) {
  if (!set.halo_catalog.empty()) return set.halo_catalog;
  if (find_field(fields.info(), "halo_id") != nullptr) return std::nullopt;
  const std::filesystem::path& file = snapshot.info().files.front();
  if (const auto found = find_halo_catalog(file)) return found;
  throw UsageError(fmt::format(
      "component with {}.halo {}: particles of type {} in {} have no field of group ids, and there "
      "is no catalog of haloes beside it; expected {}.catalog",
      key, *set.halo, fields.info().type, file.string(), key));
}

// Which particles of a run of a type still belong to a set, while its conditions are applied one
// after the other.
class Membership {
 public:
  Membership(const TypeFields& fields, const Snapshot& snapshot,
             const std::optional<BoxSides>& periodic_box, const ParticleRun& run)
      : fields_(fields),
        snapshot_(snapshot),
        periodic_box_(periodic_box),
        run_(run),
        is_member_(run.end - run.begin, true) {}

  void keep(const ParticleSet& set, const std::string& key) {
    for (const std::string& text : set.where)
      keep_where(text, key + ".where");
    if (set.box_minimum && set.box_maximum) keep_box(*set.box_minimum, *set.box_maximum);
    if (set.sphere_center && set.sphere_radius) {
      keep_sphere(*set.sphere_center, *set.sphere_radius);
    }
    if (!set.id_file.empty()) keep_ids(set.id_file);
    if (set.halo) keep_halo(set, key);
  }

  bool has(std::size_t particle) const { return is_member_[particle - run_.begin]; }

 private:
  template <class Holds>
  void keep_if(Holds&& holds) {
    for (std::size_t i = 0; i < is_member_.size(); ++i) {
      if (is_member_[i] && !holds(run_.begin + i)) is_member_[i] = false;
    }
  }

  // look(first, last, holds) for blocks of particles, on all cores.
  template <class Look>
  void keep_blocks(Look&& look) {
    constexpr std::size_t block = std::size_t{1} << 16;
    std::vector<char> holds(is_member_.size());
    for_blocks(holds.size(), block, [&](std::size_t first, std::size_t last) {
      look(run_.begin + first, run_.begin + last, holds.data() + first);
    });
    keep_if([&](std::size_t i) { return holds[i - run_.begin] != 0; });
  }

  void keep_where(const std::string& text, const std::string& key) {
    const Formula condition = condition_on(fields_, text, key);
    const auto values = formula_values(fields_, condition, key);
    keep_blocks([&](std::size_t first, std::size_t last, char* holds) {
      std::vector<double> found(last - first);
      values->evaluate(first, last, found.data());
      std::transform(found.begin(), found.end(), holds,
                     [](double value) { return static_cast<char>(value != 0); });
    });
  }

  void keep_box(const Vec3& minimum, const Vec3& maximum) {
    keep_places([&](const Vec3& x) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(x.a[axis] >= minimum.a[axis] && x.a[axis] <= maximum.a[axis])) return false;
      }
      return true;
    });
  }

  // Across the faces of a periodic box as far as the nearest image.
  void keep_sphere(const Vec3& center, double radius) {
    keep_places([&](const Vec3& x) {
      double d[3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        d[axis] = x.a[axis] - center.a[axis];
        if (periodic_box_) d[axis] = nearest_image(d[axis], (*periodic_box_)[axis]);
      }
      return std::hypot(d[0], d[1], d[2]) <= radius;
    });
  }

  template <class Holds>
  void keep_places(Holds&& holds) {
    const Column position = fields_.positions();
    const Vec3 origin = snapshot_.position_origin();
    keep_blocks([&](std::size_t first, std::size_t last, char* kept) {
      const ColumnStretch stretch(position, 3 * first, 3 * last);
      for (std::size_t i = first; i < last; ++i) {
        const Vec3 offset = {{static_cast<double>(stretch[3 * i]),
                              static_cast<double>(stretch[3 * i + 1]),
                              static_cast<double>(stretch[3 * i + 2])}};
        *kept++ = static_cast<char>(holds(Vec3(origin + offset)));
      }
    });
  }

  void keep_ids(const std::string& file) { keep_listed(wanted_ids(snapshot_, file)); }

  void keep_listed(const Ids& wanted) {
    const Ids own = fields_.ids();
    keep_if(
        [&](std::size_t i) { return std::binary_search(wanted.begin(), wanted.end(), own[i]); });
  }

  void keep_halo(const ParticleSet& set, const std::string& key) {
    const int type = fields_.info().type;
    const std::uint64_t number = *set.halo;
    const auto catalog = catalog_of(set, key, fields_, snapshot_);
    if (!catalog) {
      const Ids haloes = snapshot_.read_integers(type, "halo_id");
      keep_if([&](std::size_t i) { return haloes[i] == number; });
      return;
    }
    const HaloMembers members = read_halo(*catalog, number, type);
    if (members.ids) return keep_listed(*members.ids);
    if (members.sphere) return keep_halo_sphere(*members.sphere, *catalog);
    check_places(members, *catalog);
    keep_if([&](std::size_t i) { return members.has_place(snapshot_.place_in_file(type, i)); });
  }

  void keep_halo_sphere(const HaloSphere& sphere, const std::filesystem::path& catalog) {
    using namespace boost::qvm;
    const std::string unit = find_field(fields_.info(), "position")->unit;
    const auto ratio = ratio_of_known_units(sphere.unit, unit, unit_factors(snapshot_.info()));
    if (!ratio) {
      throw UsageError(fmt::format(
          "{}: the halo is a sphere in {}, but the positions of {} are in {}, expected a unit of "
          "length that is known; name it as read.units = {{position = \"kpc/h a\"}}",
          catalog.string(), sphere.unit, snapshot_.info().files.front().string(),
          unit.empty() ? "a unit that it does not say" : unit));
    }
    keep_sphere(*ratio * sphere.center, *ratio * sphere.radius);
  }

  // A snapshot of which only a part is read does not say how many there are.
  void check_places(const HaloMembers& members, const std::filesystem::path& catalog) const {
    const bool is_whole = fields_.info().particles_per_drawn == 1;
    for (const PlaceRange& range : members.places) {
      const bool fits =
          range.first <= fields_.count() && range.count <= fields_.count() - range.first;
      if (fits || !is_whole || range.count == 0) continue;
      throw DataError(fmt::format(
          "{}: the halo's particles of type {} are {} from number {} on, but {} has only {}; the "
          "catalog belongs to another snapshot",
          catalog.string(), fields_.info().type, range.count, range.first,
          snapshot_.info().files.front().string(), fields_.count()));
    }
  }

  const TypeFields& fields_;
  const Snapshot& snapshot_;
  std::optional<BoxSides> periodic_box_;
  ParticleRun run_;
  std::vector<bool> is_member_;
};

// Wind has a time of formation below 0 until it joins the gas again.
ParticleSet stars_by(const FieldInfo& time_of_formation) {
  ParticleSet stars;
  stars.where = {time_of_formation.file_name + " > 0"};
  return stars;
}

bool has_condition_on(const ParticleSet& set, const FieldInfo& field,
                      const ParticleTypeInfo& type) {
  for (const std::string& text : set.where) {
    const Formula condition = parse_condition(text, "where");
    for (const std::string& name : condition.fields()) {
      if (find_field(type, name) == &field) return true;
    }
  }
  return false;
}

void find_indices(const Component& component, const TypeFields& fields, const Snapshot& snapshot,
                  const std::optional<BoxSides>& periodic_box, const ParticleRun& run,
                  ParticleIndices& indices) {
  Membership selected(fields, snapshot, periodic_box, run);
  selected.keep(component.select, "select");
  Membership excluded(fields, snapshot, periodic_box, run);
  if (component.exclude.is_given()) excluded.keep(component.exclude, "exclude");
  if (const FieldInfo* const wind = find_wind(component, fields.info()))
    selected.keep(stars_by(*wind), "select");
  for (std::size_t i = run.begin; i < run.end; ++i) {
    const bool is_left_out = component.exclude.is_given() && excluded.has(i);
    if (selected.has(i) && !is_left_out) indices.push_back(i);
  }
}

// Of particles that are spread over ranks each selects its own.
ParticlePass pass_to_select(const Snapshot& snapshot, std::size_t count) {
  return snapshot.spread() ? ParticlePass(count) : pass_over_made(snapshot, count);
}

std::string text_of(const std::optional<Vec3>& v) {
  return v ? fmt::format("{} {} {}", v->a[0], v->a[1], v->a[2]) : "-";
}

std::string text_of(const ParticleSet& set) {
  return fmt::format("where {} ids {} halo {} of {} box {} {} sphere {} {} rim {}",
                     fmt::join(set.where, "; "), set.id_file,
                     set.halo ? fmt::format("{}", *set.halo) : "-", set.halo_catalog,
                     text_of(set.box_minimum), text_of(set.box_maximum), text_of(set.sphere_center),
                     set.sphere_radius ? fmt::format("{}", *set.sphere_radius) : "-",
                     set.sphere_rim ? fmt::format("{}", *set.sphere_rim) : "-");
}

void check_ids(const TypeFields& fields, const Snapshot& snapshot) {
  if (find_field(fields.info(), "id") == nullptr) snapshot.read_ids(fields.info().type);
}

void check_set(const ParticleSet& set, const std::string& key, const TypeFields& fields,
               const Snapshot& snapshot) {
  for (const std::string& text : set.where) {
    const Formula condition = condition_on(fields, text, key + ".where");
    check_formula(fields, condition, key + ".where");
    for (const std::string& name : condition.fields()) {
      if (canonical_field_name(name) == "id") check_ids(fields, snapshot);
    }
  }
  if (set.halo) catalog_of(set, key, fields, snapshot);
  if (set.id_file.empty()) return;
  wanted_ids(snapshot, set.id_file);
  check_ids(fields, snapshot);
}

}  // namespace

std::shared_ptr<const ParticleIndices> select_particles(
    const Component& component, const TypeFields& fields, const Snapshot& snapshot,
    const std::optional<BoxSides>& periodic_box) {
  const bool selects = component.select.is_given() || component.exclude.is_given() ||
                       find_wind(component, fields.info()) != nullptr;
  if (!selects) return nullptr;
  using Selected = std::shared_ptr<const ParticleIndices>;
  return snapshot.memory().get<Selected>(
      fmt::format("type {}: {}", fields.info().type, selection_key(component, periodic_box)),
      [&]() -> Selected {
        return std::make_shared<ParticleIndices>(
            pass_to_select(snapshot, fields.count())
                .collect<std::size_t>([&](const ParticleRun& run, ParticleIndices& indices) {
                  find_indices(component, fields, snapshot, periodic_box, run, indices);
                }));
      });
}

void check_selection(const Component& component, const TypeFields& fields,
                     const Snapshot& snapshot) {
  check_set(component.select, "select", fields, snapshot);
  check_set(component.exclude, "exclude", fields, snapshot);
}

std::string tell_found_catalog(const Component& component, const TypeFields& fields,
                               const Snapshot& snapshot) {
  for (const ParticleSet* const set : {&component.select, &component.exclude}) {
    if (!set->halo || !set->halo_catalog.empty()) continue;
    const auto catalog = catalog_of(*set, "select", fields, snapshot);
    if (catalog) return fmt::format("halo {} is looked up in {}", *set->halo, catalog->string());
  }
  return {};
}

namespace {

std::string tell_lost_ids(const std::string& file, const std::vector<TypeFields>& types,
                          const Snapshot& snapshot) {
  Ids wanted = wanted_ids(snapshot, file);
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<bool> is_there(wanted.size(), false);
  for (const TypeFields& type : types) {
    for (const std::uint64_t id : type.ids()) {
      const auto place = std::lower_bound(wanted.begin(), wanted.end(), id);
      if (place != wanted.end() && *place == id)
        is_there[static_cast<std::size_t>(place - wanted.begin())] = true;
    }
  }
  const auto lost = std::count(is_there.begin(), is_there.end(), false);
  if (lost == 0) return {};
  return fmt::format("{} of the {} ids in {} are those of none of its particles", lost,
                     wanted.size(), file);
}

}  // namespace

std::string tell_lost_ids(const Component& component, const std::vector<TypeFields>& types,
                          const Snapshot& snapshot) {
  std::string notes, numbers;
  for (const TypeFields& type : types)
    numbers += fmt::format(" {}", type.info().type);
  for (const std::string& file : {component.select.id_file, component.exclude.id_file}) {
    if (file.empty()) continue;
    const std::string note =
        snapshot.memory().get<std::string>(fmt::format("lost ids of types{} in {}", numbers, file),
                                           [&] { return tell_lost_ids(file, types, snapshot); });
    if (!note.empty()) notes += (notes.empty() ? "" : "; ") + note;
  }
  return notes;
}

const FieldInfo* find_wind(const Component& component, const ParticleTypeInfo& type) {
  constexpr int stars = 4;
  if (type.type != stars) return nullptr;
  for (const FieldInfo& field : type.fields) {
    if (field.file_name != "GFM_StellarFormationTime") continue;
    const bool is_named = has_condition_on(component.select, field, type) ||
                          has_condition_on(component.exclude, field, type);
    return is_named ? nullptr : &field;
  }
  return nullptr;
}

std::string selection_key(const Component& component, const std::optional<BoxSides>& periodic_box) {
  const auto& center = component.center.a;
  return fmt::format("center {} {} {} select {} exclude {} in box {}", center[0], center[1],
                     center[2], text_of(component.select), text_of(component.exclude),
                     periodic_box ? periodic_box->text() : "none");
}

Column gather(const Column& column, const std::shared_ptr<const ParticleIndices>& selected,
              std::size_t width, bool streams) {
  if (selected == nullptr || !column.is_array()) return column;
  const auto gathered = [column, selected, width](std::size_t first, std::size_t end) {
    return gather_in_order(column, width, end - first,
                           [&](std::size_t i) { return (*selected)[first + i]; });
  };
  if (!streams) return gathered(0, selected->size());
  return make_column(selected->size() * width, true,
                     [gathered, width](std::size_t begin, std::size_t end, float* values) {
                       const std::size_t first = begin / width;
                       const Column some = gathered(first, ceil_divide(end, width));
                       std::copy_n(some.data() + (begin - first * width), end - begin, values);
                     });
}

}  // namespace splotchcl
