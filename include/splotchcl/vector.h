#pragma once

// Boost.QVM is header-only, so the renderer still builds with nothing but Boost's
// headers and an OpenCL loader. Components are read as v.a[0], v.a[1], v.a[2].
#include <boost/qvm/vec.hpp>
#include <boost/qvm/vec_access.hpp>
#include <boost/qvm/vec_operations.hpp>

namespace splotchcl {

// x, y and z in double precision.
using Vec3 = boost::qvm::vec<double, 3>;

}  // namespace splotchcl
