#include "common/unfinished_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <ctime>
#include <optional>
#include <random>
#include <string_view>
#include <system_error>
#include <vector>

#include "common/words.h"
#include "scene/hash.h"
#include "splotchcl/error.h"
#include "system/system.h"

namespace splotchcl {
namespace {

std::string host_name() {
  std::array<char, 256> name = {};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// Readable, and different also for machines whose names are alike: "localhost".
std::string name_of_machine() {
  constexpr std::size_t readable_letters = 16;
  const std::string host = host_name();
  WordHash hash;
  hash.add(host);
  hash.add(of_system::process_space());
  hash.add(of_system::machine_identity());
  std::string readable = host.substr(0, readable_letters);
  const auto is_plain = [](char letter) {
    return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
           (letter >= 'A' && letter <= 'Z');
  };
  std::replace_if(
      readable.begin(), readable.end(), [&](char letter) { return !is_plain(letter); }, '_');
  return fmt::format("{}~{:08x}", readable, static_cast<std::uint32_t>(hash.value() >> 32));
}

}  // namespace

WritingProcess WritingProcess::own() {
  return {::getpid(), of_system::start_of_process(::getpid()), name_of_machine()};
}

bool WritingProcess::is_of_this_machine() const {
  return machine.empty() || machine == name_of_machine();
}

bool WritingProcess::is_running() const {
  if (::kill(number, 0) != 0 && errno == ESRCH) return false;
  if (of_system::is_only_number(number)) return false;
  const std::uint64_t start_now = start == 0 ? 0 : of_system::start_of_process(number);
  return start_now == 0 || start_now == start;
}

namespace {

constexpr std::string_view end_of_name = ".part";

std::size_t longest_name_in(const std::filesystem::path& folder) {
  constexpr long usual = 255;
  const long longest = ::pathconf(folder.c_str(), _PC_NAME_MAX);
  return static_cast<std::size_t>(longest > 0 ? longest : usual);
}

bool continues_a_letter(char byte) {  // of UTF-8
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// The target's name as a part of an unfinished one, which is at most as long as the file system
// allows.
std::string shortened_name(const std::string& name, std::size_t longest) {
  // The dots, ten digits of a process, twenty of its start, 25 letters of a machine, ten digits.
  constexpr std::size_t others = 80, checksum_letters = 17;
  if (name.size() + others <= longest) return name;
  std::size_t kept = longest > others + checksum_letters ? longest - others - checksum_letters : 0;
  while (kept > 0 && continues_a_letter(name[kept]))
    --kept;
  WordHash hash;
  hash.add(name);
  return fmt::format("{}~{:016x}", name.substr(0, kept), hash.value());
}

template <typename Number>
std::optional<Number> read_number(std::string_view text) {
  Number number = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || next != text.data() + text.size()) {
    return std::nullopt;
  }
  return number;
}

// PID@START@HOST, or the PID of earlier versions.
std::optional<WritingProcess> read_process(std::string_view text) {
  WritingProcess process;
  const std::size_t first = text.find('@');
  const auto number = read_number<pid_t>(text.substr(0, first));
  if (!number || *number <= 0) return std::nullopt;
  process.number = *number;
  if (first == std::string_view::npos) return process;
  const std::size_t second = text.find('@', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const auto start = read_number<std::uint64_t>(text.substr(first + 1, second - first - 1));
  process.machine = text.substr(second + 1);
  if (!start || process.machine.empty()) return std::nullopt;
  process.start = *start;
  return process;
}

struct UnfinishedName {
  std::string target;  // as shortened_name() has it
  WritingProcess process;
};

std::optional<UnfinishedName> read_name(const std::string& name) {
  const std::size_t dash = name.rfind('-');
  const bool is_one =
      name.size() > end_of_name.size() && name.front() == '.' &&
      name.compare(name.size() - end_of_name.size(), end_of_name.size(), end_of_name) == 0;
  if (!is_one || dash == std::string::npos) return std::nullopt;
  const std::size_t dot = name.rfind('.', dash);
  if (dot == 0 || dot == std::string::npos) return std::nullopt;
  const auto process = read_process(std::string_view(name).substr(dot + 1, dash - dot - 1));
  if (!process) return std::nullopt;
  return UnfinishedName{name.substr(1, dot - 1), *process};
}

// Long enough for whatever clocks of machines differ by, and for programs that are stopped over a
// weekend.
bool is_old(const std::filesystem::path& file) {
  constexpr std::chrono::hours week(7 * 24);
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  return !error && std::filesystem::file_time_type::clock::now() - written > week;
}

}  // namespace

std::filesystem::path unfinished_name(const std::filesystem::path& target) {
  const WritingProcess process = WritingProcess::own();
  const std::string name =
      shortened_name(target.filename().string(), longest_name_in(folder_of(target)));
  return fmt::format(".{}.{}@{}@{}-{}{}", name, process.number, process.start, process.machine,
                     std::random_device()(), end_of_name);
}

UnfinishedNames::UnfinishedNames(const std::filesystem::path& folder,
                                 const std::set<std::string>& targets)
    : targets_(targets) {  // earlier versions shortened none
  const std::size_t longest = longest_name_in(folder);
  for (const std::string& target : targets)
    targets_.insert(shortened_name(target, longest));
}

bool UnfinishedNames::has_leftover(const std::filesystem::path& entry) const {
  const std::optional<UnfinishedName> file = read_name(entry.filename().string());
  if (!file || targets_.count(file->target) == 0) return false;
  return file->process.is_of_this_machine() ? !file->process.is_running() : is_old(entry);
}

std::filesystem::path temporary_folder() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder;
  throw DataError(
      "environment variable TMPDIR: found no folder, expected one for temporary files; correct it "
      "or unset it");
}

namespace {

// There is something, but neither a file nor a folder.
bool is_stream(const std::filesystem::path& path) {
  struct stat status = {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

// Also where nothing is at their end yet.
std::filesystem::path follow_links(const std::filesystem::path& path) {
  constexpr int most_links = 40;  // as Linux has it
  std::filesystem::path target = path;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(target, error); ++links) {
    if (links == most_links) {
      throw DataError(path.string() + ": cannot be written: " + reason(ELOOP));
    }
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) return target;
    target = target.parent_path() / next;  // an absolute one takes its place
  }
  return target;
}

std::filesystem::path temporary_path(const std::filesystem::path& target, bool is_stream) {
  return (is_stream ? temporary_folder() : folder_of(target)) / unfinished_name(target);
}

// While it lives, a FIFO that nobody reads any more answers with an error, not with a signal.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    of_system::drop_pipe_signal();  // one that has come meanwhile
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  ::sigset_t pipe_ = {}, before_ = {};
};

// Signal handlers can only look at global data.
struct Unfinished {
  enum State { free, taken, named };
  std::atomic<State> state{free};
  std::array<char, 4096> path{};
};
std::array<Unfinished, 64> unfinished;
constexpr int not_remembered = -1;

// Returns its place. Must not allocate: it is called when the file is there and the object that
// removes it is not yet.
int remember_unfinished(const std::string& path) noexcept {
  for (std::size_t place = 0; place < unfinished.size(); ++place) {
    Unfinished& one = unfinished[place];
    Unfinished::State expected = Unfinished::free;
    if (path.size() >= one.path.size() ||
        !one.state.compare_exchange_strong(expected, Unfinished::taken)) {
      continue;
    }
    std::memcpy(one.path.data(), path.c_str(), path.size() + 1);
    one.state = Unfinished::named;
    return static_cast<int>(place);
  }
  return not_remembered;
}

void forget_unfinished(int place) noexcept {
  if (place != not_remembered) unfinished[static_cast<std::size_t>(place)].state = Unfinished::free;
}

// The error's number, or 0.
int write_all(int descriptor, const char* next, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t written = ::write(descriptor, next, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    next += written;
    bytes -= static_cast<std::size_t>(written);
  }
  return 0;
}

// What open() would only call "no such file or folder".
void check_folder(const std::filesystem::path& path, const std::filesystem::path& target) {
  const std::filesystem::path folder = folder_of(target);
  std::error_code error;
  if (std::filesystem::is_directory(target, error)) {
    throw DataError(path.string() + ": is a folder; name the file to write in it");
  }
  if (!std::filesystem::is_directory(folder, error)) {
    throw DataError(path.string() + ": cannot be written: there is no folder " + folder.string() +
                    "; create it first");
  }
}

}  // namespace

void remove_unfinished_files() noexcept {
  for (Unfinished& one : unfinished) {
    if (one.state == Unfinished::named) ::unlink(one.path.data());
  }
}

void remove_leftovers(const std::filesystem::path& folder, const std::set<std::string>& names) {
  const UnfinishedNames unfinished_names(folder, names);
  std::error_code error;
  std::vector<std::filesystem::path> leftovers;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (unfinished_names.has_leftover(entry.path())) leftovers.push_back(entry.path());
  }
  for (const std::filesystem::path& path : leftovers)
    std::filesystem::remove(path, error);
}

void check_output_path(const std::filesystem::path& path) {
  const UnfinishedFile file(path);
  const std::filesystem::path target = follow_links(path);
  remove_leftovers(folder_of(target), {target.filename().string()});
}

UnfinishedFile::UnfinishedFile(const std::filesystem::path& path)
    : path_(path),
      is_stream_(is_stream(path)),
      target_(is_stream_ ? path : follow_links(path)),
      temporary_(splotchcl::temporary_path(target_, is_stream_)) {
  check_folder(path_, target_);
  if (is_stream_ && ::access(target_.c_str(), W_OK) != 0) fail(errno);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
  place_ = remember_unfinished(temporary_.native());
}

UnfinishedFile::~UnfinishedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (temporary_.empty()) return;
  ::unlink(temporary_.c_str());
  forget_unfinished(place_);
}

void UnfinishedFile::write(const void* data, std::size_t bytes) {
  const int error = write_all(descriptor_, static_cast<const char*>(data), bytes);
  if (error != 0) fail(error);
}

void UnfinishedFile::close_file() {
  // Some file systems report a full disk only here. Those without fsync say EINVAL.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail(errno);
}

bool UnfinishedFile::finish_unless_there() {
  close_file();
  if (::link(temporary_.c_str(), target_.c_str()) == 0) return true;
  if (errno == EEXIST) return false;
  // A file system without links.
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  return true;
}

void UnfinishedFile::finish() {
  close_file();
  if (is_stream_) return copy_into_stream();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  forget_unfinished(place_);
  temporary_.clear();
}

void UnfinishedFile::copy_into_stream() {
  const NoPipeSignal no_signal;
  const int from = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  // Waits for a reader of a FIFO, as every program does.
  const int to = from < 0 ? -1 : ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  int error = to < 0 ? errno : 0;
  std::array<char, 1 << 16> bytes;
  ssize_t count = 0;
  while (error == 0 && (count = ::read(from, bytes.data(), bytes.size())) > 0)
    error = write_all(to, bytes.data(), static_cast<std::size_t>(count));
  if (error == 0 && count < 0) error = errno;
  if (from >= 0) ::close(from);
  if (to >= 0 && ::close(to) != 0 && error == 0) error = errno;
  if (error != 0) {
    throw DataError(path_.string() + ": cannot be written: " + reason(error));
  }
}

void UnfinishedFile::fail(int error_number) const {
  throw DataError(path_.string() + ": cannot be written: " + reason(error_number) +
                  "; nothing was left behind");
}

}  // namespace splotchcl
