// Tipsy: a header, then the particles of each type as records of single-precision numbers, in
// either endianness. Positions, and velocities with them, may have double precision.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "formats/snapshot_format.h"
#include "formats/stored_values.h"
#include "formats/tipsy/tipsy_arrays.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

constexpr std::uint64_t unpadded_header_bytes = 28;
constexpr std::uint64_t padded_header_bytes = 32;

// The auxiliary arrays of Gasoline and ChaNGa, and that of pynbody: half of the radius that the
// kernel reaches.
constexpr std::array<const char*, 2> smoothing_labels = {"smoothlength", "smooth"};
constexpr double smoothing_length_factor = 2;

double factor_of(const std::string& array) {
  const bool is_half =
      std::find(smoothing_labels.begin(), smoothing_labels.end(), array) != smoothing_labels.end();
  return is_half ? smoothing_length_factor : 1;
}

// Which vectors have double precision: the length of the file tells.
struct TipsyPrecision {
  bool has_double_positions = false, has_double_velocities = false;
};
constexpr std::array<TipsyPrecision, 3> precisions = {
    {{false, false}, {true, false}, {true, true}}};

struct TipsyField {
  const char* label;
  int values_per_particle;
  ValueKind kind(const TipsyPrecision& precision) const {
    const std::string_view name = label;
    const bool is_double = (name == "pos" && precision.has_double_positions) ||
                           (name == "vel" && precision.has_double_velocities);
    return is_double ? ValueKind::float64 : ValueKind::float32;
  }
  std::uint64_t bytes(const TipsyPrecision& precision) const {
    return size_of(kind(precision)) * static_cast<unsigned>(values_per_particle);
  }
};

struct TipsyType {
  int type;  // Gadget's number
  std::vector<TipsyField> fields;

  std::uint64_t bytes_per_particle(const TipsyPrecision& precision) const {
    std::uint64_t bytes = 0;
    for (const TipsyField& field : fields)
      bytes += field.bytes(precision);
    return bytes;
  }
};

// In the order of the file.
const std::array<TipsyType, 3>& tipsy_types() {
  static const std::array<TipsyType, 3> types = {
      TipsyType{0,
                {{"mass", 1},
                 {"pos", 3},
                 {"vel", 3},
                 {"rho", 1},
                 {"temp", 1},
                 {"hsmooth", 1},
                 {"metals", 1},
                 {"phi", 1}}},
      TipsyType{1, {{"mass", 1}, {"pos", 3}, {"vel", 3}, {"eps", 1}, {"phi", 1}}},
      TipsyType{4,
                {{"mass", 1},
                 {"pos", 3},
                 {"vel", 3},
                 {"metals", 1},
                 {"tform", 1},
                 {"eps", 1},
                 {"phi", 1}}}};
  return types;
}

struct TipsyHeader {
  double time = 0;
  std::uint64_t particles = 0;
  std::array<std::uint64_t, 3> counts = {};  // gas, dark, stars
  bool is_swapped = false;

  std::uint64_t particle_bytes(const TipsyPrecision& precision) const {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      bytes += counts[i] * tipsy_types()[i].bytes_per_particle(precision);
    }
    return bytes;
  }
};

// A header in one endianness; none when its numbers do not agree with each other.
std::optional<TipsyHeader> parse_header(const std::shared_ptr<const MappedFile>& file,
                                        bool is_swapped) {
  const auto count = [&](std::uint64_t offset) {
    return static_cast<std::uint64_t>(number_at(file, offset, ValueKind::uint32, is_swapped));
  };
  TipsyHeader header;
  header.is_swapped = is_swapped;
  header.time = number_at(file, 0, ValueKind::float64, is_swapped);
  header.particles = count(8);
  const std::uint64_t dimensions = count(12);
  for (std::size_t i = 0; i < 3; ++i)
    header.counts[i] = count(16 + 4 * i);
  const std::uint64_t sum = header.counts[0] + header.counts[1] + header.counts[2];
  if (dimensions != 3 || header.particles == 0 || header.particles != sum) return std::nullopt;
  return header;
}

std::optional<TipsyHeader> find_header(const std::shared_ptr<const MappedFile>& file) {
  if (file->size() < unpadded_header_bytes) return std::nullopt;
  const auto native = parse_header(file, false);
  return native ? native : parse_header(file, true);
}

class TipsySnapshot : public Snapshot {
 public:
  explicit TipsySnapshot(const std::filesystem::path& path);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  Vec3 position_origin() const override { return origin_; }

 private:
  static std::size_t group_of(int type);
  static bool is_own(std::size_t group, const FieldInfo& field);
  // A field that the records have.
  StoredValues values_of(std::size_t group, const std::string& label) const;
  void choose_origin();
  const TipsyArray* find_array(const std::string& name) const;
  std::uint64_t first_of(std::size_t group) const;  // among the particles of all types
  void find_start();
  void describe_types();

  std::shared_ptr<const MappedFile> file_;
  TipsyHeader header_;
  std::uint64_t start_ = padded_header_bytes;  // of the first particle
  TipsyPrecision precision_;
  Vec3 origin_ = {{0, 0, 0}};
  std::vector<TipsyArray> arrays_;  // beside the file
  SnapshotInfo info_;
};

TipsySnapshot::TipsySnapshot(const std::filesystem::path& path) : file_(MappedFile::open(path)) {
  const std::optional<TipsyHeader> header = find_header(file_);
  if (!header) {  // it was one when it was recognised
    throw DataError(path.string() + ": not a Tipsy file any more; is it being written?");
  }
  header_ = *header;
  info_.format = fmt::format("Tipsy, {}-endian",
                             header_.is_swapped == is_little_endian_host() ? "big" : "little");
  info_.files = {path};
  info_.time = header_.time;
  info_.velocity_doubt = "Tipsy does not tell its units, nor whether its time is the scale factor";
  find_start();
  arrays_ = find_tipsy_arrays(path, header_.particles, header_.is_swapped, info_.notes);
  describe_types();
  if (precision_.has_double_positions) choose_origin();
  info_.files_mark = hash_of_files(info_).value();
}

const TipsyArray* TipsySnapshot::find_array(const std::string& name) const {
  for (const TipsyArray& array : arrays_) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

std::uint64_t TipsySnapshot::first_of(std::size_t group) const {
  return std::accumulate(header_.counts.begin(),
                         header_.counts.begin() + static_cast<std::ptrdiff_t>(group),
                         std::uint64_t{0});
}

void TipsySnapshot::find_start() {
  for (const TipsyPrecision& precision : precisions) {
    for (const std::uint64_t header : {padded_header_bytes, unpadded_header_bytes}) {
      if (file_->size() != header_.particle_bytes(precision) + header) continue;
      start_ = header;
      precision_ = precision;
      return;
    }
  }
  throw DataError(fmt::format(
      "{}: a Tipsy file of {} gas, {} dark and {} star particles should have {} bytes, or {} with "
      "positions in double precision, but has {}; it is truncated or damaged: copy or write it "
      "again",
      file_->path().string(), header_.counts[0], header_.counts[1], header_.counts[2],
      header_.particle_bytes(precisions[0]) + padded_header_bytes,
      header_.particle_bytes(precisions[1]) + padded_header_bytes, file_->size()));
}

StoredValues TipsySnapshot::values_of(std::size_t group, const std::string& label) const {
  std::uint64_t offset = start_;
  for (std::size_t i = 0; i < group; ++i)
    offset += header_.counts[i] * tipsy_types()[i].bytes_per_particle(precision_);
  const TipsyType& layout = tipsy_types()[group];
  auto field = layout.fields.begin();
  for (; field->label != label; ++field)
    offset += field->bytes(precision_);
  return {file_,
          offset,
          header_.counts[group],
          field->values_per_particle,
          layout.bytes_per_particle(precision_),
          field->kind(precision_),
          header_.is_swapped};
}

void TipsySnapshot::choose_origin() {
  std::vector<std::array<double, 3>> sample;
  const std::vector<std::uint64_t> counts(header_.counts.begin(), header_.counts.end());
  for (const SampleRange& range : sample_ranges(counts)) {
    const StoredValues positions = values_of(range.part, "pos");
    for (std::uint64_t i = range.first; i < range.first + range.count; ++i)
      sample.push_back(
          {value_at(positions, i, 0), value_at(positions, i, 1), value_at(positions, i, 2)});
  }
  origin_ = choose_position_origin(sample);
}

void TipsySnapshot::describe_types() {
  for (const TipsyArray& array : arrays_)
    info_.files_beside.push_back(array.file->path());
  for (std::size_t i = 0; i < header_.counts.size(); ++i) {
    if (header_.counts[i] == 0) continue;
    ParticleTypeInfo type;
    type.type = tipsy_types()[i].type;
    type.count = header_.counts[i];
    for (const TipsyField& field : tipsy_types()[i].fields) {
      type.fields.push_back({"", field.label, field.values_per_particle, ""});
    }
    for (const TipsyArray& array : arrays_) {
      const bool is_new =
          std::none_of(type.fields.begin(), type.fields.end(),
                       [&](const FieldInfo& f) { return f.file_name == array.name; });
      if (is_new) type.fields.push_back({"", array.name, 1, ""});
    }
    name_fields(type);
    info_.types.push_back(std::move(type));
  }
  if (header_.counts[0] > 0) {
    info_.notes.push_back(
        "Tipsy's hsmooth holds the softening of gravity, as codes write it, and is not taken for a "
        "smoothing length");
  }
}

std::size_t TipsySnapshot::group_of(int type) {
  std::size_t group = 0;
  while (tipsy_types()[group].type != type)
    ++group;
  return group;
}

bool TipsySnapshot::is_own(std::size_t group, const FieldInfo& field) {
  const auto& fields = tipsy_types()[group].fields;
  return std::any_of(fields.begin(), fields.end(),
                     [&](const TipsyField& f) { return f.label == field.file_name; });
}

Column TipsySnapshot::read(int type, const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  const std::size_t group = group_of(type);
  if (!is_own(group, field)) {
    return read_tipsy_array(*find_array(field.file_name), first_of(group), header_.counts[group],
                            factor_of(field.file_name));
  }
  const Vec3 origin = field.name == "position" ? origin_ : Vec3{{0, 0, 0}};
  return make_column({values_of(group, field.file_name)}, origin);
}

std::vector<std::uint64_t> TipsySnapshot::read_integers(int type, const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  const std::size_t group = group_of(type);
  auto numbers = is_own(group, field) ? make_integers({values_of(group, field.file_name)})
                                      : read_tipsy_integers(*find_array(field.file_name),
                                                            first_of(group), header_.counts[group]);
  if (!numbers) refuse_integers(info_, type, field);
  return std::move(*numbers);
}

class TipsyFormat : public SnapshotFormat {
 public:
  bool recognizes(const std::shared_ptr<const MappedFile>& file) const override {
    return find_header(file).has_value();
  }
  std::unique_ptr<Snapshot> open(const std::filesystem::path& path,
                                 const SnapshotOptions&) const override {
    return std::make_unique<TipsySnapshot>(path);
  }
};

}  // namespace

const SnapshotFormat& tipsy_format() {
  static const TipsyFormat format;
  return format;
}

}  // namespace splotchcl
