#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

TEST(ParticleTypes, TheNamesThatPeopleUseAreFoundInAnyCase) {
  const std::vector<std::pair<std::string, int>> names = {
      {"gas", 0},       {"halo", 1},      {"dm", 1},         {"dark_matter", 1},
      {"disk", 2},      {"bulge", 3},     {"stars", 4},      {"star", 4},
      {"Star", 4},      {"DM", 1},        {"boundary", 5},   {"black_holes", 5},
      {"PartType0", 0}, {"parttype1", 1}, {"PartType31", 31}};
  for (const auto& [name, type] : names)
    EXPECT_EQ(find_particle_type(name), type) << name;
}

TEST(ParticleTypes, OtherWordsMeanNone) {
  for (const char* word : {"", "g", "PartType", "PartType32", "PartType-1", "PartType1x", "4"})
    EXPECT_FALSE(find_particle_type(word)) << word;
}

}  // namespace
}  // namespace splotchcl
