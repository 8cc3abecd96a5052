#pragma once

#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/trust/io/server_trust.h"
#include "common/trust/limiter.h"
#include "server/admission.h"
#include "server/app/admissions.h"
#include "server/app/hosted_session.h"
#include "server/app/shard.h"
#include "server/kept_session.h"

namespace tandem::server {

/// The sessions of a server as its door sees them: who may sit where. Everything on the control plane's thread; what a session must do
/// itself is ordered from its shard and answered later.
class House final : public Admissions {
 public:
  /// @param trust  tickets; of the same thread
  /// @param limits  of a shard, above which nobody new gets a seat in it
  House(asio::io_context& context, trust::ServerTrust& trust, const LoadLimits& limits = {});
  ~House() override;

  /// A session that people may join from now on. Before the context runs, or on its thread.
  struct Opening {
    std::string name;          ///< for people: 1 to 32 characters of A-Z a-z 0-9 _ -
    trust::Id16 id{};
    std::string code;          ///< 10 characters of 0-9 A-Z: who is enrolled may join by it; empty: tickets only
    std::uint64_t epoch = 1;
    HostedSession* session = nullptr;  ///< lives until it is over
    Shard* shard = nullptr;            ///< serves it already, or is about to
    const KeptSession* kept = nullptr; ///< what it went on from, read by `open`; null: it is new
    std::function<void(const std::vector<std::array<std::byte, 32>>&)> sent_away{};  ///< hears of all who were sent away, when one more is; null: nobody keeps it
    Time back_until{};                 ///< who sat there may come back so long  @pre kept
  };
  void open(Opening opening);
  /// The same for a shard that runs already: it is told.
  void open_late(Opening opening);
  /// A session that is over: nobody hears of it any more. `gone` is called once nothing refers to it.
  void close(const trust::Id16& id, std::function<void()> gone);
  /// Lets all hands of a session go and ends it.
  void end(const trust::Id16& id);
  /// No newcomers from now on.
  void drain() noexcept { draining_ = true; }
  /// No newcomers from now on, and all hands are let go in `grace_s`. @param who  ordered it
  void drain_in(std::uint32_t grace_s, const std::string& who);
  /// Hears, on the control plane's thread, what people ordered, one line each. Before the context runs.
  void tell_people(std::function<void(const std::string&)> say) { say_ = std::move(say); }
  /// When all hands are to be let go, as an operator ordered; nothing: nobody did. From any thread.
  [[nodiscard]] std::optional<Time> drain_due() const noexcept;
  /// How far that is.
  [[nodiscard]] control::StatusDrain drain_progress() const;
  /// Lets go, gently, of the seats and visits of workstations that are not in the book any more.
  void look_for_revoked();

  // ---- For those who look on, on the control plane's thread ----
  [[nodiscard]] ServingSpec serving() const;
  [[nodiscard]] bool draining() const noexcept { return draining_; }
  [[nodiscard]] std::vector<const Opening*> openings() const;
  [[nodiscard]] std::vector<const Shard*> shards() const;
  [[nodiscard]] static control::SessionPhase phase_of(wire::SessionState state) noexcept;
  /// Hears when the shard has carried out orders.
  void watch(Shard& shard);
  /// Hears nobody any more, so that the context can end.
  void stop_watching();

  void admit(const JoinRequest& request, std::function<void(Admission)> answer) override;
  void seated(const JoinRequest& request, const control::Welcome& welcome, const Secret<trust::kExportSize>& secrets) override;
  void abandoned(const control::Welcome& welcome) override;
  [[nodiscard]] control::SessionList list(const WorkstationRow& workstation) override;
  void command(const control::Welcome& standing, const WorkstationRow& workstation, const control::Body& command,
               std::function<void(control::Body)> answer) override;
  [[nodiscard]] bool holds(const control::Welcome& standing) const override;
  void left(const control::Welcome& standing, bool in_vain) override;

 private:
  /// What is known of a seat beside the session: who may come back to it, and whether somebody is just being let in.
  struct Claim {
    bool being_given = false;
    std::optional<trust::Id16> ticket{};  ///< of who is just being let in
    std::optional<WorkstationRow> by{};  ///< who sits there, or sat there last
    std::uint32_t cid = 0;               ///< of his datagrams
    std::array<std::byte, 32> resume_hash{};
    std::array<std::byte, 32> before_hash{};  ///< the same owner's last one under which he was heard: a Welcome may be lost on its way
    std::array<std::byte, 32> before_next{};  ///< the same, once who is just being let in sits there
    bool resumable = false;
    double force_scale = 1;           ///< of whom the hash belongs to, as his ticket allowed
    double offered_scale = 1;         ///< of who is just being let in
    std::optional<Time> back_until{}; ///< after a restart, until its owner is back; else the session knows how long he is silent
    std::uint32_t lost_cid = 0;       ///< of whom the seat was taken from last
    std::string lost_why{};           ///< by whom, and his words
    Time held_until{};                ///< after a restart: nobody else gets it before
  };
  /// What the newest stop's maker at a console said.
  struct StopWords {
    std::uint32_t number = 0;
    std::string workstation{}, why{};
  };
  /// What everybody in a session may read of what happened lately, and who resumed it from a console.
  struct News {
    std::vector<control::StatusNews> list{};
    std::uint32_t count = 0;         ///< so far
    std::uint32_t resume_told = 0;   ///< number of the stop whose end is in the list
    std::uint32_t resumed = 0;       ///< number of the stop that `resumer` ended from a console
    std::string resumer{};
  };
  struct Visit {
    std::optional<WorkstationRow> by{};
    std::uint32_t cid = 0;
  };
  /// The ticket of somebody without a seat, until his connection is over. His Welcome's secret tells him from others.
  struct Standing {
    Secret<32> who;
    trust::Id16 ticket{};
  };
  struct Room {
    Opening opening;
    std::vector<Claim> claims;  ///< one per seat
    std::size_t orders = 0;        ///< under way
    std::function<void()> gone{};  ///< set: it is over, and waits for its last order
    std::size_t visits_being_given = 0;
    std::array<Visit, Visitors::kMax> visits{};              ///< who was let in last, by place
    std::vector<std::array<std::byte, 32>> sent_away{};      ///< keys of workstations whose person was removed
    StopWords words{};
    News news{};
    std::vector<Standing> standing{};
    trust::TokenBucket complaints{1, 5};                     ///< of what roles may not, in the audit log
  };
  struct Watched {
    Shard* shard;
    asio::posix::stream_descriptor news;
  };

  [[nodiscard]] std::variant<Room*, control::Refused> room_for(const JoinRequest& request);
  [[nodiscard]] Room* room(const control::Id& id);
  // People at control connections (house_command.cpp).
  void stand(Room& room, const JoinRequest& request, const std::function<void(Admission)>& answer);
  void visit(Room& room, const JoinRequest& request, std::function<void(Admission)> answer);
  static void visited(Room& room, const Order& order, const WorkstationRow& by, std::uint32_t cid);
  /// What is answered; trouble of the server's own is told to those who watch it.
  [[nodiscard]] control::Refused ticket_refused(const trust::ServerTrust::TicketTrouble& trouble) const;
  void give_back(const trust::Id16& ticket, const Room& room);
  void stands_no_more(Room& room, const control::Welcome& standing, bool ticket_is_good_again);
  void write_down(Room& room, const std::string& who, const std::string& why, const Command& command, const Outcome& outcome);
  [[nodiscard]] control::Status status_of(const Room& room, const control::Welcome& standing, const Outcome& outcome) const;
  static void add_news(Room& room, const std::string& text);
  static void look_for_resume(Room& room, const Outcome& outcome);
  [[nodiscard]] static std::string why_gone(const Room& room, const control::Welcome& standing);
  static void send_away(Room& room, std::size_t seat, std::string how);
  [[nodiscard]] static bool was_sent_away(const Room& room, const WorkstationRow& workstation);
  void let_go(Room& room, std::size_t seat);
  void sit(Room& room, const JoinRequest& request, std::function<void(Admission)> answer);
  [[nodiscard]] std::optional<control::Refused> judge(Room& room, const JoinRequest& request, std::size_t seat, double& force_scale);
  /// @param device  of the seat; null: a visit, or somebody without a seat
  [[nodiscard]] control::Welcome welcome(const Room& room, std::size_t seat, const control::DeviceFacts* device, std::uint8_t place, bool has_aes, double force_scale);
  /// Whether anybody new may come in at all.
  [[nodiscard]] std::optional<control::Refused> too_busy(const Room& room) const;
  // Coming back (house_resume.cpp).
  static void remember(Room& room);
  enum class Back : std::uint8_t { kNo, kByNewest, kByOneBefore };
  /// The key to which resume secrets of this workstation are bound.
  [[nodiscard]] Checkpoint::Hash bound_to(const WorkstationRow& workstation) const;
  [[nodiscard]] Back comes_back(const Claim& claim, const Secret<32>& secret, const WorkstationRow& workstation) const;
  /// Whether the seat is kept for somebody else, who sat there when the server died.
  [[nodiscard]] static bool held_for_another(const Claim& claim);
  /// A secret is good for 10 min after its owner was lost. @param silence  of who sits there
  [[nodiscard]] static bool too_late(const Claim& claim, Duration silence);
  /// From now on its owner is who was just let in. The secret before stays good until he is heard.
  void give(Claim& claim, const Secret<32>& secret, const WorkstationRow& workstation, Entry& entry) const;
  void post(Room& room, Order order);
  void sweep(Room& room);
  void hear(Watched& watched);

  asio::io_context& context_;
  trust::ServerTrust& trust_;
  LoadLimits limits_;
  bool draining_ = false;
  std::list<Room> rooms_;
  std::list<Watched> watched_;
  std::list<Order> orders_;  ///< under way
  std::uint8_t visitors_ = 0;
  std::function<void(const std::string&)> say_{};
  std::atomic<std::int64_t> drain_due_{0};  ///< [ns] of the monotonic clock; 0: not ordered
};

/// A session's code as people read it: 5 characters, a dash, 5 characters. And back: dashes, spaces and lower case do not matter.
[[nodiscard]] std::string draw_session_code();
[[nodiscard]] std::string code_text(const std::string& code);

}  // namespace tandem::server
