#include "common/auth/io/state_directory.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "common/auth/io/write_all.h"
#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "common/base/raw_bytes.h"
#include "common/io/clock.h"
#include "common/io/output_file.h"

namespace tandem::auth {
namespace {

constexpr std::size_t kProbe = 16384;  // [bytes] as much as a list of used tickets may need
constexpr mode_t kOwnFolder = 0700, kOthers = 0077;

std::string owner_remedy(const std::string& path, uid_t owner) {
  return path + " belongs to user " + std::to_string(owner) + ", but this program runs as user " +
         std::to_string(geteuid()) + "; run it as that user (sudo -u \\#" + std::to_string(owner) +
         " ...), or name another folder with --state";
}

/// Returns the system's text for an error; a full disk gets a text with a remedy.
std::string why(int error) {
  return error == ENOSPC || error == EDQUOT ? io::write_error_text(error) : std::strerror(error);
}

/// Creates the missing parts of a path, for the owner only.
std::string make_folders(const std::string& path) {
  std::filesystem::path made;
  for (const auto& part : std::filesystem::path(path)) {
    made /= part;
    if (made.empty() || ::mkdir(made.c_str(), kOwnFolder) == 0 || errno == EEXIST || errno == EISDIR || errno == EROFS)
      continue;
    if (std::error_code error; std::filesystem::is_directory(made, error)) continue;
    return made.string() + " cannot be made: " + why(errno);
  }
  return {};
}

std::expected<std::string, std::string> below_home(const char* rest, const char* option) {
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home != '/')
    return std::unexpected(std::string("no state folder is known: name one with --state or $") + option +
                           " ($HOME is not set)");
  return std::string(home) + rest;
}

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::expected<StateDirectory, std::string> StateDirectory::open(const std::string& path, Missing missing,
                                                                std::string_view hint) {
  if (missing == Missing::kIsMade)
    if (std::string problem = make_folders(path); !problem.empty()) return std::unexpected(std::move(problem));
  struct stat s{};
  // A link is followed if root or this user made it (systemd does for its services), but not if another user did.
  if (lstat(path.c_str(), &s) == 0 && S_ISLNK(s.st_mode) && s.st_uid != 0 && s.st_uid != geteuid())
    return std::unexpected(path + " is a link that user " + std::to_string(s.st_uid) +
                           " made; remove it, or name another folder");
  io::Fd folder{::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (!folder.open()) {
    std::string text = path + " cannot be opened: " + std::strerror(errno);
    if (errno == ENOENT && !hint.empty()) text += "; " + std::string(hint);
    return std::unexpected(std::move(text));
  }
  if (fstat(folder.get(), &s) != 0) return std::unexpected(path + ": " + std::strerror(errno));
  if (s.st_uid != geteuid()) return std::unexpected(owner_remedy(path, s.st_uid));
  if ((s.st_mode & kOthers) != 0)
    return std::unexpected(
        format("%s can be entered by others (mode %04o); if no stranger has been there: chmod 0700 %s", path.c_str(),
               static_cast<unsigned>(s.st_mode & 07777), path.c_str()));
  return StateDirectory(path, std::move(folder));
}

std::string StateDirectory::call_error(const std::string& name, std::string_view doing) const {
  return path_of(name) + " cannot be " + std::string(doing) + ": " + why(errno);
}

std::string StateDirectory::file_problem(int fd, const std::string& name, std::uint64_t size_max) const {
  struct stat s{};
  if (fstat(fd, &s) != 0) return call_error(name, "looked at");
  if (!S_ISREG(s.st_mode)) return path_of(name) + " must be a file";
  if (s.st_uid != geteuid()) return owner_remedy(path_of(name), s.st_uid);
  if ((s.st_mode & kOthers) != 0)
    return format("%s can be read by others (mode %04o); if no stranger has read it: chmod 0600 %s",
                  path_of(name).c_str(), static_cast<unsigned>(s.st_mode & 07777), path_of(name).c_str());
  if (static_cast<std::uint64_t>(s.st_size) > size_max) return path_of(name) + " is longer than 8 MiB";
  return {};
}

bool StateDirectory::has(const std::string& name) const noexcept {
  return faccessat(folder_.get(), name.c_str(), F_OK, AT_SYMLINK_NOFOLLOW) == 0;
}

std::expected<std::optional<SecretBuffer>, std::string> StateDirectory::read(const std::string& name) const {
  const io::Fd file{openat(folder_.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
  if (!file.open()) {
    if (errno == ENOENT) return std::nullopt;
    if (errno == ELOOP) return std::unexpected(path_of(name) + " must be a file, not a link");
    return std::unexpected(call_error(name, "opened"));
  }
  if (std::string wrong = file_problem(file.get(), name); !wrong.empty()) return std::unexpected(std::move(wrong));
  struct stat s{};
  if (fstat(file.get(), &s) != 0) return std::unexpected(call_error(name, "looked at"));
  SecretBuffer bytes(static_cast<std::size_t>(s.st_size));
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::read(file.get(), bytes.bytes().data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return std::unexpected(call_error(name, "read"));
    if (n == 0) return std::unexpected(path_of(name) + " became shorter while it was read");
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

std::string StateDirectory::replace(const std::string& name, std::span<const std::byte> bytes, Sync sync) const {
  const std::string beside = "." + name + ".new";
  unlinkat(folder_.get(), beside.c_str(), 0);  // of a process that died here
  {
    const io::Fd file{
        openat(folder_.get(), beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kFileMode)};
    if (!file.open()) return call_error(name, "written");
    if (!write_all(file.get(), bytes) || (sync == Sync::kYes && fsync(file.get()) != 0)) {
      std::string text = call_error(name, "written");
      unlinkat(folder_.get(), beside.c_str(), 0);
      return text;
    }
  }
  if (renameat(folder_.get(), beside.c_str(), folder_.get(), name.c_str()) != 0) {
    std::string text = call_error(name, "replaced");
    unlinkat(folder_.get(), beside.c_str(), 0);
    return text;
  }
  return sync == Sync::kNo || fsync(folder_.get()) == 0 ? std::string{} : call_error(name, "synced");
}

std::string StateDirectory::replace(const std::string& name, std::string_view text, Sync sync) const {
  return replace(name, bytes_of(text), sync);
}

std::string StateDirectory::write_problem() const {
  if (faccessat(folder_.get(), ".", W_OK | X_OK, AT_EACCESS) != 0)
    return path_ + " cannot be written to: " + std::strerror(errno) + "; chmod 0700 " + path_ +
           ", or mount it writable";
  // A full disk is found only by writing.
  const std::string probe = ".check-" + std::to_string(::getpid()) + ".new";
  const std::vector<std::byte> bytes(kProbe, std::byte{0x5a});
  const io::Fd file{
      openat(folder_.get(), probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kFileMode)};
  std::string problem;
  if (!file.open() || !write_all(file.get(), bytes) || fsync(file.get()) != 0)
    problem = path_ + " cannot be written to: " + why(errno);
  if (file.open()) unlinkat(folder_.get(), probe.c_str(), 0);
  return problem;
}

std::string StateDirectory::remove(const std::string& name) const {
  return unlinkat(folder_.get(), name.c_str(), 0) == 0 || errno == ENOENT ? std::string{} : call_error(name, "removed");
}

StateDirectory::Stamp StateDirectory::stamp(const std::string& name) const noexcept {
  struct stat s{};
  if (fstatat(folder_.get(), name.c_str(), &s, AT_SYMLINK_NOFOLLOW) != 0) return {};
  return {s.st_ino, static_cast<std::uint64_t>(s.st_size),
          static_cast<std::int64_t>(s.st_ctim.tv_sec) * 1'000'000'000 + s.st_ctim.tv_nsec};
}

void StateDirectory::remove_leftovers() const noexcept {
  std::error_code error;
  for (std::filesystem::directory_iterator i(path_, error), end; !error && i != end; i.increment(error)) {
    const std::string name = i->path().filename().string();
    if (name.starts_with('.') && name.ends_with(".new")) unlinkat(folder_.get(), name.c_str(), 0);
  }
}

std::expected<std::string, std::string> server_state_path(const std::string& option) {
  if (!option.empty()) return option;
  if (std::string named = environment("TANDEM_STATE"); !named.empty()) return named;
  const char* const system = "/var/lib/tandem";
  if (access(system, W_OK | X_OK) == 0) return system;
  return below_home("/.local/state/tandem", "TANDEM_STATE");
}

std::string server_state_option(const std::string& folder) {
  if (folder.empty()) return {};
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(folder, error);
  const auto usual = server_state_path("");
  if (error || (usual && std::filesystem::absolute(*usual, error) == whole)) return {};
  return state_option(whole.lexically_normal().string());
}

std::expected<std::string, std::string> client_state_path(const std::string& option) {
  if (!option.empty()) return option;
  if (std::string named = environment("TANDEM_CLIENT_STATE"); !named.empty()) return named;
  return below_home("/.config/tandem", "TANDEM_CLIENT_STATE");
}

std::string runtime_path(const std::string& users) {
  if (std::string named = environment("TANDEM_RUNTIME"); !named.empty()) return named;
  if (const std::string user = environment("XDG_RUNTIME_DIR"); !user.empty()) return user + "/tandem";
  const std::string user = users + "/" + std::to_string(geteuid());
  if (struct stat s{}; lstat(user.c_str(), &s) == 0 && S_ISDIR(s.st_mode) && s.st_uid == geteuid())
    return user + "/tandem";
  return "/tmp/tandem-" + std::to_string(geteuid());
}

void fill_random(std::span<std::byte> out) noexcept {
  while (!out.empty()) {
    const ssize_t n = getrandom(out.data(), out.size(), 0);
    if (n > 0) out = out.subspan(static_cast<std::size_t>(n));
  }
}

std::int64_t wall_seconds() noexcept {
  return std::chrono::duration_cast<std::chrono::seconds>(io::read_clock(CLOCK_REALTIME)).count();
}

}  // namespace tandem::auth
