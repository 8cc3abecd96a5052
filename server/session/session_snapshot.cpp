#include "server/session/session_snapshot.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"
#include "proto/rpc/rpc_texts.h"

namespace tandem::server {
namespace {

constexpr std::string_view kMagic = "TKS3";
constexpr std::size_t kDigest = sizeof(Checkpoint::Hash);
constexpr std::size_t kTextMaximum = 255, kPersonMaximum = 32;
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

using Key = std::array<std::byte, 32>;

// Releases of before RestoreCounts read and write the list of removed workstations as it is. Therefore the counts are
// an entry of it that no fingerprint of a key can be: this label, flags, the epoch that wrote it, and three numbers.
constexpr std::string_view kCountsLabel = "tandem-runs";
constexpr std::byte kHandedOver{1};

Key counts_entry(const Checkpoint& checkpoint) {
  Key entry{};
  std::memcpy(entry.data(), kCountsLabel.data(), kCountsLabel.size());
  entry[kCountsLabel.size()] = checkpoint.handed_over ? kHandedOver : std::byte{0};
  const std::array<std::uint32_t, 3> numbers{checkpoint.restores->restarts, checkpoint.restores->moves,
                                             checkpoint.restores->numbers};
  std::memcpy(entry.data() + kCountsLabel.size() + 1, &checkpoint.epoch, sizeof checkpoint.epoch);
  std::memcpy(entry.data() + entry.size() - sizeof numbers, numbers.data(), sizeof numbers);
  return entry;
}

bool is_counts_entry(const Key& entry) noexcept {
  return text_of(std::span{entry}.first(kCountsLabel.size())) == kCountsLabel;
}

/// Reads the counts of an entry. They do not count if another epoch wrote the snapshot: that of an older release.
void read_counts(const Key& entry, Checkpoint& checkpoint) {
  std::uint64_t epoch = 0;
  std::array<std::uint32_t, 3> numbers{};
  std::memcpy(&epoch, entry.data() + kCountsLabel.size() + 1, sizeof epoch);
  std::memcpy(numbers.data(), entry.data() + entry.size() - sizeof numbers, sizeof numbers);
  if (epoch != checkpoint.epoch || numbers[2] > checkpoint.stops) return;
  checkpoint.restores = {numbers[0], numbers[1], numbers[2]};
  checkpoint.handed_over = entry[kCountsLabel.size()] == kHandedOver;
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
  const bool counts = kept.checkpoint.restores && kept.removed_workstations.size() < kRemovedWorkstationsMax;
  out.push_back(static_cast<std::byte>(kept.removed_workstations.size() + (counts ? 1 : 0)));
  for (const auto& key : kept.removed_workstations) put(key);
  if (counts) put(counts_entry(kept.checkpoint));
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
  kept.checkpoint.restores.reset();
  for (const Key& key : kept.removed_workstations)
    if (is_counts_entry(key)) read_counts(key, kept.checkpoint);
  std::erase_if(kept.removed_workstations, is_counts_entry);
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
