#pragma once

#include "splotchcl/particles.h"

namespace splotchcl {

// Whether both have as many particles and the same columns: the same memory, the same that makes
// their values, or the same value for all. Whoever keeps `known` keeps its memory alive, so that no
// other column can have come to lie there. No value is made. Origins and boxes are not compared.
bool have_same_columns(const Particles& known, const Particles& particles);

}  // namespace splotchcl
