#pragma once

#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "splotchcl/communicator.h"

namespace splotchcl::test {

// Ranks that are threads of this process. A send waits until it is received, so that what would
// wait for itself under MPI does so here; when one rank has failed, the others throw where they
// wait.
class ThreadRanks {
 public:
  explicit ThreadRanks(int size) : size_(size) {}

  // Runs work(communicator) on each rank; throws what the first of them that failed has thrown.
  static void run(int size, const std::function<void(Communicator&)>& work) {
    ThreadRanks ranks(size);
    std::vector<std::thread> threads;
    std::exception_ptr first;
    for (int rank = 0; rank < size; ++rank) {
      threads.emplace_back([&, rank] {
        Rank own(ranks, rank);
        try {
          work(own);
        } catch (...) {
          const std::lock_guard<std::mutex> lock(ranks.mutex_);
          if (!first) first = std::current_exception();
          ranks.has_failed_ = true;
          ranks.changed_.notify_all();
        }
      });
    }
    for (std::thread& thread : threads)
      thread.join();
    if (first) std::rethrow_exception(first);
  }

 private:
  using Bytes = Communicator::Bytes;

  class Rank final : public Communicator {
   public:
    Rank(ThreadRanks& all, int rank) : all_(all), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return all_.size_; }
    int rank_on_host() const override { return rank_; }
    int size_on_host() const override { return all_.size_; }
    std::string host() const override { return "host" + std::to_string(rank_); }

    void broadcast(void* data, std::size_t bytes, int root) override {
      for (int to = 0; rank_ == root && to < size(); ++to) {
        if (to != root) send(data, bytes, to);
      }
      if (rank_ != root) receive(data, bytes, root);
    }
    std::vector<Bytes> gather(const Bytes& own) override {
      return exchange(std::vector<Bytes>(static_cast<std::size_t>(size()), own));
    }
    void add_up(std::vector<std::uint64_t>& values) override {
      Bytes bytes(values.size() * sizeof(std::uint64_t));
      if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
      std::vector<std::uint64_t> sums(values.size());
      for (const Bytes& of_rank : gather(bytes)) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
          std::uint64_t value = 0;
          std::memcpy(&value, of_rank.data() + i * sizeof(value), sizeof(value));
          sums[i] += value;
        }
      }
      values = sums;
    }
    std::vector<Bytes> exchange(std::vector<Bytes> parts) override {
      for (int to = 0; to < size(); ++to)
        all_.put(rank_, to, parts[static_cast<std::size_t>(to)], false);
      std::vector<Bytes> received;
      for (int from = 0; from < size(); ++from)
        received.push_back(all_.take(from, rank_));
      return received;
    }
    void send(const void* data, std::size_t bytes, int to) override {
      const auto* first = static_cast<const std::byte*>(data);
      all_.put(rank_, to, Bytes(first, first + bytes), true);
    }
    void receive(void* data, std::size_t bytes, int from) override {
      const Bytes message = all_.take(from, rank_);
      if (message.size() != bytes) throw std::logic_error("a message of another length came");
      if (bytes > 0) std::memcpy(data, message.data(), bytes);
    }
    [[noreturn]] void abort(int) override { throw std::runtime_error("aborted"); }

   private:
    ThreadRanks& all_;
    int rank_;
  };

  struct Channel {
    std::deque<Bytes> messages;
    std::size_t taken = 0, sent = 0;
  };

  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, const Condition& condition) {
    changed_.wait(lock, [&] { return has_failed_ || condition(); });
    if (has_failed_ && !condition()) throw std::runtime_error("another rank has failed");
  }
  void put(int from, int to, Bytes message, bool waits) {
    std::unique_lock<std::mutex> lock(mutex_);
    Channel& channel = channels_[{from, to}];
    channel.messages.push_back(std::move(message));
    const std::size_t number = ++channel.sent;
    changed_.notify_all();
    if (waits) wait(lock, [&] { return channel.taken >= number; });
  }
  Bytes take(int from, int to) {
    std::unique_lock<std::mutex> lock(mutex_);
    Channel& channel = channels_[{from, to}];
    wait(lock, [&] { return !channel.messages.empty(); });
    Bytes message = std::move(channel.messages.front());
    channel.messages.pop_front();
    ++channel.taken;
    changed_.notify_all();
    return message;
  }

  const int size_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::pair<int, int>, Channel> channels_;
  bool has_failed_ = false;
};

}  // namespace splotchcl::test
