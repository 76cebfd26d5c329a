#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>
#include <optional>

#include "load/derived_fields.h"
#include "load/type_fields.h"
#include "python/progress.h"
#include "python/source.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl::python {
namespace {

// Values of one field, which numpy takes as they lie.
struct Values {
  Column column;
  py::ssize_t count = 0;
  py::ssize_t width = 1;
};

py::buffer_info buffer_of(const Values& values) {
  constexpr auto size = static_cast<py::ssize_t>(sizeof(float));
  std::vector<py::ssize_t> shape = {values.count}, strides = {size * values.width};
  if (values.width > 1) {
    shape.push_back(values.width);
    strides.push_back(size);
  }
  constexpr bool is_read_only = true;
  return {const_cast<float*>(values.column.data()),  // read-only all the same
          size,
          py::format_descriptor<float>::format(),
          static_cast<py::ssize_t>(shape.size()),
          shape,
          strides,
          is_read_only};
}

Column as_array(const Column& column, std::uint64_t values) {
  if (column.is_array()) return column;
  return Column::owning(std::vector<float>(static_cast<std::size_t>(values), column[0]));
}

Values read_field(const Source& source, int type, const std::string& name) {
  const Snapshot& snapshot = source.snapshot();
  const ParticleTypeInfo& info = require_type(snapshot.info(), type);
  Values values;
  values.count = static_cast<py::ssize_t>(info.count);
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

py::buffer_info buffer_of(const Integers& integers) {
  constexpr bool is_read_only = true;
  return {const_cast<std::uint64_t*>(integers.values.data()),  // read-only all the same
          static_cast<py::ssize_t>(integers.values.size()), is_read_only};
}

Integers read_integers(const Snapshot& snapshot, int type, const std::string& name) {
  const FieldInfo* const field = find_field(require_type(snapshot.info(), type), name);
  if (field != nullptr && field->name == "id") return {snapshot.read_ids(type)};
  return {snapshot.read_integers(type, name)};
}

// Names in files may have any bytes.
py::str readable(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

py::list readable(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts)
    list.append(readable(text));
  return list;
}

py::dict describe(const ParticleTypeInfo& type) {
  py::dict fields;
  for (const FieldInfo& field : type.fields) {
    fields[readable(field.name)] =
        py::make_tuple(readable(field.file_name), field.values_per_particle, readable(field.unit));
  }
  py::dict text;
  text["type"] = type.type;
  text["count"] = type.count;
  text["mass"] = type.table_mass;
  text["fields"] = fields;
  text["derived"] = derivable_fields(type);
  return text;
}

// A number for a cube, else three.
py::object describe(const std::optional<BoxSides>& box) {
  if (!box) return py::none();
  if (box->is_cube()) return py::float_((*box)[0]);
  return py::make_tuple((*box)[0], (*box)[1], (*box)[2]);
}

py::dict describe(const Source& source) {
  const SnapshotInfo& info = source.snapshot().info();
  py::dict types;
  for (const ParticleTypeInfo& type : info.types)
    types[py::str(particle_type_name(type.type))] = describe(type);
  py::dict text;
  text["format"] = info.format;
  text["files"] = info.files;
  text["time"] = info.time;
  text["redshift"] = info.redshift;
  text["box_size"] = describe(info.box_size);
  text["hubble_parameter"] = info.hubble_parameter;
  text["notes"] = readable(info.notes);
  text["types"] = types;
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

void bind_values(py::module_& module) {
  py::class_<Values>(module, "Values", py::buffer_protocol()).def_buffer([](const Values& values) {
    return buffer_of(values);
  });
  py::class_<Integers>(module, "Integers", py::buffer_protocol())
      .def_buffer([](const Integers& integers) { return buffer_of(integers); });
}

void bind_particles(py::module_& module) {
  py::class_<ParticleArrays, Source, std::shared_ptr<ParticleArrays>>(module, "ParticleArrays")
      .def(py::init<>())
      .def("set_field", &ParticleArrays::set_field)
      .def("set_mass", &ParticleArrays::set_mass)
      .def("clear", &ParticleArrays::clear)
      .def("set_box_size",
           [](ParticleArrays& particles, const std::array<double, 3>& sides) {
             particles.set_box_size(vector_of(sides));
           })
      .def("set_time", &ParticleArrays::set_time)
      .def("set_scale_factor", &ParticleArrays::set_scale_factor)
      .def("set_origin", [](ParticleArrays& particles, const std::array<double, 3>& origin) {
        particles.set_origin(vector_of(origin));
      });
}

}  // namespace

void bind_sources(py::module_& module) {
  bind_values(module);
  py::class_<Source, std::shared_ptr<Source>>(module, "Source")
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
  module.def("is_unit", &is_unit);
  module.def("ratio_of_units",
             [](const std::string& from, const std::string& to, const Source& source) {
               return without_python([&] {
                 return source.in_turn([&](const Snapshot& s) {
                   return ratio_of_known_units(from, to, unit_factors(s.info()));
                 });
               });
             });
  module.def("canonical_field_name", &canonical_field_name);
  module.def("find_particle_type", &find_particle_type);
  module.def("particle_type_name", &particle_type_name);
}

}  // namespace splotchcl::python
