#include "server/export/app/parquet_process.h"

#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/base/sanitize.h"
#include "common/io/output_file.h"
#include "server/export/app/parquet_program.h"

// NOLINTNEXTLINE(readability-redundant-declaration): POSIX declares it in no header
extern char** environ;

namespace tandem::server {

namespace {

constexpr int kStreamDescriptor = 3;
constexpr int kCommandNotFound = 127;
constexpr std::size_t kMessageMax = 2000;  // bytes of Node.js' own words that are kept
constexpr const char* kNoNode =
    "Parquet files need Node.js 18 or later, and there is no program `node`: apt install nodejs. CSV and HDF5 do not "
    "need it";

const char* name_of(ParquetColumn::Type type) {
  constexpr std::array kNames{"FLOAT", "DOUBLE", "INT64", "BOOLEAN", "STRING"};
  return kNames[static_cast<std::size_t>(type)];
}

/// An anonymous file. @return closed on failure
io::Fd anonymous_file(const char* name) { return io::Fd{::memfd_create(name, MFD_CLOEXEC)}; }

bool fill_file(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t wrote = ::write(fd, text.data(), text.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(wrote));
  }
  return ::lseek(fd, 0, SEEK_SET) == 0;
}

/// Starts node with the program on standard input, the stream on descriptor 3 and its words in `messages`.
/// @return errno, 0 if it was started
int start_node(int program, int stream, int messages, pid_t& pid) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t how;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&how);
  posix_spawn_file_actions_adddup2(&files, program, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, messages, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, messages, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&files, stream, kStreamDescriptor);
  // A group of its own: Ctrl-C reaches the exporter only, which then ends the process.
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&how, 0);
  posix_spawnattr_setsigmask(&how, &none);
  std::array<std::string, 3> words{"node", "--input-type=module", "-"};
  std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
  const int failed = posix_spawnp(&pid, "node", &files, &how, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&how);
  return failed;
}

}  // namespace

ParquetProcess::ParquetProcess() {
  std::array<int, 2> ends{-1, -1};
  const io::Fd program = anonymous_file("parquet_writer");
  messages_ = anonymous_file("messages");
  if (!program.open() || !messages_.open() || !fill_file(program.get(), parquet_program()) ||
      ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    error_ = std::string("Node.js could not be started: ") + std::strerror(errno);
    return;
  }
  stream_ = io::Fd{ends[0]};
  const io::Fd theirs{ends[1]};
  const int failed = start_node(program.get(), theirs.get(), messages_.get(), pid_);
  if (failed == 0) return;
  pid_ = 0;
  error_ = failed == ENOENT ? kNoNode : std::string("Node.js could not be started: ") + std::strerror(failed);
}

ParquetProcess::~ParquetProcess() {
  if (pid_ == 0) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ParquetProcess::send(std::span<const std::byte> bytes) {
  while (!bytes.empty() && error_.empty()) {
    const ssize_t wrote = ::send(stream_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) {  // the process has ended, and its words say why
      reap();
      if (error_.empty()) error_ = "Node.js ended before all data were written";
      return;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
  }
}

void ParquetProcess::send_json(const std::string& json) {
  const auto size = static_cast<std::uint32_t>(json.size());
  std::array<std::byte, sizeof size> head{};
  for (std::size_t k = 0; k < head.size(); ++k) head[k] = static_cast<std::byte>(size >> (8 * k));
  send(head);
  send(std::as_bytes(std::span(json)));
}

void ParquetProcess::begin(const std::string& path, const std::vector<ParquetColumn>& columns,
                           const std::map<std::string, std::string>& metadata) {
  nlohmann::json message = {{"file", path}, {"columns", nlohmann::json::array()}, {"metadata", metadata}};
  if (metadata.empty()) message["metadata"] = nlohmann::json::object();
  for (const ParquetColumn& column : columns)
    message["columns"].push_back({{"name", column.name}, {"type", name_of(column.type)}, {"shape", column.shape}});
  send_json(message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void ParquetProcess::rows(std::size_t count, std::span<const std::byte> numbers,
                          const std::map<std::string, std::vector<std::string>>& texts) {
  nlohmann::json message = {{"rows", count}};
  for (const auto& [column, values] : texts) message["texts"][column] = values;
  send_json(message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  send(numbers);
}

void ParquetProcess::end() { send_json(R"({"end": true})"); }

void ParquetProcess::reap() {
  if (pid_ == 0) return;
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  if ((WIFEXITED(status) && WEXITSTATUS(status) == 0) || !error_.empty()) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kCommandNotFound) {
    error_ = kNoNode;
    return;
  }
  std::string words(kMessageMax, '\0');
  const ssize_t size = ::pread(messages_.get(), words.data(), words.size(), 0);
  words.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  constexpr std::string_view kErrno = "errno ";
  if (words.starts_with(kErrno)) {
    error_ =
        "the Parquet files could not be written: " + io::write_error_text(std::atoi(words.c_str() + kErrno.size()));
  } else {
    error_ = "Node.js could not write the Parquet files (version 18 or later is needed): " +
             (words.empty() ? "it was killed" : sanitize(words));
  }
}

std::string ParquetProcess::finish() {
  stream_.reset();
  reap();
  return error_;
}

}  // namespace tandem::server
