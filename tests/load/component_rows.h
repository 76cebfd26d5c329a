#pragma once

#include <string>
#include <vector>

#include "testing.h"
#include "text_rows.h"

namespace splotchcl::test {

// A component's keys in a scene file, and below them other tables, as texts of a file (text_rows.h)
// in tests; what is loaded of it from the six particles of gas_row (load/particles.h), which
// "given N particles", "given FIELD VALUES", "given origin X Y Z" and "given box SIDE" change.
// Expected is "COLUMN VALUES", of which "weight" is the mass; "count N"; "range LOW HIGH" of the
// color after scaling; "note PART OF ONE", "no note PART", "no notes"; or "refused PART".
class ComponentKeys : public ::testing::TestWithParam<TextRow> {};

std::vector<TextRow> component_rows(const std::string& file);

inline std::string name_of_component_row(const ::testing::TestParamInfo<TextRow>& info) {
  return info.param.name;
}

}  // namespace splotchcl::test
