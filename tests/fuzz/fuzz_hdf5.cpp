// Damage inside HDF5's own structures is for libhdf5 to find, and libhdf5 1.10 has known crashes
// of its own. So the bytes are the plan of a file that HDF5 itself writes: which groups,
// datasets and attributes it has, of which names, types and shapes.
#include <array>
#include <vector>

#include "formats/halo_catalog.h"
#include "formats/hdf5/hdf5_values.h"
#include "fuzz/fuzz.h"
#include "fuzz/plan.h"

namespace {

using namespace splotchcl;
using namespace splotchcl::test;
using fuzz::Plan;

// An empty one is the root.
const std::array<const char*, 15> groups = {"Header",    "header",      "particles", "PartType0",
                                            "PartType1", "PartType3",   "PartType9", "Units",
                                            "Config",    "HydroScheme", "",          "Group",
                                            "gas",       "star",        "something"};
const std::array<const char*, 45> names = {"Coordinates",
                                           "Masses",
                                           "ParticleIDs",
                                           "SmoothingLength",
                                           "Density",
                                           "Volume",
                                           "CenterOfMass",
                                           "TracerID",
                                           "xyz",
                                           "x",
                                           "y",
                                           "z",
                                           "h",
                                           "m",
                                           "rho",
                                           "itype",
                                           "iphase",
                                           "massoftype",
                                           "hfact",
                                           "time",
                                           "udist",
                                           "utime",
                                           "umass",
                                           "vx",
                                           "vy",
                                           "vz",
                                           "Velocities",
                                           "InternalEnergy",
                                           "sinks",
                                           "Color",
                                           "SmoothingLengths",
                                           "Densities",
                                           "pos",
                                           "any",
                                           "particle_position_x",
                                           "particle_position_y",
                                           "particle_position_z",
                                           "particle_index",
                                           "GroupLenType",
                                           "GroupOffsetType",
                                           "GroupNr_bound",
                                           "FOFGroupIDs",
                                           "Group_Size",
                                           "Offset",
                                           "Particle_IDs"};
const std::array<const char*, 30> attributes = {"NumPart_ThisFile",
                                                "NumPart_Total",
                                                "NumPart_Total_HighWord",
                                                "MassTable",
                                                "Time",
                                                "Redshift",
                                                "BoxSize",
                                                "NumFilesPerSnapshot",
                                                "Omega0",
                                                "HubbleParam",
                                                "OmegaLambda",
                                                "GIZMO_version",
                                                "UnitLength_In_CGS",
                                                "ComovingIntegrationOn",
                                                "Kernel gamma",
                                                "Scale-factor",
                                                "UnitLength_in_cm",
                                                "UnitMass_in_g",
                                                "Code",
                                                "a_scaling",
                                                "h_scaling",
                                                "length_scaling",
                                                "units",
                                                "data_type",
                                                "domain_left_edge",
                                                "domain_right_edge",
                                                "Unit length in cgs (U_L)",
                                                "Ngroups_Total",
                                                "NumFiles",
                                                "cosmological_simulation"};
const std::array<double, 16> numbers = {0,    1,     2,   3,    4,      5,    7,   -1,
                                        1e15, 1e300, 0.5, 1e-9, 1e-300, 1.25, 1.8, 4294967296.0};

hid_t type_of(std::size_t choice) {
  const std::array<hid_t, 10> types = {
      H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_IEEE_F32BE, H5T_STD_U32LE, H5T_STD_U64BE,
      H5T_STD_I8LE,   H5T_STD_I64LE,  H5T_STD_U16BE,  H5T_STD_B32LE, H5T_NATIVE_LDOUBLE};
  return types[choice % types.size()];
}

void add_dataset(const Hdf5Output& file, const std::string& path, Plan& plan) {
  std::vector<hsize_t> shape(plan.below(4));
  for (hsize_t& side : shape)
    side = plan.below(6);
  if (shape.size() == 2 && plan.below(4) != 0) shape[1] = 3;
  const Hdf5Handle<H5Sclose> space(
      shape.empty() ? H5Screate(H5S_SCALAR)
                    : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
  const Hdf5Handle<H5Pclose> properties(H5Pcreate(H5P_DATASET_CREATE));
  const std::size_t storage = plan.below(5);
  if (storage < 2 && !shape.empty()) {
    std::vector<hsize_t> chunk(shape.size());
    for (hsize_t& side : chunk)
      side = 1 + plan.below(4);
    H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
    if (storage == 1) H5Pset_deflate(properties.id(), 1);
  }
  const Hdf5Handle<H5Dclose> dataset(H5Dcreate2(file.id(), path.c_str(), type_of(plan.below(10)),
                                                space.id(), H5P_DEFAULT, properties.id(),
                                                H5P_DEFAULT));
  if (!dataset.is_valid() || storage == 4) return;  // never written
  std::size_t size = 1;
  for (const hsize_t side : shape)
    size *= side;
  std::vector<double> values(size);
  for (double& value : values)
    value = plan.one_of(numbers);
  H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

void add_attribute(const Hdf5Output& file, const std::string& owner_path, Plan& plan) {
  const std::string path = owner_path.empty() ? "/" : owner_path;
  const Hdf5Handle<H5Oclose> owner(H5Oopen(file.id(), path.c_str(), H5P_DEFAULT));
  if (!owner.is_valid()) return;
  const std::string name = plan.one_of(attributes);
  if (H5Aexists(owner.id(), name.c_str()) > 0) return;
  if (name == "Code" && plan.below(2) == 0) {
    const Hdf5Handle<H5Tclose> text(H5Tcopy(H5T_C_S1));
    H5Tset_size(text.id(), 6);
    const Hdf5Handle<H5Sclose> scalar(H5Screate(H5S_SCALAR));
    const Hdf5Handle<H5Aclose> attribute(
        H5Acreate2(owner.id(), name.c_str(), text.id(), scalar.id(), H5P_DEFAULT, H5P_DEFAULT));
    H5Awrite(attribute.id(), text.id(), "SWIFT");
    return;
  }
  if ((name == "units" || name == "data_type") && plan.below(4) != 0) {
    write_text(file, path, name, plan.below(2) == 0 ? "yt_cm" : "");
    return;
  }
  const hsize_t length = 1 + plan.below(8);
  const Hdf5Handle<H5Sclose> space(H5Screate_simple(1, &length, nullptr));
  const Hdf5Handle<H5Aclose> attribute(H5Acreate2(owner.id(), name.c_str(), type_of(plan.below(10)),
                                                  space.id(), H5P_DEFAULT, H5P_DEFAULT));
  std::vector<double> values(length);
  for (double& value : values)
    value = plan.one_of(numbers);
  if (attribute.is_valid()) H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, values.data());
}

void make_group_once(const Hdf5Output& file, const std::string& group) {
  if (group.empty() || H5Lexists(file.id(), group.c_str(), H5P_DEFAULT) > 0) return;
  make_group(file, group);
}

// Whatever it is, it may be named as a catalog of haloes.
void read_haloes() {
  for (const std::uint64_t number : {0U, 1U, 3U}) {
    for (const int type : {0, 1, 5}) {
      try {
        const HaloMembers members = read_halo(fuzz::scratch_file(), number, type);
        volatile bool has_place = members.has_place(number);
        static_cast<void>(has_place);
      } catch (const Error&) {
        // refused
      }
    }
  }
}

}  // namespace

void splotchcl::fuzz::fuzz_hdf5(const std::uint8_t* data, std::size_t size) {
  const Hdf5Silence silence;
  {
    const Hdf5Output file = create_hdf5(fuzz::scratch_file());
    Plan plan(data, size);
    std::string group = "Header";
    make_group(file, group);
    while (!plan.is_at_end()) {
      switch (plan.below(4)) {
        case 0:
          group = plan.one_of(groups);
          make_group_once(file, group);
          break;
        case 1:
          add_attribute(file, group, plan);
          break;
        case 2: {
          const std::string path = (group.empty() ? "" : group + "/") + plan.one_of(names);
          if (H5Lexists(file.id(), path.c_str(), H5P_DEFAULT) <= 0) add_dataset(file, path, plan);
          break;
        }
        default:
          // Phantom's files have no group Header.
          if (plan.below(8) == 0) H5Ldelete(file.id(), "Header", H5P_DEFAULT);
          make_group_once(file, group);
          break;
      }
    }
  }
  fuzz::read_as(hdf5_formats());
  read_haloes();
}
