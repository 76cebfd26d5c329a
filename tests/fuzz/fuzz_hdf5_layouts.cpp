// Layouts without a header: groups in groups, records, steps, constants, tables of texts and what
// read.columns names. As in fuzz_hdf5 the bytes are the plan of a file that HDF5 itself writes.
#include <array>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_values.h"
#include "fuzz/fuzz.h"
#include "fuzz/plan.h"

namespace {

using namespace splotchcl;
using namespace splotchcl::test;
using fuzz::Plan;
using Handle = Hdf5Handle<H5Tclose>;

const std::array<const char*, 16> groups = {"",
                                            "data/1",
                                            "data/1/particles/e",
                                            "data/1/particles/e/position",
                                            "data/1/particles/e/positionOffset",
                                            "data/1/particles/e/positionOffset/x",
                                            "data/2/particles/e",
                                            "data/2/particles/gas/pos",
                                            "table/columns",
                                            "table/columns/x",
                                            "table/columns/y",
                                            "table/columns/z",
                                            "Step#0",
                                            "Step#01",
                                            "df",
                                            "stars/a/b/c/d/e/f/g"};
const std::array<const char*, 18> names = {"x",
                                           "y",
                                           "z",
                                           "data",
                                           "mask",
                                           "value",
                                           "position",
                                           "pos",
                                           "vel",
                                           "mass",
                                           "id",
                                           "block0_items",
                                           "block0_values",
                                           "list",
                                           "list.__table_column_meta__",
                                           "a:b",
                                           "step",
                                           "r"};
const std::array<const char*, 10> attributes = {
    "value",   "shape", "unitSI",  "unitDimension", "time",
    "openPMD", "units", "BoxSize", "scale_factor",  "add_offset"};
const std::array<double, 12> numbers = {0,  1,    2,     3,      4,   5,
                                        -1, 1e15, 1e300, 1e-300, 0.5, 4294967296.0};

hid_t number_type(std::size_t choice) {
  const std::array<hid_t, 6> types = {H5T_NATIVE_FLOAT, H5T_NATIVE_DOUBLE, H5T_IEEE_F32BE,
                                      H5T_NATIVE_INT8,  H5T_STD_U64BE,     H5T_NATIVE_INT32};
  return types[choice % types.size()];
}

// A number, an array of them, a text, or records.
Handle member_type(Plan& plan, int depth);

Handle record_type(Plan& plan, int depth) {
  std::vector<Handle> members;
  std::size_t bytes = 0;
  const std::size_t count = 1 + plan.below(5);
  for (std::size_t i = 0; i < count; ++i) {
    members.push_back(member_type(plan, depth));
    bytes += H5Tget_size(members.back().id());
  }
  Handle record(H5Tcreate(H5T_COMPOUND, bytes + plan.below(3)));
  std::size_t offset = 0;
  for (const Handle& member : members) {
    H5Tinsert(record.id(), plan.one_of(names), offset, member.id());
    offset += H5Tget_size(member.id());
  }
  return record;
}

Handle member_type(Plan& plan, int depth) {
  constexpr int deepest = 6;
  switch (plan.below(6)) {
    case 0: {
      const std::array<hsize_t, 2> shape = {1 + plan.below(4), 1 + plan.below(2)};
      return Handle(H5Tarray_create2(number_type(plan.below(6)),
                                     1 + static_cast<unsigned>(plan.below(2)), shape.data()));
    }
    case 1: {
      Handle text(H5Tcopy(H5T_C_S1));
      H5Tset_size(text.id(), 1 + plan.below(8));
      return text;
    }
    case 2:
      if (depth < deepest) return record_type(plan, depth + 1);
      break;
    default:
      break;
  }
  return Handle(H5Tcopy(number_type(plan.below(6))));
}

void add_dataset(const Hdf5Output& file, const std::string& path, const Handle& type, Plan& plan) {
  std::vector<hsize_t> shape(plan.below(3));
  for (hsize_t& side : shape)
    side = plan.below(6);
  if (shape.size() == 2 && plan.below(2) != 0) shape[plan.below(2)] = 3;
  const Hdf5Handle<H5Sclose> space(
      shape.empty() ? H5Screate(H5S_SCALAR)
                    : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
  const Hdf5Handle<H5Pclose> links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), path.c_str(), type.id(), space.id(),
                                                links.id(), H5P_DEFAULT, H5P_DEFAULT));
  if (!dataset.is_valid() || plan.below(8) == 0) return;  // never written
  std::size_t bytes = H5Tget_size(type.id());
  for (const hsize_t side : shape)
    bytes *= side;
  std::string content(bytes, '\0');
  for (char& byte : content)
    byte = static_cast<char>(plan.below(256));
  if (bytes > 0) H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, content.data());
}

void add_attribute(const Hdf5Output& file, const std::string& owner, Plan& plan) {
  const std::string path = owner.empty() ? "/" : owner;
  const std::string name = plan.one_of(attributes);
  if (H5Oexists_by_name(file.id(), path.c_str(), H5P_DEFAULT) <= 0) return;
  if (H5Aexists_by_name(file.id(), path.c_str(), name.c_str(), H5P_DEFAULT) > 0) return;
  if (name == "openPMD" || name == "units" || plan.below(6) == 0) {
    write_text(file, path, name, plan.below(2) == 0 ? "kpc" : "3");
    return;
  }
  std::vector<double> values(1 + plan.below(8));
  for (double& value : values)
    value = plan.one_of(numbers);
  write_attribute(file, path, name, values);
}

void make_groups(const Hdf5Output& file, const std::string& path) {
  if (path.empty()) return;
  const Hdf5Handle<H5Pclose> links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle<H5Gclose> group(
      H5Gcreate2(file.id(), path.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT));
}

void write_file(Plan& plan) {
  const Hdf5Output file = create_hdf5(fuzz::scratch_file());
  std::string group;
  while (!plan.is_at_end()) {
    const std::string path = (group.empty() ? "" : group + "/") + plan.one_of(names);
    switch (plan.below(7)) {
      case 0:
        group = plan.one_of(groups);
        make_groups(file, group);
        break;
      case 6:  // to itself, to another, or nowhere
        H5Lcreate_soft(plan.one_of(groups), file.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        break;
      case 1:
        add_attribute(file, plan.below(2) == 0 ? group : path, plan);
        break;
      case 2:
        add_dataset(file, path, record_type(plan, 0), plan);
        break;
      case 3:
        add_dataset(file, path, member_type(plan, 0), plan);
        break;
      default:
        add_dataset(file, path, Handle(H5Tcopy(number_type(plan.below(6)))), plan);
        break;
    }
  }
}

void read_group(const char* group) {
  try {
    fuzz::read_all(*hdf5_formats().open(fuzz::scratch_file() / group, {}));
  } catch (const Error&) {
    // refused
  }
}

}  // namespace

void splotchcl::fuzz::fuzz_hdf5_layouts(const std::uint8_t* data, std::size_t size) {
  const Hdf5Silence silence;
  Plan plan(data, size);
  write_file(plan);
  fuzz::read_as(hdf5_formats());
  read_group("data/1");
  read_group("Step#0");
  fuzz::read_as(hdf5_formats(), {{"x=x", "y=list:y", "z=pos:1"}});
  fuzz::read_as(hdf5_formats(), {{"position=pos", "m=data/1/particles/e/mass", "q=a:b"}});
  fuzz::read_as(hdf5_formats(), {{"position=list:position", "id=list:list.id:2"}});
}
