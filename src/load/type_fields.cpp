#include "load/type_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "between/interpolation.h"
#include "common/words.h"
#include "load/derived_fields.h"
#include "load/missing_sizes.h"
#include "load/passes.h"
#include "load/placement.h"
#include "parallel/for_blocks.h"
#include "ranks/spread_particles.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "smoothing/smoothing_lengths.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Whether a value of the column is wanted.
template <class IsWanted>
bool has_value(const Column& column, const ParticlePass& pass, const IsWanted& is_wanted) {
  const auto find_one = [&](const ParticleRun& run, std::vector<std::size_t>& found) {
    for_stretches(run, [&](std::size_t begin, std::size_t end) {
      if (!found.empty()) return;
      const ColumnStretch stretch(column, begin, end);
      for (std::size_t i = begin; i < end && found.empty(); ++i) {
        if (is_wanted(stretch[i])) found.push_back(i);
      }
    });
  };
  return !pass.collect<std::size_t>(find_one).empty();
}

bool all_are_sizes(const Column& column, const ParticlePass& pass) {
  return !has_value(column, pass, [](float h) { return !is_smoothing_length(h); });
}

// As codes may write that do without. The first value tells nearly always that they do not.
bool are_all_zero(const Column& column, const ParticlePass& pass) {
  return !has_value(column, pass, [](float h) { return h != 0; });
}

}  // namespace

TypeFields::TypeFields(const Snapshot& snapshot, const ParticleTypeInfo& type, std::string label,
                       const Vec3& center, std::function<void(const std::string&)> note,
                       MissingSizes sizes)
    : snapshot_(&snapshot),
      type_(&type),
      label_(std::move(label)),
      center_(center),
      note_(std::move(note)),
      sizes_(std::move(sizes)) {}

Column TypeFields::positions() const {
  Column position = snapshot_->read(type_->type, "position");
  const auto between = interpolated(position);
  if (between && !between->interpolation().note.empty()) say(between->interpolation().note);
  return position;
}

std::vector<std::uint64_t> TypeFields::ids() const {
  return snapshot_->read_ids(type_->type);
}

Column TypeFields::scalars(const std::string& field, const std::string& key) const {
  if (has_plain(field) || !Formula::may_be(field)) return plain_scalars(field, key);
  const Formula formula = Formula::parse(field, what(key));
  check_formula(*this, formula, key);
  const auto& c = center_.a;
  return remembered(fmt::format("formula {} from {} {} {}", field, c[0], c[1], c[2]),
                    [&] { return formula_column(formula, key); });
}

bool TypeFields::has_plain(const std::string& field) const {
  return find_field(*type_, field) != nullptr || find_derived(field, "").has_value();
}

Column TypeFields::plain_scalars(const std::string& field, const std::string& key) const {
  if (const FieldInfo* const info = find_field(*type_, field)) {
    if (info->values_per_particle == 1) return snapshot_->read(type_->type, field);
    if (info->values_per_particle != 3) refuse_width(*info, field, key, "1 or 3");
    return remembered("length of " + field,
                      [&] { return lengths_of_vectors(field_column(*info), streams()); });
  }
  if (const auto derive = find_derived(field, key)) return (*derive)();
  refuse_field(field, key);
}

Column TypeFields::formula_column(const Formula& formula, const std::string& key) const {
  constexpr std::size_t block = std::size_t{1} << 16;
  const std::shared_ptr<const FormulaValues> values = formula_values(*this, formula, key);
  const auto make = [values](std::size_t begin, std::size_t end, float* out) {
    std::vector<double> exact(end - begin);
    values->evaluate(begin, end, exact.data());
    std::transform(exact.begin(), exact.end(), out,
                   [](double value) { return static_cast<float>(value); });
  };
  if (streams()) return make_column(count(), true, make);
  std::vector<float> all(count());
  for_blocks(all.size(), block,
             [&](std::size_t begin, std::size_t end) { make(begin, end, all.data() + begin); });
  return Column::owning(std::move(all));
}

// Coordinates in double precision, as they are stored.
FieldValues TypeFields::plain_values(const std::string& field, const std::string& key) const {
  const auto [vectors, axis] = find_axis(*type_, field);
  const bool is_coordinate =
      find_field(*type_, field) == nullptr && vectors != nullptr && vectors->name == "position";
  if (is_coordinate) {
    return [position = positions(), origin = snapshot_->position_origin().a[axis], a = axis](
               std::size_t begin, std::size_t end, double* out) {
      const ColumnStretch stretch(position, 3 * begin, 3 * end);
      for (std::size_t i = begin; i < end; ++i)
        *out++ = origin + static_cast<double>(stretch[3 * i + a]);
    };
  }
  return [column = plain_scalars(field, key)](std::size_t begin, std::size_t end, double* out) {
    const ColumnStretch stretch(column, begin, end);
    for (std::size_t i = begin; i < end; ++i)
      *out++ = static_cast<double>(stretch[i]);
  };
}

namespace {

// "ParticleIDs", "halo_id", "ParentID".
bool is_called_id(const std::string& name) {
  const std::string lower = lower_case(name);
  const auto ends_with = [&lower](const std::string& end) {
    return lower.size() >= end.size() &&
           lower.compare(lower.size() - end.size(), end.size(), end) == 0;
  };
  return ends_with("id") || ends_with("ids");
}

}  // namespace

std::optional<WholeNumbers> TypeFields::whole_numbers(const std::string& field,
                                                      bool are_large) const {
  using Numbers = std::vector<std::uint64_t>;
  if (canonical_field_name(field) == "id")
    return WholeNumbers{std::make_shared<const Numbers>(ids()), false};
  const FieldInfo* const info = find_field(*type_, field);
  const bool may_be_ids = info != nullptr && info->values_per_particle == 1 &&
                          (are_large || info->name == "halo_id" || is_called_id(info->name));
  if (!may_be_ids) return std::nullopt;
  try {
    auto numbers =
        std::make_shared<const Numbers>(snapshot_->read_integers(type_->type, info->name));
    // As a float the first that may be below 0 tells whether it is.
    constexpr std::uint64_t first_negative = std::uint64_t{1} << 63;
    const auto large = std::find_if(numbers->begin(), numbers->end(),
                                    [](std::uint64_t number) { return number >= first_negative; });
    const bool are_signed =
        large == numbers->end() ||
        field_column(*info)[static_cast<std::size_t>(large - numbers->begin())] < 0;
    return WholeNumbers{std::move(numbers), are_signed};
  } catch (const DataError&) {  // numbers with a point, or none between two snapshots
    return std::nullopt;
  }
}

void TypeFields::check_scalars(const std::string& field, const std::string& key) const {
  if (has_plain(field)) return;
  if (!Formula::may_be(field)) refuse_field(field, key);
  check_formula(*this, Formula::parse(field, what(key)), key);
}

Column TypeFields::vectors(const std::string& field, const std::string& key) const {
  return field_column(require_vectors(field, key));
}

void TypeFields::check_vectors(const std::string& field, const std::string& key) const {
  require_vectors(field, key);
}

const FieldInfo& TypeFields::require_vectors(const std::string& field,
                                             const std::string& key) const {
  const FieldInfo* const info = find_field(*type_, field);
  if (info == nullptr) refuse_field(field, key);
  if (info->values_per_particle != 3) refuse_width(*info, field, key, "3");
  return *info;
}

Column TypeFields::field_column(const FieldInfo& field) const {
  return snapshot_->read(type_->type, field.name);
}

std::optional<std::function<Column()>> TypeFields::find_derived(const std::string& field,
                                                                const std::string& key) const {
  const std::string canonical = canonical_field_name(field);
  if (canonical == "smoothing_length") return [this] { return smoothing_lengths(); };
  if (canonical == "density") return [this] { return densities(); };
  if (canonical == "mass" && type_->table_mass) return [this] { return masses(); };
  if (canonical == "temperature" && find_field(*type_, "internal_energy") != nullptr) {
    return [this, key] {
      return remembered("temperature", [&] { return derived_temperatures(key); });
    };
  }
  if (equal_ignoring_case(field, "speed") && find_field(*type_, "velocity") != nullptr) {
    return [this, key] { return scalars("velocity", key); };
  }
  if (equal_ignoring_case(field, "radius")) {
    return [this] {
      const auto& c = center_.a;
      return remembered(fmt::format("radius from {} {} {}", c[0], c[1], c[2]), [&] {
        return distances(positions(), snapshot_->position_origin(), center_, streams());
      });
    };
  }
  if (const auto [vector, axis] = find_axis(*type_, field); vector != nullptr) {
    return [this, info = vector, a = axis] {
      const double added = info->name == "position" ? snapshot_->position_origin().a[a] : 0;
      return remembered(fmt::format("axis {} of {}", a, info->name),
                        [&] { return axis_of_vectors(field_column(*info), a, added, streams()); });
    };
  }
  return std::nullopt;
}

Column TypeFields::derived_temperatures(const std::string& key) const {
  const FieldInfo& energy = *find_field(*type_, "internal_energy");
  const std::optional<double> unit = energy_unit_in_cgs(snapshot_->info(), energy);
  if (!unit) {
    throw UsageError(fmt::format(
        "{}: {} is \"temperature\", which needs the unit of internal_energy, but {} has {}, "
        "expected that of an energy per mass, such as (km/s)^2 or erg/g; use internal_energy "
        "itself",
        label_, key, file(), energy.unit.empty() ? "none" : "\"" + energy.unit + "\""));
  }
  const FieldInfo* const electrons = find_field(*type_, "electron_abundance");
  std::string assumed;
  if (energy.unit.empty()) assumed = "internal energies taken to be in (km/s)^2, Gadget's unit";
  if (electrons == nullptr) {
    assumed += fmt::format("{}all gas to be ionised", assumed.empty() ? "" : ", and ");
  }
  say(fmt::format("type {} has no temperature in the file; it follows from internal_energy{}{}",
                  type_->type, assumed.empty() ? "" : ", with ", assumed));
  return temperatures(field_column(energy),
                      electrons != nullptr ? field_column(*electrons) : Column(), *unit, count(),
                      streams());
}

Column TypeFields::masses() const {
  if (find_field(*type_, "mass") != nullptr) return snapshot_->read(type_->type, "mass");
  if (type_->table_mass) return Column::uniform(static_cast<float>(*type_->table_mass));
  throw UsageError(fmt::format(
      "{}: weight is \"mass\", but particles of type {} in {} have no masses{}; give them "
      "masses, or set weight to \"constant\"",
      label_, type_->type, file(), why_left_out(snapshot_->info(), "mass")));
}

Column TypeFields::densities() const {
  return remembered("density", [this] {
    const Column mass = has_masses(*type_) ? masses() : Column::uniform(1);
    const Column h = smoothing_lengths();
    say(fmt::format("type {} has no density in the file; estimated from its smoothing lengths",
                    type_->type));
    // Neighbors that lengths reach to are those that are read.
    const bool is_part = type_->particles_per_drawn != 1;
    const double stands_for = is_part && reach_to_neighbors() ? type_->particles_per_drawn : 1;
    return densities_from_smoothing_lengths(mass, h, count(), stands_for * sizes_.neighbors,
                                            streams());
  });
}

// Where they are not all 0, on which ranks that have parts of their own would have to agree.
std::optional<Column> TypeFields::own_lengths() const {
  if (find_field(*type_, "smoothing_length") == nullptr) return std::nullopt;
  Column own = snapshot_->read(type_->type, "smoothing_length");
  const bool count = snapshot_->spread() || !are_all_zero(own, pass_over(*snapshot_, type_->type));
  return count ? std::optional(std::move(own)) : std::nullopt;
}

bool TypeFields::reach_to_neighbors() const {
  std::string reason;
  return !own_lengths() && !lengths_from_volumes(reason);
}

Column TypeFields::smoothing_lengths() const {
  if (std::optional<Column> own = own_lengths()) return *std::move(own);
  if (find_field(*type_, "smoothing_length") != nullptr) {
    say(fmt::format("the smoothing lengths of type {} in the file are all 0: they do not count",
                    type_->type));
  }
  return remembered(fmt::format("smoothing_length {}", sizes_.neighbors),
                    [this] { return find_lengths(); });
}

// Of the file's densities, in the unit of mass over the cube of that of positions. None where these
// cannot be compared.
std::optional<double> TypeFields::unit_of_densities() const {
  const FieldInfo* const density = find_field(*type_, "density");
  if (density == nullptr) return 1;
  return unit_ratio(density->unit, unit_of_matching_density(*type_),
                    unit_factors(snapshot_->info()));
}

std::optional<double> TypeFields::unit_of_volumes() const {
  return unit_ratio(find_field(*type_, "volume")->unit, unit_of_matching_volume(*type_),
                    unit_factors(snapshot_->info()));
}

Column TypeFields::volumes(const std::string& key, double unit) const {
  const std::optional<double> of_densities = unit_of_densities();
  if (!of_densities) {
    throw UsageError(fmt::format(
        "{}: {} needs volumes, which are mass over density, but the densities of type {} in {} are "
        "in \"{}\", expected a unit that can be compared with {}, those of its masses and "
        "positions",
        label_, key, type_->type, file(), find_field(*type_, "density")->unit,
        unit_of_matching_density(*type_)));
  }
  return volumes_of(masses(), scalars("density", key), *of_densities * unit, count(), streams());
}

bool TypeFields::has_density_and_mass() const {
  return has_masses(*type_) && find_field(*type_, "density") != nullptr;
}

// From densities and masses or the volumes of cells, where they give all particles a size.
std::optional<Column> TypeFields::lengths_from_volumes(std::string& reason) const {
  const bool has_density = has_density_and_mass();
  if (!has_density && find_field(*type_, "volume") == nullptr) return std::nullopt;
  const std::optional<double> unit = has_density ? unit_of_densities() : unit_of_volumes();
  if (!unit) {
    reason = fmt::format(
        ", and the unit of its {} is not comparable with {}", has_density ? "densities" : "volumes",
        has_density ? unit_of_matching_density(*type_) : unit_of_matching_volume(*type_));
    return std::nullopt;
  }
  const Column lengths =
      has_density
          ? smoothing_lengths_from_density(masses(), snapshot_->read(type_->type, "density"),
                                           count(), sizes_.neighbors, streams(), *unit)
          : smoothing_lengths_from_volume(snapshot_->read(type_->type, "volume"), count(),
                                          sizes_.neighbors, streams(), *unit);
  if (all_are_sizes(lengths, pass_over(*snapshot_, type_->type))) return lengths;
  reason = has_density ? ", and some of its densities or masses are not above 0"
                       : ", and some of its volumes are not above 0";
  return std::nullopt;
}

Column TypeFields::find_lengths() const {
  std::string reason;
  if (const auto lengths = lengths_from_volumes(reason)) {
    say(fmt::format("type {} has no smoothing lengths in the file; they follow from {}",
                    type_->type,
                    has_density_and_mass() ? "density and mass" : "the volumes of its cells"));
    return *lengths;
  }
  say(
      fmt::format("type {} has no smoothing lengths in the file{}; each particle is given one that "
                  "reaches to neighbour {}",
                  type_->type, reason, sizes_.neighbors));
  const Column position = positions();
  if (const auto spread = snapshot_->spread()) {
    return find_spread_sizes(*spread, type_->type, position,
                             snapshot_->place_in_file(type_->type, 0), sizes_, periodic_box());
  }
  return find_sizes_by_neighbors(*snapshot_, type_->type, position, periodic_box(), sizes_,
                                 [this](const std::string& text) { say(text); });
}

// The box of the header, unless particles lie outside of one period of it.
std::optional<BoxSides> TypeFields::periodic_box() const {
  const std::optional<BoxSides>& box = snapshot_->info().box_size;
  if (!box) return std::nullopt;
  const PositionExtent extent = extent_of_type(*snapshot_, type_->type);
  if (lies_in_one_period(extent, *box)) return box;
  say(tell_box_is_not_used(*box, extent));
  return std::nullopt;
}

// Of what ranks share each makes what it asks for.
bool TypeFields::streams() const {
  return has_shared_passes(*snapshot_);
}

// Notes go with what they are about: whoever finds it in the memory hears them, too.
Column TypeFields::remembered(const std::string& what, const std::function<Column()>& make) const {
  const std::string key = fmt::format("type {}: {}", type_->type, what);
  const Made& made = snapshot_->memory().get<Made>(key, [&] {
    const auto first = static_cast<std::ptrdiff_t>(said_.size());
    Made fresh;
    fresh.column = make();
    fresh.notes.assign(said_.begin() + first, said_.end());
    return fresh;
  });
  for (const std::string& note : made.notes)
    say(note);
  return made.column;
}

void TypeFields::say(const std::string& text) const {
  said_.push_back(text);
  note_(text);
}

void TypeFields::refuse_field(const std::string& field, const std::string& key) const {
  std::vector<std::string> names;
  for (const FieldInfo& known : type_->fields)
    names.push_back(known.name);
  const std::vector<std::string> derived = derivable_fields(*type_);
  std::vector<std::string> all = names;
  all.insert(all.end(), derived.begin(), derived.end());
  throw UsageError(fmt::format(
      "{}: {} is \"{}\", which particles of type {} in {} do not have{}, expected one of {}, or, "
      "derived, {}{}",
      label_, key, field, type_->type, file(), why_left_out(snapshot_->info(), field),
      fmt::join(names, ", "), fmt::join(derived, ", "), did_you_mean(nearest_name(field, all))));
}

void TypeFields::refuse_width(const FieldInfo& info, const std::string& field,
                              const std::string& key, const char* expected) const {
  throw UsageError(
      fmt::format("{}: {} is \"{}\", which has {} per particle, expected a field with {}", label_,
                  key, field, counted(info.values_per_particle, "value"), expected));
}

std::string TypeFields::file() const {
  return snapshot_->info().files.front().string();
}

}  // namespace splotchcl
