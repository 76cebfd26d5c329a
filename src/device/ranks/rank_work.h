#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/communicator.h"
#include "splotchcl/error.h"

namespace splotchcl {

// What one rank has done for a frame.
struct RankWork {
  std::uint64_t particles = 0;   // that it has projected
  std::uint64_t splats = 0;      // that it has composited
  std::uint64_t sent_bytes = 0;  // of splats and planes, to others
};

// The ranks that draw a frame together.
struct FrameRanks {
  Communicator& all;
  RankWork work;

  int rank() const { return all.rank(); }
  int size() const { return all.size(); }
};

// The one rank of a frame that one process draws: what all ranks have is what it has itself.
class LoneRank final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int rank_on_host() const override { return 0; }
  int size_on_host() const override { return 1; }
  std::string host() const override { return {}; }
  void broadcast(void*, std::size_t, int) override {}
  std::vector<Bytes> gather(const Bytes& own) override { return {own}; }
  void add_up(std::vector<std::uint64_t>&) override {}
  std::vector<Bytes> exchange(std::vector<Bytes> parts) override { return parts; }
  void send(const void*, std::size_t, int) override { throw_alone(); }
  void receive(void*, std::size_t, int) override { throw_alone(); }
  [[noreturn]] void abort(int code) override { std::_Exit(code); }

 private:
  [[noreturn]] static void throw_alone() {
    throw Error(
        "found a message to another process where one draws alone, expected none; please "
        "report this");
  }
};

}  // namespace splotchcl
