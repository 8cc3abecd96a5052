#include "server/seat_port.h"

#include <utility>

namespace tandem::server {

namespace {
/// How long a seat that fell silent still holds its end of the spring: then its weight goes to others or the tool is braked.
constexpr Duration kHoldLimit = std::chrono::milliseconds(200);
}  // namespace

SeatPort::SeatPort(const SceneSpec& scene, std::size_t seat, const AxisArray& scale)
    : scene_(&scene), end_(make_channel_end(scene, seat, scale)), codec_(scene.dof, scene.port) {}

void SeatPort::take(Time now, Entry& entry) noexcept {
  std::unique_ptr<link::Link> before = connection_ ? connection_->give_up() : nullptr;
  connection_.emplace(now, std::exchange(entry.link, std::move(before)));
  std::swap(end_, entry.end);
  taken_ = true;
  generation_ = 0;
  rx_ = wire::StateMessage{};
  was_present_ = false;
}

SeatPort::Heard SeatPort::on_datagram(Time now, const Endpoint& from, std::span<const std::byte> bytes) noexcept {
  Heard heard;
  const auto opened = connection_->open(now, from, bytes, codec_);
  if (!opened) return heard;
  link::Link& link = connection_->link();
  switch (opened->type) {
    case wire::Type::kState: {
      const auto decoded = codec_.decode_state(opened->plaintext);
      if (!decoded) {
        link.refuse_body();
        break;
      }
      if (!opened->newer) break;  // latest wins: nothing acts backwards
      connection_->acts(now, from, *opened, decoded->preamble);
      for (std::size_t a = 0; a < scene_->dof; ++a) energy_fell_ |= decoded->message.port.e_in[a] < rx_.port.e_in[a];
      rx_ = decoded->message;
      ++generation_;
      break;
    }
    case wire::Type::kAuthority:
      if (const auto decoded = codec_.decode_authority(opened->plaintext)) {
        link.accept_other();
        heard.authority = decoded->message;
      } else {
        link.refuse_body();
      }
      break;
    case wire::Type::kClose:
      if (codec_.decode_close(opened->plaintext)) {
        heard.close = true;
      } else {
        link.refuse_body();
      }
      break;
    default: link.refuse_body(); break;
  }
  return heard;
}

bool SeatPort::alive(Time now) const noexcept {
  return taken_ && generation_ > 0 && connection_->silence(now) < kHoldLimit;
}

void SeatPort::move(Time now, double dt, bool present, const Near& near) noexcept {
  const double age = taken_ ? seconds(connection_->link().freshness().age(now)) : 0;
  if (!present || !was_present_) {
    if (was_present_) ++outages_;
    end_->engage(near.x, age);
    was_present_ = present;
    return;
  }
  control::EndInput in;
  in.dt = dt;
  in.age = age;
  in.weight = near.weight;
  in.x = near.x;
  in.dissipated = near.dissipated;
  in.pass_on = near.pass_on;
  in.rx = rx_.port;
  for (std::size_t a = 0; a < scene_->dof; ++a) in.rx.x[a] -= near.offset[a];
  end_->move(in);
}

Transmit SeatPort::transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept {
  return taken_ ? connection_->seal(now, tick, wire::Type::kForce, tx, codec_, buffer) : Transmit{};
}

Transmit SeatPort::transmit_close(Time now, std::uint32_t tick, wire::CloseReason why, std::span<std::byte> buffer) noexcept {
  return taken_ ? connection_->seal(now, tick, wire::Type::kClose, wire::CloseMessage{why}, codec_, buffer) : Transmit{};
}

std::optional<Transmit> SeatPort::transmit_challenge(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept {
  return taken_ ? connection_->poll_challenge(now, tick, codec_, buffer) : std::nullopt;
}

}  // namespace tandem::server
