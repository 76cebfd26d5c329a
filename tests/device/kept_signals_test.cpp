// What the process does with signals is its own, whatever compilers of kernels do meanwhile.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>

#include "device/opencl/runtime_lock.h"

namespace splotchcl::test {
namespace {

using Handler = void (*)(int);

void of_this_program(int) {}
void also_of_this_program(int) {}

// In another library, as a compiler's. Never called.
Handler of_a_compiler() {
  return reinterpret_cast<Handler>(::dlsym(RTLD_DEFAULT, "srand"));
}

void handle(int signal, Handler handler) {
  struct sigaction action = {};
  action.sa_handler = handler;
  ASSERT_EQ(::sigaction(signal, &action, nullptr), 0);
}

// What is done with it after kernels were compiled, where that was so before and that meanwhile.
Handler after(int signal, Handler before, Handler meanwhile) {
  struct sigaction at_first = {}, at_last = {};
  ::sigaction(signal, nullptr, &at_first);
  handle(signal, before);
  {
    const KeptSignals signals;
    handle(signal, meanwhile);
  }
  ::sigaction(signal, &at_first, &at_last);
  return at_last.sa_handler;
}

TEST(KeptSignals, GiveBackWhatACompilerTook) {
  EXPECT_EQ(after(SIGINT, of_this_program, of_a_compiler()), &of_this_program);
  EXPECT_EQ(after(SIGBUS, of_this_program, of_a_compiler()), &of_this_program);
  EXPECT_EQ(after(SIGSEGV, SIG_DFL, of_a_compiler()), SIG_DFL);
}

TEST(KeptSignals, LeaveWhatThisProgramTookMeanwhile) {
  for (const Handler before : {of_a_compiler(), Handler{of_this_program}, SIG_DFL, SIG_IGN}) {
    EXPECT_EQ(after(SIGINT, before, also_of_this_program), &also_of_this_program);
    EXPECT_EQ(after(SIGBUS, before, also_of_this_program), &also_of_this_program);
  }
}

// As it does when the first Ctrl-C comes.
TEST(KeptSignals, GiveNothingBackToACompilerThatHasDoneWithThem) {
  EXPECT_EQ(after(SIGINT, of_a_compiler(), SIG_IGN), SIG_IGN);
  EXPECT_EQ(after(SIGTERM, of_a_compiler(), SIG_DFL), SIG_DFL);
}

}  // namespace
}  // namespace splotchcl::test
