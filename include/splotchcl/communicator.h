#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace splotchcl {

// Processes that draw a frame together: ranks 0 to size() - 1, each of which calls what draws. What
// stands below MPI, or threads in tests. All of a communicator's ranks make the same collective
// calls in the same order; what is sent is received in the order in which it was sent. A rank that
// cannot go on calls abort(), which ends all of them.
class Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Among the ranks on this host.
  virtual int rank_on_host() const = 0;
  virtual int size_on_host() const = 0;
  virtual std::string host() const = 0;

  // Collective: all ranks have the root's bytes afterwards.
  virtual void broadcast(void* data, std::size_t bytes, int root) = 0;
  // Collective: every rank has what all ranks gave, by rank. For little.
  virtual std::vector<Bytes> gather(const Bytes& own) = 0;
  // Collective: each value becomes the sum of all ranks'.
  virtual void add_up(std::vector<std::uint64_t>& values) = 0;
  // Collective: part r goes to rank r; what the ranks had for this one, by rank.
  virtual std::vector<Bytes> exchange(std::vector<Bytes> parts) = 0;

  // Between two ranks; a send may wait until the other one receives.
  virtual void send(const void* data, std::size_t bytes, int to) = 0;
  virtual void receive(void* data, std::size_t bytes, int from) = 0;

  // Ends all ranks' processes with this code, whatever they are at.
  [[noreturn]] virtual void abort(int code) = 0;
};

// What ranks throw that have agreed to end what they are at: none of them waits for another one.
class AgreedFailure {
 public:
  virtual ~AgreedFailure() = default;
};

// Thrown by ranks that did not fail, or not first: another one tells what happened, by an Error.
// This is none, so that nobody takes it for one of this rank's own.
class FailedElsewhere : public std::exception, public AgreedFailure {
 public:
  explicit FailedElsewhere(bool is_usage) : is_usage_(is_usage) {}
  const char* what() const noexcept override { return "another process has failed"; }
  bool is_usage() const { return is_usage_; }  // UsageError there, else another Error

 private:
  bool is_usage_;
};

// Made from an MPI communicator by splotchcl::ranks_of (mpi_communicator.h), which tells which MPI
// it is of, "openmpi" or "mpich", and where the MPI_Comm lies. The ranks of one machine share out
// its cores: before the first OpenCL call it sets PoCL's variables of the environment for that,
// unless they are set. Throws UsageError for another MPI, and before MPI_Init; DataError where the
// library was built without a module for this MPI.
std::shared_ptr<Communicator> ranks_of_mpi(const std::string& mpi, const void* communicator);

}  // namespace splotchcl
