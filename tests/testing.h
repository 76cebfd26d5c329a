#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "long_tests.h"
#include "paths.h"
#include "splotchcl/error.h"
#include "temporary_folder.h"

// What nearly every test uses, read once for all of them: it is what is precompiled.
namespace splotchcl {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

namespace test {

// What the action was refused with; empty where it was not.
template <class Refusal, class Action>
std::string refusal_by(const Action& action) {
  try {
    action();
  } catch (const Refusal& error) {
    return error.what();
  }
  return {};
}

}  // namespace test
}  // namespace splotchcl
