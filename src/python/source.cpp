#include "python/source.h"

#include <mutex>
#include <optional>
#include <utility>

#include "load/derived_fields.h"
#include "load/type_fields.h"
#include "python/progress.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl::python {

void Turn::lock() {
  if (owner_ == std::this_thread::get_id()) {
    throw UsageError(
        "a progress callable uses the renderer or the particles that call it, expected others; do "
        "it when the picture is drawn");
  }
  mutex_.lock();
  owner_ = std::this_thread::get_id();
}

void Turn::unlock() {
  owner_ = std::thread::id();
  mutex_.unlock();
}

namespace {

template <typename Change>
void change(Turn& turn, Change&& work) {
  without_python([&] {
    const std::lock_guard<Turn> mine(turn);
    work();
  });
}

void set_numbers(ArraySnapshot& arrays, int type, const std::string& field,
                 const py::ArrayOfNumbers& values) {
  using Kind = py::ArrayOfNumbers::Kind;
  switch (values.kind) {
    case Kind::float32:
      return arrays.set_field(type, field, static_cast<const float*>(values.first), values.count,
                              values.width, values.owner);
    case Kind::float64:
      return arrays.set_field(type, field, static_cast<const double*>(values.first), values.count,
                              values.width);
    case Kind::int64:
      return arrays.set_field(type, field, static_cast<const std::int64_t*>(values.first),
                              values.count);
    case Kind::uint64:
      return arrays.set_field(type, field, static_cast<const std::uint64_t*>(values.first),
                              values.count);
  }
}

}  // namespace

ParticleArrays::ParticleArrays() : ParticleArrays(std::make_shared<ArraySnapshot>()) {}

void ParticleArrays::set_field(int type, const std::string& field, const py::ArrayOfNumbers& values,
                               const std::string& unit) {
  change(turn(), [&] {
    set_numbers(*arrays_, type, field, values);
    arrays_->set_unit(type, field, unit);
  });
}

void ParticleArrays::set_mass(int type, double mass) {
  change(turn(), [&] { arrays_->set_mass(type, mass); });
}

void ParticleArrays::clear(int type) {
  change(turn(), [&] { arrays_->clear(type); });
}

void ParticleArrays::set_box_size(const Vec3& sides) {
  change(turn(), [&] { arrays_->set_box_size(BoxSides(sides)); });
}

void ParticleArrays::set_time(double time) {
  change(turn(), [&] { arrays_->set_time(time); });
}

void ParticleArrays::set_scale_factor(double scale_factor) {
  change(turn(), [&] { arrays_->set_scale_factor(scale_factor); });
}

void ParticleArrays::set_origin(const Vec3& origin) {
  change(turn(), [&] { arrays_->set_position_origin(origin); });
}

namespace {

// Values of one field, which numpy takes as they lie.
struct Values {
  Column column;
  std::int64_t count = 0;
  std::int64_t width = 1;
};

py::ArrayLayout layout_of(const Values& values) {
  py::ArrayLayout layout = {values.column.data(), "f4", {values.count}};
  if (values.width > 1) layout.shape.push_back(values.width);
  return layout;
}

Column as_array(const Column& column, std::uint64_t values) {
  if (column.is_array()) return column;
  return Column::owning(std::vector<float>(static_cast<std::size_t>(values), column[0]));
}

Values read_field(const Source& source, int type, const std::string& name) {
  const Snapshot& snapshot = source.snapshot();
  const ParticleTypeInfo& info = require_type(snapshot.info(), type);
  Values values;
  values.count = static_cast<std::int64_t>(info.count);
  const FieldInfo* const stored = find_field(info, name);
  if (stored != nullptr && !stored->file_name.empty()) {
    values.width = stored->values_per_particle;
    values.column = snapshot.read(type, name);
  } else {
    const TypeFields fields(snapshot, info, particle_type_name(type), {{0, 0, 0}},
                            [](const std::string&) {});
    values.column = name == "smoothing_length" ? fields.smoothing_lengths()
                    : name == "mass"           ? fields.masses()
                                               : fields.scalars(name, "field");
  }
  values.column = as_array(values.column, info.count * static_cast<std::uint64_t>(values.width));
  return values;
}

// Identifiers, which floats would not hold.
struct Integers {
  std::vector<std::uint64_t> values;
};

py::ArrayLayout layout_of(const Integers& integers) {
  return {integers.values.data(), "u8", {static_cast<std::int64_t>(integers.values.size())}};
}

Integers read_integers(const Snapshot& snapshot, int type, const std::string& name) {
  const FieldInfo* const field = find_field(require_type(snapshot.info(), type), name);
  if (field != nullptr && field->name == "id") return {snapshot.read_ids(type)};
  return {snapshot.read_integers(type, name)};
}

// Names in files may have any bytes.
py::Object readable(const std::string& text) {
  return py::text_of(text, "replace");
}

std::vector<py::Object> readable(const std::vector<std::string>& texts) {
  std::vector<py::Object> objects;
  for (const std::string& text : texts)
    objects.push_back(readable(text));
  return objects;
}

py::Dict describe(const ParticleTypeInfo& type) {
  py::Dict fields;
  for (const FieldInfo& field : type.fields) {
    fields.set(
        readable(field.name),
        py::make_tuple(readable(field.file_name), field.values_per_particle, readable(field.unit)));
  }
  py::Dict text;
  text.set("type", type.type);
  text.set("count", type.count);
  text.set("particles_per_read", type.particles_per_drawn);
  text.set("mass", type.table_mass);
  text.set("fields", fields);
  text.set("derived", derivable_fields(type));
  return text;
}

// A number for a cube, else three.
py::Object describe(const std::optional<BoxSides>& box) {
  if (!box) return py::none();
  if (box->is_cube()) return py::to((*box)[0]);
  return py::make_tuple((*box)[0], (*box)[1], (*box)[2]);
}

py::Dict describe(const Source& source) {
  const SnapshotInfo& info = source.snapshot().info();
  py::Dict types;
  for (const ParticleTypeInfo& type : info.types)
    types.set(particle_type_name(type.type), describe(type));
  py::Dict text;
  text.set("format", info.format);
  text.set("files", info.files);
  text.set("time", info.time);
  text.set("redshift", info.redshift);
  text.set("box_size", describe(info.box_size));
  text.set("hubble_parameter", info.hubble_parameter);
  text.set("notes", readable(info.notes));
  text.set("types", types);
  return text;
}

ReadSettings read_settings(const std::vector<std::string>& settings) {
  return apply_settings(Scene(), settings).read;
}

// Whether maps of snapshots that do not say a and h can read a unit; of the dimension of `like`,
// where that is not empty.
bool is_unit(const std::string& text, const std::string& like) {
  try {
    const Unit unit = parse_unit(text, {}, "unit");
    return like.empty() || same_dimension(unit, parse_unit(like, {}, "unit"));
  } catch (const UsageError&) {
    return false;
  }
}

Vec3 vector_of(const std::array<double, 3>& values) {
  return {{values[0], values[1], values[2]}};
}

void bind_values(py::Module& module) {
  py::Class<Values>(module, "splotchcl._core.Values")
      .property("__array_interface__", [](const Values& values) { return layout_of(values); });
  py::Class<Integers>(module, "splotchcl._core.Integers")
      .property("__array_interface__",
                [](const Integers& integers) { return layout_of(integers); });
}

void bind_particles(py::Module& module) {
  py::Class<ParticleArrays>(module, "splotchcl._core.ParticleArrays")
      .init<>()
      .def("set_field", py::function<&ParticleArrays::set_field>)
      .def("set_mass", py::function<&ParticleArrays::set_mass>)
      .def("clear", py::function<&ParticleArrays::clear>)
      .def("set_box_size",
           [](ParticleArrays& particles, const std::array<double, 3>& sides) {
             particles.set_box_size(vector_of(sides));
           })
      .def("set_time", py::function<&ParticleArrays::set_time>)
      .def("set_scale_factor", py::function<&ParticleArrays::set_scale_factor>)
      .def("set_origin", [](ParticleArrays& particles, const std::array<double, 3>& origin) {
        particles.set_origin(vector_of(origin));
      });
}

}  // namespace

void bind_sources(py::Module& module) {
  bind_values(module);
  py::Class<Source>(module, "splotchcl._core.Source")
      .def("describe",
           [](const Source& source) {
             // Arrays may be set meanwhile.
             std::unique_lock<Turn> mine(source.turn(), std::defer_lock);
             without_python([&] { mine.lock(); });
             return describe(source);
           })
      .def("position_origin",
           [](const Source& source) {
             const Vec3 origin = without_python([&] {
               return source.in_turn([](const Snapshot& s) { return s.position_origin(); });
             });
             return std::array<double, 3>{origin.a[0], origin.a[1], origin.a[2]};
           })
      .def("canonical_name",
           [](const Source& source, int type, const std::string& name) -> std::string {
             return without_python([&] {
               return source.in_turn([&](const Snapshot& s) {
                 const FieldInfo* const field = find_field(require_type(s.info(), type), name);
                 return field == nullptr ? name : field->name;
               });
             });
           })
      .def("read_integers",
           [](const Source& source, int type, const std::string& name) {
             return without_python([&] {
               return source.in_turn(
                   [&](const Snapshot& s) { return read_integers(s, type, name); });
             });
           })
      .def("read", [](const Source& source, int type, const std::string& name) {
        return without_python([&] {
          const std::lock_guard<Turn> mine(source.turn());
          source.refresh();
          return read_field(source, type, name);
        });
      });
  bind_particles(module);
  module.def("open_snapshot",
             [](const std::filesystem::path& path, const std::vector<std::string>& settings) {
               return without_python([&] {
                 return std::make_shared<Source>(open_snapshot_for(path, read_settings(settings)));
               });
             });
  module.def("is_unit", py::function<&is_unit>);
  module.def("ratio_of_units",
             [](const std::string& from, const std::string& to, const Source& source) {
               return without_python([&] {
                 return source.in_turn([&](const Snapshot& s) {
                   return ratio_of_known_units(from, to, unit_factors(s.info()));
                 });
               });
             });
  module.def("canonical_field_name", py::function<&canonical_field_name>);
  module.def("find_particle_type", py::function<&find_particle_type>);
  module.def("particle_type_name", py::function<&particle_type_name>);
}

}  // namespace splotchcl::python
