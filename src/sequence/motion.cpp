#include "sequence/motion.h"

#include <fmt/format.h>

#include <cmath>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

[[noreturn]] void refuse(const SnapshotInfo& info, const std::string& what) {
  throw UsageError(
      fmt::format("time.interpolation is \"hermite\", which needs velocities, but {}: {}; set "
                  "time.interpolation to \"linear\", or say what is missing",
                  info.files.front().string(), what));
}

std::optional<Cosmology> cosmology_of(const SnapshotInfo& info, const SequenceSettings& settings) {
  std::optional<Cosmology> cosmology = info.cosmology;
  // The scene says that there is one where the snapshot does not.
  if (!cosmology && settings.omega_matter && info.time > 0) {
    cosmology.emplace();
    cosmology->scale_factor = info.time;
  }
  if (!cosmology) return std::nullopt;
  cosmology->omega_matter = settings.omega_matter.value_or(cosmology->omega_matter);
  cosmology->omega_lambda = settings.omega_lambda.value_or(cosmology->omega_lambda);
  cosmology->hubble_rate = settings.hubble_rate.value_or(cosmology->hubble_rate);
  return cosmology;
}

// da as a change of comoving position per stored velocity.
double comoving_rate(const Cosmology& cosmology, const SnapshotInfo& info) {
  const double a = cosmology.scale_factor;
  const double hubble =
      cosmology.hubble_rate * expansion_rate(a, cosmology.omega_matter, cosmology.omega_lambda);
  if (!(hubble > 0) || !std::isfinite(hubble)) {
    refuse(info,
           fmt::format("its expansion rate is not known (omega_matter {}, omega_lambda {}, "
                       "hubble_rate {})",
                       cosmology.omega_matter, cosmology.omega_lambda, cosmology.hubble_rate));
  }
  return std::pow(a, cosmology.velocity_power) / (a * a * hubble);
}

}  // namespace

double expansion_rate(double scale_factor, double omega_matter, double omega_lambda) {
  const double z1 = 1 / scale_factor;
  const double curvature = 1 - omega_matter - omega_lambda;
  return std::sqrt(omega_matter * z1 * z1 * z1 + curvature * z1 * z1 + omega_lambda);
}

Motion find_motion(const SnapshotInfo& first, const SnapshotInfo& second,
                   const SequenceSettings& settings) {
  const auto cosmology = cosmology_of(first, settings);
  const auto second_cosmology = cosmology_of(second, settings);
  Motion motion;
  // A run without cosmology may happen to stop at a time that fits its redshift of 0.
  if (cosmology && second_cosmology) {
    motion.first_time = cosmology->scale_factor;
    motion.second_time = second_cosmology->scale_factor;
    motion.first_rate = comoving_rate(*cosmology, first);
    motion.second_rate = comoving_rate(*second_cosmology, second);
  } else {
    for (const SnapshotInfo* const info : {&first, &second}) {
      if (!info->velocity_doubt.empty()) refuse(*info, info->velocity_doubt);
    }
    motion.first_time = first.time;
    motion.second_time = second.time;
  }
  if (motion.first_time == motion.second_time) {
    refuse(second, fmt::format("it has the same time, {}, as {}", motion.second_time,
                               first.files.front().string()));
  }
  return motion;
}

}  // namespace splotchcl
