#include "server/console/app/browser_seat.h"

#include <poll.h>

#include <algorithm>
#include <utility>

#include "client/app/seat_runner.h"
#include "common/io/clock.h"
#include "hal/io/open_sim_device.h"

namespace tandem::console {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLeave = 1500ms;    // for the ramp of the force and the CLOSE
constexpr double kLost = 5;            // silence of the server that ends the seat [s]
constexpr int kPeriodMs = 16;          // between two pictures
constexpr std::size_t kSamples = 256;  // ticks between two pictures, with a margin
constexpr const char* kDevice = "sim:keyboard";
constexpr const char* kServerLost = "the server was lost; take the seat again";
constexpr const char* kNeverHeard =
    "the server admitted the seat, but no datagram arrives; a firewall between this gateway and the server may block "
    "UDP. `tandem-client link-test` on the gateway's computer judges the link";

std::string end_text(wire::CloseReason why) {
  switch (why) {
    case wire::CloseReason::kRemoved:
    case wire::CloseReason::kRevoked:
      return "you were removed from the seat";
    case wire::CloseReason::kServerReturns:
      return "the server is being restarted; take the seat again in a moment";
    default:
      return "the session is over";
  }
}

std::array<double, 3> scaled(const std::array<double, 3>& v, double by) { return {v[0] * by, v[1] * by, v[2] * by}; }

}  // namespace

/// Parts of a held seat, in the order in which they are needed.
struct BrowserSeat::Held {
  Held(const client::JoinedSeat& joined, io::UdpSocket socket, hal::LiveSim opened)
      : live(std::move(opened)),
        seat(joined.setup, live.device->caps(), joined.link),
        runner(std::move(socket), seat, live.sim, {}, &samples),
        scale(joined.setup.seat.motion_scale) {}
  ~Held() {
    live.device->disable();
    live.device->close();
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  hal::LiveSim live;
  client::SampleQueue samples{kSamples};
  client::Seat seat;
  client::SeatRunner runner;
  double scale;  ///< motion in the scene per motion of the device
};

BrowserSeat::BrowserSeat(client::JoinOptions join, std::function<void()> news)
    : join_(std::move(join)), news_(std::move(news)) {
  picture_.seat = join_.seat;
  join_.signals = end_.get();
  join_.console.reset();
  join_.watch = false;
  thread_ = std::thread([this] { work(); });
}

BrowserSeat::~BrowserSeat() {
  leave();
  thread_.join();
}

void BrowserSeat::leave() noexcept { end_.signal(); }

void BrowserSeat::point(const std::array<double, 3>& x, bool holds, Time now) {
  const std::lock_guard hold{lock_};
  pointer_ = Pointer{x, holds, now};
}

SeatPicture BrowserSeat::newest() const {
  const std::lock_guard hold{lock_};
  return picture_;
}

template <class Change>
void BrowserSeat::update(Change change) {
  {
    const std::lock_guard hold{lock_};
    change(picture_);
  }
  news_();
}

void BrowserSeat::work() {
  std::string ended;
  const auto probe = hal::open_sim_device(kDevice, SimDeviceSpec{}, HandSpec{});
  if (probe) join_.caps = probe->device->caps();
  join_.caps.damping.reset();  // the scene decides the model of a simulated device
  join_.caps.mass.reset();
  join_.caps.stiffness.reset();
  for (hal::AxisLimit& axis : join_.caps.axis) axis = {};
  if (const auto joined = client::join_seat(join_)) {
    ended = hold(*joined);
  } else {
    ended = joined.error().interrupted ? "left" : joined.error().reason;
  }
  over_.store(true, std::memory_order_release);
  update([&](SeatPicture& picture) { picture.ended = ended; });
}

/// Holds the seat until it ends. @return why it ended
std::string BrowserSeat::hold(const client::JoinedSeat& joined) {
  auto socket = io::connect_udp(joined.udp);
  if (!socket) return socket.error();
  const SeatSetup& setup = joined.setup;
  auto opened =
      hal::open_sim_device(kDevice, setup.seat.device, setup.seat.hand, setup.seat.environment, io::monotonic_now());
  if (!opened) return opened.error().message;
  Held held(joined, std::move(*socket), hal::make_live(std::move(*opened), from_seconds(1.0 / setup.tick_hz)));
  if (auto ok = held.live.device->start(held.runner); !ok) return ok.error().message;
  if (auto ok = held.live.device->enable(); !ok) return ok.error().message;
  const hal::DeviceCaps& caps = held.live.device->caps();
  update([&](SeatPicture& picture) {
    picture.joined = true;
    picture.force_limit_n = setup.gate.force_max;
    picture.workspace_min = scaled(caps.workspace_min, held.scale);
    picture.workspace_max = scaled(caps.workspace_max, held.scale);
  });
  return watch(held);
}

std::string BrowserSeat::watch(Held& held) {
  std::optional<Time> leaving;
  client::Sample newest{};
  bool sampled = false;
  while (true) {
    pollfd files[] = {{held.runner.finished_fd(), POLLIN, 0}, {leaving ? -1 : end_.get(), POLLIN, 0}};
    ::poll(files, 2, kPeriodMs);
    const Time now = io::monotonic_now();
    if (files[1].revents != 0) {
      leaving = now;
      held.runner.commands().leave();
    }
    while (const auto sample = held.samples.take()) newest = *sample, sampled = true;
    const client::ClientStatus status = held.runner.status();
    if (files[0].revents != 0)
      return leaving                     ? "left"
             : held.runner.device_lost() ? "the simulated device ended"
                                         : end_text(status.close_reason);
    if (leaving && now - *leaving > kLeave) return "left";
    if (!leaving && status.silence_s > kLost) return status.heard ? kServerLost : kNeverHeard;
    aim(held, now);
    if (!sampled) continue;
    update([&](SeatPicture& picture) {
      picture.heard = newest.silence_s >= 0 && newest.silence_s < 1;
      picture.session = status.session;
      picture.gate = newest.gate;
      picture.authority = newest.alpha;
      picture.x = scaled(newest.x, held.scale);
      picture.f = newest.f_out;
    });
  }
}

/// Gives the simulated hand its place: where the person points, or its own place if the person does not hold it.
void BrowserSeat::aim(Held& held, Time now) {
  const std::lock_guard hold{lock_};
  const bool points = pointer_ && pointer_->holds && now - pointer_->at <= kSilent;
  std::array<double, 3> to{};
  picture_.limited = false;
  picture_.target.reset();
  if (points) {
    to = pointer_->x;
    const bool known = picture_.workspace_min != picture_.workspace_max;
    for (std::size_t k = 0; known && k < 3; ++k) {
      const double kept = std::clamp(to[k], picture_.workspace_min[k], picture_.workspace_max[k]);
      picture_.limited |= kept != to[k];
      to[k] = kept;
    }
    picture_.target = to;
  } else if (picture_.x) {
    to = *picture_.x;
  } else {
    return;
  }
  held.live.sim->hand().keyboard()->set({to[0] / held.scale, to[1] / held.scale, to[2] / held.scale});
}

}  // namespace tandem::console
