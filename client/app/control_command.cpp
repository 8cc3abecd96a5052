#include "client/app/control_command.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "client/app/ask.h"
#include "client/app/control_words.h"
#include "client/app/server_option.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/help_text.h"
#include "common/io/number_option.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "common/trust/io/control_client.h"

namespace tandem::client {
namespace {

constexpr int kDone = 0, kRefused = 1, kWrong = 2;
constexpr int kLookEveryMs = 1000;  // between two looks at how the session stands

struct Arguments {
  TicketOption ticket;
  std::string server, session, state, role, patience = "5";
  std::vector<std::string> words;
  bool json = false;
};

/// Lines of standard input, until it ends or a signal comes.
class Lines {
 public:
  Lines(int signals, int server) : signals_(signals), server_(server) {}
  /// @return nothing: no more, or nobody typed for a while
  std::optional<std::string> next() {
    idle_ = false;
    while (true) {
      if (const auto end = text_.find('\n'); end != std::string::npos) {
        std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        return line;
      }
      pollfd files[] = {{STDIN_FILENO, POLLIN, 0}, {signals_, POLLIN, 0}, {server_, POLLIN | POLLRDHUP, 0}};
      const int events = poll(files, 3, kLookEveryMs);
      if (events == 0) {
        idle_ = true;
        return std::nullopt;
      }
      if (events < 0 || files[1].revents != 0) return std::nullopt;
      if (files[2].revents != 0) {
        server_gone_ = true;
        return std::nullopt;
      }
      std::array<char, 4096> part;
      const ssize_t size = ::read(STDIN_FILENO, part.data(), part.size());
      if (size <= 0 || text_.size() > part.size()) return text_.empty() ? std::nullopt : std::optional(std::exchange(text_, {}));
      text_.append(part.data(), static_cast<std::size_t>(size));
    }
  }

  [[nodiscard]] bool idle() const { return idle_; }
  /// The server ended the connection while nothing was asked of it.
  [[nodiscard]] bool server_gone() const { return server_gone_; }

 private:
  int signals_, server_;
  bool server_gone_ = false, idle_ = false;
  std::string text_;
};

/// Somebody who looks after one session over one connection.
class Attendant {
 public:
  Attendant(Console console, const Asking& asked, bool json)
      : console_(std::move(console)), asked_(asked), patience_(std::chrono::duration_cast<std::chrono::milliseconds>(asked.patience)), json_(json) {}

  [[nodiscard]] const control::Welcome& welcome() const { return console_.welcome; }
  [[nodiscard]] int connection() const { return console_.connection->fd(); }

  /// What happened since it was last asked: said.
  enum class Look { kNothing, kTold, kGone };
  Look look() {
    const auto answer = console_.connection->ask(control::StatusRequest{console_.welcome.session_id}, patience_);
    if (!answer) return Look::kGone;
    const auto* said = std::get_if<control::Status>(&*answer);
    if (said == nullptr) return Look::kNothing;  // asked too often, or the session is over: an order will say so
    const control::Status now = completed(*said);
    const std::string news = news_text(seen_.value_or(control::Status{}), now);
    seen_ = now;
    if (news.empty()) return Look::kNothing;
    say((isatty(STDIN_FILENO) == 1 ? "\n" : "") + news);  // not behind the prompt
    return Look::kTold;
  }

  /// Until a drained server has ended, or the person has seen enough.
  int follow_drain(int signals) {
    while (true) {
      const bool gone = look() == Look::kGone;
      pollfd files[] = {{signals, POLLIN, 0}, {connection(), POLLIN | POLLRDHUP, 0}};
      poll(files, 2, gone ? 0 : kLookEveryMs / 2);
      if (files[0].revents != 0) return say("the drain goes on without this console");
      if (gone || files[1].revents != 0) return say("the server has ended");
    }
  }

  /// A drain ordered here was due: a server that ended the connection now did what it was told.
  [[nodiscard]] bool drained() const { return drain_due_ && io::monotonic_now() >= *drain_due_; }

  int obey(const Wish& wish) {
    const control::Id& id = console_.welcome.session_id;
    switch (wish.what) {
      case Wish::What::kStatus:
        return show_status();
      case Wish::What::kStop:
        return order(control::StopSession{id, wish.why}) ? tell_stop("STOPPED") : kRefused;
      case Wish::What::kPause:
        return order(control::PauseSession{id, wish.why}) ? tell_stop("PAUSED") : kRefused;
      case Wish::What::kResume:
        return resume(wish);
      case Wish::What::kAuthority:
        return authority(wish);
      case Wish::What::kRemove:
        if (!order(control::RemovePerson{id, wish.seat, wish.why})) return kRefused;
        return say(wish.seat + ": let go; the seat is free in a moment, and the session's code does not let that workstation in again");
      case Wish::What::kDrain: {
        const Time due = io::monotonic_now() + std::chrono::seconds(wish.grace_s);  // looked at before the server does: it never ends earlier
        if (!order(control::Drain{wish.grace_s})) return kRefused;
        if (!drain_due_ || due < *drain_due_) drain_due_ = due;
        return say(wish.grace_s == 0 ? std::string("draining: all hands are let go, then the server ends")
                                     : format("draining: nobody new comes in; all hands are let go in %u s, then the server ends", wish.grace_s));
      }
      case Wish::What::kHelp:
        return say(control_words_help());
      case Wish::What::kQuit:
        return kDone;
    }
    return kWrong;
  }

 private:
  static int say(const std::string& text) {
    const std::string line = text.ends_with('\n') ? text : text + "\n";
    std::fputs(text.starts_with('{') ? line.c_str() : io::for_terminal(line, stdout).c_str(), stdout);  // JSON stays as it is
    return std::fflush(stdout) == 0 ? kDone : kRefused;
  }
  static int complain(const std::string& text, int code = kRefused) {
    io::print(stderr, "tandem-client control: " + text + "\n");
    return code;
  }

  /// The answer, if it is of this kind; else it says why not.
  template <class Answer>
  std::optional<Answer> ask(const control::Body& question) {
    const auto answer = console_.connection->ask(question, patience_);
    if (!answer) {
      complain(answer.error().text);
    } else if (const auto* good = std::get_if<Answer>(&*answer)) {
      return *good;
    } else if (const auto* refused = std::get_if<control::Refused>(&*answer)) {
      complain("refused: " + refused->text);
    } else {
      complain("the server answered something else; is it of the same release?");
    }
    return std::nullopt;
  }
  bool order(const control::Body& command) { return ask<control::Done>(command).has_value(); }
  std::optional<control::Status> status() {
    auto now = ask<control::Status>(control::StatusRequest{console_.welcome.session_id});
    if (now) seen_ = now = completed(*now);
    return now;
  }

  int show_status() {
    const auto now = status();
    return now ? say(json_ ? status_json(*now) : status_text(*now)) : kRefused;
  }

  int tell_stop(const char* what) {
    const auto now = status();
    if (!now) return say(std::string(what) + ": all hands are let go");  // it is done, whatever came afterwards
    return say(format("%s: all hands are let go; `resume %u` ends it", what, now->stops));
  }

  int resume(const Wish& wish) {
    std::uint32_t stop = wish.stop.value_or(0);
    if (!wish.stop) {
      const auto now = status();
      if (!now) return kRefused;
      stop = now->stops;
    }
    if (!order(control::ResumeSession{console_.welcome.session_id, stop})) return kRefused;
    return say(format("RESUMED: stop %u is over", stop));
  }

  int authority(const Wish& wish) {
    const auto now = status();
    if (!now) return kRefused;
    const auto frame = authority_frame(wish, *now);
    if (!frame) return complain(frame.error(), kWrong);
    const auto answer = ask<control::AuthorityAnswer>(*frame);
    if (!answer) return kRefused;
    const std::string is = format("authority over %s, version %u: ", now->tools[frame->tool].name.c_str(), answer->version) + weights_text(*now, answer->alpha);
    if (answer->applied) return say(is + "; announced, it begins in 50 ms");
    return complain("refused: somebody was faster. In force: " + is + ". Look, then say it again");
  }

  /// Commands in the server's words work as typed here.
  [[nodiscard]] control::Status completed(control::Status status) const {
    if (status.stop) status.stop->ends = complete_commands(status.stop->ends, asked_, status.name);
    return status;
  }

  Console console_;
  Asking asked_;
  std::optional<control::Status> seen_;
  std::optional<Time> drain_due_;  ///< the earliest that was ordered here
  std::chrono::milliseconds patience_;
  bool json_;
};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

int tell_gone(bool person, int worst) {
  io::printf_for_people(stderr,
               "%standem-client control: the server ended this connection: it was stopped, is being restarted, or took the right to it away. Nothing can be\n"
               "ordered here any more; start again, with a new ticket if you came with one (`tandem-server ticket` on the server)\n",
               person ? "\n" : "");
  return std::max(worst, kRefused);
}

/// Orders line by line. @return the worst exit code of them
int converse(Attendant& attendant, int signals) {
  const bool person = isatty(STDIN_FILENO) == 1;
  const std::string prompt = attendant.welcome().session_name + " (" + std::string(to_text(attendant.welcome().role)) + ")> ";
  if (person) std::printf("the connection stands until you quit; `help` lists the orders\n");
  Lines lines(signals, attendant.connection());
  int worst = kDone;
  bool waiting = false;  // the prompt stands there
  while (true) {
    if (person && !waiting) std::printf("%s", prompt.c_str());
    std::fflush(stdout);
    const auto line = lines.next();
    if (!line && lines.idle()) {
      const auto became = attendant.look();
      waiting = became == Attendant::Look::kNothing;
      if (became != Attendant::Look::kGone) continue;
    }
    waiting = false;
    if (lines.server_gone() || (!line && lines.idle())) {
      if (!attendant.drained()) return tell_gone(person, worst);
      std::printf("%sthe server has ended: the drain was carried out as ordered\n", person ? "\n" : "");
      return worst;
    }
    if (!line) return worst;
    const auto words = words_of(*line);
    if (words.empty()) continue;
    const auto wish = understand(words);
    int code = kWrong;
    if (wish) {
      if (wish->what == Wish::What::kQuit) return worst;
      code = attendant.obey(*wish);
    } else {
      io::printf_for_people(stderr, "tandem-client control: %s\n", wish.error().c_str());
    }
    worst = std::max(worst, code);
  }
}

int control_command(const Arguments& arguments) {
  std::vector<std::string> mistakes;
  Asking asking;
  if (const auto server = server_option(arguments.server, mistakes)) asking.server = *server;
  std::string patience = arguments.patience;
  if (const auto problem = io::number_in(0.1, 3600, "s")(patience); !problem.empty()) mistakes.push_back("--patience: " + problem);
  std::optional<Wish> wish;
  if (!arguments.words.empty()) {
    auto understood = understand(arguments.words);
    if (understood) {
      wish = std::move(*understood);
    } else {
      mistakes.push_back(understood.error());
    }
  }
  asking.console = wish ? role_for(wish->what) : AccessRole::kOperator;
  if (!arguments.role.empty()) {
    const auto role = access_role_named(arguments.role);
    const bool stands = role && (*role == AccessRole::kInstructor || *role == AccessRole::kOperator || *role == AccessRole::kRecorder);
    if (!stands) mistakes.push_back("--role: \"" + arguments.role + "\" must be operator, instructor or recorder");
    if (stands) asking.console = *role;
  }
  asking.ticket = ticket_of(arguments.ticket, mistakes);
  if (!mistakes.empty()) {
    for (const std::string& mistake : mistakes) io::printf_for_people(stderr, "tandem-client control: %s\n", mistake.c_str());
    return kWrong;
  }
  if (wish && wish->what == Wish::What::kHelp) return std::fputs(control_words_help(), stdout) < 0 ? kRefused : kDone;
  if (wish && wish->what == Wish::What::kQuit) return kDone;
  const io::Fd signals = io::signals_as_file();
  asking.session = arguments.session;
  asking.state = arguments.state;
  asking.patience = from_seconds(std::stod(patience));
  asking.signals = signals.get();
  auto console = ask_for_console(asking);
  if (!console) {
    io::printf_for_people(stderr, "tandem-client control: %s\n", console.error().reason.c_str());
    return kRefused;
  }
  Attendant attendant(std::move(*console), asking, arguments.json);
  if (!wish) return converse(attendant, signals.get());
  const int code = attendant.obey(*wish);
  return code == kDone && wish->what == Wish::What::kDrain ? attendant.follow_drain(signals.get()) : code;
}

}  // namespace

void add_control_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const command = root.add_subcommand("control", "Stops, resumes and looks after a session without sitting in it.");
  command->add_option("--server", arguments->server, "required: the address that tandem-server prints as `listening on`")->option_text("HOST:PORT")->required();
  command->add_option("--session", arguments->session, "name, code or id of the session; default: the ticket's, or the only one there")->option_text("NAME|CODE|ID");
  add_ticket_options(*command, arguments->ticket, "what `tandem-server ticket --role operator` printed; not needed beside a server on loopback that made its keys itself");
  command->add_option("--role", arguments->role, "without a ticket: operator, instructor or recorder; default: operator, for `authority` instructor")->option_text("ROLE");
  command->add_option("--state", arguments->state, "folder of this workstation's key; default: $TANDEM_CLIENT_STATE, else ~/.config/tandem")->option_text("DIR");
  command->add_option("--patience", arguments->patience, "how long to wait for a server that does not answer [s]; default 5")->option_text("S");
  command->add_flag("--json", arguments->json, "status for machines");
  command->add_option("ORDER", arguments->words, "one of those below; none: a console that takes one order per line and stays connected")->option_text("...");
  command->footer(std::string("Orders\n") + control_words_help() +
                  "\nA ticket is good for one connection, and used up by the first order that is carried out, a look too unless the rest is refused: for\n"
                  "several orders use the console (a pipe will do); what others stop, and how far a drain is, is told there as it happens. A stop is latched and numbered; who\n"
                  "resumes names the newest, so that an old order never undoes a newer stop.\n"
                  "Exit: 0 done; 1 refused, with the reason, or server not there; 2 wrong arguments. In the console: the greatest of its orders.\n\n"
                  "Examples\n"
                  "  tandem-client control --server 127.0.0.1:7000 stop somebody is in the way\n"
                  "  tandem-client control --server lab-server:7000 --ticket-file operator.ticket");
  command->callback([arguments, &action] { action = [arguments] { return control_command(*arguments); }; });
}

}  // namespace tandem::client
