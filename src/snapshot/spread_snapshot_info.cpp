#include "snapshot/spread_snapshot_info.h"

#include <fmt/format.h>

#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

class Writer {
 public:
  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    text_.append(bytes, sizeof(Value));
  }
  void put(const std::string& text) {
    put(text.size());
    text_ += text;
  }
  void put(const std::optional<double>& value) {
    put(value.has_value());
    put(value.value_or(0));
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  template <class Value>
  Value get() {
    Value value;
    std::memcpy(&value, rest_.data(), sizeof(Value));
    rest_.remove_prefix(sizeof(Value));
    return value;
  }
  std::string get_text() {
    const auto size = get<std::size_t>();
    std::string text(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return text;
  }
  std::optional<double> get_optional() {
    const bool is_there = get<bool>();
    const double value = get<double>();
    return is_there ? std::optional(value) : std::nullopt;
  }

 private:
  std::string_view rest_;
};

void put_type(const ParticleTypeInfo& type, Writer& out) {
  out.put(type.type);
  out.put(type.count);
  out.put(type.table_mass);
  out.put(type.fields.size());
  for (const FieldInfo& field : type.fields) {
    out.put(field.name);
    out.put(field.file_name);
    out.put(field.values_per_particle);
    out.put(field.unit);
  }
}

ParticleTypeInfo get_type(Reader& in) {
  ParticleTypeInfo type;
  type.type = in.get<int>();
  type.count = in.get<std::uint64_t>();
  type.table_mass = in.get_optional();
  type.fields.resize(in.get<std::size_t>());
  for (FieldInfo& field : type.fields) {
    field.name = in.get_text();
    field.file_name = in.get_text();
    field.values_per_particle = in.get<int>();
    field.unit = in.get_text();
  }
  return type;
}

std::string text_of(const std::optional<BoxSides>& box) {
  return box ? box->text() : "none";
}

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

void require_same(const std::string& what, std::size_t rank, const std::string& found,
                  const std::string& expected) {
  if (found == expected) return;
  throw UsageError(
      fmt::format("particles spread over processes: found {} {} on rank {}, expected that of rank "
                  "0, {}; give all ranks the same",
                  what, found, rank, expected));
}

// Which fields there are, with the number of their values, in any order.
std::string fields_of(const ParticleTypeInfo& type) {
  std::set<std::string> fields;
  for (const FieldInfo& field : type.fields)
    fields.insert(field.values_per_particle == 1
                      ? field.name
                      : fmt::format("{} ({} values)", field.name, field.values_per_particle));
  return fields.empty() ? "none" : fmt::format("{}", fmt::join(fields, ", "));
}

// A type as the ranks have it. One that has no particles need not say more of them.
class WholeType {
 public:
  void add(const ParticleTypeInfo& part, std::size_t rank) {
    if (!first_) {
      whole_ = part;
      first_ = rank;
      return;
    }
    const bool is_first_with_particles = whole_.count == 0 && part.count > 0;
    const std::uint64_t count = whole_.count + part.count;
    if (part.count > 0 && !is_first_with_particles) check(part, rank);
    if (is_first_with_particles) {
      whole_ = part;
      first_ = rank;
    }
    whole_.count = count;
  }
  const ParticleTypeInfo& whole() const { return whole_; }

 private:
  void check(const ParticleTypeInfo& part, std::size_t rank) const {
    check_alike("fields", part, rank, fields_of(part), fields_of(whole_));
    check_alike("the mass for all", part, rank, text_of(part.table_mass),
                text_of(whole_.table_mass));
  }
  void check_alike(const std::string& what, const ParticleTypeInfo& part, std::size_t rank,
                   const std::string& found, const std::string& expected) const {
    if (found == expected) return;
    throw UsageError(fmt::format(
        "particles of type {} spread over processes: found {} {} on rank {}, expected those of "
        "rank {}, {}; give all ranks with particles of the type the same",
        part.type, what, found, rank, *first_, expected));
  }

  ParticleTypeInfo whole_;
  std::optional<std::size_t> first_;  // the rank that says what it is like
};

}  // namespace

std::string packed(const SnapshotPart& part) {
  Writer out;
  out.put(part.info.time);
  out.put(part.info.redshift);
  const std::optional<BoxSides>& box = part.info.box_size;
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.put(box ? (*box)[axis] : 0.0);
  for (const double x : part.origin.a)
    out.put(x);
  out.put(part.info.types.size());
  for (const ParticleTypeInfo& type : part.info.types)
    put_type(type, out);
  return out.take();
}

SnapshotPart unpacked(const std::string& text) {
  Reader in(text);
  SnapshotPart part;
  part.info.time = in.get<double>();
  part.info.redshift = in.get_optional();
  std::vector<double> sides;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sides.push_back(in.get<double>());
  part.info.box_size = box_of(sides);
  for (double& x : part.origin.a)
    x = in.get<double>();
  const auto types = in.get<std::size_t>();
  for (std::size_t t = 0; t < types; ++t)
    part.info.types.push_back(get_type(in));
  return part;
}

SnapshotInfo whole_of(const std::vector<SnapshotPart>& parts) {
  const SnapshotPart& first = parts.front();
  std::map<int, WholeType> types;
  for (std::size_t rank = 0; rank < parts.size(); ++rank) {
    const SnapshotPart& part = parts[rank];
    require_same("a time of", rank, fmt::format("{}", part.info.time),
                 fmt::format("{}", first.info.time));
    require_same("a redshift of", rank, text_of(part.info.redshift), text_of(first.info.redshift));
    require_same("a box size of", rank, text_of(part.info.box_size), text_of(first.info.box_size));
    require_same("an origin of positions of", rank,
                 fmt::format("{}", fmt::join(part.origin.a, " ")),
                 fmt::format("{}", fmt::join(first.origin.a, " ")));
    for (const ParticleTypeInfo& type : part.info.types)
      types[type.type].add(type, rank);
  }
  SnapshotInfo whole = first.info;
  whole.types.clear();
  for (const auto& [number, type] : types)
    whole.types.push_back(type.whole());
  return whole;
}

}  // namespace splotchcl
