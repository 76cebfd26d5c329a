#include "formats/numpy/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>

#include "formats/snapshot_format.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what,
                       const std::string& reason) {
  throw DataError(
      fmt::format("{}: {}: {}; the archive is truncated or damaged: copy or write it again",
                  path.string(), what, reason));
}

zip_t* handle(void* archive) {
  return static_cast<zip_t*>(archive);
}

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

}  // namespace

void ZipArchive::Close::operator()(void* archive) const {
  zip_discard(handle(archive));
}

ZipArchive::ZipArchive(const std::filesystem::path& path) : path_(path) {
  int code = 0;
  archive_.reset(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive_) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    fail(path, "the zip archive cannot be opened", reason);
  }
  const zip_int64_t count = zip_get_num_entries(handle(archive_.get()), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t status;
    zip_stat_init(&status);
    const auto index = static_cast<zip_uint64_t>(i);
    constexpr zip_uint64_t needed = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
    const bool is_known = zip_stat_index(handle(archive_.get()), index, 0, &status) == 0 &&
                          (status.valid & needed) == needed;
    if (!is_known) fail(path_, fmt::format("entry {}", i), "it has no name or length");
    if (status.size / best_packing_of_deflate > status.comp_size) {
      fail(path_, status.name,
           fmt::format("{} bytes cannot come out of {}", status.size, status.comp_size));
    }
    entries_.push_back({status.name, index, status.size});
  }
}

std::vector<std::byte> ZipArchive::read(const Entry& entry, std::uint64_t bytes) const {
  const std::unique_ptr<zip_file_t, CloseEntry> file(
      zip_fopen_index(handle(archive_.get()), entry.index, 0));
  if (!file) fail(path_, entry.name, zip_strerror(handle(archive_.get())));
  // Grown piece by piece: what the archive says of the length need not be true.
  constexpr std::uint64_t piece = 1U << 24;
  std::vector<std::byte> content;
  const std::uint64_t wanted = std::min(bytes, entry.bytes);
  while (content.size() < wanted) {
    const std::size_t have = content.size();
    const std::uint64_t more = std::min(piece, wanted - have);
    content.resize(have + more);
    const zip_int64_t got = zip_fread(file.get(), content.data() + have, more);
    if (got <= 0) {
      fail(path_, entry.name,
           got < 0 ? zip_file_strerror(file.get())
                   : fmt::format("it ends after {} of {} bytes", have, entry.bytes));
    }
    content.resize(have + static_cast<std::size_t>(got));
  }
  // At the end, and only there, libzip compares the checksum.
  std::byte beyond{};
  if (wanted == entry.bytes && zip_fread(file.get(), &beyond, 1) < 0) {
    fail(path_, entry.name, zip_file_strerror(file.get()));
  }
  return content;
}

}  // namespace splotchcl
