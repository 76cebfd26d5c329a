#include "cli/processes.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "cli/commands.h"
#include "common/child_process.h"
#include "common/guards.h"
#include "device/opencl/program_cache.h"
#include "ranks/exchange.h"
#include "ranks/mpi_library.h"
#include "splotchcl/error.h"
#include "system/system.h"

namespace splotchcl::cli {
namespace {

struct Processes {
  bool are_joined = false;
  std::shared_ptr<Communicator> ranks;
};

Processes& processes() {
  static Processes all;
  return all;
}

}  // namespace

std::shared_ptr<Communicator> join_processes(Console& console) {
  Processes& all = processes();
  if (all.are_joined) return all.ranks;
  all.are_joined = true;
  all.ranks = started_with_mpi();
  if (!all.ranks) return nullptr;
  share_cores(*all.ranks);
  if (all.ranks->rank() > 0) console.set_verbosity(Verbosity::quiet);
  require_same(*all.ranks, "version", version_and_commit(), "install the same version everywhere");
  return all.ranks;
}

bool writes_files(const std::shared_ptr<Communicator>& ranks) {
  return !ranks || ranks->rank() == 0;
}

void expect_one_process(const Communicator* ranks, const std::string& option) {
  if (ranks == nullptr) return;
  throw UsageError(option + ": found " + std::to_string(ranks->size()) +
                   " processes, expected one: it draws alone");
}

void leave_processes(int code, bool is_agreed) {
  Processes& all = processes();
  if (!all.ranks) return;
  let_libraries_exit();
  if (!is_agreed) all.ranks->abort(code);
  all.ranks.reset();
}

namespace {

// Of a text that is sent. Nothing that is compiled here is as large.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;

class Socket {
 public:
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Socket& operator=(Socket&&) = delete;
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  int descriptor() const { return descriptor_; }

  // False where the other end is gone.
  bool send(const std::string& text) const {
    const std::uint64_t size = text.size();
    return send_bytes(reinterpret_cast<const char*>(&size), sizeof(size)) &&
           send_bytes(text.data(), text.size());
  }
  // Nothing where the other end is gone, or has said nothing for as long as `patience`.
  std::optional<std::string> receive(std::chrono::milliseconds patience) const {
    std::uint64_t size = 0;
    if (!receive_bytes(reinterpret_cast<char*>(&size), sizeof(size), patience)) return std::nullopt;
    if (size > most_bytes) return std::nullopt;
    std::string text(size, '\0');
    if (!receive_bytes(text.data(), text.size(), patience)) return std::nullopt;
    return text;
  }

 private:
  bool send_bytes(const char* bytes, std::size_t size) const {
    while (size > 0) {
      const ssize_t sent = of_system::send_without_signal(descriptor_, bytes, size, 0);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      bytes += sent;
      size -= static_cast<std::size_t>(sent);
    }
    return true;
  }
  bool receive_bytes(char* bytes, std::size_t size, std::chrono::milliseconds patience) const {
    while (size > 0) {
      pollfd ready = {descriptor_, POLLIN, 0};
      const int events = ::poll(&ready, 1, static_cast<int>(patience.count()));
      if (events < 0 && errno == EINTR) continue;
      if (events <= 0) return false;
      const ssize_t received = ::recv(descriptor_, bytes, size, 0);
      if (received < 0 && errno == EINTR) continue;
      if (received <= 0) return false;
      bytes += received;
      size -= static_cast<std::size_t>(received);
    }
    return true;
  }

  int descriptor_;
};

constexpr std::chrono::milliseconds for_ever(-1);

class CompilerProcess : public ProgramCompiler {
 public:
  CompilerProcess(Socket own, const Socket& of_child)
      : socket_(std::move(own)),
        process_({of_system::own_program().string(), compiler_command},
                 {of_child.descriptor(), -1, -1}) {}

  std::string compile(const ProgramToCompile& program) override {
    // Many times as long as the longest takes on a machine in use.
    constexpr std::chrono::minutes patience(2);
    if (!socket_.send(program.device) || !socket_.send(program.options) ||
        !socket_.send(program.source))
      return {};
    return socket_.receive(patience).value_or(std::string());
  }

 private:
  Socket socket_;
  ChildProcess process_;
};

std::unique_ptr<ProgramCompiler> start_process() {
  int ends[2] = {};
  if (!of_system::connect_ends(ends)) return nullptr;
  Socket own(ends[0]), of_child(ends[1]);
  try {
    return std::make_unique<CompilerProcess>(std::move(own), of_child);
  } catch (const std::exception&) {
    return nullptr;  // no more processes are to be had
  }
}

// Ends this process when the other one closes the socket, also while something is compiled.
void end_with(const Socket& socket) {
  std::thread([descriptor = socket.descriptor()] {
    pollfd hung_up = {descriptor, 0, 0};
    while (::poll(&hung_up, 1, -1) < 0 && errno == EINTR) {
    }
    ::_exit(0);
  }).detach();
}

void expect_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof(type);
  if (::getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0) return;
  throw UsageError(std::string(compiler_command) +
                   ": found no socket on standard input, expected to be started by another "
                   "splotchcl; splotchcl render draws pictures");
}

}  // namespace

StartCompiler compiler_processes(const std::shared_ptr<Communicator>& ranks) {
  if (ranks) return {};
  return start_process;
}

int run_compiler() {
  expect_socket(STDIN_FILENO);
  const Socket socket(STDIN_FILENO);
  end_with(socket);
  LocalCompiler compiler;
  while (true) {
    const auto device = socket.receive(for_ever), options = socket.receive(for_ever),
               source = socket.receive(for_ever);
    if (!device || !options || !source) return 0;
    if (!socket.send(compiler.compile({*device, *options, *source}))) return 0;
  }
}

}  // namespace splotchcl::cli
