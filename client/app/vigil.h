#pragma once

#include <memory>
#include <optional>
#include <string>

#include "client/app/attend.h"
#include "client/app/client_status.h"
#include "client/app/come_back.h"
#include "client/app/handover_text.h"
#include "client/app/held_device.h"
#include "client/app/person.h"
#include "client/app/seat_pump.h"
#include "client/app/session_words.h"
#include "common/io/terminal.h"

namespace tandem::client {

/// Watches over a seat from its first tick to its last, on the person's thread: shows the status, hands keys on, sees when the server fell
/// silent and comes back to it, and says how it ended. The servo thread never waits for it.
class Vigil {
 public:
  struct Over {
    const AttendPlan& plan;
    const Asking& asked;      ///< for the seat
    const GivenSeat& given;   ///< as it was then
    const Seat& seat;
    SeatPump& pump;
    Person& person;
    hal::Device& device;
    HeldDevice* held;         ///< null: simulated
    int signals;              ///< file of signals.h
    io::StatusLine& line;
  };
  /// @param socket  a duplicate of the one that the pump has
  Vigil(const Over& over, io::UdpSocket socket);

  /// Until the end.
  [[nodiscard]] SeatEnd keep();
  /// For the person.
  [[nodiscard]] std::string farewell(SeatEnd end) const;
  /// Of those silences that ended.
  [[nodiscard]] double away_longest_s() const noexcept { return away_longest_s_; }

 private:
  void leave(const std::string& why);
  void hear_person();
  void see_device();
  /// Comes back where the server fell silent. @return how it ended, if it did
  [[nodiscard]] std::optional<SeatEnd> see_server(const ClientStatus& status);
  [[nodiscard]] std::optional<SeatEnd> take_back();
  void show(ClientStatus status);
  /// Tells what the server says of the session: stops, resumes, removals, a drain. Asks at once when FORCE shows a change.
  void see_words(const ClientStatus& status);
  void see_companion(const ClientStatus& status);
  /// The server said that it is about to be started anew.
  [[nodiscard]] static bool returns(const ClientStatus& status) noexcept {
    return status.closed && status.close_reason == wire::CloseReason::kServerReturns;
  }
  [[nodiscard]] bool may_come_back() const noexcept { return o_.plan.rejoin_s > 0 && !left_; }

  Over o_;
  io::UdpSocket kept_;             ///< the same socket as the pump's
  io::KeyReader keys_;
  OwnSeat own_;
  std::unique_ptr<ComeBack> coming_;
  std::shared_ptr<trust::ControlClient> connection_;  ///< by which the seat was given last
  std::unique_ptr<SessionWords> words_;
  std::optional<control::Status> known_;  ///< what it said last
  ClientStatus asked_at_;          ///< as FORCE was when it was hurried last
  std::string key_told_;           ///< why a key did nothing, told last
  Time key_told_at_{};
  std::string trouble_;            ///< why the seat is gone
  Time begin_, shown_, news_, looked_;  ///< news_: of the server, the last
  Time handed_over_{};             ///< the last new connection
  Duration patience_;              ///< without news, before it is asked for the seat again
  std::optional<Time> left_;
  wire::SessionState before_ = wire::SessionState::kWaiting;
  HandoverNotes handovers_;
  bool motors_hot_ = false;
  bool fault_told_ = false, wants_force_again_ = false, away_ = false;
  double away_longest_s_ = 0;
};

}  // namespace tandem::client
