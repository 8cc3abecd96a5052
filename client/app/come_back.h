#pragma once

#include <atomic>
#include <expected>
#include <memory>
#include <optional>
#include <thread>

#include "client/app/ask.h"
#include "client/app/seat_pump.h"
#include "common/io/fd.h"

namespace tandem::client {

/// Asks for a seat again whose server fell silent, on a thread of its own, until it is given, refused for good, or nobody needs it any more.
/// Meanwhile the device is served as ever: the gate let go long before, and zeros go to the motors.
class ComeBack {
 public:
  /// Begins. @param asking  as the seat was asked for; patience and signals are chosen here
  /// @param seat, pump  must outlive it
  /// @param kept  the socket in use: taken again where this host's address is still the same, so that what stands between (a NAT, netsim's proxy)
  ///              sees the client it knows
  ComeBack(Asking asking, OwnSeat own, const Seat& seat, const SeatPump& pump, const io::UdpSocket& kept);
  /// Gives up; a seat that was given and not taken is given back.
  ~ComeBack();
  ComeBack(const ComeBack&) = delete;
  ComeBack& operator=(const ComeBack&) = delete;

  [[nodiscard]] bool done() const noexcept { return done_.load(std::memory_order_acquire); }
  /// Readable once it is.
  [[nodiscard]] int done_fd() const noexcept { return done_event_.get(); }
  struct Back {
    GivenSeat given;
    std::unique_ptr<SeatPump::Handover> handover;
  };
  /// Once. @pre done()
  [[nodiscard]] std::expected<Back, NotBack> take() { return std::move(*result_); }

 private:
  void work();
  [[nodiscard]] std::expected<Back, NotBack> attempt(Duration patience);

  Asking asking_;
  OwnSeat own_;
  const Seat* seat_;
  const SeatPump* pump_;
  const io::UdpSocket* kept_;
  io::Fd cancel_, done_event_;
  std::optional<std::expected<Back, NotBack>> result_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

/// How long after the last news somebody begins to come back: 1 s, so that short outages heal by themselves, and up to half a second more,
/// so that a school does not knock all at once (design notes, security 4).
[[nodiscard]] Duration draw_wait_before_return();

}  // namespace tandem::client
