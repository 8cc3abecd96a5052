#include "server/archive/io/recording_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace tandem::server {

namespace {

std::int64_t modified_of(const struct stat& facts) {
  return std::int64_t{facts.st_mtim.tv_sec} * 1'000'000'000 + facts.st_mtim.tv_nsec;
}

std::size_t read_from(int file, std::uint64_t offset, std::span<std::byte> into) {
  std::size_t filled = 0;
  while (filled < into.size()) {
    const ssize_t got = ::pread(file, into.data() + filled, into.size() - filled, static_cast<off_t>(offset + filled));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;  // cut meanwhile, or an error of the disk
    filled += static_cast<std::size_t>(got);
  }
  return filled;
}

}  // namespace

std::expected<RecordingFile, std::string> RecordingFile::open(const std::string& path) {
  RecordingFile out;
  out.file_ = io::Fd{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};  // a pipe must not block
  struct stat facts{};
  if (!out.file_.open() || ::fstat(out.file_.get(), &facts) != 0) return std::unexpected(std::strerror(errno));
  if (!S_ISREG(facts.st_mode)) return std::unexpected("it is no file");
  out.bytes_ = static_cast<std::uint64_t>(facts.st_size);
  out.modified_ns_ = modified_of(facts);
  auto parts = RecordingParts::find(out.read(), out.bytes_);
  if (!parts) return std::unexpected(parts.error());
  out.parts_ = std::move(*parts);
  return out;
}

ReadAt RecordingFile::read() const {
  return
      [file = file_.get()](std::uint64_t offset, std::span<std::byte> into) { return read_from(file, offset, into); };
}

bool RecordingFile::unchanged() const noexcept {
  struct stat facts{};
  return ::fstat(file_.get(), &facts) == 0 && facts.st_nlink > 0 &&
         static_cast<std::uint64_t>(facts.st_size) == bytes_ && modified_of(facts) == modified_ns_;
}

}  // namespace tandem::server
