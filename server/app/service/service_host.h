#pragma once

#include <expected>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/app/process/session_table.h"
#include "server/app/service/directory_snapshots.h"
#include "server/app/service/ended_sessions.h"
#include "server/app/service/registry_mirror.h"
#include "server/app/service/service_list_file.h"
#include "server/app/service/service_locator.h"
#include "server/app/service/service_thread.h"
#include "server/app/service/service_ticket_uses.h"
#include "server/service/service_differences.h"
#include "server/service/service_news.h"

namespace tandem::server {

/// Connects a server process to its service: serves the sessions that the member owns, creates sessions for operators,
/// publishes snapshots, lists and load, and reports to the operator. All members belong to the main loop's thread,
/// except `locator`.
class ServiceHost {
 public:
  /// Parts of the server process; all must outlive this.
  struct Parts {
    const ServerOptions& options;
    SessionTable& sessions;
    ShardPool& shards;
    ControlServer& control;
    ServerOutput& output;
  };

  /// @pre `parts.options.directory` is set
  /// @return the host, not yet started; or the error with its remedy
  [[nodiscard]] static std::expected<std::unique_ptr<ServiceHost>, std::string> open(const Parts& parts);

  /// Begins to register the server, after the control server was started.
  void start();
  /// Descriptor that is readable when `step` has to be called.
  [[nodiscard]] int fd() const noexcept { return thread_->fd(); }
  /// Executes the orders of the member, and publishes load and lists. @param now  of the monotonic clock
  void step(Time now);
  /// Takes an order to create a session. @return false: it is another order, and untouched
  [[nodiscard]] bool take(SessionOrder& order);
  /// The server drains, and has no session any more.
  [[nodiscard]] bool left_by_all() const;
  /// Lets consoles join the next owners by the tickets that they have. For the begin of the server's end.
  void release_consoles();
  /// Hands all sessions over, after the last one is over and before the process ends.
  void leave();
  /// For the control plane's thread.
  [[nodiscard]] SessionLocator& locator() noexcept { return *locator_; }
  [[nodiscard]] TicketUses& ticket_uses() noexcept { return *ticket_uses_; }
  [[nodiscard]] ServiceStatus status() {
    auto status = thread_->quietly([](const ServiceMember& member, Time now) { return member.status(now); });
    status.voucher_ends = voucher_ends_;
    return status;
  }

 private:
  /// A session that the member owns and that cannot be opened until its former run here is over.
  struct Waiting {
    ServiceEvent event;
    Time until{};
  };

  ServiceHost(const Parts& parts, std::string server, directory::ServerRecord record, auth::ServerKeystore keys);
  void execute(ServiceEvent event, Time now);
  void open_session(const ServiceEvent& event);
  void open_failed(const ServiceEvent& event, const std::string& why);
  void reply(std::uint64_t order, rpc::Body body);
  void forget_moved();
  /// A person holds or takes a seat of the session, or a console is joined, as of now.
  [[nodiscard]] bool in_use(const std::string& session);
  void on_over(const std::string& session, const ServiceSession& spec, bool given_up);
  [[nodiscard]] std::optional<rpc::ErrorReply> creation_problem(const rpc::CreateSession& wanted) const;
  [[nodiscard]] std::expected<std::shared_ptr<const SessionOptions>, std::string> options_of(
      const std::string& session, const ServiceSession& spec) const;
  void publish_load();
  void publish_lists();
  void report(const std::vector<ServiceNews::Line>& lines);
  void report_differences();

  Parts parts_;
  std::string server_;
  std::int64_t voucher_ends_;  ///< last second of the voucher, since 1970, UTC
  directory::ServerRecord record_;
  DirectorySnapshots snapshots_;
  std::unique_ptr<ServiceThread> thread_;
  std::unique_ptr<RegistryMirror> registry_;
  std::unique_ptr<ServiceListFile> list_file_;
  std::unique_ptr<ServiceLocator> locator_;
  std::unique_ptr<ServiceTicketUses> ticket_uses_;
  ServiceNews news_;
  std::optional<ServiceDifferences> differences_;
  std::vector<Waiting> waiting_;
  std::map<std::uint64_t, SessionOrder> orders_;  ///< creations without a reply, by number
  std::uint64_t newest_order_ = 0;
  EndedSessions ended_;
  std::set<std::string> handing_over_;         ///< sessions that move to another server, and are not over here
  std::set<std::string> handed_over_;          ///< the same, once they are over here
  std::map<std::string, std::string> listed_;  ///< as last published
  std::set<std::string> watched_;              ///< sessions with consoles
  std::optional<Time> published_;
  bool leaving_ = false;
};

}  // namespace tandem::server
