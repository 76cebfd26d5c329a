#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "splotchcl/communicator.h"

namespace splotchcl::test {

// Passes all on to other ranks, for tests that change a part of it. Ends nobody.
class ForwardingRanks : public Communicator {
 public:
  explicit ForwardingRanks(Communicator& ranks) : ranks_(ranks) {}

  int rank() const override { return ranks_.rank(); }
  int size() const override { return ranks_.size(); }
  int rank_on_host() const override { return ranks_.rank_on_host(); }
  int size_on_host() const override { return ranks_.size_on_host(); }
  std::string host() const override { return ranks_.host(); }
  void broadcast(void* data, std::size_t bytes, int root) override {
    ranks_.broadcast(data, bytes, root);
  }
  std::vector<Bytes> gather(const Bytes& own) override { return ranks_.gather(own); }
  void add_up(std::vector<std::uint64_t>& values) override { ranks_.add_up(values); }
  std::vector<Bytes> exchange(std::vector<Bytes> parts) override {
    return ranks_.exchange(std::move(parts));
  }
  void send(const void* data, std::size_t bytes, int to) override { ranks_.send(data, bytes, to); }
  void receive(void* data, std::size_t bytes, int from) override {
    ranks_.receive(data, bytes, from);
  }
  [[noreturn]] void abort(int) override { throw std::runtime_error("aborted"); }

 private:
  Communicator& ranks_;
};

}  // namespace splotchcl::test
