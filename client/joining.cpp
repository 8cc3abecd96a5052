#include "client/joining.h"

#include <algorithm>

namespace tandem::client {

namespace {
constexpr Duration kRepeat = std::chrono::milliseconds(100);
}

Joining::Joining(const Params& p)
    : params_(p),
      sealing_(link::loopback_key(0, link::Direction::kToServer)),
      opening_(link::loopback_key(0, link::Direction::kToClient)) {}

std::optional<std::size_t> Joining::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  if (answered_ || buffer.size() < link::kDatagramMax) return std::nullopt;
  if (started_ && now - last_ < kRepeat) return std::nullopt;
  if (!started_) first_ = now;
  started_ = true;
  last_ = now;

  wire::BindMessage m;
  std::copy_n(params_.seat.begin(), std::min(params_.seat.size(), m.seat.size()), m.seat.begin());
  m.nonce = params_.nonce;
  m.client_cid = params_.own_cid;
  m.joints = static_cast<std::uint32_t>(params_.caps.joints);
  m.tip_axes = static_cast<std::uint32_t>(params_.caps.tip_axes);
  m.simulated = params_.caps.simulated;
  m.prismatic = params_.caps.prismatic;
  m.force_peak_n = params_.caps.axis[0].peak.value_or(0);
  m.damping_n_s_m = params_.caps.damping.value_or(0);
  m.mass_kg = params_.caps.mass.value_or(0);
  const std::size_t plain = codec_.encode({}, m, buffer.subspan(link::kHeaderSize));
  const std::size_t size = link::kHeaderSize + plain + link::kTagSize;
  if (plain == 0) return std::nullopt;
  const std::uint64_t counter = (params_.nonce << 16) + counter_++;
  link::write_header({wire::Type::kBind, 0, 0, counter}, buffer.first<link::kHeaderSize>());
  if (!sealing_.seal(counter, buffer.first(size))) return std::nullopt;
  return size;
}

void Joining::on_datagram(Time, std::span<const std::byte> bytes) noexcept {
  const auto header = link::read_header(bytes);
  if (answered_ || !header || header->cid != 0 || header->type != wire::Type::kBindAck) return;
  std::array<std::byte, link::kDatagramMax> plain;
  const std::span<std::byte> plaintext{plain.data(), bytes.size() - link::kHeaderSize - link::kTagSize};
  if (!opening_.open(header->counter, bytes, plaintext)) return;
  const auto decoded = codec_.decode_bind_ack(plaintext);
  if (!decoded || decoded->message.nonce != params_.nonce) return;
  const wire::BindAckMessage& m = decoded->message;
  result_ = m.result;
  answered_ = true;
  if (m.result != wire::BindResult::kAccepted) {
    reason_.assign(m.reason.data(), static_cast<std::size_t>(std::find(m.reason.begin(), m.reason.end(), '\0') - m.reason.begin()));
    return;
  }
  auto setup = decode_seat_setup(std::span{m.setup}.first(std::min<std::size_t>(m.setup_size, m.setup.size())));
  if (!setup) {
    result_ = wire::BindResult::kDeviceUnfit;
    reason_ = "the server sent a setup this client cannot accept: " + (setup.error().empty() ? "" : setup.error().front().message);
    return;
  }
  setup_ = std::move(*setup);
  server_cid_ = m.server_cid;
}

Joining::Outcome Joining::outcome(Time now) const noexcept {
  if (answered_) return result_ == wire::BindResult::kAccepted ? Outcome::kAccepted : Outcome::kRefused;
  return started_ && now - first_ > params_.patience ? Outcome::kNoAnswer : Outcome::kAsking;
}

link::Link::Params Joining::link() const noexcept {
  return {link::Direction::kToServer, params_.own_cid, server_cid_, from_seconds(1.0 / setup_.tick_hz)};
}

}  // namespace tandem::client
