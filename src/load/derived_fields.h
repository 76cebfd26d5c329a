#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formula/formula.h"
#include "formula/formula_units.h"
#include "formula/formula_values.h"
#include "load/type_fields.h"
#include "splotchcl/snapshot.h"

// Fields that follow from others.
namespace splotchcl {

// The mass fraction of hydrogen that abundances and temperatures are computed with.
constexpr double hydrogen_mass_fraction = 0.76;

// T = (gamma - 1) u mu m_p / k_B in kelvin, with gamma = 5/3, u = `internal_energy` *
// `energy_unit` in (cm/s)^2 and the mean molecular weight mu = 4 / (1 + 3 X + 4 X n_e),
// n_e the electrons per hydrogen nucleus and X the mass fraction of hydrogen (the rest
// being helium). Without n_e (an absent column) all is ionised: n_e = (1 + X) / (2 X). Here and
// below values are held in memory unless `streams` says, or one of the columns is, otherwise.
Column temperatures(const Column& internal_energy, const Column& electron_abundance,
                    double energy_unit, std::size_t count, bool streams = false);

// The same of gas with an internal energy of 1 that is all ionised.
double temperature_of_one(double energy_unit);

// The field's unit of energy per mass in (cm/s)^2, from its name and the header. Nothing
// when it is not known.
std::optional<double> energy_unit_in_cgs(const SnapshotInfo& info, const FieldInfo& field);

// Mass over density, whose unit is `density_unit` times that of mass over volume.
Column volumes_of(const Column& mass, const Column& density, double density_unit, std::size_t count,
                  bool streams);

// |v| of vectors, 3 values each.
Column lengths_of_vectors(const Column& vectors, bool streams);
// One axis of vectors, to which `added` is added in double precision.
Column axis_of_vectors(const Column& vectors, std::size_t axis, double added, bool streams);
// |x - center| with x = origin + position, in double precision.
Column distances(const Column& position, const Vec3& origin, const Vec3& center, bool streams);

// {velocity, 2} of "velocity_z" or "vz", as of "z" {position, 2}, where the type has such a vector
// field; no field otherwise.
std::pair<const FieldInfo*, std::size_t> find_axis(const ParticleTypeInfo& type,
                                                   const std::string& name);

// Of the values of a field that the type has or that can be derived; empty where it is not known.
std::string unit_of(const ParticleTypeInfo& type, const std::string& name);

// The names of what can be derived for this type and is not a field of its own.
std::vector<std::string> derivable_fields(const ParticleTypeInfo& type);

// Formulas and conditions on the fields of a type; `key` is the scene's that has them.

// Throws UsageError for a text that is no condition.
Formula condition_on(const TypeFields& fields, const std::string& text, const std::string& key);

// Refuses, before anything is read, fields that the type does not have and units that do not fit
// each other.
void check_formula(const TypeFields& fields, const Formula& formula, const std::string& key);

std::shared_ptr<const FormulaValues> formula_values(const TypeFields& fields,
                                                    const Formula& formula, const std::string& key);

}  // namespace splotchcl
