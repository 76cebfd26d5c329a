#include "formats/gadget/gadget_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/words.h"
#include "snapshot/field_names.h"
#include "snapshot/stated_numbers.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::uint64_t sum(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

void check_same_snapshot(const GadgetHeader& first, const GadgetHeader& other,
                         const std::filesystem::path& first_path,
                         const std::filesystem::path& other_path) {
  const char* difference = nullptr;
  if (other.counts.size() != first.counts.size()) difference = "number of particle types";
  if (other.table_masses != first.table_masses) difference = "mass table";
  if (other.total_counts != first.total_counts) difference = "total number of particles";
  if (other.files != first.files) difference = "number of files";
  if (other.redshift != first.redshift) difference = "redshift";
  if (other.box_size.has_value() != first.box_size.has_value() ||
      (first.box_size && other.box_size->text() != first.box_size->text()))
    difference = "box";
  if (other.time != first.time) difference = "time";
  if (difference == nullptr) return;
  throw DataError(
      fmt::format("{}: its header has another {} than that of {}; the files belong to different "
                  "snapshots: keep those of one snapshot together",
                  other_path.string(), difference, first_path.filename().string()));
}

bool have_high_words(const std::vector<GadgetHeader>& headers) {
  return std::any_of(headers.begin(), headers.end(),
                     [](const GadgetHeader& header) { return sum(header.total_counts_high) > 0; });
}

// Gadget keeps the scale factor as the time of a cosmological run. One without cosmology may
// have a density parameter in its header all the same.
bool is_cosmological(const GadgetHeader& header) {
  constexpr double rounding = 1e-4;
  return header.omega_matter > 0 && header.time > 0 &&
         std::abs(header.time * (1 + header.redshift) - 1) < rounding;
}

std::vector<double> sides_of(const BoxSides& box) {
  return box.is_cube() ? std::vector{box[0]} : std::vector{box[0], box[1], box[2]};
}

}  // namespace

std::uint64_t GadgetHeader::particles() const {
  return sum(counts);
}

std::vector<std::uint64_t> GadgetHeader::full_total_counts() const {
  std::vector<std::uint64_t> totals = total_counts;
  for (std::size_t type = 0; type < std::min(totals.size(), total_counts_high.size()); ++type) {
    totals[type] += total_counts_high[type] << 32;
  }
  return totals;
}

void check_header(const GadgetHeader& header, const std::filesystem::path& path) {
  for (std::size_t type = 0; type < header.table_masses.size(); ++type) {
    const double mass = header.table_masses[type];
    if (std::isfinite(mass) && mass >= 0) continue;
    throw DataError(fmt::format(
        "{}: the header's mass table holds {} for type {}; expected 0 or a mass: the header is "
        "damaged, or the file is no snapshot",
        path.string(), mass, type));
  }
  if (header.particles() == 0 && header.files <= 1) {
    throw DataError(fmt::format(
        "{}: its header counts no particles of any type; expected a snapshot with particles",
        path.string()));
  }
}

bool is_complete_alone(const GadgetHeader& header) {
  return header.files <= 1 ||
         (header.particles() > 0 && header.counts == header.full_total_counts());
}

bool may_have_siblings(const GadgetHeader& header, std::size_t files_there) {
  if (header.files > 1) return files_there == static_cast<std::size_t>(header.files);
  return header.total_counts != header.counts &&
         sum(header.full_total_counts()) > header.particles();
}

bool are_of_one_time(const GadgetHeader& a, const GadgetHeader& b) {
  return a.time == b.time && a.files == b.files && a.counts.size() == b.counts.size();
}

GadgetHeader merge_headers(const std::vector<GadgetHeader>& headers,
                           const std::vector<std::filesystem::path>& paths,
                           std::vector<std::string>& notes) {
  GadgetHeader merged = headers.front();
  for (std::size_t i = 1; i < headers.size(); ++i) {
    check_same_snapshot(headers.front(), headers[i], paths.front(), paths[i]);
    for (std::size_t type = 0; type < merged.counts.size(); ++type) {
      merged.counts[type] += headers[i].counts[type];
    }
  }
  if (merged.particles() == 0) {
    throw DataError(fmt::format("{}: the headers of its {} count no particles of any type",
                                paths.front().string(), counted(paths.size(), "file")));
  }
  if (headers.size() == 1 && merged.files > 1) {
    notes.push_back(
        fmt::format("the header speaks of {} files, but this one is complete", merged.files));
  }
  if (headers.size() > 1 && merged.files <= 1) {
    notes.push_back(fmt::format(
        "the headers of {} files beside each other say that each is the only one; they are read "
        "together, as their particles add up to the total in the headers",
        headers.size()));
  }
  const std::vector<std::uint64_t> totals = merged.full_total_counts();
  if (sum(totals) == 0 || totals == merged.counts) return merged;
  if (have_high_words(headers) && merged.total_counts == merged.counts) {
    notes.push_back(
        "the high words of the header's total numbers of particles are ignored: the files' own "
        "counts contradict them");
    return merged;
  }
  if (headers.size() > 1) {
    throw DataError(fmt::format(
        "{}: the {} files together hold {} particles, but their headers say {}; a file may be "
        "missing, exchanged or damaged: restore the set{}",
        paths.front().string(), paths.size(), merged.particles(), sum(totals),
        merged.files > 1 ? "" : ", or read one file alone under a name without a number"));
  }
  notes.push_back(fmt::format(
      "the header's total number of particles ({}) is not the number in the file ({}); ignored",
      sum(totals), merged.particles()));
  return merged;
}

void add_table_mass(ParticleTypeInfo& type, const char* label, std::vector<std::string>& notes) {
  const bool has_own_masses = std::any_of(
      type.fields.begin(), type.fields.end(),
      [](const FieldInfo& field) { return canonical_field_name(field.file_name) == "mass"; });
  if (has_own_masses) {
    type.table_mass.reset();
  } else if (type.table_mass) {
    type.fields.push_back({"", label, 1, ""});
  } else {
    notes.push_back(fmt::format(
        "particles of type {} have no masses: neither their own nor in the header's mass table",
        type.type));
  }
}

void note_other_scale_factor(SnapshotInfo& info) {
  constexpr double rounding = 1e-3;
  const double redshift = info.redshift.value_or(0);
  const bool may_be_one = info.time > 0 && info.time <= 1 && info.redshift.has_value();
  if (info.cosmology || !may_be_one || std::abs(info.time * (1 + redshift) - 1) < rounding) return;
  info.notes.push_back(
      fmt::format("the header's time, {}, is no scale factor of its redshift, {}: a is {:.6g} in "
                  "units, of the redshift",
                  info.time, redshift, 1 / (1 + redshift)));
}

void describe(const GadgetHeader& header, SnapshotInfo& info) {
  info.time = header.time;
  // Runs without cosmology write a redshift of 0 that means nothing.
  if (header.omega_matter > 0 || header.redshift != 0) info.redshift = header.redshift;
  if (header.box_size) info.box_size = box_stated(sides_of(*header.box_size), info.notes);
  const double hubble_parameter = hubble_parameter_of(header.hubble_parameter, info.notes);
  if (hubble_parameter > 0) info.hubble_parameter = hubble_parameter;
  if (is_cosmological(header)) {
    // kpc/h and km/s, as most have them: the header does not say.
    constexpr double hubble_rate = 0.1;
    info.cosmology =
        Cosmology{header.time, header.omega_matter, header.omega_lambda, hubble_rate, 0.5};
  }
  for (std::size_t type = 0; type < header.counts.size(); ++type) {
    if (header.counts[type] == 0) continue;
    ParticleTypeInfo particles;
    particles.type = static_cast<int>(type);
    particles.count = header.counts[type];
    if (header.table_masses[type] > 0) particles.table_mass = header.table_masses[type];
    info.types.push_back(std::move(particles));
  }
}

}  // namespace splotchcl
