#include "parallel/ordered_tasks.h"

#include <chrono>
#include <stdexcept>
#include <string>

#include "testing.h"

namespace splotchcl {
namespace {

// The first goes on only when the second has run.
TEST(OrderedTasks, GiveResultsInTheOrderInWhichTheyWereBegun) {
  std::promise<void> second_has_run;
  OrderedTasks<std::string> tasks;
  tasks.begin([&] {
    const auto wait = second_has_run.get_future().wait_for(std::chrono::minutes(2));
    return std::string(wait == std::future_status::ready ? "first" : "first, alone");
  });
  tasks.begin([&] {
    second_has_run.set_value();
    return std::string("second");
  });
  EXPECT_EQ(tasks.size(), 2U);
  EXPECT_EQ(tasks.take(), "first");
  EXPECT_EQ(tasks.take(), "second");
  EXPECT_EQ(tasks.size(), 0U);
}

TEST(OrderedTasks, ThrowWhatATaskThrewWhereItsResultIsTaken) {
  OrderedTasks<int> tasks;
  tasks.begin([]() -> int { throw std::runtime_error("failed"); });
  tasks.begin([] { return 2; });
  EXPECT_THROW(tasks.take(), std::runtime_error);
  EXPECT_EQ(tasks.take(), 2);
}

}  // namespace
}  // namespace splotchcl
