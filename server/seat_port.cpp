#include "server/seat_port.h"

#include <algorithm>

#include "common/setup/channel_setup.h"

namespace tandem::server {

namespace {
/// How long a seat that fell silent still holds its end of the spring: then its weight goes to others or the tool is braked.
constexpr Duration kHoldLimit = std::chrono::milliseconds(200);
}  // namespace

SeatPort::SeatPort(const SceneSpec& scene, std::size_t seat, const AxisArray& scale)
    : scene_(&scene), seat_(seat), scale_(scale), codec_(scene.dof, scene.port) {
  const SeatSpec& s = scene.seats[seat];
  const std::optional<double> k_s = s.kind == SeatKind::kSlave ? std::optional{scene.tools[s.tool].k_s} : std::nullopt;
  end_ = setup::make_channel(scene.channel, control::Side::kServer, scene.dof, scale_, scene.gate.force_max, !scene.unsafe_gains, k_s);
}

void SeatPort::bind(Time now, Endpoint at, std::uint64_t nonce, const link::Link::Params& link) {
  at_ = at;
  bound_at_ = now;
  generation_ = 0;
  nonce_ = nonce;
  link_.emplace(link);
  rx_ = wire::StateMessage{};
  was_present_ = false;
  const SeatSpec& s = scene_->seats[seat_];
  const std::optional<double> k_s = s.kind == SeatKind::kSlave ? std::optional{scene_->tools[s.tool].k_s} : std::nullopt;
  end_ = setup::make_channel(scene_->channel, control::Side::kServer, scene_->dof, scale_, scene_->gate.force_max, !scene_->unsafe_gains, k_s);
}

SeatPort::Heard SeatPort::on_datagram(Time now, std::span<const std::byte> bytes) noexcept {
  Heard heard;
  const auto opened = link_->open(bytes);
  if (!opened) return heard;
  switch (opened->type) {
    case wire::Type::kState: {
      const auto decoded = codec_.decode_state(opened->plaintext);
      if (!decoded) {
        link_->refuse_body();
        break;
      }
      if (!opened->newer) break;  // latest wins: nothing acts backwards
      link_->accept(now, *opened, decoded->preamble);
      for (std::size_t a = 0; a < scene_->dof; ++a) energy_fell_ |= decoded->message.port.e_in[a] < rx_.port.e_in[a];
      rx_ = decoded->message;
      ++generation_;
      break;
    }
    case wire::Type::kAuthority:
      if (const auto decoded = codec_.decode_authority(opened->plaintext)) {
        link_->accept_other();
        heard.authority = decoded->message;
      } else {
        link_->refuse_body();
      }
      break;
    case wire::Type::kClose:
      if (codec_.decode_close(opened->plaintext)) {
        heard.close = true;
      } else {
        link_->refuse_body();
      }
      break;
    default: link_->refuse_body(); break;
  }
  return heard;
}

Duration SeatPort::silence(Time now) const noexcept {
  return link_ && generation_ > 0 ? link_->freshness().silence(now) : now - bound_at_;
}

bool SeatPort::alive(Time now) const noexcept {
  return link_ && generation_ > 0 && link_->freshness().silence(now) < kHoldLimit;
}

void SeatPort::move(Time now, double dt, bool present, const Near& near) noexcept {
  const double age = link_ ? seconds(link_->freshness().age(now)) : 0;
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

template <class Message>
std::size_t SeatPort::seal(Time now, std::uint32_t tick, wire::Type type, const Message& m, std::span<std::byte> buffer) noexcept {
  if (!link_ || buffer.size() < link::kHeaderSize) return 0;
  const std::size_t plain = codec_.encode(link_->preamble(now, tick), m, buffer.subspan(link::kHeaderSize));
  return plain == 0 ? 0 : link_->seal(now, type, buffer, plain);
}

std::size_t SeatPort::transmit(Time now, std::uint32_t tick, std::span<std::byte> buffer) noexcept {
  return seal(now, tick, wire::Type::kForce, tx, buffer);
}

std::size_t SeatPort::transmit_close(Time now, std::uint32_t tick, wire::CloseReason why, std::span<std::byte> buffer) noexcept {
  return seal(now, tick, wire::Type::kClose, wire::CloseMessage{why}, buffer);
}

}  // namespace tandem::server
