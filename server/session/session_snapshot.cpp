#include "server/session/session_snapshot.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>

#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"
#include "proto/rpc/rpc_texts.h"
#include "server/session/stop_entries.h"

namespace tandem::server {
namespace {

constexpr std::string_view kMagic = "TKS3";
constexpr std::size_t kDigest = sizeof(Checkpoint::Hash);
constexpr std::size_t kTextMaximum = 255, kPersonMaximum = 32;
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

using Key = SnapshotEntry;

// Releases of before RestoreCounts read and write the list of removed workstations as it is. Therefore later additions
// are entries of it that no fingerprint of a key can be: a label, flags, the epoch that wrote it, and numbers at the
// end.
constexpr std::string_view kCountsLabel = "tandem-runs", kLifeLabel = "tandem-life";
static_assert(kCountsLabel.size() == kLifeLabel.size());
constexpr std::size_t kFlagsAt = kCountsLabel.size(), kEpochAt = kFlagsAt + 1;
constexpr std::byte kHandedOver{1};

template <class Numbers>
Key make_entry(std::string_view label, std::byte flags, std::uint64_t epoch, const Numbers& numbers) {
  static_assert(kEpochAt + sizeof epoch + sizeof numbers <= sizeof(Key));
  Key entry{};
  std::memcpy(entry.data(), label.data(), label.size());
  entry[kFlagsAt] = flags;
  std::memcpy(entry.data() + kEpochAt, &epoch, sizeof epoch);
  std::memcpy(entry.data() + entry.size() - sizeof numbers, &numbers, sizeof numbers);
  return entry;
}

bool has_label(const Key& entry, std::string_view label) noexcept {
  return text_of(std::span{entry}.first(label.size())) == label;
}

/// Numbers of an entry with this label; nullopt: it has another one, or another epoch wrote the snapshot: that of an
/// older release, which does not know the entry.
template <class Numbers>
std::optional<Numbers> numbers_of(const Key& entry, std::string_view label, std::uint64_t epoch) {
  std::uint64_t by = 0;
  Numbers numbers{};
  std::memcpy(&by, entry.data() + kEpochAt, sizeof by);
  std::memcpy(&numbers, entry.data() + entry.size() - sizeof numbers, sizeof numbers);
  return has_label(entry, label) && by == epoch ? std::optional(numbers) : std::nullopt;
}

using Counts = std::array<std::uint32_t, 3>;

/// The entries beside the removed workstations.
std::vector<Key> additions(const SessionSnapshot& kept) {
  std::vector<Key> all;
  const Checkpoint& checkpoint = kept.checkpoint;
  if (const auto& restores = checkpoint.restores)
    all.push_back(make_entry(kCountsLabel, checkpoint.handed_over ? kHandedOver : std::byte{0}, checkpoint.epoch,
                             Counts{restores->restarts, restores->moves, restores->numbers}));
  if (kept.life_left_s) all.push_back(make_entry(kLifeLabel, std::byte{0}, checkpoint.epoch, *kept.life_left_s));
  std::ranges::copy(stop_entries(checkpoint.latest_stop, checkpoint.epoch), std::back_inserter(all));
  const std::size_t room = kRemovedWorkstationsMax - kept.removed_workstations.size();
  if (all.size() > room) all.resize(room);
  return all;
}

/// Takes the additions out of the list of removed workstations.
void take_additions(SessionSnapshot& kept) {
  Checkpoint& checkpoint = kept.checkpoint;
  checkpoint.restores.reset();
  checkpoint.latest_stop = stop_of(kept.removed_workstations, checkpoint.epoch, checkpoint.seats_n);
  for (const Key& entry : kept.removed_workstations) {
    const auto counts = numbers_of<Counts>(entry, kCountsLabel, checkpoint.epoch);
    if (counts && (*counts)[2] <= checkpoint.stops) {
      checkpoint.restores = {(*counts)[0], (*counts)[1], (*counts)[2]};
      checkpoint.handed_over = entry[kFlagsAt] == kHandedOver;
    }
    const auto left = numbers_of<std::int64_t>(entry, kLifeLabel, checkpoint.epoch);
    if (left && *left >= 0 && *left <= rpc::kLifeMaxS) kept.life_left_s = left;
  }
  std::erase_if(kept.removed_workstations, [](const Key& entry) {
    return has_label(entry, kCountsLabel) || has_label(entry, kLifeLabel) || has_label(entry, kStopLabel);
  });
}

const char* cause(CheckpointError error) noexcept {
  switch (error) {
    case CheckpointError::kSize:
      return "its checkpoint is cut off";
    case CheckpointError::kVersion:
      return "its checkpoint has another layout: it was written by another release";
    case CheckpointError::kDigest:
      return "its checkpoint is damaged";
    case CheckpointError::kRange:
      return "its checkpoint has a number out of range";
  }
  return "";
}

}  // namespace

void set_checkpoint(SessionSnapshot& kept, const Checkpoint& newest) {
  const bool same_stop = kept.checkpoint.stops == newest.stops;
  const auto named = kept.checkpoint.latest_stop.words.person;
  kept.checkpoint = newest;
  StopLatch::Latest& stop = kept.checkpoint.latest_stop;
  if (stop.restored || !stop.words.workstation.empty() || stop.by >= kept.persons.size()) return;
  stop.words.person = same_stop ? named : FixedText<rpc::kNameMax>{kept.persons[stop.by]};
}

std::vector<std::byte> encode_snapshot(const SessionSnapshot& kept) {
  if (kept.name.empty() || kept.name.size() > kTextMaximum || kept.code.size() > kTextMaximum ||
      kept.removed_workstations.size() > kRemovedWorkstationsMax || kept.persons.size() > kSeatsMax ||
      std::ranges::any_of(kept.persons, [](const std::string& name) { return name.size() > kPersonMaximum; }))
    return {};
  std::vector<std::byte> out;
  const auto put = [&](std::span<const std::byte> bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); };
  const auto text = [&](const std::string& s) {
    out.push_back(static_cast<std::byte>(s.size()));
    put(bytes_of(s));
  };
  put(bytes_of(kMagic));
  put(std::as_bytes(std::span{&kept.written_s, 1}));
  put(kept.id);
  text(kept.name);
  text(kept.code);
  const std::vector<Key> added = additions(kept);
  out.push_back(static_cast<std::byte>(kept.removed_workstations.size() + added.size()));
  for (const Key& key : kept.removed_workstations) put(key);
  for (const Key& key : added) put(key);
  out.push_back(static_cast<std::byte>(kept.persons.size()));
  for (const std::string& name : kept.persons) text(name);
  std::array<std::byte, kCheckpointMax> checkpoint;
  put(std::span{checkpoint}.first(encode_checkpoint(kept.checkpoint, checkpoint)));
  const Checkpoint::Hash digest = transport::sha256(out);
  put(digest);
  return out;
}

std::expected<SessionSnapshot, std::string> decode_snapshot(std::span<const std::byte> bytes) {
  if (bytes.size() < kMagic.size() + kDigest || bytes.size() > kSnapshotMax)
    return std::unexpected("its size is out of range");
  if (text_of(bytes.first(kMagic.size())) != kMagic) return std::unexpected("it is no checkpoint of this release");
  std::span<const std::byte> rest = bytes.first(bytes.size() - kDigest);
  const Checkpoint::Hash digest = transport::sha256(rest);
  if (!std::ranges::equal(digest, bytes.last(kDigest))) return std::unexpected("it is damaged or cut off");
  bool whole = true;
  const auto take = [&](std::size_t size) {
    whole = whole && size <= rest.size();
    const auto part = rest.first(whole ? size : 0);
    rest = rest.subspan(part.size());
    return part;
  };
  const auto text = [&] {
    const auto size = take(1);
    return std::string(text_of(take(size.empty() ? 0 : std::to_integer<std::size_t>(size[0]))));
  };
  SessionSnapshot kept;
  take(kMagic.size());
  if (const auto written = take(sizeof kept.written_s); whole)
    std::memcpy(&kept.written_s, written.data(), written.size());
  if (const auto id = take(kept.id.size()); whole) std::ranges::copy(id, kept.id.begin());
  kept.name = text();
  kept.code = text();
  const auto count = take(1);
  const std::size_t keys = count.empty() ? 0 : std::to_integer<std::size_t>(count[0]);
  if (keys > kRemovedWorkstationsMax) return std::unexpected("it lists too many removed workstations");
  for (std::size_t i = 0; i < keys && whole; ++i)
    if (const auto key = take(32); whole) std::ranges::copy(key, kept.removed_workstations.emplace_back().begin());
  const auto seats = take(1);
  const std::size_t persons = seats.empty() ? 0 : std::to_integer<std::size_t>(seats[0]);
  if (persons > kSeatsMax) return std::unexpected("it names too many persons");
  for (std::size_t i = 0; i < persons && whole; ++i) {
    kept.persons.push_back(text());
    const std::string& person = kept.persons.back();
    if (!person.empty() && !rpc::is_name(person)) return std::unexpected("the name of a person in it is not valid");
  }
  if (!whole || kept.name.empty()) return std::unexpected("it is cut off");
  const auto checkpoint = decode_checkpoint(rest);
  if (!checkpoint) return std::unexpected(cause(checkpoint.error()));
  kept.checkpoint = *checkpoint;
  take_additions(kept);
  return kept;
}

std::string incompatibility(const SessionSnapshot& kept, std::string_view name, const SceneSpec& scene,
                            std::int64_t now) {
  if (kept.name != name) return "it belongs to the session " + kept.name;
  if (kept.written_s > now && kept.written_s - now > kResumeLifeS)
    return "it was written in the future: this computer's clock was set back";
  if (now > kept.written_s && now - kept.written_s > kResumeLifeS)
    return "it is " + std::to_string((now - kept.written_s) / 60) + " min old; a checkpoint can be used for 10 min";
  return incompatibility(kept.checkpoint, scene);
}

}  // namespace tandem::server
