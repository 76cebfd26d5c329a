#include "common/unfinished_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <optional>
#include <random>
#include <system_error>
#include <vector>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  return folder.empty() ? "." : folder;
}

std::filesystem::path follow_links(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target;
}

// Hidden, and different for programs that write the same picture at the same time.
std::filesystem::path temporary_name(const std::filesystem::path& target) {
  const std::string unique =
      std::to_string(::getpid()) + "-" + std::to_string(std::random_device()());
  return folder_of(target) / ("." + target.filename().string() + "." + unique + ".part");
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

// The reverse of temporary_name().
struct Leftover {
  std::string target;
  pid_t process;
};
std::optional<Leftover> read_temporary_name(const std::string& name) {
  const std::string end = ".part";
  const std::size_t dash = name.rfind('-');
  const bool is_one = name.size() > end.size() && name.front() == '.' &&
                      name.compare(name.size() - end.size(), end.size(), end) == 0;
  if (!is_one || dash == std::string::npos) return std::nullopt;
  const std::size_t dot = name.rfind('.', dash);
  pid_t process = 0;
  const char* const last = name.data() + dash;
  const auto [next, error] = std::from_chars(name.data() + dot + 1, last, process);
  if (dot == 0 || error != std::errc() || next != last || process <= 0) return std::nullopt;
  return Leftover{name.substr(1, dot - 1), process};
}

bool is_running(pid_t process) {
  return ::kill(process, 0) == 0 || errno != ESRCH;
}

}  // namespace

void remove_leftovers(const std::filesystem::path& folder, const std::set<std::string>& names) {
  std::error_code error;
  std::vector<std::filesystem::path> leftovers;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const auto leftover = read_temporary_name(entry.path().filename().string());
    if (leftover && names.count(leftover->target) > 0 && !is_running(leftover->process)) {
      leftovers.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& path : leftovers)
    std::filesystem::remove(path, error);
}

void check_output_path(const std::filesystem::path& path) {
  const UnfinishedFile file(path);
}

UnfinishedFile::UnfinishedFile(const std::filesystem::path& path)
    : path_(path), target_(follow_links(path)), temporary_(temporary_name(target_)) {
  check_folder(path_, target_);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
}

UnfinishedFile::~UnfinishedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void UnfinishedFile::write(const void* data, std::size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = ::write(descriptor_, next, bytes);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail(errno);
    }
    next += written;
    bytes -= static_cast<std::size_t>(written);
  }
}

void UnfinishedFile::finish() {
  // Some file systems report a full disk only here. Those without fsync say EINVAL.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail(errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void UnfinishedFile::fail(int error_number) const {
  throw DataError(path_.string() + ": cannot be written: " + reason(error_number) +
                  "; nothing was left behind");
}

}  // namespace splotchcl
