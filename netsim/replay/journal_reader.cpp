#include "netsim/replay/journal_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/base/raw_bytes.h"

namespace tandem::netsim {

using server::InputRecord;

namespace {

/// Last enumerators, so that a damaged journal makes no value outside of them.
constexpr auto kLastShedLevel = static_cast<std::uint8_t>(server::kShedLevels - 1);
constexpr std::size_t kDropAt = 1 << 20;  ///< read bytes are dropped once there are so many of them

}  // namespace

/// Reads numbers one after the other. After a read beyond the end, `whole` is false and all values are zero.
class JournalReader::Fields {
 public:
  explicit Fields(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}
  template <class T>
  T get() noexcept {
    T value{};
    const auto from = bytes(sizeof value);
    if (from.size() == sizeof value) std::memcpy(&value, from.data(), sizeof value);
    return value;
  }
  std::span<const std::byte> bytes(std::size_t size) noexcept {
    if (size > bytes_.size() - at_) {
      whole_ = false;
      return {};
    }
    at_ += size;
    return bytes_.subspan(at_ - size, size);
  }
  [[nodiscard]] bool whole() const noexcept { return whole_; }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool whole_ = true;
};

bool JournalReader::add(std::span<const std::byte> piece) {
  if (!error_.empty()) return false;
  constexpr std::size_t kHeader = server::InputJournal::kPieceHeader;
  if (piece.size() <= kHeader) {
    fail("a piece of " + std::to_string(piece.size()) + " bytes, less than a position and one byte");
    return false;
  }
  std::uint64_t position = 0;
  std::memcpy(&position, piece.data(), sizeof position);
  if (position != dropped_ + bytes_.size()) {
    error_ = "bytes " + std::to_string(dropped_ + bytes_.size()) + " to " + std::to_string(position) +
             " of the inputs are missing";
    return false;
  }
  if (at_ >= kDropAt) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
    dropped_ += at_;
    at_ = 0;
  }
  bytes_.insert(bytes_.end(), piece.begin() + kHeader, piece.end());
  return true;
}

void JournalReader::fail(const std::string& what) {
  error_ = "byte " + std::to_string(dropped_ + at_) + " of the inputs: " + what;
}

std::optional<JournalEvent> JournalReader::next() {
  while (error_.empty()) {
    while (at_ < bytes_.size() && bytes_[at_] == std::byte{0}) ++at_;  // between two records
    if (at_ == bytes_.size()) break;
    Fields fields{std::span{bytes_}.subspan(at_)};
    auto event = read(fields);
    if (!error_.empty() || !fields.whole()) break;  // damaged, or continued by the next piece
    at_ += fields.at();
    if (event) return event;  // else settings, which belong to the next tick
  }
  return std::nullopt;
}

std::optional<JournalEvent> JournalReader::read(Fields& fields) {
  const auto kind = fields.get<InputRecord>();
  if (!begun_ && kind != InputRecord::kBegin) {
    fail("they do not begin with a session");
    return std::nullopt;
  }
  const auto reason = [&] {
    const auto value = fields.get<std::uint8_t>();
    if (fields.whole() && value > wire::kCloseReasonMax) fail("close reason " + std::to_string(value));
    return static_cast<wire::CloseReason>(value);
  };
  switch (kind) {
    case InputRecord::kBegin:
      return read_begin(fields);
    case InputRecord::kAdmit:
      return read_admit(fields);
    case InputRecord::kDatagram:
      return read_datagram(fields);
    case InputRecord::kStop:
    case InputRecord::kPause:
    case InputRecord::kResume:
    case InputRecord::kAuthority:
      return read_command(fields, kind);
    case InputRecord::kRemove: {
      const auto seat = fields.get<std::uint8_t>();
      if (seat >= kSeatsMax) fail("seat " + std::to_string(seat));
      return JournalRemove{seat, reason()};
    }
    case InputRecord::kEnd:
      return JournalEnd{reason()};
    case InputRecord::kContacts:
      return JournalContacts{fields.get<std::uint8_t>()};
    case InputRecord::kTick:
      return read_tick(fields);
    case InputRecord::kSettings: {
      const auto level = fields.get<std::uint8_t>(), flags = fields.get<std::uint8_t>();
      const auto interval = fields.get<std::uint32_t>();
      if (!fields.whole()) return std::nullopt;
      if (level > kLastShedLevel || flags > 7 || interval == 0) fail("settings out of range");
      settings_ = {
          {static_cast<server::ShedLevel>(level), (flags & 1) != 0}, (flags & 2) != 0, interval, (flags & 4) == 0};
      return std::nullopt;
    }
    case InputRecord::kOverflow:
      return JournalOverflow{fields.get<std::uint64_t>()};
  }
  fail("unknown record " + std::to_string(static_cast<unsigned>(kind)));
  return std::nullopt;
}

std::optional<JournalEvent> JournalReader::read_begin(Fields& fields) {
  Fields body{fields.bytes(fields.get<std::uint16_t>())};
  if (!fields.whole()) return std::nullopt;
  JournalBegin begin;
  const auto version = body.get<std::uint8_t>();
  if (version != server::kInputJournalVersion) {
    fail("version " + std::to_string(version) + " of the journal; this program reads version " +
         std::to_string(server::kInputJournalVersion));
    return std::nullopt;
  }
  begin.build = text_of(body.bytes(body.get<std::uint8_t>()));
  begin.scene = body.get<server::Checkpoint::Hash>();
  bool finite = true;
  for (double& scale : begin.scale) {
    scale = body.get<double>();
    finite &= std::isfinite(scale);
  }
  begin.start = Time{Duration{body.get<std::int64_t>()}};
  if (const auto bytes = body.bytes(body.get<std::uint16_t>()); !bytes.empty()) {
    const auto from = server::decode_checkpoint(bytes);
    if (!from) {
      fail("the checkpoint that the session was restored from is damaged");
      return std::nullopt;
    }
    begin.from = *from;
  }
  if (!body.whole() || !finite) {
    fail("the begin of the session is damaged");
    return std::nullopt;
  }
  begun_ = true;
  seats_ = {};
  settings_ = {};
  last_ = begin.start;
  return begin;
}

std::optional<JournalEvent> JournalReader::read_admit(Fields& fields) {
  JournalAdmit admit;
  admit.seat = fields.get<std::uint8_t>();
  admit.same_owner = fields.get<std::uint8_t>() != 0;
  const Duration dt{fields.get<std::int64_t>()};
  admit.own_cid = fields.get<std::uint32_t>();
  admit.peer_cid = fields.get<std::uint32_t>();
  admit.device.joints = fields.get<std::uint32_t>();
  admit.device.tip_axes = fields.get<std::uint32_t>();
  const auto flags = fields.get<std::uint8_t>();
  admit.device.simulated = (flags & 1) != 0;
  admit.device.prismatic = (flags & 2) != 0;
  bool finite = true;
  for (double* const value : {&admit.device.force_peak_n, &admit.device.damping_n_s_m, &admit.device.mass_kg,
                              &admit.device.latency_s, &admit.force_scale}) {
    *value = fields.get<double>();
    finite &= std::isfinite(*value) && *value >= 0;
  }
  if (!fields.whole()) return std::nullopt;
  const auto axes = [](std::uint32_t n) { return n >= 1 && n <= kAxesMax; };
  if (admit.seat >= kSeatsMax || !finite || !axes(admit.device.joints) || !axes(admit.device.tip_axes)) {
    fail("an admission to seat " + std::to_string(admit.seat) + " with numbers out of range");
    return std::nullopt;
  }
  seats_[admit.seat] = {};
  admit.at = last_ += dt;
  return admit;
}

std::optional<JournalEvent> JournalReader::read_datagram(Fields& fields) {
  JournalDatagram d;
  const unsigned word = fields.get<std::uint8_t>();
  const auto type = fields.get<std::uint8_t>();
  d.key_phase = fields.get<std::uint8_t>();
  const std::size_t size = fields.get<std::uint16_t>();
  const Duration dt{fields.get<std::int64_t>()};
  const auto ahead = fields.get<std::uint64_t>();
  const bool new_address = (word & server::input::kNewAddress) != 0;
  const std::uint64_t address = new_address ? fields.get<std::uint64_t>() : 0;
  if ((word & server::input::kTokenTaken) != 0) d.token = fields.get<std::uint64_t>();
  d.plaintext = fields.bytes(size);
  if (!fields.whole()) return std::nullopt;
  d.seat = word & server::input::kSeatMask;
  if (d.seat >= kSeatsMax || type < wire::kFirstType || type > wire::kLastType ||
      size > transport::kDatagramMax - transport::kHeaderSize - transport::kTagSize) {
    fail("a datagram of type " + std::to_string(type) + " and " + std::to_string(size) + " bytes to seat " +
         std::to_string(d.seat));
    return std::nullopt;
  }
  Seat& seat = seats_[d.seat];
  if (new_address) {
    seat.from = {};
    seat.from.size = sizeof address;
    std::memcpy(seat.from.bytes.data(), &address, sizeof address);
  }
  d.type = static_cast<wire::Type>(type);
  d.counter = seat.next_counter + ahead;
  seat.next_counter = d.counter + 1;
  d.from = seat.from;
  d.at = last_ += dt;
  return d;
}

std::optional<JournalEvent> JournalReader::read_command(Fields& fields, InputRecord kind) {
  JournalCommand c;
  bool valid = true;
  const Duration dt{fields.get<std::int64_t>()};
  const auto role = fields.get<std::uint8_t>();
  c.command.seat = fields.get<std::uint8_t>();
  c.command.cid = fields.get<std::uint32_t>();
  if (kind == InputRecord::kStop) c.command.body = rpc::StopSession{};
  if (kind == InputRecord::kPause) c.command.body = rpc::PauseSession{};
  if (kind == InputRecord::kResume) {
    rpc::ResumeSession resume;
    resume.stop = fields.get<std::uint32_t>();
    c.command.body = resume;
  }
  if (kind == InputRecord::kAuthority) {
    rpc::SetAuthority wanted;
    wanted.tool = fields.get<std::uint32_t>();
    wanted.version = fields.get<std::uint32_t>();
    const std::size_t masters = fields.get<std::uint8_t>();
    if (masters <= kMastersMax) wanted.alpha.resize(masters);
    for (double& alpha : wanted.alpha) {
      alpha = fields.get<double>();
      valid &= alpha >= 0 && alpha <= 1;
    }
    valid &= masters <= kMastersMax && wanted.tool < kToolsMax;
    c.command.body = wanted;
  }
  if (!fields.whole()) return std::nullopt;
  if (role >= kAccessRoles || !valid) {
    fail("a command with numbers out of range");
    return std::nullopt;
  }
  c.command.role = static_cast<AccessRole>(role);
  c.at = last_ += dt;
  return c;
}

std::optional<JournalEvent> JournalReader::read_tick(Fields& fields) {
  JournalTick tick;
  const Duration dt{fields.get<std::int64_t>()};
  tick.missed = fields.get<std::uint32_t>();
  tick.settings = settings_;
  tick.sent = fields.get<std::uint32_t>();
  for (std::size_t i = 0; i < kSeatsMax; ++i)
    if ((tick.sent >> i & 1) != 0) tick.outputs[i] = fields.get<std::uint16_t>();
  if (!fields.whole()) return std::nullopt;
  if (tick.sent >> kSeatsMax != 0) {
    fail("outputs of a seat that no scene has");
    return std::nullopt;
  }
  tick.at = last_ += dt;
  return tick;
}

}  // namespace tandem::netsim
