#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/console/acknowledgement_window.h"
#include "server/console/app/gateway.h"
#include "server/console/browser_frame.h"

namespace tandem::console {

/// One open page: the messages for it, and the meaning of its frames. It knows no socket. For the web thread.
class LivePage : public std::enable_shared_from_this<LivePage> {
 public:
  static constexpr std::size_t kQueueMax = 64;  ///< messages that wait

  /// @param flush  called when messages wait
  LivePage(Gateway& gateway, std::shared_ptr<Person> person, std::function<void()> flush);
  /// Leaves the seat of the page.
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  /// Call it after a new picture of any link.
  void on_news();
  /// Call it twenty times per second or so.
  void on_period(std::chrono::steady_clock::time_point now);
  /// Handles a frame of the browser. @return reason to close the connection; empty: none
  [[nodiscard]] std::string on_frame(std::string_view text);

  /// Messages for the browser, oldest first. The socket removes the first one when it is written.
  [[nodiscard]] std::deque<std::string>& queue() noexcept { return queue_; }
  /// More than kQueueMax messages waited: the browser is too slow, and messages are missing.
  [[nodiscard]] bool overflowed() const noexcept { return overflowed_; }

 private:
  void send(std::string text);
  void greet();
  void choose_view();
  void send_notices(const LivePicture& own, const LivePicture& view);
  void send_events(const rpc::Status& status);
  void send_state(const LivePicture& own, const LivePicture& view);
  void watch(const Watch& wish);
  void give(Order order);
  void ask(std::uint64_t id, rpc::Body body);
  void mark(const MarkFrame& frame);
  void sheet(const SheetFrame& frame);
  void send_notes(const LivePicture& own);
  void send_scores(const LivePicture& own);
  void take(const TakeSeat& wish);
  void leave(const LeaveSeat& wish);
  void point(const Pointer& pointer);
  void invite(const Invite& wish);
  void send_seat();

  Gateway& gateway_;
  std::shared_ptr<Person> person_;
  std::function<void()> flush_;
  std::shared_ptr<ServerLink> link_;   ///< of the watched session; the orders go there
  std::shared_ptr<ServerLink> view_;   ///< shows that session
  std::shared_ptr<BrowserSeat> seat_;  ///< that the person holds in this page; null: none
  std::string seat_words_;             ///< last message seat
  std::deque<std::string> queue_;
  AcknowledgementWindow window_;
  std::chrono::steady_clock::time_point second_{};
  std::vector<rpc::ListedSession> listed_;  ///< as in the last hello
  std::string scene_;                       ///< last message scene
  std::uint64_t shown_ = 0;                 ///< number of the last picture of `view_`
  std::uint32_t event_ = 0;
  std::shared_ptr<const EvaluationNotes> notes_;  ///< of the last message notes
  std::shared_ptr<const std::string> scores_;     ///< the last message scores
  std::shared_ptr<const rpc::SceneList> scenes_;  ///< as in the last hello
  unsigned frames_ = 0;
  AccessRole role_ = AccessRole::kObserver;
  std::string warning_;
  bool greeted_ = false, connected_ = true, again_ = false, held_ = false, overflowed_ = false;
};

}  // namespace tandem::console
