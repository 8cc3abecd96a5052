#include "server/archive/app/lesson_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <new>
#include <vector>

#include "common/io/fd.h"
#include "proto/recording/lesson_reader.h"
#include "server/archive/io/recording_file.h"
#include "server/archive/summary_reader.h"

namespace tandem::server {

namespace {

constexpr const char* kTooLarge = "it is too large for the memory of this computer";

std::expected<std::vector<std::byte>, std::string> read_all(const std::string& path) {
  const io::Fd file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat facts{};
  if (!file.open() || ::fstat(file.get(), &facts) != 0) return std::unexpected(std::strerror(errno));
  if (!S_ISREG(facts.st_mode)) return std::unexpected("it is no file");
  std::vector<std::byte> bytes(static_cast<std::size_t>(facts.st_size));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::unexpected(std::strerror(errno));
    if (got == 0) break;  // cut meanwhile
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace

std::expected<Lesson, std::string> load_lesson(const std::string& path, const LessonSeatSet& without) try {
  const auto bytes = read_all(path);
  if (!bytes) return std::unexpected(bytes.error());
  return read_lesson(*bytes, without);
} catch (const std::bad_alloc&) {
  return std::unexpected(kTooLarge);
}

std::expected<Lesson, std::string> load_lesson(const std::vector<std::string>& files, const LessonSeatSet& without) {
  LessonReader reader(without);
  for (const std::string& file : files) {
    const std::string name = files.size() > 1 ? file + ": " : std::string();
    try {
      const auto bytes = read_all(file);
      if (!bytes) return std::unexpected(name + bytes.error());
      if (const auto added = reader.add(*bytes); !added) return std::unexpected(name + added.error());
    } catch (const std::bad_alloc&) {
      return std::unexpected(name + kTooLarge);
    }
  }
  return reader.take();
}

std::expected<RecordingSummary, std::string> load_summary(const std::string& path) try {
  const auto file = RecordingFile::open(path);
  if (!file) return std::unexpected(file.error());
  return read_summary(file->parts(), file->read());
} catch (const std::bad_alloc&) {
  return std::unexpected(kTooLarge);
}

}  // namespace tandem::server
