#include "netsim/app/cell_journal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <string_view>

#include "common/io/output_file.h"
#include "common/transport/digest.h"

namespace tandem::netsim {
namespace {

constexpr std::string_view kKind = "tandem-netsim sweep: results of cells, format 1";
constexpr std::size_t kCheckDigits = 8;
constexpr int kLockTries = 50, kLockWaitMs = 100;  // jobs of a killed program end within this time

std::string first_line(const CellJournal::Identity& identity) {
  return std::string(kKind) + ", program " + identity.program + ", cells " + identity.cells + ", count " +
         std::to_string(identity.count);
}

std::string check_of(std::string_view text) {
  transport::Digest digest;
  digest.add(text);
  return digest.hex().substr(0, kCheckDigits);
}

bool lock(int fd) {
  for (int i = 0; i < kLockTries; ++i) {
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK && errno != EINTR) return false;
    ::poll(nullptr, 0, kLockWaitMs);
  }
  return false;
}

/// @return whether all bytes were written; false: errno holds the reason
bool write_whole(int fd, std::string_view text) {
  while (!text.empty()) {
    const auto n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = ENOSPC;
    if (n <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// @return whether the file was read to its end
bool read_whole(int fd, std::string& into) {
  std::array<char, 65536> part;
  for (off_t at = 0;;) {
    const auto n = ::pread(fd, part.data(), part.size(), at);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    if (n == 0) return true;
    into.append(part.data(), static_cast<std::size_t>(n));
    at += n;
  }
}

constexpr const char* kRemedy = "name another file, or remove this one to compute all cells again";

}  // namespace

std::expected<CellJournal, std::string> CellJournal::open(const std::string& file, const Identity& identity) {
  io::Fd fd{::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644)};
  if (!fd.open()) return std::unexpected(file + " cannot be opened: " + io::write_error_text(errno));
  struct stat s{};
  if (fstat(fd.get(), &s) != 0 || !S_ISREG(s.st_mode))
    return std::unexpected(file + " is no ordinary file; name a file that can be read and appended to");
  if (!lock(fd.get()))
    return std::unexpected(file + " is in use by another process; wait for its end, or name another file");
  CellJournal journal{file, std::move(fd)};
  if (std::string problem = journal.read(identity); !problem.empty()) return std::unexpected(std::move(problem));
  return journal;
}

std::string CellJournal::read(const Identity& identity) {
  std::string text;
  if (!read_whole(file_.get(), text)) return name_ + " cannot be read: " + io::write_error_text(errno);
  const std::string head = first_line(identity);
  const auto whole = text.rfind('\n') + 1;  // npos + 1 is 0
  if (whole == 0 && !(head + "\n").starts_with(text))
    return name_ + " is no file of results of a sweep; name another file";
  std::size_t number = 0;
  for (std::size_t at = 0; at < whole;) {
    const std::size_t end = text.find('\n', at);
    if (std::string problem = read_line(std::string_view(text).substr(at, end - at), ++number, identity);
        !problem.empty())
      return problem;
    at = end + 1;
  }
  if (whole < text.size() && ::ftruncate(file_.get(), static_cast<off_t>(whole)) != 0)
    return name_ + ": its unfinished last line cannot be removed: " + io::write_error_text(errno);
  return whole == 0 ? append_line(head) : std::string{};
}

std::string CellJournal::read_line(std::string_view line, std::size_t number, const Identity& identity) {
  if (number == 1) {
    if (line == first_line(identity)) return {};
    if (!line.starts_with(kKind)) return name_ + " is no file of results of a sweep; name another file";
    const bool program = line.find(", program " + identity.program + ",") != std::string_view::npos;
    return name_ + " has results of " + (program ? "other cells" : "another version of the program") +
           ", which are not comparable; " + kRemedy;
  }
  std::size_t cell = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), cell);
  const auto rest = line.substr(static_cast<std::size_t>(end - line.data()));
  const bool right = error == std::errc{} && cell >= 1 && cell <= identity.count && rest.size() > kCheckDigits + 2 &&
                     rest[0] == ' ' && rest[kCheckDigits + 1] == ' ' &&
                     rest.substr(1, kCheckDigits) == check_of(rest.substr(kCheckDigits + 2));
  if (!right) return name_ + ":" + std::to_string(number) + ": the line is damaged; " + kRemedy;
  finished_.insert_or_assign(cell, std::string(rest.substr(kCheckDigits + 2)));
  return {};
}

std::string CellJournal::append(std::size_t number, const std::string& result) {
  return append_line(std::to_string(number) + " " + check_of(result) + " " + result);
}

std::string CellJournal::append_line(const std::string& line) {
  struct stat before{};
  if (fstat(file_.get(), &before) != 0) return name_ + ": " + io::write_error_text(errno);
  if (write_whole(file_.get(), line + "\n") && ::fdatasync(file_.get()) == 0) return {};
  std::string problem = name_ + " could not be written: " + io::write_error_text(errno);
  if (::ftruncate(file_.get(), before.st_size) != 0)
    problem += "; an unfinished line may be left, which the next run removes";
  return problem;
}

}  // namespace tandem::netsim
