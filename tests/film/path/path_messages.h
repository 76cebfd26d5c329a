#pragma once

#include "testing.h"

namespace splotchcl::test {

// What a mistake is answered with, one line; empty where it passes.
inline std::string refusal(const std::function<void()>& mistake) {
  try {
    mistake();
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "was not refused";
  return "";
}

}  // namespace splotchcl::test
