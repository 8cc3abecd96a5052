#include "server/recording/io/input_spool.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/base/format.h"
#include "common/io/output_file.h"

namespace tandem::server {
namespace {

constexpr const char* kPrefix = ".tandem-inputs-";

std::string spool_error(int error) {
  return error == ENOSPC || error == EDQUOT ? "the disk is full" : io::write_error_text(error);
}

/// A file that lost its name at once, where the file system makes none without a name.
int create_and_unlink(const std::string& folder) {
  std::string path = folder + "/" + kPrefix + "XXXXXX";
  const int file = ::mkostemp(path.data(), O_CLOEXEC);
  if (file >= 0) static_cast<void>(::unlink(path.c_str()));
  return file;
}

}  // namespace

std::expected<InputSpool, std::string> InputSpool::create(const std::string& folder) {
  int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == ENOENT)) file = create_and_unlink(folder);
  if (file < 0) return std::unexpected(spool_error(errno));
  return InputSpool{io::Fd{file}};
}

std::string InputSpool::append(std::string_view bytes) {
  struct statvfs disk{};
  if (::fstatvfs(file_.get(), &disk) == 0 && std::uint64_t{disk.f_bavail} * disk.f_frsize < kFreeMin)
    return format("the disk has less than %llu MiB free", static_cast<unsigned long long>(kFreeMin >> 20U));
  std::uint64_t at = size_;
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return spool_error(n < 0 ? errno : EIO);
    at += static_cast<std::uint64_t>(n);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  size_ = at;
  return {};
}

bool InputSpool::read(std::uint64_t at, std::span<std::byte> out) const noexcept {
  while (!out.empty()) {
    const ssize_t n = ::pread(file_.get(), out.data(), out.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += static_cast<std::uint64_t>(n);
    out = out.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

void remove_stale_spools(const std::string& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> stale;
  for (std::filesystem::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error))
    if (at->path().filename().string().starts_with(kPrefix)) stale.push_back(at->path());
  // Another server that has just made one removes its name itself, so that both may do so.
  for (const auto& path : stale) static_cast<void>(::unlink(path.c_str()));
}

}  // namespace tandem::server
