#include "server/export/io/trial_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

namespace tandem::server {

namespace {

constexpr char kEnded = '.';  // last byte of a child that came to its end
constexpr std::size_t kTextMax = std::size_t{1} << 20;

void write_all(int to, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(to, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

std::string attempt_text(const std::function<std::string()>& attempt) {
  try {
    return attempt();
  } catch (const std::bad_alloc&) {
    return "there is not enough memory";
  } catch (const std::exception& error) {
    return error.what();
  }
}

[[noreturn]] void run_child(int to, const std::function<std::string()>& attempt, unsigned cpu_seconds) {
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(number, SIG_DFL);
  const rlimit none{0, 0}, time{cpu_seconds, cpu_seconds + 1};
  ::setrlimit(RLIMIT_CORE, &none);
  ::setrlimit(RLIMIT_CPU, &time);
  if (const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC); null >= 0) ::dup2(null, STDERR_FILENO);
  write_all(to, attempt_text(attempt) + kEnded);
  ::_exit(0);
}

/// Reads to the end, and keeps at most kTextMax bytes.
std::string read_all(int from) {
  std::string out;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = ::read(from, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return out;
    if (out.size() < kTextMax) out.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::string try_in_child(const std::function<std::string()>& attempt, unsigned cpu_seconds) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return std::string("no pipe to a child process: ") + std::strerror(errno);
  const pid_t child = ::fork();
  if (child == 0) run_child(pipe[1], attempt, cpu_seconds);
  const int fork_error = errno;
  ::close(pipe[1]);
  std::string text = child < 0 ? std::string() : read_all(pipe[0]);
  ::close(pipe[0]);
  if (child < 0) return std::string("no child process: ") + std::strerror(fork_error);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (text.ends_with(kEnded)) {
    text.pop_back();
    return text;
  }
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
    return "reading took more than " + std::to_string(cpu_seconds) + " s of processor time, or was killed";
  const std::string reason = WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status)) : "";
  return "reading crashed" + (reason.empty() ? "" : ": " + reason);
}

}  // namespace tandem::server
