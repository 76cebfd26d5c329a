#include "formats/hdf5/gadget_hdf5_fields.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

constexpr std::uint64_t most_columns_of_one = 64;

// The elements in the order of GIZMO, behind the whole, and of AREPO's GFM.
std::vector<std::string> elements_of(const std::string& label, std::uint64_t columns) {
  if (label == "Metallicity" && columns == 11)
    return {"", "He", "C", "N", "O", "Ne", "Mg", "Si", "S", "Ca", "Fe"};
  if (label == "GFM_Metals" && columns == 10)
    return {"H", "He", "C", "N", "O", "Ne", "Mg", "Si", "Fe", "others"};
  return {};
}

// SWIFT lists them elsewhere.
std::vector<std::string> names_of_swift(const Hdf5File& file, const std::string& label) {
  for (const char* const group : {"/SubgridScheme/NamedColumns/", "/NamedColumns/"}) {
    if (file.has(group + label)) return file.lines(group + label);
  }
  return {};
}

std::vector<std::string> names_of_parts(const Hdf5File& file, const Hdf5Dataset& dataset) {
  const std::uint64_t columns = dataset.values_per_row();
  std::vector<std::string> names = names_of_swift(file, dataset.label());
  if (names.size() != columns) names = elements_of(dataset.label(), columns);
  for (std::uint64_t i = names.size(); i < columns; ++i)
    names.push_back(std::to_string(i + 1));
  return names;
}

bool has_parts(const Hdf5Dataset& dataset) {
  return dataset.is_number() && dataset.shape.size() == 2 &&
         dataset.values_per_row() <= most_columns_of_one && dataset.values_per_row() > 1;
}

void add_parts(const Hdf5File& file, const Hdf5Dataset& dataset, const std::string& label,
               std::vector<Hdf5Field>& fields) {
  const std::vector<std::string> names = names_of_parts(file, dataset);
  for (std::uint64_t column = 0; column < names.size(); ++column) {
    Hdf5Dataset part = dataset;
    part.column = column;
    const std::string& name = names[column];
    fields.push_back({name.empty() ? label : label + "." + name, 1, std::move(part)});
  }
}

// What cannot be fields, for notes.
struct LeftOut {
  std::vector<std::string> of_other_lengths, others;
};

// `start` is before each label: that of the group in a type's group, and a point.
void add_fields_of(const Hdf5File& file, const std::string& group, const std::string& start,
                   std::uint64_t count, std::vector<Hdf5Field>& fields, LeftOut& left_out) {
  for (const Hdf5Dataset& dataset : file.datasets(group)) {
    const std::string label = start + dataset.label();
    const std::uint64_t values = dataset.values_per_row();
    if (dataset.shape.empty() || dataset.rows() != count) {
      left_out.of_other_lengths.push_back(fmt::format("{} ({})", label, dataset.rows()));
    } else if (dataset.is_number() && (values == 1 || values == 3)) {
      fields.push_back({label, static_cast<int>(values), dataset});
    } else if (has_parts(dataset)) {
      add_parts(file, dataset, label, fields);
    } else {
      left_out.others.push_back(label);
    }
  }
}

}  // namespace

std::vector<Hdf5Field> find_hdf5_fields(const Hdf5File& file, std::uint64_t count, int type,
                                        std::vector<std::string>& notes) {
  const std::string group = fmt::format("PartType{}", type);
  std::vector<Hdf5Field> fields;
  LeftOut left_out;
  add_fields_of(file, group, "", count, fields, left_out);
  for (const std::string& inner : file.groups(group))
    add_fields_of(file, group + "/" + inner, inner + ".", count, fields, left_out);
  if (!left_out.of_other_lengths.empty()) {
    notes.push_back(fmt::format("left out of {}, as they have other than {} rows: {}", group, count,
                                fmt::join(left_out.of_other_lengths, ", ")));
  }
  if (!left_out.others.empty()) {
    notes.push_back(
        fmt::format("left out of {}, as they are not one or a few numbers per particle: {}", group,
                    fmt::join(left_out.others, ", ")));
  }
  return fields;
}

}  // namespace splotchcl
