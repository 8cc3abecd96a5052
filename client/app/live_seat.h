#pragma once

#include <expected>
#include <memory>
#include <string>

#include "client/app/client_status.h"
#include "common/base/time.h"
#include "hal/core/device.h"
#include "proto/text/seat_setup.h"

namespace tandem::client {

/// Server and seat that a program wants to join.
struct LiveSeatOptions {
  std::string server;        ///< `HOST:PORT`, as the server prints it
  std::string seat;          ///< name of the seat in the scene
  std::string session = {};  ///< name, code or id of the session; empty: the only session of the server
  std::string ticket = {};   ///< output of `tandem-server ticket`; empty: none
  std::string state = {};    ///< state directory with this workstation's key; empty: the default directory
  Duration timeout = std::chrono::seconds(5);  ///< limit of the connect and of the server's reply, positive
  /// Exchange period of the device, at most one tick of the scene. The seat then ticks in the exchange nearest to each
  /// tick time. Zero: one exchange per tick.
  Duration exchange = Duration::zero();
};

/// A joined seat of a running server, for a program that brings its own device.
///
/// Order of calls: `join`, start and enable the device with this object as its client, wait, `leave`, wait until the
/// seat is closed, close the device, destroy this object. The seat does not reconnect: when the server is silent, the
/// force gate ramps the force to zero, and `status().silence_s` grows.
///
/// Threads: the device's thread calls `tick` and `lost`; every other function may be called by one other thread.
class LiveSeat final : public hal::ServoClient {
 public:
  /// Joins a seat. Blocks until the server has replied, at most about twice `options.timeout`.
  /// @param options  server and seat
  /// @param caps  capabilities of the device that will call `tick`; the server and the seat derive limits from them
  /// @return the seat, or the cause and remedy as text: address, server, name, ticket or device
  /// @throws std::runtime_error if the crypto library lacks a cipher.
  [[nodiscard]] static std::expected<std::unique_ptr<LiveSeat>, std::string> join(const LiveSeatOptions& options,
                                                                                  const hal::DeviceCaps& caps);
  /// @pre the device is closed
  ~LiveSeat() override;

  /// Advances the seat when a tick is due: receives, computes, sends. Real-time safe.
  /// @return joint effort [N m or N] after the force gate, with its expiry; finite for every input
  hal::Command tick(const hal::State& state) noexcept override;
  /// Returns the shift of the next exchange that lets the STATE arrive shortly before the server's tick.
  [[nodiscard]] Duration next_shift() noexcept override;
  /// Reports that the device is lost; the seat then counts as closed.
  void lost(hal::Errc why) noexcept override;

  /// Returns the scene's settings of this seat: role, tick rate, axes, names of the masters.
  [[nodiscard]] const SeatSetup& setup() const noexcept;
  /// Returns the status as of at most 64 ticks ago.
  [[nodiscard]] ClientStatus status() const;
  /// Waits until the server or this client has closed the seat, or the device is lost.
  /// @return false if `timeout` expired first
  [[nodiscard]] bool wait_until_closed(Duration timeout) const;

  /// Requests that this seat leave: its force ramps to zero, then the server receives a CLOSE.
  void leave() noexcept;
  /// Stops this seat with its next tick: its force ramps to zero, until `resume`.
  void stop() noexcept;
  /// Requests a stop or pause of the whole session, as the role of this seat allows.
  void stop_all() noexcept;
  /// Ends the local stop, and also the session's stop if this seat may end it.
  void resume() noexcept;
  /// Clears a latched force gate and latched guards.
  void reset_gate() noexcept;

 private:
  struct Parts;
  explicit LiveSeat(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace tandem::client
