#include "server/app/service/directory_snapshots.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/auth/io/state_directory.h"
#include "common/base/raw_bytes.h"
#include "server/service/service_consoles.h"

namespace tandem::server {
namespace {

/// A mark is the number of the entry, followed by the number of orders.
constexpr unsigned kOrderBits = 32;

/// Time after which a snapshot is written again although only the rest of the session's time has changed. A next owner
/// may give the session that much too long.
constexpr std::int64_t kLifeStepS = 30;

}  // namespace

std::shared_ptr<CheckpointMailbox> DirectorySnapshots::add(SessionSnapshot kept) {
  const std::lock_guard lock(lock_);
  entries_.remove_if([&](const Entry& entry) { return entry.snapshot.name == kept.name; });
  Entry& entry = entries_.emplace_back(
      Entry{std::move(kept), std::make_shared<CheckpointMailbox>(order_arrived_, CheckpointMailbox::Wakes::kOrders)});
  entry.number = ++added_;
  entry.mailbox->stored().set_problem(problem_);
  return entry.mailbox;
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

void DirectorySnapshots::set_consoles(const std::string& name, const std::vector<auth::Id16>& tickets) {
  const std::lock_guard lock(lock_);
  for (Entry& entry : entries_)
    if (entry.snapshot.name == name && entry.consoles != tickets)
      entry.consoles = tickets, entry.consoles_changed = true;
}

void DirectorySnapshots::set_stored(std::uint64_t mark) {
  const std::lock_guard lock(lock_);
  for (Entry& entry : entries_)
    if (entry.number == mark >> kOrderBits) entry.mailbox->stored().set_stored(static_cast<std::uint32_t>(mark));
}

void DirectorySnapshots::set_problem(const std::string& why) {
  const std::lock_guard lock(lock_);
  if (problem_ == why) return;
  problem_ = why;
  for (Entry& entry : entries_) entry.mailbox->stored().set_problem(why);
}

void DirectorySnapshots::take_snapshot(Entry& entry, News& news, Time now) {
  std::optional<std::int64_t> left_s = entry.snapshot.life_left_s;
  if (left_s) {
    if (!entry.life_ends) entry.life_ends = now + std::chrono::seconds(*left_s);
    left_s = std::max<std::int64_t>(0, std::chrono::ceil<std::chrono::seconds>(*entry.life_ends - now).count());
    entry.changed = entry.changed || *entry.snapshot.life_left_s - *left_s >= kLifeStepS;
  }
  Checkpoint checkpoint;
  const bool arrived = entry.mailbox->take(checkpoint);
  if (!arrived && !(entry.changed && !entry.taken.empty())) return;
  if (arrived) {
    std::vector<std::byte> bytes(kCheckpointMax);
    bytes.resize(encode_checkpoint(checkpoint, bytes));
    const bool leaves = checkpoint.handed_over != entry.snapshot.checkpoint.handed_over;
    news.order = checkpoint.orders != entry.snapshot.checkpoint.orders;
    if (bytes == entry.taken && !entry.changed && !leaves && !news.order) return;
    entry.taken = std::move(bytes);
    set_checkpoint(entry.snapshot, checkpoint);
  }
  entry.changed = false;
  entry.snapshot.written_s = auth::wall_seconds();
  entry.snapshot.life_left_s = left_s;
  news.snapshot = std::string(text_of(encode_snapshot(entry.snapshot)));
  news.mark = std::uint64_t{entry.number} << kOrderBits | entry.snapshot.checkpoint.orders;
}

std::vector<DirectorySnapshots::News> DirectorySnapshots::take(Time now) {
  std::vector<News> all;
  const std::lock_guard lock(lock_);
  order_arrived_.clear();
  for (Entry& entry : entries_) {
    News news{.session = entry.snapshot.name};
    take_snapshot(entry, news, now);
    if (std::exchange(entry.consoles_changed, false))
      news.consoles = to_text(ServiceConsoles{entry.snapshot.id, entry.snapshot.checkpoint.epoch, entry.consoles});
    if (!news.snapshot.empty() || news.consoles) all.push_back(std::move(news));
  }
  return all;
}

}  // namespace tandem::server
