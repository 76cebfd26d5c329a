#pragma once

#include "splotchcl/vector.h"
#include "testing.h"

namespace splotchcl::test {

inline void expect_near(const Vec3& a, const Vec3& b, double limit) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(a.a[axis], b.a[axis], limit);
}

}  // namespace splotchcl::test
