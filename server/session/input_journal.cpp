#include "server/session/input_journal.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <variant>

#include "common/base/raw_bytes.h"
#include "server/session/session_command.h"

namespace tandem::server {
namespace {

/// A record under construction.
template <std::size_t kSize>
class RecordWriter {
 public:
  explicit RecordWriter(InputRecord kind) noexcept { put(kind); }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void put(T value) noexcept {
    std::memcpy(&bytes_[size_], &value, sizeof value);
    size_ += sizeof value;
  }
  void put(std::span<const std::byte> bytes) noexcept {
    std::ranges::copy(bytes, bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += bytes.size();
  }
  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return std::span{bytes_}.first(size_); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Replaces a number that was put at `at`.
  template <class T>
  void replace(std::size_t at, T value) noexcept {
    std::memcpy(&bytes_[at], &value, sizeof value);
  }

 private:
  std::array<std::byte, kSize> bytes_;  // not cleared: only what was put is read
  std::size_t size_ = 0;
};

/// Writes the fields of a record to memory that the caller reserved.
class Cursor {
 public:
  Cursor(std::byte* at, InputRecord kind) noexcept : at_(at) { put(kind); }
  template <class T>
  void put(T value) noexcept {
    std::memcpy(at_, &value, sizeof value);
    at_ += sizeof value;
  }
  [[nodiscard]] std::byte* at() const noexcept { return at_; }

 private:
  std::byte* at_;
};

/// Without what only the owners of seats may know.
Checkpoint without_secrets(Checkpoint checkpoint) noexcept {
  for (Checkpoint::Seat& seat : checkpoint.seats) seat.resume = {};
  return checkpoint;
}

}  // namespace

std::size_t InputJournal::drain(std::span<std::byte> out) noexcept {
  if (out.size() <= kPieceHeader) return 0;
  const std::uint64_t position = ring_.taken();
  const std::size_t size = ring_.take(out.subspan(kPieceHeader));
  if (size == 0) return 0;
  std::memcpy(out.data(), &position, sizeof position);
  return kPieceHeader + size;
}

std::int64_t InputJournal::since_last(Time now) noexcept {
  const std::int64_t dt = (now - last_).count();
  last_ = now;
  return dt;
}

void InputJournal::lose() noexcept {
  overflowed_ = true;
  dropped_.fetch_add(1, std::memory_order_relaxed);
}

void InputJournal::write(std::span<const std::byte> record) noexcept {
  std::byte* const at = open(record.size());
  if (at == nullptr) return;
  std::memcpy(at, record.data(), record.size());
  ring_.commit(record.size());
}

void InputJournal::write_overflow() noexcept {
  constexpr std::size_t kSize = 1 + sizeof ticks_;
  std::byte* const at = told_ ? nullptr : ring_.reserve(kSize);
  if (at == nullptr) return;
  Cursor cursor{at, InputRecord::kOverflow};
  cursor.put(ticks_);
  ring_.commit(kSize);
  ring_.publish();
  told_ = true;
}

void InputJournal::begin(const Begin& b) noexcept {
  for (Seat& seat : seats_) seat = {};
  seats_n_ = b.seats;
  settings_ = kNoSettings;
  in_tick_ = false;
  last_ = b.start;
  RecordWriter<kCheckpointMax + 512> record{InputRecord::kBegin};
  record.put(std::uint16_t{0});
  const std::size_t rest = record.size();
  record.put(kInputJournalVersion);
  const std::string_view build = b.build.substr(0, input::kBuildMax);
  record.put(static_cast<std::uint8_t>(build.size()));
  record.put(bytes_of(build));
  record.put(std::span<const std::byte>{b.scene});
  for (const double scale : b.scale) record.put(scale);
  record.put(std::int64_t{b.start.time_since_epoch().count()});
  std::array<std::byte, kCheckpointMax> checkpoint;
  const std::size_t size = b.from == nullptr ? 0 : encode_checkpoint(without_secrets(*b.from), checkpoint);
  record.put(static_cast<std::uint16_t>(size));
  record.put(std::span<const std::byte>{checkpoint}.first(size));
  record.replace(1, static_cast<std::uint16_t>(record.size() - rest));
  // After an overflow the journal of the next session is whole again, behind the record of the overflow.
  if (overflowed_) write_overflow();
  overflowed_ = overflowed_ && !told_;
  if (!overflowed_) {
    told_ = false;
    ticks_ = 0;
  }
  write(record.bytes());
  ring_.publish();
}

void InputJournal::admit(Time now, std::size_t seat, std::uint32_t own_cid, std::uint32_t peer_cid,
                         const rpc::DeviceFacts& device, double force_scale, bool same_owner) noexcept {
  seats_[seat].from = {};
  seats_[seat].next_counter = 0;
  RecordWriter<80> record{InputRecord::kAdmit};
  record.put(static_cast<std::uint8_t>(seat));
  record.put(static_cast<std::uint8_t>(same_owner ? 1 : 0));
  record.put(since_last(now));
  record.put(own_cid);
  record.put(peer_cid);
  record.put(device.joints);
  record.put(device.tip_axes);
  record.put(static_cast<std::uint8_t>((device.simulated ? 1 : 0) | (device.prismatic ? 2 : 0)));
  for (const double value : {device.force_peak_n, device.damping_n_s_m, device.mass_kg, device.latency_s, force_scale})
    record.put(value);
  write(record.bytes());
}

void InputJournal::datagram(Time now, std::size_t seat, const PeerAddress& from, const transport::Header& header,
                            std::span<const std::byte> plaintext, const std::uint64_t* token) noexcept {
  constexpr std::size_t kHead = 6 + 2 * sizeof(std::uint64_t);
  Seat& own = seats_[seat];
  const bool moved = !(from == own.from);
  const std::size_t size =
      kHead + (moved ? sizeof(std::uint64_t) : 0) + (token != nullptr ? sizeof *token : 0) + plaintext.size();
  std::byte* const memory = open(size);
  if (memory == nullptr) [[unlikely]]
    return;
  Cursor record{memory, InputRecord::kDatagram};
  record.put(
      static_cast<std::uint8_t>(seat | (moved ? input::kNewAddress : 0) | (token != nullptr ? input::kTokenTaken : 0)));
  record.put(static_cast<std::uint8_t>(header.type));
  record.put(header.key_phase);
  record.put(static_cast<std::uint16_t>(plaintext.size()));
  record.put(since_last(now));
  record.put(header.counter - own.next_counter);
  own.next_counter = header.counter + 1;
  if (moved) [[unlikely]] {
    own.from = from;
    record.put(transport::keyed_hash(address_key_, std::span{from.bytes}.first(from.size)));
  }
  if (token != nullptr) [[unlikely]]
    record.put(*token);
  std::memcpy(record.at(), plaintext.data(), plaintext.size());
  ring_.commit(size);
}

void InputJournal::command(Time now, const SessionCommand& command) noexcept {
  RecordWriter<48 + 8 * kMastersMax> record{InputRecord::kStop};
  const auto head = [&](InputRecord kind) {
    record = RecordWriter<48 + 8 * kMastersMax>{kind};
    record.put(since_last(now));
    record.put(static_cast<std::uint8_t>(command.role));
    record.put(command.seat);
    record.put(command.cid);
  };
  if (std::holds_alternative<rpc::StopSession>(command.body)) {
    head(InputRecord::kStop);
  } else if (std::holds_alternative<rpc::PauseSession>(command.body)) {
    head(InputRecord::kPause);
  } else if (const auto* resume = std::get_if<rpc::ResumeSession>(&command.body)) {
    head(InputRecord::kResume);
    record.put(resume->stop);
  } else if (const auto* wanted = std::get_if<rpc::SetAuthority>(&command.body);
             wanted != nullptr && wanted->alpha.size() <= kMastersMax) {
    head(InputRecord::kAuthority);
    record.put(static_cast<std::uint32_t>(wanted->tool));
    record.put(static_cast<std::uint32_t>(wanted->version));
    record.put(static_cast<std::uint8_t>(wanted->alpha.size()));
    for (const double alpha : wanted->alpha) record.put(alpha);
  } else {
    return;  // the others change nothing, or arrive as `remove`
  }
  write(record.bytes());
}

void InputJournal::remove(std::size_t seat, wire::CloseReason why) noexcept {
  RecordWriter<4> record{InputRecord::kRemove};
  record.put(static_cast<std::uint8_t>(seat));
  record.put(static_cast<std::uint8_t>(why));
  write(record.bytes());
}

void InputJournal::end(wire::CloseReason why) noexcept {
  RecordWriter<4> record{InputRecord::kEnd};
  record.put(static_cast<std::uint8_t>(why));
  write(record.bytes());
}

void InputJournal::contacts(std::size_t tool) noexcept {
  RecordWriter<4> record{InputRecord::kContacts};
  record.put(static_cast<std::uint8_t>(tool));
  write(record.bytes());
}

void InputJournal::write_settings(const Settings& settings) noexcept {
  settings_ = word_of(settings);
  RecordWriter<8> record{InputRecord::kSettings};
  record.put(static_cast<std::uint8_t>(settings.load.level));
  record.put(static_cast<std::uint8_t>((settings.load.overloaded ? 1 : 0) | (settings.telemetry_every_tick ? 2 : 0) |
                                       (settings.may_act ? 0 : 4)));
  record.put(settings.record_interval);
  write(record.bytes());
}

void InputJournal::tick(Time now, std::uint32_t missed, const Settings& settings) noexcept {
  if (settings_ != word_of(settings)) [[unlikely]]
    write_settings(settings);
  tick_at_ = now;
  missed_ = missed;
  in_tick_ = true;
}

void InputJournal::end_tick() noexcept {
  if (!in_tick_) return;
  in_tick_ = false;
  constexpr std::size_t kHead = 1 + sizeof(std::int64_t) + 2 * sizeof(std::uint32_t);
  std::byte* const memory = open(kHead + seats_n_ * sizeof(std::uint16_t));
  if (memory == nullptr) [[unlikely]]
    return write_overflow();
  Cursor record{memory, InputRecord::kTick};
  record.put(since_last(tick_at_));
  record.put(missed_);
  std::byte* const mask = record.at();
  std::uint32_t sent = 0;
  record.put(sent);
  for (std::size_t i = 0; i < seats_n_; ++i) {
    OutputDigest& digest = seats_[i].outputs;
    if (!digest.sent()) continue;
    digest.clear_sent();
    sent |= 1U << i;
    record.put(static_cast<std::uint16_t>(digest.value()));
  }
  std::memcpy(mask, &sent, sizeof sent);
  ring_.commit(static_cast<std::size_t>(record.at() - memory));
  ring_.publish();
  ++ticks_;
}

}  // namespace tandem::server
