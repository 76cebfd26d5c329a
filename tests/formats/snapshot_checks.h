#pragma once

#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {

using ::testing::DoubleNear;
using ::testing::Pointwise;

// The values of a column as a vector, one value for a uniform one.
inline std::vector<float> values_of(const Column& column) {
  if (column.is_uniform()) return {column.uniform_value()};
  return {column.data(), column.data() + column.size()};
}

// Positions of a type from 0, not from the snapshot's origin.
inline std::vector<double> absolute_positions(const Snapshot& snapshot, int type) {
  const Column offsets = snapshot.read(type, "position");
  std::vector<double> values;
  for (std::size_t i = 0; i < offsets.size(); ++i)
    values.push_back(static_cast<double>(offsets[i]) + snapshot.position_origin().a[i % 3]);
  return values;
}

inline std::vector<float> as_floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

inline bool has_field(const Snapshot& snapshot, int type, const std::string& name) {
  for (const FieldInfo& field : snapshot.info().find_type(type)->fields) {
    if (field.name == name) return true;
  }
  return false;
}

// Every field of `expected` reads the same, bit for bit, from both. Fields are found by
// canonical name, so that dialects with other labels can be compared.
inline void expect_same_columns(const Snapshot& actual, const Snapshot& expected) {
  ASSERT_EQ(actual.info().types.size(), expected.info().types.size());
  for (const ParticleTypeInfo& type : expected.info().types) {
    ASSERT_NE(actual.info().find_type(type.type), nullptr);
    EXPECT_EQ(actual.info().find_type(type.type)->count, type.count);
    EXPECT_EQ(actual.info().find_type(type.type)->table_mass, type.table_mass);
    EXPECT_EQ(actual.info().find_type(type.type)->fields.size(), type.fields.size());
    for (const FieldInfo& field : type.fields) {
      EXPECT_EQ(values_of(actual.read(type.type, field.name)),
                values_of(expected.read(type.type, field.name)))
          << "type " << type.type << " " << field.name;
    }
  }
}

// The columns hold what the test has put into the file.
inline void expect_columns_of(const Snapshot& actual, const TestSnapshot& expected) {
  for (const TestBlock& block : expected.blocks) {
    for (int type = 0; type < 6; ++type) {
      const auto& values = block.values[static_cast<std::size_t>(type)];
      if (values.empty()) continue;
      EXPECT_EQ(values_of(actual.read(type, block.label)), as_floats(values))
          << "type " << type << " " << block.label;
    }
  }
}

// Its positions as doubles that single precision would round to 2^-5.
inline TestSnapshot of_doubles_far_away(TestSnapshot snapshot) {
  snapshot.set_kind("POS", ValueKind::float64);
  for (auto& of_type : snapshot.block("POS").values) {
    for (double& x : of_type)
      x += 1e6 + 1e-7;
  }
  return snapshot;
}

// Of doubles, in the first block. Offsets from the median are below 64, where floats lie 2^-18
// apart.
inline void expect_positions_of(const Snapshot& actual, const TestSnapshot& expected) {
  for (const std::size_t type : {0U, 1U, 4U})
    EXPECT_THAT(absolute_positions(actual, static_cast<int>(type)),
                Pointwise(DoubleNear(0x1p-18), expected.blocks.front().values[type]));
}

// What opening says about a file that must be refused; empty when it is not refused.
inline std::string refusal(const std::filesystem::path& path) {
  return refusal_by<DataError>([&] { open_snapshot(path); });
}

}  // namespace splotchcl::test
