// HDF5 with a group `particles`: Phantom's dumps, with lower-case names and a group header, and
// files after sphNG, which may have no header. The particles of all types lie together, told
// apart by itype (Phantom) or iphase (sphNG).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "formats/hdf5/hdf5_column.h"
#include "formats/hdf5/hdf5_formats.h"
#include "formats/hdf5/hdf5_units.h"
#include "formats/stored_values.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
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

// sphNG's phases as Gadget's types: 0 is gas, above are point masses, below are particles that
// were accreted.
int gadget_type_of_phase(float iphase) {
  if (iphase > 0) return 4;
  return iphase < 0 ? 5 : 0;
}

// A field of all particles: one dataset, or one for each axis.
struct ParticleField {
  std::string label;
  std::vector<Hdf5Dataset> sources;

  std::uint64_t values_per_particle() const {
    return sources.size() == 1 ? sources.front().values_per_row() : sources.size();
  }
};

// The vectors that some codes write as a dataset for each axis.
struct SplitVector {
  const char* label;
  std::array<const char*, 3> axes;
};
constexpr std::array<SplitVector, 3> split_vectors = {
    {{"xyz", {"x", "y", "z"}}, {"vxyz", {"vx", "vy", "vz"}}, {"Bxyz", {"Bx", "By", "Bz"}}}};

UnitPowers phantom_powers_of(const std::string& field) {
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
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  Vec3 position_origin() const override { return origin_; }

 private:
  double header_number(const std::string& name, double otherwise) const;
  std::vector<float> header_array(const std::string& name) const;
  void read_kernel();
  void find_datasets();
  void join_axes();
  const ParticleField* find_particle_field(const std::string& label) const;
  void check_rows(const Hdf5Dataset& dataset, std::uint64_t rows) const;
  void read_types();
  Column read_numbers(const std::string& label) const;
  std::vector<int> read_type_numbers(std::vector<float>& itypes);
  void choose_origin();
  Column read_axes(const ParticleField& field, const Vec3& origin) const;
  void describe_type(int number, const PhantomType& particles);
  Column read_dataset(int type, const std::string& label, const Vec3& origin, double factor) const;
  Column density(int type) const;

  std::unique_ptr<const Hdf5File> file_;  // while it is being described
  SnapshotInfo info_;
  std::vector<ParticleField> fields_;
  std::map<int, PhantomType> types_;
  std::uint64_t count_ = 0;
  double hfact_ = 1.2;        // h = hfact (m / rho)^(1/3)
  double kernel_radius_ = 2;  // of the kernel's support, in units of h
  Vec3 origin_ = {{0, 0, 0}};
};

PhantomSnapshot::PhantomSnapshot(const std::filesystem::path& path)
    : file_(std::make_unique<const Hdf5File>(path)) {
  const bool is_phantom = file_->has("/header/massoftype");
  info_.format = is_phantom ? "Phantom HDF5" : "HDF5 with a group particles, after sphNG";
  info_.files = {path};
  info_.time = header_number("time", 0);
  read_kernel();
  find_datasets();
  read_types();
  for (const auto& [number, particles] : types_)
    describe_type(number, particles);
  if (file_->has("/sinks/xyz")) {
    info_.notes.push_back(fmt::format("sinks left out, as they have no smoothing length: {}",
                                      file_->dataset("/sinks/xyz").rows()));
  }
  info_.files_beside.assign(file_->links().followed.begin(), file_->links().followed.end());
  info_.files_mark = hash_of_files(info_).value();
  note_refused(file_->links(), info_.notes);
  choose_origin();
  file_.reset();  // others in this process may want to change it
}

void PhantomSnapshot::choose_origin() {
  const ParticleField& positions = *find_particle_field("xyz");
  if (positions.sources.size() == 1) {
    origin_ = find_position_origin({{file_->path(), positions.sources.front()}});
    return;
  }
  const bool has_doubles = std::any_of(positions.sources.begin(), positions.sources.end(),
                                       [](const Hdf5Dataset& axis) { return axis.is_double(); });
  if (!has_doubles) return;
  std::vector<std::array<double, 3>> sample;
  for (const SampleRange& range : sample_ranges({count_})) {
    const std::size_t first = sample.size();
    sample.resize(first + range.count);
    std::vector<double> values(range.count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      file_->read_rows(positions.sources[axis], range.first, range.count, values.data());
      for (std::size_t i = 0; i < values.size(); ++i)
        sample[first + i][axis] = values[i];
    }
  }
  origin_ = choose_position_origin(sample);
}

double PhantomSnapshot::header_number(const std::string& name, double otherwise) const {
  const std::string path = "/header/" + name;
  if (!file_->has(path)) return otherwise;
  const Hdf5Dataset dataset = file_->dataset(path);
  const bool is_number = dataset.is_number() && dataset.rows() * dataset.values_per_row() == 1;
  double value = otherwise;
  if (is_number) file_->read_rows(dataset, 0, 1, &value);
  return value;
}

std::vector<float> PhantomSnapshot::header_array(const std::string& name) const {
  const std::string path = "/header/" + name;
  if (!file_->has(path)) return {};
  const Column values = read_column({{file_->path(), file_->dataset(path)}});
  return {values.data(), values.data() + values.size()};
}

void PhantomSnapshot::read_kernel() {
  hfact_ = header_number("hfact", hfact_);
  // The quintic kernel goes with hfact 1.0, the cubic one with 1.2.
  kernel_radius_ = hfact_ < 1.1 ? 3 : 2;
  if (!file_->has("/particles/h")) return;
  info_.notes.push_back(fmt::format(
      "the file does not say which kernel was used: {} it is taken to reach {:g} h",
      file_->has("/header/hfact") ? fmt::format("from hfact {:g}", hfact_) : "as in sphNG",
      kernel_radius_));
}

void PhantomSnapshot::check_rows(const Hdf5Dataset& dataset, std::uint64_t rows) const {
  if (!dataset.shape.empty() && dataset.rows() == rows) return;
  throw DataError(
      fmt::format("{}: dataset {} has {} rows, but there are {} positions; the file is damaged",
                  file_->path().string(), dataset.path, dataset.rows(), rows));
}

void PhantomSnapshot::find_datasets() {
  std::vector<std::string> left_out;
  for (const Hdf5Dataset& dataset : file_->datasets("/particles")) {
    const std::uint64_t values = dataset.values_per_row();
    const bool is_usable = dataset.is_number() && (values == 1 || values == 3);
    if (is_usable) {
      fields_.push_back({dataset.label(), {dataset}});
    } else {
      left_out.push_back(dataset.label());
    }
  }
  join_axes();
  const ParticleField* const positions = find_particle_field("xyz");
  const bool has_positions = positions != nullptr && positions->values_per_particle() == 3 &&
                             positions->sources.front().rows() > 0;
  if (!has_positions) {
    throw DataError(fmt::format(
        "{}: no positions: expected a dataset particles/xyz with three columns and some rows, or "
        "x, y and z; the file is incomplete, or no dump of Phantom or sphNG",
        file_->path().string()));
  }
  count_ = positions->sources.front().rows();
  for (const ParticleField& field : fields_) {
    for (const Hdf5Dataset& source : field.sources)
      check_rows(source, count_);
  }
  if (left_out.empty()) return;
  info_.notes.push_back(
      fmt::format("left out, as they are not one or three numbers per particle: {}",
                  fmt::join(left_out, ", ")));
}

const ParticleField* PhantomSnapshot::find_particle_field(const std::string& label) const {
  const auto found = std::find_if(fields_.begin(), fields_.end(),
                                  [&](const ParticleField& field) { return field.label == label; });
  return found == fields_.end() ? nullptr : &*found;
}

void PhantomSnapshot::join_axes() {
  for (const SplitVector& vector : split_vectors) {
    ParticleField joined = {vector.label, {}};
    for (const char* axis : vector.axes) {
      const ParticleField* const field = find_particle_field(axis);
      const bool is_axis = field != nullptr && field->values_per_particle() == 1;
      if (is_axis) joined.sources.push_back(field->sources.front());
    }
    if (joined.sources.size() < 3 || find_particle_field(vector.label) != nullptr) continue;
    fields_.erase(std::remove_if(fields_.begin(), fields_.end(),
                                 [&](const ParticleField& field) {
                                   return std::find(vector.axes.begin(), vector.axes.end(),
                                                    field.label) != vector.axes.end();
                                 }),
                  fields_.end());
    fields_.push_back(std::move(joined));
  }
}

void PhantomSnapshot::read_types() {
  std::vector<float> itypes;
  const std::vector<int> numbers = read_type_numbers(itypes);
  const std::vector<float> masses = header_array("massoftype");  // from type 1 on
  std::size_t without_mass = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const int itype = itype_of(itypes[i]);
    const bool has_mass = itype > 0 && static_cast<std::size_t>(itype) <= masses.size();
    PhantomType& type = types_[numbers[i]];
    type.particles.push_back(i);
    type.masses.push_back(has_mass ? masses[static_cast<std::size_t>(itype) - 1] : 0);
    if (!has_mass) ++without_mass;
  }
  if (without_mass == 0 || masses.empty()) return;
  info_.notes.push_back(
      fmt::format("{} particles are of types without a mass in header/massoftype; it is taken "
                  "for 0",
                  without_mass));
}

// Gadget's type of each particle, and Phantom's. Gas for all where the file does not say.
std::vector<int> PhantomSnapshot::read_type_numbers(std::vector<float>& itypes) {
  // Before memory is taken for as many as there should be.
  for (const Hdf5Dataset& source : find_particle_field("xyz")->sources)
    file_->check_complete(source);
  std::vector<int> numbers;
  const bool has_types = file_->has("/particles/itype");
  const Column types = has_types ? read_numbers("itype") : Column::uniform(1);
  itypes.reserve(count_);
  for (std::size_t i = 0; i < count_; ++i)
    itypes.push_back(types[i]);
  if (!has_types && file_->has("/particles/iphase")) {
    const Column phases = read_numbers("iphase");
    for (std::size_t i = 0; i < count_; ++i)
      numbers.push_back(gadget_type_of_phase(phases[i]));
    info_.notes.push_back(
        "types follow from iphase: 0 is gas, above 0 are point masses (type 4), below 0 is what "
        "was accreted (type 5)");
    return numbers;
  }
  for (const float itype : itypes)
    numbers.push_back(gadget_type(itype_of(itype)));
  return numbers;
}

Column PhantomSnapshot::read_numbers(const std::string& label) const {
  const ParticleField* const field = find_particle_field(label);
  if (field != nullptr && field->values_per_particle() == 1) {
    return read_column({{file_->path(), field->sources.front()}});
  }
  throw DataError(
      fmt::format("{}: dataset particles/{} is not one number per particle, as was expected; "
                  "the file is damaged",
                  file_->path().string(), label));
}

void PhantomSnapshot::describe_type(int number, const PhantomType& particles) {
  const double length = header_number("udist", 0), time = header_number("utime", 0);
  const BaseUnits units = {length, header_number("umass", 0), time > 0 ? length / time : 0};
  ParticleTypeInfo type;
  type.type = number;
  type.count = particles.particles.size();
  for (const ParticleField& field : fields_) {
    type.fields.push_back({"", field.label, static_cast<int>(field.values_per_particle()), ""});
  }
  name_fields(type);
  if (find_field(type, "mass") == nullptr && file_->has("/header/massoftype")) {
    type.fields.push_back({"mass", mass_label, 1, ""});
    const std::vector<float>& masses = particles.masses;
    const bool is_one_mass =
        std::adjacent_find(masses.begin(), masses.end(), std::not_equal_to<>()) == masses.end();
    if (is_one_mass) type.table_mass = static_cast<double>(masses.front());
  }
  const bool has_mass = has_masses(type);
  if (find_field(type, "density") == nullptr && find_field(type, "h") != nullptr && has_mass) {
    type.fields.push_back({"density", density_label, 1, ""});
  }
  for (FieldInfo& field : type.fields)
    field.unit = unit_name(phantom_powers_of(field.name), units);
  info_.types.push_back(std::move(type));
}

Column PhantomSnapshot::read_dataset(int type, const std::string& label, const Vec3& origin,
                                     double factor) const {
  const ParticleField& field = *find_particle_field(label);
  const Column all =
      field.sources.size() == 1
          ? read_column({{info_.files.front(), field.sources.front()}}, origin, factor)
          : read_axes(field, origin);
  const std::vector<std::size_t>& particles = types_.at(type).particles;
  if (particles.size() == count_) return all;
  const std::size_t width = field.values_per_particle();
  std::vector<float> values;
  values.reserve(particles.size() * width);
  for (const std::size_t particle : particles) {
    for (std::size_t i = 0; i < width; ++i)
      values.push_back(all[particle * width + i]);
  }
  return Column::owning(std::move(values));
}

Column PhantomSnapshot::read_axes(const ParticleField& field, const Vec3& origin) const {
  const Hdf5File file(info_.files.front());
  for (const Hdf5Dataset& source : field.sources)
    file.check_complete(source);
  std::vector<float> values(3 * count_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Hdf5Dataset& source = field.sources[axis];
    const std::uint64_t piece = file.rows_per_piece(source);
    std::vector<double> buffer;
    for (std::uint64_t first = 0; first < count_; first += piece) {
      buffer.resize(std::min(piece, count_ - first));
      file.read_rows(source, first, buffer.size(), buffer.data());
      for (std::size_t i = 0; i < buffer.size(); ++i) {
        values[3 * (first + i) + axis] = static_cast<float>(buffer[i] - origin.a[axis]);
      }
    }
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
  check_files_are_the_same(info_);
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

std::vector<std::uint64_t> PhantomSnapshot::read_integers(int type, const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  const ParticleField* const stored = find_particle_field(field.file_name);
  if (stored == nullptr) return Snapshot::read_integers(type, name);
  check_files_are_the_same(info_);
  const auto all = splotchcl::read_integers({{info_.files.front(), stored->sources.front()}});
  if (!all || stored->values_per_particle() != 1) refuse_integers(info_, type, field);
  std::vector<std::uint64_t> numbers;
  for (const std::size_t particle : types_.at(type).particles)
    numbers.push_back((*all)[particle]);
  return numbers;
}

}  // namespace

bool is_phantom_hdf5(const Hdf5File& file) {
  const std::vector<std::string> groups = file.groups("/");
  const bool has_group = std::find(groups.begin(), groups.end(), "particles") != groups.end();
  if (!has_group || file.has("/Header")) return false;
  const bool has_its_names =
      file.has("/header/massoftype") || file.has("/particles/xyz") || file.has("/particles/x");
  return has_its_names || !is_plain_hdf5(file);
}

std::unique_ptr<Snapshot> open_phantom_hdf5(const std::filesystem::path& path) {
  return std::make_unique<PhantomSnapshot>(path);
}

}  // namespace splotchcl
