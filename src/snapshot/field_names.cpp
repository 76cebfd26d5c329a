#include "snapshot/field_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>
#include <vector>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct FieldNames {
  const char* canonical;
  std::vector<const char*> labels;  // Gadget blocks, then HDF5 dialects
};

const std::vector<FieldNames>& known_fields() {
  static const std::vector<FieldNames> table = {
      {"position", {"POS", "Coordinates", "Coordinate", "Positions", "coords", "xyz", "Points"}},
      {"velocity", {"VEL", "Velocities", "vxyz"}},
      {"id", {"ParticleIDs", "ParticleID", "ids", "iorder", "iord"}},
      {"halo_id",
       {"FOFGroupIDs", "FOFGroupID", "GroupNr_bound", "GroupNr_all", "GroupNr", "GroupNumber",
        "GroupIDs", "GroupID", "HaloID"}},
      {"mass",
       {"Masses", "mass table", "MassTable", "m", "DynamicalMasses", "particle mass",
        "particle_mass"}},
      {"internal_energy", {"U", "InternalEnergy", "InternalEnergies"}},
      {"density", {"RHO", "Densities", "den"}},
      {"smoothing_length",
       {"HSML", "SmoothingLength", "SmoothingLengths", "KernelMaxRadius", "h", "smoothlength",
        "smooth"}},
      {"star_smoothing_length", {"HSMS", "StellarHsml"}},
      {"temperature", {"TEMP", "Temperatures", "T"}},
      {"stellar_age",
       {"AGE", "StellarAge", "StellarFormationTime", "GFM_StellarFormationTime", "tform"}},
      {"metallicity", {"Z", "Metals", "GFM_Metallicity", "MetalMassFractions"}},
      {"potential", {"POT", "Potentials", "phi", "poten"}},
      {"acceleration", {"ACCE", "Accelerations"}},
      {"softening", {"Softenings", "eps", "hsmooth"}},
      {"entropy_change_rate", {"ENDT", "RateOfChangeOfEntropy"}},
      {"time_step", {"TSTP", "TimeStep", "TimeSteps"}},
      {"volume", {"VOL", "Volumes"}},
      {"entropy", {"Entropies"}},
      {"pressure", {"Pressures"}},
      {"electron_abundance", {"NE", "ElectronAbundance"}},
      {"neutral_hydrogen_abundance", {"NH", "NeutralHydrogenAbundance"}},
      {"star_formation_rate", {"SFR", "StarFormationRate", "StarFormationRates"}},
      {"magnetic_field", {"BFLD", "MagneticField", "Bxyz"}},
  };
  return table;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Whether a label is a name in words that are apart or joined: "Smoothing Length" and
// "smoothing_lengths" as "SmoothingLength(s)". Short ones may mean something else: n_e is no NE.
bool is_same_name(std::string_view label, std::string_view known) {
  constexpr std::size_t short_name = 5;
  if (known.size() <= short_name) return equal_ignoring_case(label, known);
  const auto next_letter = [](std::string_view text, std::size_t i) {
    return std::min(text.find_first_not_of(" _-", i), text.size());
  };
  std::size_t i = next_letter(label, 0), j = next_letter(known, 0);
  while (i < label.size() && j < known.size() && lower(label[i]) == lower(known[j])) {
    i = next_letter(label, i + 1);
    j = next_letter(known, j + 1);
  }
  return i == label.size() && j == known.size();
}

std::string_view without_trailing_blanks(std::string_view text) {
  const std::size_t last = text.find_last_not_of(' ');
  return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

}  // namespace

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

std::string canonical_field_name(std::string_view label) {
  const std::string_view text = without_trailing_blanks(label);
  for (const FieldNames& field : known_fields()) {
    if (is_same_name(text, field.canonical)) return field.canonical;
    for (const char* const known : field.labels) {
      if (is_same_name(text, known)) return field.canonical;
    }
  }
  return {};
}

std::vector<std::string> names_of_fields(const std::vector<FieldInfo>& fields) {
  const auto wanted = [](const FieldInfo& field) {
    return field.name.empty() ? canonical_field_name(field.file_name) : field.name;
  };
  std::map<std::string, const FieldInfo*> owners;
  for (const FieldInfo& field : fields) {
    const FieldInfo*& owner = owners[wanted(field)];
    // Else the name would mean the one and the other.
    const bool is_better = owner != nullptr && owner->name.empty() && field.name.empty() &&
                           field.file_name == wanted(field);
    if (owner == nullptr || is_better) owner = &field;
  }
  std::vector<std::string> names;
  for (const FieldInfo& field : fields) {
    const std::string name = wanted(field);
    const bool is_owner = !name.empty() && owners.at(name) == &field;
    names.push_back(is_owner ? name : field.file_name);
  }
  return names;
}

void name_fields(ParticleTypeInfo& type) {
  for (FieldInfo& field : type.fields)
    field.name.clear();
  const std::vector<std::string> names = names_of_fields(type.fields);
  for (std::size_t i = 0; i < names.size(); ++i)
    type.fields[i].name = names[i];
}

const FieldInfo* find_field(const ParticleTypeInfo& type, std::string_view name) {
  const auto find = [&type](auto&& matches) -> const FieldInfo* {
    const auto found = std::find_if(type.fields.begin(), type.fields.end(), matches);
    return found == type.fields.end() ? nullptr : &*found;
  };
  const std::string_view wanted = without_trailing_blanks(name);
  // The file's own spelling first: it is the only way to reach the second of two fields
  // that mean the same quantity.
  if (const auto* field = find([&](const FieldInfo& f) { return f.file_name == wanted; })) {
    return field;
  }
  if (const auto* field = find([&](const FieldInfo& f) {
        return equal_ignoring_case(f.name, wanted) || equal_ignoring_case(f.file_name, wanted);
      })) {
    return field;
  }
  const std::string canonical = canonical_field_name(wanted);
  if (canonical.empty()) return nullptr;
  if (const auto* field = find([&](const FieldInfo& f) { return f.name == canonical; })) {
    return field;
  }
  if (canonical != "smoothing_length") return nullptr;
  return find([](const FieldInfo& f) { return f.name == "star_smoothing_length"; });
}

bool has_masses(const ParticleTypeInfo& type) {
  return type.table_mass || find_field(type, "mass") != nullptr;
}

const ParticleTypeInfo& require_type(const SnapshotInfo& info, int type) {
  if (const ParticleTypeInfo* const found = info.find_type(type)) return *found;
  std::vector<int> types;
  for (const ParticleTypeInfo& present : info.types)
    types.push_back(present.type);
  throw DataError(fmt::format("{}: no particles of type {}; the types with particles are {}",
                              info.files.front().string(), type, fmt::join(types, ", ")));
}

const FieldInfo& require_field(const SnapshotInfo& info, int type, std::string_view name) {
  const ParticleTypeInfo& particles = require_type(info, type);
  if (const FieldInfo* const found = find_field(particles, name)) return *found;
  std::vector<std::string> names;
  for (const FieldInfo& field : particles.fields)
    names.push_back(field.name);
  throw DataError(fmt::format("{}: particles of type {} have no field '{}'; they have {}",
                              info.files.front().string(), type, name, fmt::join(names, ", ")));
}

std::string why_left_out(const SnapshotInfo& info, std::string_view name) {
  if (name.empty()) return {};
  const std::string meaning = canonical_field_name(name);
  const auto names_it = [&](std::string_view note) {
    while (!note.empty()) {
      const std::size_t end = std::min(note.find_first_of(" ,:;()/"), note.size());
      const std::string_view word = note.substr(0, end);
      const bool is_it = equal_ignoring_case(word, name) ||
                         (!meaning.empty() && canonical_field_name(word) == meaning);
      if (is_it) return true;
      note.remove_prefix(std::min(end + 1, note.size()));
    }
    return false;
  };
  const auto found =
      std::find_if(info.notes.begin(), info.notes.end(), [&](const std::string& note) {
        return note.find("left out") != std::string::npos && names_it(note);
      });
  return found == info.notes.end() ? std::string() : " (" + *found + ")";
}

const FieldInfo& require_ids(const SnapshotInfo& info, int type) {
  if (const FieldInfo* const found = find_field(require_type(info, type), "id")) return *found;
  throw DataError(fmt::format(
      "{}: particles of type {} have no ids, expected ids, by which particles of different "
      "snapshots are matched: use a snapshot with ids",
      info.files.front().string(), type));
}

void refuse_integers(const SnapshotInfo& info, int type, const FieldInfo& field) {
  throw DataError(
      fmt::format("{}: {} of type {} is not one whole number per particle, as was expected",
                  info.files.front().string(), field.file_name, type));
}

void refuse_ids(const SnapshotInfo& info, int type, const FieldInfo& field) {
  throw DataError(
      fmt::format("{}: the ids of type {} ({}) are not one whole number per particle, as was "
                  "expected; the file is damaged or of an unknown dialect",
                  info.files.front().string(), type, field.file_name));
}

namespace {

constexpr std::array<std::pair<const char*, int>, 12> other_names = {{
    {"dm", 1},
    {"dark", 1},
    {"dark_matter", 1},
    {"darkmatter", 1},
    {"disc", 2},
    {"star", 4},
    {"bndry", 5},
    {"bh", 5},
    {"black_hole", 5},
    {"black_holes", 5},
    {"blackhole", 5},
    {"blackholes", 5},
}};

// PartType12 is 12.
std::optional<int> number_of_group(std::string_view word) {
  constexpr std::string_view stem = "PartType";
  if (!equal_ignoring_case(word.substr(0, stem.size()), stem)) return std::nullopt;
  const std::string_view digits = word.substr(stem.size());
  int number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  if (!is_number || number < 0 || number >= particle_type_limit) return std::nullopt;
  return number;
}

}  // namespace

std::string particle_type_name(int type) {
  const auto index = static_cast<std::size_t>(type);
  return index < particle_type_names.size() ? particle_type_names[index]
                                            : "type_" + std::to_string(type);
}

std::optional<int> find_particle_type(std::string_view word) {
  for (std::size_t type = 0; type < particle_type_names.size(); ++type) {
    if (equal_ignoring_case(word, particle_type_names[type])) return static_cast<int>(type);
  }
  for (const auto& [name, type] : other_names) {
    if (equal_ignoring_case(word, name)) return type;
  }
  return number_of_group(word);
}

}  // namespace splotchcl
