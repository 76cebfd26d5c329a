#pragma once

#include <exception>
#include <functional>
#include <string>

#include "splotchcl/communicator.h"

// Where one rank fails, all end, and one of them says why.
namespace splotchcl {

// What agree() and require_same() throw is one of these as well: all ranks end, by themselves.
class AgreedFailure {
 public:
  virtual ~AgreedFailure() = default;
};

// Thrown by ranks that did not fail, or not first: another one tells what happened. It is no Error,
// so that nobody takes it for one of this rank's own.
class FailedElsewhere : public std::exception, public AgreedFailure {
 public:
  explicit FailedElsewhere(bool is_usage) : is_usage_(is_usage) {}
  const char* what() const noexcept override { return "another process has failed"; }
  bool is_usage() const { return is_usage_; }  // UsageError there, else another Error

 private:
  bool is_usage_;
};

// Collective: does the work, and waits until all ranks have done theirs. Where it throws an Error
// on some, it is thrown on the first of them, which names itself unless all failed alike, and
// FailedElsewhere on all others. `ranks` may be null: one process.
void agree(Communicator* ranks, const std::function<void()>& work);

// Throws DeviceError on all ranks where they have not the same text; `what` names it.
void require_same(Communicator& ranks, const std::string& what, const std::string& own,
                  const std::string& advice);

}  // namespace splotchcl
