#include "device/opencl/binary_cache.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <utility>

#include "scene/hash.h"

namespace splotchcl {
namespace {

// What a file holds: this line, how many bytes the binary has, a checksum of key and binary,
// the key, its end, the binary.
constexpr char first_line[] = "splotchcl kernels 3\n";
constexpr char end_of_key = '\0';

std::uint64_t hash_of(const std::string& key) {
  WordHash hash;
  hash.add(key);
  return hash.value();
}

std::uint64_t checksum_of(const std::string& key, const std::string& binary) {
  WordHash hash;
  hash.add(key);
  hash.add(std::uint64_t{binary.size()});
  hash.add(checksum(reinterpret_cast<const std::byte*>(binary.data()), binary.size()));
  return hash.value();
}

std::string head_of(const std::string& key, const std::string& binary) {
  std::ostringstream head;
  head << first_line << binary.size() << ' ' << std::hex << checksum_of(key, binary) << '\n'
       << key << end_of_key;
  return head.str();
}

std::optional<std::uint64_t> binary_bytes(const std::string& head) {
  constexpr std::size_t begin = sizeof(first_line) - 1;
  if (head.compare(0, begin, first_line) != 0) return std::nullopt;
  std::uint64_t bytes = 0;
  const char* const end = head.data() + head.size();
  if (std::from_chars(head.data() + begin, end, bytes).ec != std::errc()) return std::nullopt;
  return bytes;
}

// The whole file, where it is as long as its head, which ends with `key`, says; else nothing, so
// that no memory is claimed for what a file has grown to.
std::string text_in(const std::filesystem::path& path, const std::string& key) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) return {};
  constexpr std::size_t numbers = 40;  // at most, with what is between them
  std::string text(std::min<std::uintmax_t>(size, sizeof(first_line) + numbers + key.size()), '\0');
  std::ifstream file(path, std::ios::binary);
  const auto read = [&](std::size_t begin) {
    file.read(text.data() + begin, static_cast<std::streamsize>(text.size() - begin));
    return file.gcount() == static_cast<std::streamsize>(text.size() - begin);
  };
  if (!read(0)) return {};
  const std::size_t key_end = text.find(end_of_key);
  const std::optional<std::uint64_t> bytes = binary_bytes(text);
  if (key_end == std::string::npos || !bytes || size - key_end - 1 != *bytes) return {};
  const std::size_t begin = text.size();
  text.resize(static_cast<std::size_t>(size));
  return read(begin) ? text : std::string();
}

// Nobody else may write to it, from when it is there.
void make_own_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), ignored);
  ::mkdir(folder.c_str(), S_IRWXU);
}

// What processes that were killed left unfinished of this file. To write one takes no hour.
void remove_leftovers_of(const std::filesystem::path& file) {
  const std::string begin = file.filename().string() + ".";
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path(), error)) {
    if (entry.path().filename().string().compare(0, begin.size(), begin) != 0) continue;
    const auto age = std::filesystem::file_time_type::clock::now() - entry.last_write_time(error);
    if (!error && age > std::chrono::hours(1)) std::filesystem::remove(entry.path(), error);
  }
}

}  // namespace

std::optional<std::filesystem::path> BinaryCache::user_folder() {
  if (const char* const own = std::getenv("SPLOTCHCL_CACHE"); own != nullptr) {
    if (*own == '\0') return std::nullopt;
    return std::filesystem::path(own);
  }
  if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return std::filesystem::path(cache) / "splotchcl";
  }
  if (const char* const home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".cache" / "splotchcl";
  }
  return std::nullopt;
}

// What is run from a folder that someone else may write to is theirs, not ours.
std::string BinaryCache::distrust(const std::filesystem::path& folder) {
  struct stat status = {};
  const std::string what = "the cache of compiled kernels is not used: " + folder.string();
  if (stat(folder.c_str(), &status) != 0) {
    if (errno == ENOENT) return {};  // it will be made
    return what + ": " + std::strerror(errno);
  }
  if (status.st_uid != geteuid()) return what + " belongs to someone else";
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    return what + " may be written to by others; chmod go-w mends that";
  }
  return {};
}

BinaryCache::BinaryCache(std::optional<std::filesystem::path> folder)
    : folder_(std::move(folder)), note_(folder_ ? distrust(*folder_) : std::string()) {
  if (!note_.empty()) folder_.reset();
}

std::filesystem::path BinaryCache::file_for(const std::string& key) const {
  std::ostringstream name;
  name << std::hex << hash_of(key) << ".kernels";
  return *folder_ / name.str();
}

std::optional<std::string> BinaryCache::find(const std::string& key) const {
  // Someone else may have made the folder since it was missing.
  if (!folder_ || !distrust(*folder_).empty()) return std::nullopt;
  const std::string text = text_in(file_for(key), key);
  const std::size_t key_end = text.find(end_of_key);
  if (key_end == std::string::npos) return std::nullopt;
  std::string binary = text.substr(key_end + 1);
  if (binary.empty() || text.compare(0, key_end + 1, head_of(key, binary)) != 0) {
    return std::nullopt;
  }
  return binary;
}

void BinaryCache::keep(const std::string& key, const std::string& binary) const {
  if (!folder_ || binary.empty()) return;
  make_own_folder(*folder_);
  if (!distrust(*folder_).empty()) return;
  std::error_code failure;
  const std::filesystem::path file = file_for(key);
  remove_leftovers_of(file);
  std::filesystem::path unfinished = file;
  unfinished += "." + std::to_string(std::random_device()());
  {
    std::ofstream out(unfinished, std::ios::binary);
    out << head_of(key, binary) << binary;
    out.close();
    if (!out) {
      std::filesystem::remove(unfinished, failure);
      return;
    }
  }
  std::filesystem::rename(unfinished, file, failure);
  if (failure) std::filesystem::remove(unfinished, failure);
}

}  // namespace splotchcl
