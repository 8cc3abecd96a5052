#include "server/lobby.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "common/base/rng.h"
#include "proto/seat_setup.h"

namespace tandem::server {

namespace {

std::string_view name_in(const std::array<char, wire::kSeatNameMax>& field) noexcept {
  const auto end = std::find(field.begin(), field.end(), '\0');
  return {field.data(), static_cast<std::size_t>(end - field.begin())};
}

void put_reason(wire::BindAckMessage& ack, std::string_view text) noexcept {
  ack.reason.fill('\0');
  std::copy_n(text.begin(), std::min(text.size(), ack.reason.size() - 1), ack.reason.begin());
}

/// Why this device may not sit here; empty when it may.
std::string unfit(const SceneSpec& scene, const SeatSpec& seat, const wire::BindMessage& m) {
  const std::size_t needed = scene.dof;
  if (scene.port == PortSpace::kTip ? m.tip_axes < needed : m.joints < needed)
    return "the scene needs " + std::to_string(needed) + " axes, the device has " +
           std::to_string(scene.port == PortSpace::kTip ? m.tip_axes : m.joints);
  if (!m.simulated && !scene.gate.latch) return "gate.latch: false is for simulated devices only";
  if (!m.simulated && scene.gate.loop_age_max > 0.3)
    return "gate.loop_age_max_ms above 300 is for simulated devices only; use a scene with at most 300";
  if (!scene.unsafe_gains && m.damping_n_s_m > 0 && seat.kind == SeatKind::kMaster) {
    const double limit = 2 * m.damping_n_s_m * scene.tick_hz;
    if (scene.coupling.k_c > limit * (1 + 1e-9))
      return "k_c is above the device's passivity limit 2 b/T = " + std::to_string(static_cast<int>(limit)) + " N/m";
  }
  return {};
}

}  // namespace

Lobby::Lobby(const SceneSpec& scene, const AxisArray& scale, std::uint64_t secret)
    : scene_(&scene),
      opening_(link::loopback_key(0, link::Direction::kToServer)),
      sealing_(link::loopback_key(0, link::Direction::kToClient)),
      secret_(secret) {
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    SeatSetup setup = seat_setup(scene, i);
    setup.axis_scale = scale;
    wire::BindAckMessage ack;
    ack.result = wire::BindResult::kAccepted;
    ack.setup_size = static_cast<std::uint32_t>(encode_seat_setup(setup, ack.setup));
    accepted_.push_back(ack);
  }
  waiting_.reserve(kWaitingMax);
}

std::uint32_t Lobby::draw_cid(std::size_t seat) noexcept {
  // The low bits name the seat, the rest is drawn: a table look-up, and nothing to guess from an old session.
  const std::uint64_t drawn = RandomKey{secret_}.bits(++draws_);
  return static_cast<std::uint32_t>((drawn << 8) | (seat + 1));
}

std::optional<std::size_t> Lobby::seat_of_cid(std::uint32_t cid) const noexcept {
  const std::size_t seat = (cid & 0xff) - 1;
  if (seat >= scene_->seats.size() || cids_[seat] != cid) return std::nullopt;
  return seat;
}

wire::BindAckMessage Lobby::receive_visitor(Time now, const Endpoint& from, const wire::BindMessage& m, Visitors& visitors) noexcept {
  const std::uint32_t cid =
      visitors.bind(now, from, m.nonce, m.client_cid, draw_cid(kSeatsMax), from_seconds(1.0 / scene_->tick_hz));
  wire::BindAckMessage ack;
  if (cid == 0) {
    ack.result = wire::BindResult::kSeatTaken;
    put_reason(ack, "as many link tests as there may be are under way");
  } else {
    ack = accepted_.front();  // a seat's rate and sizes
    ack.server_cid = cid;
  }
  return ack;
}

bool Lobby::on_bind(Time now, const Endpoint& from, std::span<const std::byte> bytes, std::span<SeatPort> seats, Visitors& visitors,
                    bool closed) noexcept {
  const auto header = link::read_header(bytes);
  if (!header || header->type != wire::Type::kBind) return false;
  std::array<std::byte, link::kDatagramMax> plain;
  const std::span<std::byte> plaintext{plain.data(), bytes.size() - link::kHeaderSize - link::kTagSize};
  if (!opening_.open(header->counter, bytes, plaintext)) return false;
  const auto decoded = codec_.decode_bind(plaintext);
  if (!decoded) return false;
  const wire::BindMessage& m = decoded->message;

  const std::string_view name = name_in(m.seat);
  const auto spec = std::ranges::find_if(scene_->seats, [&](const SeatSpec& s) { return s.name == name; });
  wire::BindAckMessage ack;
  ack.nonce = m.nonce;
  if (closed) {
    ack.result = wire::BindResult::kSessionOver;
    put_reason(ack, "the session is ending");
  } else if (spec == scene_->seats.end() && name == wire::kVisitorName) {
    ack = receive_visitor(now, from, m, visitors);
    ack.nonce = m.nonce;
  } else if (spec == scene_->seats.end()) {
    std::string text = "no seat of this name; seats:";
    for (const SeatSpec& s : scene_->seats) text += " " + s.name;
    ack.result = wire::BindResult::kNoSuchSeat;
    put_reason(ack, text);
  } else {
    const auto i = static_cast<std::size_t>(spec - scene_->seats.begin());
    SeatPort& seat = seats[i];
    const bool same = seat.bound() && seat.nonce() == m.nonce && seat.endpoint() == from;
    const bool silent = !seat.bound() || seat.silence(now) > std::chrono::seconds(2);  // its owner is gone
    if (const std::string why = unfit(*scene_, *spec, m); !why.empty()) {
      ack.result = wire::BindResult::kDeviceUnfit;
      put_reason(ack, why);
    } else if (!same && !silent) {
      ack.result = wire::BindResult::kSeatTaken;
      put_reason(ack, "somebody sits there already");
    } else {
      if (!same) {
        const std::uint32_t cid = draw_cid(i);
        cids_[i] = cid;
        seat.bind(now, from, m.nonce,
                  {link::Direction::kToClient, cid, m.client_cid, from_seconds(1.0 / scene_->tick_hz)});
      }
      ack = accepted_[i];
      ack.nonce = m.nonce;
      ack.server_cid = cids_[i];
    }
  }
  answer(from, ack);
  return true;
}

void Lobby::answer(const Endpoint& to, const wire::BindAckMessage& ack) noexcept {
  if (waiting_.size() >= kWaitingMax) return;
  Waiting& w = waiting_.emplace_back();
  w.to = to;
  const std::size_t plain = codec_.encode({}, ack, std::span{w.bytes}.subspan(link::kHeaderSize));
  w.size = link::kHeaderSize + plain + link::kTagSize;
  link::write_header({wire::Type::kBindAck, 0, 0, counter_}, std::span{w.bytes}.first<link::kHeaderSize>());
  if (plain == 0 || w.size > w.bytes.size() || !sealing_.seal(counter_++, std::span{w.bytes}.first(w.size))) waiting_.pop_back();
}

std::optional<Lobby::Answer> Lobby::poll(std::span<std::byte> buffer) noexcept {
  if (waiting_.empty()) return std::nullopt;
  const Waiting& w = waiting_.back();
  const Answer out{w.to, w.size};
  const bool fits = w.size <= buffer.size();
  if (fits) std::copy_n(w.bytes.begin(), w.size, buffer.begin());
  waiting_.pop_back();
  return fits ? std::optional{out} : std::nullopt;
}

}  // namespace tandem::server
