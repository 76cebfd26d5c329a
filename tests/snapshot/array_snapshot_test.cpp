#include "splotchcl/array_snapshot.h"

#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

TEST(ArraySnapshot, FloatsAreBorrowed) {
  std::vector<float> position = {1, 2, 3, 4, 5, 6};
  ArraySnapshot snapshot;
  snapshot.set_field(0, "position", position.data(), 2, 3);
  EXPECT_EQ(snapshot.read(0, "position").data(), position.data());
  position[4] = 50;
  EXPECT_EQ(snapshot.read(0, "position")[4], 50);
  EXPECT_EQ(snapshot.info().find_type(0)->count, 2u);
}

TEST(ArraySnapshot, AnOwnerIsKeptAsLongAsItsValuesAreHad) {
  auto owner = std::make_shared<const std::vector<float>>(2, 5.0F);
  ArraySnapshot snapshot;
  snapshot.set_field(0, "mass", owner->data(), 2, 1, owner);
  Column column = snapshot.read(0, "mass");
  const std::weak_ptr<const std::vector<float>> kept = std::exchange(owner, nullptr);
  snapshot.clear(0);
  EXPECT_EQ(column[1], 5);
  column = {};
  EXPECT_TRUE(kept.expired());
}

TEST(ArraySnapshot, AFilesNamesForAFieldFindIt) {
  const std::vector<float> values = {1, 2};
  ArraySnapshot snapshot;
  snapshot.set_field(0, "HSML", values.data(), 2);
  EXPECT_EQ(snapshot.read(0, "smoothing_length")[1], 2);
  EXPECT_EQ(snapshot.read(0, "SmoothingLength")[1], 2);
}

TEST(ArraySnapshot, AUnitIsThatOfTheFieldUntilItIsSetAgain) {
  const std::vector<float> values = {1, 2};
  ArraySnapshot snapshot;
  EXPECT_THROW(snapshot.set_unit(0, "Density", "g/cm^3"), UsageError);
  snapshot.set_field(0, "Density", values.data(), 2);
  snapshot.set_unit(0, "Density", "g/cm^3");
  EXPECT_EQ(require_field(snapshot.info(), 0, "density").unit, "g/cm^3");
  snapshot.set_field(0, "Mass", values.data(), 2);
  EXPECT_EQ(require_field(snapshot.info(), 0, "density").unit, "g/cm^3");
  snapshot.set_field(0, "Density", values.data(), 2);
  EXPECT_EQ(require_field(snapshot.info(), 0, "density").unit, "");
}

TEST(ArraySnapshot, DoublePositionsKeepTheirOffsetsFromTheOrigin) {
  const std::vector<double> position = {1e9 + 0.25, -1e9, 3};
  ArraySnapshot snapshot;
  snapshot.set_position_origin({{1e9, -1e9, 0}});
  snapshot.set_field(1, "position", position.data(), 1, 3);
  EXPECT_EQ(snapshot.read(1, "position")[0], 0.25F);
  EXPECT_EQ(snapshot.read(1, "position")[1], 0);
  EXPECT_THROW(snapshot.set_position_origin({{0, 0, 0}}), UsageError);
}

TEST(ArraySnapshot, WhatWasComputedOfItIsForgottenWhenItChanges) {
  ArraySnapshot snapshot;
  int computed = 0;
  const auto compute = [&] { snapshot.memory().get<int>("what", [&] { return ++computed; }); };
  compute();
  compute();
  EXPECT_EQ(computed, 1);
  snapshot.set_position_origin({{1, 2, 3}});
  compute();
  EXPECT_EQ(computed, 2);
  snapshot.set_time(0.5);
  compute();
  EXPECT_EQ(computed, 3);
}

TEST(ArraySnapshot, CountsOfATypeAgree) {
  const std::vector<float> values(9);
  ArraySnapshot snapshot;
  snapshot.set_field(0, "position", values.data(), 3, 3);
  EXPECT_THROW(snapshot.set_field(0, "mass", values.data(), 2), UsageError);
  snapshot.set_field(4, "mass", values.data(), 2);
  snapshot.clear(0);
  snapshot.set_field(0, "mass", values.data(), 2);
  EXPECT_EQ(snapshot.info().find_type(0)->count, 2u);
}

TEST(ArraySnapshot, WhatIsNoFieldIsRefused) {
  const std::vector<float> values(9);
  const float* const nothing = nullptr;
  ArraySnapshot snapshot;
  EXPECT_THROW(snapshot.set_field(-1, "mass", values.data(), 2), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "", values.data(), 2), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "mass", values.data(), 2, 2), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "position", values.data(), 2, 1), UsageError);
  EXPECT_THROW(snapshot.set_field(0, "mass", nothing, 2), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
