#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "client/app/console_commands.h"
#include "client/app/drain_target.h"
#include "client/app/join_client.h"

namespace tandem::client {

/// Executes console commands for one session over one connection, and follows the session to another server of its
/// service. Prints the results on standard output, and errors on standard error.
class ConsoleClient {
 public:
  /// @param asked  as the console was joined  @param json  status and lists for machines
  ConsoleClient(Console console, const JoinOptions& asked, bool json);

  [[nodiscard]] const rpc::Welcome& welcome() const { return console_.welcome; }
  /// Descriptor of the present connection.
  [[nodiscard]] int connection() const;

  /// kChanged: a change of the session status was printed. kGone: the connection is lost.
  enum class PollResult : std::uint8_t { kNothing, kChanged, kGone };
  PollResult poll_status();

  /// Follows the session to another server of its service. @return false: it is not there, or a signal came
  bool follow();

  /// Shows the progress of a drain until the server has ended or a signal arrives. @return exit code
  int follow_drain(int signals);

  /// True if a drain requested on this console is due, so that an end of the connection is expected.
  [[nodiscard]] bool drained() const;
  /// That server. @pre a drain was requested on this console
  [[nodiscard]] std::string drained_server() const;

  /// True if the server accepted a command, so that the ticket of this console is used up. A status query alone uses
  /// it up too, unless another command was refused. A recorder uses it up by any query, its only command.
  [[nodiscard]] bool ticket_used() const {
    return acted_ || (looked_ && (!refused_ || console_.welcome.role == AccessRole::kRecorder));
  }

  /// Executes a command. @return exit code
  int execute(const ConsoleCommand& command);

 private:
  /// Returns the reply if it has this type; otherwise prints the error.
  template <class Answer>
  std::optional<Answer> ask(const rpc::Body& question);
  bool order(const rpc::Body& command);
  std::optional<rpc::SessionList> sessions();
  std::optional<rpc::Status> status();
  int tell_stop(const char* what);

  int run(const rpc::StatusRequest& request);
  int run(const rpc::StopSession& request);
  int run(const rpc::PauseSession& request);
  int run(rpc::ResumeSession request);
  int run(const AuthorityCommand& command);
  int run(const rpc::RemoveParticipant& request);
  int run(const rpc::Drain& request);
  int run(const CreateCommand& command);
  int run(const EndCommand& command);
  int run(const SessionsCommand& command);
  int run(const rpc::Note& note);
  int run(const rpc::RecordSession& request);
  int run(const HelpCommand& command);
  int run(const QuitCommand& command);

  [[nodiscard]] DrainTarget drain_target();
  /// Completes the commands in the server's texts with the options of this console.
  [[nodiscard]] rpc::Status completed(rpc::Status status) const;

  Console console_;
  JoinOptions asked_;
  std::optional<rpc::Status> seen_;
  std::optional<Time> drain_due_;  ///< earliest drain requested on this console, of `drained_`
  DrainTarget drained_;
  std::chrono::milliseconds timeout_;
  bool json_;
  bool moved_ = false;                                     ///< the server has said that the session is at another one
  bool looked_ = false, acted_ = false, refused_ = false;  ///< a status was read; others were accepted; one was refused
};

}  // namespace tandem::client
