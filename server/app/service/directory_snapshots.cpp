#include "server/app/service/directory_snapshots.h"

#include "common/auth/io/state_directory.h"

namespace tandem::server {

std::shared_ptr<CheckpointMailbox> DirectorySnapshots::add(SessionSnapshot kept) {
  const std::lock_guard lock(lock_);
  entries_.remove_if([&](const Entry& entry) { return entry.snapshot.name == kept.name; });
  return entries_.emplace_back(Entry{std::move(kept), std::make_shared<CheckpointMailbox>(arrived_)}).mailbox;
}

void DirectorySnapshots::set_removed(const std::string& name, const std::vector<std::array<std::byte, 32>>& keys) {
  const std::lock_guard lock(lock_);
  for (Entry& entry : entries_)
    if (entry.snapshot.name == name) entry.snapshot.removed_workstations = keys, entry.changed = true;
}

void DirectorySnapshots::set_persons(const std::string& name, const std::vector<std::string>& persons) {
  const std::lock_guard lock(lock_);
  for (Entry& entry : entries_)
    if (entry.snapshot.name == name) entry.snapshot.persons = persons, entry.changed = true;
}

void DirectorySnapshots::remove(const std::string& name) {
  const std::lock_guard lock(lock_);
  entries_.remove_if([&](const Entry& entry) { return entry.snapshot.name == name; });
}

std::vector<std::pair<std::string, std::string>> DirectorySnapshots::take() {
  std::vector<std::pair<std::string, std::string>> newest;
  const std::lock_guard lock(lock_);
  arrived_.clear();
  for (Entry& entry : entries_) {
    Checkpoint checkpoint;
    const bool arrived = entry.mailbox->take(checkpoint);
    if (!arrived && !(entry.changed && !entry.taken.empty())) continue;
    if (arrived) {
      std::vector<std::byte> bytes(kCheckpointMax);
      bytes.resize(encode_checkpoint(checkpoint, bytes));
      if (bytes == entry.taken && !entry.changed) continue;
      entry.taken = std::move(bytes);
      entry.snapshot.checkpoint = checkpoint;
    }
    entry.changed = false;
    entry.snapshot.written_s = auth::wall_seconds();
    const std::vector<std::byte> encoded = encode_snapshot(entry.snapshot);
    std::string text(encoded.size(), '\0');
    for (std::size_t i = 0; i < encoded.size(); ++i) text[i] = static_cast<char>(encoded[i]);
    newest.emplace_back(entry.snapshot.name, std::move(text));
  }
  return newest;
}

}  // namespace tandem::server
