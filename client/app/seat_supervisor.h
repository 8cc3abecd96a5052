#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/app/authority_transfer_text.h"
#include "client/app/client_status.h"
#include "client/app/hardware_device.h"
#include "client/app/keyboard_controls.h"
#include "client/app/reconnector.h"
#include "client/app/run_notice.h"
#include "client/app/run_seat.h"
#include "client/app/seat_runner.h"
#include "client/app/server_watch.h"
#include "client/app/session_status_poller.h"
#include "common/io/terminal.h"

namespace tandem::client {

/// Supervisor of one joined seat on the main thread. It shows the status, handles keys, reconnects to a silent server,
/// and reports how the seat ended. The servo thread never waits for it.
class SeatSupervisor {
 public:
  struct Context {
    const SeatOptions& options;
    const JoinOptions& join_options;
    const JoinedSeat& joined;
    const Seat& seat;
    SeatRunner& runner;
    KeyboardControls& keyboard;
    hal::Device& device;
    HardwareDevice* hardware;  ///< null: simulated device
    int signals;               ///< signalfd (common/io/signals.h)
    io::StatusLine& line;
  };
  /// @param socket  duplicate of the SeatRunner's socket
  SeatSupervisor(const Context& context, io::UdpSocket socket);

  /// Runs until the seat ends. @return the reason
  [[nodiscard]] ExitReason run();
  /// Returns one sentence for the user about the end of the seat.
  [[nodiscard]] std::string exit_message(ExitReason end) const;
  /// Longest outage of the server [s].
  [[nodiscard]] double outage_longest_s() const noexcept { return server_.longest_s(); }

 private:
  void leave(const std::string& why);
  void handle_keys();
  void check_device();
  /// Detects outages of the server, and starts and finishes reconnects. @return the reason if the seat ended
  [[nodiscard]] std::optional<ExitReason> check_server(const ClientStatus& status);
  [[nodiscard]] std::optional<ExitReason> finish_reconnect();
  /// Reports why the client rejects the key of a server that answers, once for each text.
  void note_distrust(std::string why);
  void show(ClientStatus status);
  /// Shows changes of the session status from the server: stops, resumes, removals, a drain. Polls at once when FORCE
  /// shows a change.
  void show_status_changes(const ClientStatus& status);
  void update_observer(const ClientStatus& status);
  /// True if the server closed the session because it restarts.
  [[nodiscard]] static bool server_restarts(const ClientStatus& status) noexcept {
    return status.closed && status.close_reason == wire::CloseReason::kServerReturns;
  }
  [[nodiscard]] bool may_reconnect() const noexcept { return o_.options.reconnect_timeout_s > 0 && !leaving_since_; }
  [[nodiscard]] bool reconnects() const noexcept { return reconnector_ && !leaving_since_; }

  Context o_;
  io::UdpSocket socket_;  ///< duplicate of the SeatRunner's socket
  io::KeyReader keys_;
  ResumeState resume_state_;
  /// Once the seat leaves, it is only cancelled: its end, for which its destructor waits, may take longer than the hand
  /// can wait.
  std::unique_ptr<Reconnector> reconnector_;
  std::shared_ptr<auth::ControlClient> connection_;  ///< control connection of the newest join or resume
  std::unique_ptr<SessionStatusPoller> status_poller_;
  std::optional<rpc::Status> last_status_;  ///< newest status from the server
  ClientStatus status_at_poll_;             ///< client status at the last immediate poll
  std::string key_message_;                 ///< last shown reason why a key had no effect
  Time key_message_at_{};
  std::string exit_detail_;  ///< reason of ExitReason::kSeatGone
  std::string answer_;       ///< newest reason why a server did not give the seat back; empty: none was reached
  std::string distrust_;     ///< why the key of a server that answers is rejected, as reported; empty: none is
  Time begin_, shown_at_;
  ServerWatch server_;
  std::optional<Time> leaving_since_;
  RunNotice run_notice_;
  wire::SessionState session_before_ = wire::SessionState::kWaiting;
  AuthorityTransferNotices transfer_notices_;
  bool motors_hot_ = false;
  bool fault_reported_ = false, reset_requested_ = false;
};

}  // namespace tandem::client
