#include "common/auth/io/append_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>

#include "common/auth/io/directory_lock.h"
#include "common/auth/io/write_all.h"
#include "common/base/raw_bytes.h"

namespace tandem::auth {
namespace {

constexpr int kOpenedAgainMax = 8;  // attempts while other processes rotate

/// @return the length of the file's whole lines; nullopt: it cannot be read
std::optional<off_t> whole_lines(int fd, off_t size) {
  std::array<char, 4096> part;
  for (off_t end = size; end > 0;) {
    const off_t begin = std::max<off_t>(
        0, end - static_cast<off_t>(end == size ? 1 : part.size()));  // the last byte alone usually decides
    const ssize_t n = pread(fd, part.data(), static_cast<std::size_t>(end - begin), begin);
    if (n != end - begin) return std::nullopt;
    for (ssize_t i = n; i > 0; --i)
      if (part[static_cast<std::size_t>(i - 1)] == '\n') return begin + i;
    end = begin;
  }
  return 0;
}

}  // namespace

std::uint64_t AppendFile::size_max() const noexcept {
  return torn_ == TornLine::kCut ? StateDirectory::kFileMax : std::numeric_limits<std::uint64_t>::max();
}

std::expected<io::Fd, std::string> AppendFile::open_locked() const {
  for (int i = 0; i < kOpenedAgainMax; ++i) {
    io::Fd file{openat(folder_.fd(), name_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC,
                       StateDirectory::kFileMode)};
    if (!file.open()) return std::unexpected(folder_.call_error(name_, "opened"));
    if (std::string wrong = folder_.file_problem(file.get(), name_, size_max()); !wrong.empty())
      return std::unexpected(std::move(wrong));
    if (!DirectoryLock::wait_for(file.get(), DirectoryLock::kTimeout))
      return std::unexpected(folder_.path_of(name_) + " is held by " + DirectoryLock::holder_of(folder_, name_) +
                             "; end it, then try again");
    // Another process may have rotated the file in between.
    struct stat opened{}, named{};
    if (fstat(file.get(), &opened) != 0) return std::unexpected(folder_.call_error(name_, "looked at"));
    if (fstatat(folder_.fd(), name_.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 && named.st_ino == opened.st_ino &&
        named.st_dev == opened.st_dev)
      return file;
  }
  return std::unexpected(folder_.path_of(name_) + " is replaced again and again by another process");
}

std::string AppendFile::append(std::string_view lines) const {
  auto file = open_locked();
  if (!file) return file.error();
  struct stat s{};
  if (fstat(file->get(), &s) != 0) return folder_.call_error(name_, "looked at");
  const bool is_new = s.st_size == 0;
  const auto whole = whole_lines(file->get(), s.st_size);
  if (!whole) return folder_.call_error(name_, "read");
  off_t before = s.st_size;
  std::string text(lines);
  if (*whole < before && torn_ == TornLine::kEnded) text = "\n" + text;
  if (*whole < before && torn_ == TornLine::kCut) {
    if (ftruncate(file->get(), *whole) != 0) return folder_.call_error(name_, "rid of an unfinished line");
    before = *whole;
  }
  if (torn_ == TornLine::kCut && static_cast<std::uint64_t>(before) + text.size() > StateDirectory::kFileMax)
    return folder_.path_of(name_) + " would be longer than 8 MiB";
  if (write_all(file->get(), bytes_of(text)) && fdatasync(file->get()) == 0 && (!is_new || fsync(folder_.fd()) == 0))
    return {};
  std::string problem = folder_.call_error(name_, "written");
  if (ftruncate(file->get(), before) != 0) problem += "; an unfinished line may be left at its end";
  return problem;
}

std::string AppendFile::problem() const {
  const io::Fd file{openat(folder_.fd(), name_.c_str(), O_RDWR | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
  return file.open() ? folder_.file_problem(file.get(), name_, size_max()) : folder_.call_error(name_, "written to");
}

std::expected<std::uint64_t, std::string> AppendFile::rotate(std::uint64_t size_max, std::uint32_t older) const {
  const auto file = open_locked();
  if (!file) return std::unexpected(file.error());
  struct stat s{};
  if (fstat(file->get(), &s) != 0) return std::unexpected(folder_.call_error(name_, "looked at"));
  const auto size = static_cast<std::uint64_t>(s.st_size);
  if (size <= size_max) return 0;
  const auto numbered = [this](std::uint32_t number) { return name_ + "." + std::to_string(number); };
  // From the oldest on, so that a crash leaves a gap and loses only files beyond the count.
  for (std::uint32_t number = older; number > 0; --number) {
    const std::string from = number == 1 ? name_ : numbered(number - 1);
    if (renameat(folder_.fd(), from.c_str(), folder_.fd(), numbered(number).c_str()) != 0 && errno != ENOENT)
      return std::unexpected(folder_.call_error(from, "renamed"));
  }
  for (std::uint32_t number = older + 1; unlinkat(folder_.fd(), numbered(number).c_str(), 0) == 0;)
    ++number;  // an earlier limit kept more files
  if (fsync(folder_.fd()) != 0) return std::unexpected(folder_.call_error(name_, "rotated"));
  return size;
}

}  // namespace tandem::auth
