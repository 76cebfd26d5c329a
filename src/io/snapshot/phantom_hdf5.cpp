// Phantom's HDF5 dumps: groups header and particles with lower-case names; the particles of
// all types lie together, told apart by itype.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "io/snapshot/field_names.h"
#include "io/snapshot/hdf5_column.h"
#include "io/snapshot/hdf5_formats.h"
#include "io/snapshot/unit_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr const char* mass_label = "massoftype";
// Of a density that follows from h: the file has none.
constexpr const char* density_label = "";

// Gadget's numbers for Phantom's: 1 gas, 3 boundary, 4 star, 5 dark matter, 6 bulge. Dust
// of any kind, from 7, has no counterpart and takes the place of the disk.
int gadget_type(int itype) {
  static const std::map<int, int> types = {{1, 0}, {3, 5}, {4, 4}, {5, 1}, {6, 3}};
  const auto found = types.find(itype);
  return found == types.end() ? 2 : found->second;
}

// Particles that wait for deletion have a negative type. 0, which is no type, for anything
// that is none.
int itype_of(float stored) {
  constexpr float beyond_all_types = 1000;
  const float magnitude = std::abs(stored);
  return magnitude < beyond_all_types ? static_cast<int>(magnitude) : 0;
}

UnitPowers powers_of(const std::string& field) {
  UnitPowers powers;
  if (field == "position" || field == "smoothing_length") powers.length = 1;
  if (field == "velocity") powers.velocity = 1;
  if (field == "internal_energy") powers.velocity = 2;
  if (field == "mass" || field == "density") powers.mass = 1;
  if (field == "density") powers.length = -3;
  return powers;
}

// The particles of one of Gadget's types.
struct PhantomType {
  std::vector<std::size_t> particles;  // by place in the file
  std::vector<float> masses;
};

class PhantomSnapshot : public Snapshot {
 public:
  explicit PhantomSnapshot(const std::filesystem::path& path);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  Vec3 position_origin() const override { return origin_; }

 private:
  double header_number(const std::string& name, double otherwise) const;
  std::vector<float> header_array(const std::string& name) const;
  void read_kernel();
  void find_datasets();
  void check_rows(const Hdf5Dataset& dataset, std::uint64_t rows) const;
  void read_types();
  Column read_itypes() const;
  void describe_type(int number, const PhantomType& particles);
  Column read_dataset(int type, const std::string& label, const Vec3& origin, double factor) const;
  Column density(int type) const;

  Hdf5File file_;
  SnapshotInfo info_;
  std::vector<Hdf5Dataset> datasets_;
  std::map<int, PhantomType> types_;
  std::uint64_t count_ = 0;
  double hfact_ = 1.2;        // h = hfact (m / rho)^(1/3)
  double kernel_radius_ = 2;  // of the kernel's support, in units of h
  Vec3 origin_ = {{0, 0, 0}};
};

PhantomSnapshot::PhantomSnapshot(const std::filesystem::path& path) : file_(path) {
  info_.format = "Phantom HDF5";
  info_.files = {path};
  info_.time = header_number("time", 0);
  read_kernel();
  find_datasets();
  read_types();
  for (const auto& [number, particles] : types_)
    describe_type(number, particles);
  if (file_.has("/sinks/xyz")) {
    info_.notes.push_back(fmt::format("sinks left out, as they have no smoothing length: {}",
                                      file_.dataset("/sinks/xyz").rows()));
  }
  origin_ = find_position_origin({{path, file_.dataset("/particles/xyz")}});
}

double PhantomSnapshot::header_number(const std::string& name, double otherwise) const {
  const std::string path = "/header/" + name;
  if (!file_.has(path)) return otherwise;
  const Hdf5Dataset dataset = file_.dataset(path);
  const bool is_number =
      dataset.kind != Hdf5Dataset::Kind::other && dataset.rows() * dataset.values_per_row() == 1;
  double value = otherwise;
  if (is_number) file_.read_rows(dataset, 0, 1, &value);
  return value;
}

std::vector<float> PhantomSnapshot::header_array(const std::string& name) const {
  const std::string path = "/header/" + name;
  if (!file_.has(path)) return {};
  const Column values = read_column({{file_.path(), file_.dataset(path)}});
  return {values.data(), values.data() + values.size()};
}

void PhantomSnapshot::read_kernel() {
  hfact_ = header_number("hfact", hfact_);
  // The quintic kernel goes with hfact 1.0, the cubic one with 1.2.
  kernel_radius_ = hfact_ < 1.1 ? 3 : 2;
  info_.notes.push_back(
      fmt::format("Phantom does not say which kernel it used: from hfact {:g} it is taken to reach "
                  "{:g} h",
                  hfact_, kernel_radius_));
}

void PhantomSnapshot::check_rows(const Hdf5Dataset& dataset, std::uint64_t rows) const {
  if (!dataset.shape.empty() && dataset.rows() == rows) return;
  throw DataError(
      fmt::format("{}: dataset {} has {} rows, but there are {} positions; the file is damaged",
                  file_.path().string(), dataset.path, dataset.rows(), rows));
}

void PhantomSnapshot::find_datasets() {
  std::vector<std::string> left_out;
  for (const Hdf5Dataset& dataset : file_.datasets("/particles")) {
    const std::uint64_t values = dataset.values_per_row();
    const bool is_usable = dataset.kind != Hdf5Dataset::Kind::other && (values == 1 || values == 3);
    if (is_usable) {
      datasets_.push_back(dataset);
    } else {
      left_out.push_back(dataset.label());
    }
  }
  const auto positions =
      std::find_if(datasets_.begin(), datasets_.end(), [](const Hdf5Dataset& dataset) {
        return dataset.label() == "xyz" && dataset.values_per_row() == 3;
      });
  if (positions == datasets_.end() || positions->rows() == 0) {
    throw DataError(
        fmt::format("{}: no positions: expected a dataset particles/xyz with three columns and "
                    "some rows; the file is incomplete, or no dump of Phantom",
                    file_.path().string()));
  }
  count_ = positions->rows();
  for (const Hdf5Dataset& dataset : datasets_)
    check_rows(dataset, count_);
  if (left_out.empty()) return;
  info_.notes.push_back(
      fmt::format("left out, as they are not one or three numbers per particle: {}",
                  fmt::join(left_out, ", ")));
}

void PhantomSnapshot::read_types() {
  const Column itypes = read_itypes();
  const std::vector<float> masses = header_array("massoftype");  // from type 1 on
  std::size_t without_mass = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const int itype = itype_of(itypes[i]);
    const bool has_mass = itype > 0 && static_cast<std::size_t>(itype) <= masses.size();
    PhantomType& type = types_[gadget_type(itype)];
    type.particles.push_back(i);
    type.masses.push_back(has_mass ? masses[static_cast<std::size_t>(itype) - 1] : 0);
    if (!has_mass) ++without_mass;
  }
  if (without_mass == 0) return;
  info_.notes.push_back(
      fmt::format("{} particles are of types without a mass in header/massoftype; it is taken "
                  "for 0",
                  without_mass));
}

// Gas for all where the file does not say.
Column PhantomSnapshot::read_itypes() const {
  if (!file_.has("/particles/itype")) return Column::uniform(1);
  const auto found =
      std::find_if(datasets_.begin(), datasets_.end(), [](const Hdf5Dataset& dataset) {
        return dataset.label() == "itype" && dataset.values_per_row() == 1;
      });
  if (found != datasets_.end()) return read_column({{file_.path(), *found}});
  throw DataError(
      fmt::format("{}: dataset particles/itype is not one number per particle, as was expected; "
                  "the file is damaged",
                  file_.path().string()));
}

void PhantomSnapshot::describe_type(int number, const PhantomType& particles) {
  const double length = header_number("udist", 0), time = header_number("utime", 0);
  const BaseUnits units = {length, header_number("umass", 0), time > 0 ? length / time : 0};
  ParticleTypeInfo type;
  type.type = number;
  type.count = particles.particles.size();
  for (const Hdf5Dataset& dataset : datasets_) {
    type.fields.push_back({"", dataset.label(), static_cast<int>(dataset.values_per_row()), ""});
  }
  name_fields(type);
  if (find_field(type, "mass") == nullptr) {
    type.fields.push_back({"mass", mass_label, 1, ""});
    const std::vector<float>& masses = particles.masses;
    const bool is_one_mass =
        std::adjacent_find(masses.begin(), masses.end(), std::not_equal_to<>()) == masses.end();
    if (is_one_mass) type.table_mass = static_cast<double>(masses.front());
  }
  if (find_field(type, "density") == nullptr && find_field(type, "h") != nullptr) {
    type.fields.push_back({"density", density_label, 1, ""});
  }
  for (FieldInfo& field : type.fields)
    field.unit = unit_name(powers_of(field.name), units);
  info_.types.push_back(std::move(type));
}

Column PhantomSnapshot::read_dataset(int type, const std::string& label, const Vec3& origin,
                                     double factor) const {
  const Hdf5Dataset dataset = file_.dataset("/particles/" + label);
  const Column all = read_column({{file_.path(), dataset}}, origin, factor);
  const std::vector<std::size_t>& particles = types_.at(type).particles;
  if (particles.size() == count_) return all;
  const std::size_t width = dataset.values_per_row();
  std::vector<float> values;
  values.reserve(particles.size() * width);
  for (const std::size_t particle : particles) {
    for (std::size_t i = 0; i < width; ++i)
      values.push_back(all[particle * width + i]);
  }
  return Column::owning(std::move(values));
}

// Phantom keeps no densities: h says the same.
Column PhantomSnapshot::density(int type) const {
  const Column h = read_dataset(type, "h", {}, 1);
  const Column mass = read(type, "mass");
  std::vector<float> densities(h.size());
  for (std::size_t i = 0; i < densities.size(); ++i) {
    const double ratio = hfact_ / static_cast<double>(h[i]);
    densities[i] = static_cast<float>(static_cast<double>(mass[i]) * ratio * ratio * ratio);
  }
  return Column::owning(std::move(densities));
}

Column PhantomSnapshot::read(int type, const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  if (field.file_name == mass_label) {
    const std::optional<double> table_mass = require_type(info_, type).table_mass;
    if (!table_mass) return Column::owning(types_.at(type).masses);
    return Column::uniform(static_cast<float>(*table_mass));
  }
  if (field.file_name == density_label) return density(type);
  const Vec3 origin = field.name == "position" ? origin_ : Vec3{{0, 0, 0}};
  const double factor = field.name == "smoothing_length" ? kernel_radius_ : 1;
  return read_dataset(type, field.file_name, origin, factor);
}

}  // namespace

bool is_phantom_hdf5(const Hdf5File& file) {
  return file.has("/particles") && file.has("/header/massoftype");
}

std::unique_ptr<Snapshot> open_phantom_hdf5(const std::filesystem::path& path) {
  return std::make_unique<PhantomSnapshot>(path);
}

}  // namespace splotchcl
