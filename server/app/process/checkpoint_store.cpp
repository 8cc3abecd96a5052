#include "server/app/process/checkpoint_store.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/auth/io/state_directory.h"
#include "common/io/clock.h"
#include "common/io/thread_without_signals.h"

namespace tandem::server {
namespace {

/// Pause between two rounds of writing. If several checkpoints arrive in it, only the newest is written. An order of a
/// console ends it.
constexpr auto kRest = std::chrono::milliseconds(20), kLook = std::chrono::milliseconds(2);
/// [s] An unchanged checkpoint is written again after this time, so that its file does not look too old.
constexpr std::int64_t kRefreshS = 60;
constexpr const char* kEnding = ".checkpoint";
constexpr const char* kAside = ".unfit";

/// A problem for participants: they get no paths of this computer.
std::string without_path(const std::string& problem, const std::string& path) {
  return "the checkpoint file " + (problem.starts_with(path + " ") ? problem.substr(path.size() + 1) : problem);
}

}  // namespace

CheckpointStore::CheckpointStore(auth::StateDirectory folder, std::string prefix,
                                 std::function<void(const std::string&)> trouble,
                                 std::function<void(const std::string&)> recovered)
    : folder_(std::move(folder)),
      prefix_(std::move(prefix)),
      on_error_(std::move(trouble)),
      on_recovered_(std::move(recovered)) {}

CheckpointStore::~CheckpointStore() { stop(); }

std::expected<std::unique_ptr<CheckpointStore>, std::string> CheckpointStore::open(
    const std::string& path, std::string prefix, std::function<void(const std::string&)> trouble,
    std::function<void(const std::string&)> recovered) {
  auto folder = auth::StateDirectory::open(path, auth::StateDirectory::Missing::kIsMade);
  if (!folder) return std::unexpected(folder.error());
  return std::unique_ptr<CheckpointStore>(
      new CheckpointStore(std::move(*folder), std::move(prefix), std::move(trouble), std::move(recovered)));
}

/// Replaces all characters that a file name should not contain by dashes: names come from file names and addresses.
std::string CheckpointStore::file_of(const std::string& name) const {
  std::string file = prefix_ + name;
  for (char& c : file)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_') c = '-';
  return file + kEnding;
}

CheckpointStore::Found CheckpointStore::find(const std::string& name, const SceneSpec& scene, std::int64_t now,
                                             bool wanted) const {
  Found found;
  const std::string file = file_of(name);
  if (!folder_.has(file)) return found;
  const auto bytes = folder_.read(file);
  if (bytes && !*bytes) return found;
  if (!bytes) {
    found.incompatibility = bytes.error();
  } else if (auto kept = decode_snapshot(std::as_const(**bytes).bytes()); !kept) {
    found.incompatibility = kept.error();
  } else {
    found.incompatibility = wanted ? incompatibility(*kept, name, scene, now) : "--no-restore was given";
    if (found.incompatibility.empty()) {
      found.snapshot = std::move(*kept);
      found.snapshot->checkpoint.handed_over = false;  // the server that goes on is the one that wrote it
    }
  }
  if (found.snapshot) return found;
  std::error_code error;
  std::filesystem::rename(folder_.path_of(file), folder_.path_of(file + kAside), error);
  found.incompatibility += error ? "; " + folder_.path_of(file) + " cannot be moved aside: " + error.message()
                                 : "; it was moved aside to " + folder_.path_of(file + kAside);
  return found;
}

void CheckpointStore::start() {
  thread_ = io::thread_without_signals([this] { run(); });
}

std::shared_ptr<CheckpointMailbox> CheckpointStore::add(SessionSnapshot kept) {
  const std::lock_guard lock{lock_};
  return entries_.emplace_back(std::make_shared<Entry>(std::move(kept), wake_))->mailbox;
}

void CheckpointStore::set_removed(const std::string& name, const std::vector<std::array<std::byte, 32>>& keys) {
  {
    const std::lock_guard lock{lock_};
    for (const auto& entry : entries_)
      if (entry->snapshot.name == name && !entry->over) entry->removed_workstations = keys;
  }
  wake_.signal();
}

void CheckpointStore::set_persons(const std::string& name, const std::vector<std::string>& persons) {
  {
    const std::lock_guard lock{lock_};
    for (const auto& entry : entries_)
      if (entry->snapshot.name == name && !entry->over) entry->persons = persons;
  }
  wake_.signal();
}

void CheckpointStore::remove(const std::string& name) {
  {
    const std::lock_guard lock{lock_};
    for (const auto& entry : entries_)
      if (entry->snapshot.name == name) entry->over = true;
  }
  wake_.signal();
}

void CheckpointStore::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  wake_.signal();
  thread_.join();
}

void CheckpointStore::remove_all() noexcept {
  const std::unique_lock lock{lock_, std::try_to_lock};
  if (!lock) return;  // the thread uses the entries: leave the files
  for (const auto& entry : entries_) static_cast<void>(folder_.remove(file_of(entry->snapshot.name)));
}

void CheckpointStore::run() {
  while (true) {
    pollfd wake{wake_.get(), POLLIN, 0};
    poll(&wake, 1, -1);
    wake_.clear();
    const bool last = stopping_;  // read before the round, so that the round writes what was published before `stop`
    std::vector<std::shared_ptr<Entry>> entries;
    {
      const std::lock_guard lock{lock_};
      entries.assign(entries_.begin(), entries_.end());
    }
    // In order: the entry of a session that is over precedes the entry of its successor with the same name.
    for (const auto& entry : entries) {
      for (const auto& first : entries)  // consoles wait for the orders of others, also while a disk is slow
        if (first->over || first->mailbox->order_waits()) service_entry(*first);
      service_entry(*entry);
    }
    {
      const std::lock_guard lock{lock_};
      entries_.remove_if([&](const auto& entry) { return entry->gone; });
    }
    if (last) return;
    const auto order_waits = [](const auto& entry) { return entry->mailbox->order_waits(); };
    for (auto rest = kRest; rest > rest.zero() && std::ranges::none_of(entries, order_waits); rest -= kLook)
      std::this_thread::sleep_for(kLook);
  }
}

void CheckpointStore::service_entry(Entry& entry) {
  if (entry.gone) return;  // its file may be that of its successor by now
  if (entry.over) {
    entry.gone = true;
    static_cast<void>(folder_.remove(file_of(entry.snapshot.name)));
    return;
  }
  bool others = false;
  {
    const std::lock_guard lock{lock_};
    if (auto newer = std::exchange(entry.removed_workstations, std::nullopt)) {
      entry.snapshot.removed_workstations = std::move(*newer);
      others = true;
    }
    if (auto newer = std::exchange(entry.persons, std::nullopt)) {
      entry.snapshot.persons = std::move(*newer);
      others = true;
    }
  }
  const bool before = !entry.written.empty();
  if (others) entry.written.clear();  // so that the same checkpoint is written again
  if (Checkpoint newest; entry.mailbox->take(newest)) {
    write(entry, newest);
  } else if (others && before) {
    write(entry, Checkpoint{entry.snapshot.checkpoint});
  }
}

void CheckpointStore::write(Entry& entry, const Checkpoint& checkpoint) {
  std::vector<std::byte> bytes(kCheckpointMax);
  bytes.resize(encode_checkpoint(checkpoint, bytes));
  const std::int64_t now = auth::wall_seconds();
  StoredOrders& stored = entry.mailbox->stored();
  if (bytes == entry.written && now - entry.snapshot.written_s < kRefreshS && now >= entry.snapshot.written_s) {
    stored.set_stored(checkpoint.orders);
    return report(entry, {});
  }
  set_checkpoint(entry.snapshot, checkpoint);
  entry.snapshot.written_s = now;
  const std::string file = file_of(entry.snapshot.name);
  const std::string problem = folder_.replace(file, std::span<const std::byte>(encode_snapshot(entry.snapshot)));
  if (problem.empty()) {
    entry.written = std::move(bytes);
    stored.set_stored(checkpoint.orders);
  } else {
    entry.written.clear();  // the file may be either one
    stored.set_failed(checkpoint.orders, without_path(problem, folder_.path_of(file)));
  }
  report(entry, problem);
}

void CheckpointStore::report(Entry& entry, const std::string& problem) {
  const std::string session = "session " + entry.snapshot.name + ": ";
  if (!problem.empty()) {
    entry.works_since = {};
    if (!std::exchange(entry.failing, true))
      on_error_(session + problem + "; after a crash it would start from the beginning");
    return;
  }
  if (!entry.failing) return;
  const Time now = io::monotonic_now();
  if (entry.works_since == Time{}) entry.works_since = now;
  if (now - entry.works_since < kCalm) return;
  entry.failing = false;
  if (on_recovered_) on_recovered_(session + "its checkpoints are written again; a restart continues it");
}

}  // namespace tandem::server
