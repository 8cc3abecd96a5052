#include "client/app/control_command.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "client/app/ask.h"
#include "client/app/control_words.h"
#include "client/app/server_option.h"
#include "common/base/format.h"
#include "common/io/number_option.h"
#include "common/io/signals.h"
#include "common/trust/io/control_client.h"

namespace tandem::client {
namespace {

constexpr int kDone = 0, kRefused = 1, kWrong = 2;

struct Arguments {
  std::string server, session, ticket, state, role, patience = "5";
  std::vector<std::string> words;
  bool json = false;
};

/// As typed, or the first line of a file of this name.
std::string ticket_of(const std::string& typed) {
  std::ifstream file(typed);
  std::string line;
  return !typed.starts_with("ticket:") && file && std::getline(file, line) ? line : typed;
}

/// Lines of standard input, until it ends or a signal comes.
class Lines {
 public:
  Lines(int signals, int server) : signals_(signals), server_(server) {}
  /// @return nothing: no more
  std::optional<std::string> next() {
    while (true) {
      if (const auto end = text_.find('\n'); end != std::string::npos) {
        std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        return line;
      }
      pollfd files[] = {{STDIN_FILENO, POLLIN, 0}, {signals_, POLLIN, 0}, {server_, POLLIN | POLLRDHUP, 0}};
      if (poll(files, 3, -1) < 0 || files[1].revents != 0) return std::nullopt;
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

  /// The server ended the connection while nothing was asked of it.
  [[nodiscard]] bool server_gone() const { return server_gone_; }

 private:
  int signals_, server_;
  bool server_gone_ = false;
  std::string text_;
};

/// Somebody who looks after one session over one connection.
class Attendant {
 public:
  Attendant(Console console, Duration patience, bool json)
      : console_(std::move(console)), patience_(std::chrono::duration_cast<std::chrono::milliseconds>(patience)), json_(json) {}

  [[nodiscard]] const control::Welcome& welcome() const { return console_.welcome; }
  [[nodiscard]] int connection() const { return console_.connection->fd(); }

  int obey(const Wish& wish) {
    const control::Id& id = console_.welcome.session_id;
    switch (wish.what) {
      case Wish::What::kStatus:
        return show_status();
      case Wish::What::kStop:
        return order(control::StopSession{id, wish.why}) ? tell_stop("STOPPED") : kRefused;
      case Wish::What::kPause:
        return order(control::PauseSession{id}) ? tell_stop("PAUSED") : kRefused;
      case Wish::What::kResume:
        return resume(wish);
      case Wish::What::kAuthority:
        return authority(wish);
      case Wish::What::kRemove:
        if (!order(control::RemovePerson{id, wish.seat, wish.why})) return kRefused;
        return say(wish.seat + ": let go; the seat is free in a moment, and the session's code does not let that workstation in again");
      case Wish::What::kDrain:
        if (!order(control::Drain{wish.grace_s})) return kRefused;
        return say(wish.grace_s == 0 ? std::string("draining: all hands are let go, then the server ends")
                                     : format("draining: nobody new comes in; all hands are let go in %u s, then the server ends", wish.grace_s));
      case Wish::What::kHelp:
        return say(control_words_help());
      case Wish::What::kQuit:
        return kDone;
    }
    return kWrong;
  }

 private:
  static int say(const std::string& text) {
    std::printf("%s%s", text.c_str(), text.ends_with('\n') ? "" : "\n");
    return std::fflush(stdout) == 0 ? kDone : kRefused;
  }
  static int complain(const std::string& text, int code = kRefused) {
    std::fprintf(stderr, "tandem-client control: %s\n", text.c_str());
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
  std::optional<control::Status> status() { return ask<control::Status>(control::StatusRequest{console_.welcome.session_id}); }

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

  Console console_;
  std::chrono::milliseconds patience_;
  bool json_;
};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// Orders line by line. @return the worst exit code of them
int converse(Attendant& attendant, int signals) {
  const bool person = isatty(STDIN_FILENO) == 1;
  const std::string prompt = attendant.welcome().session_name + " (" + std::string(to_text(attendant.welcome().role)) + ")> ";
  if (person) std::printf("the connection stands until you quit; `help` lists the orders\n");
  Lines lines(signals, attendant.connection());
  int worst = kDone;
  while (true) {
    if (person) std::printf("%s", prompt.c_str());
    std::fflush(stdout);
    const auto line = lines.next();
    if (lines.server_gone()) {
      std::fprintf(stderr,
                   "%standem-client control: the server ended this connection: it was stopped, is being started anew, or took the right to it away. Nothing can be\n"
                   "ordered here any more; start again, with a new ticket if you came with one (`tandem-server ticket` on the server)\n",
                   person ? "\n" : "");
      return std::max(worst, kRefused);
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
      std::fprintf(stderr, "tandem-client control: %s\n", wish.error().c_str());
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
  if (!mistakes.empty()) {
    for (const std::string& mistake : mistakes) std::fprintf(stderr, "tandem-client control: %s\n", mistake.c_str());
    return kWrong;
  }
  if (wish && wish->what == Wish::What::kHelp) return std::fputs(control_words_help(), stdout) < 0 ? kRefused : kDone;
  if (wish && wish->what == Wish::What::kQuit) return kDone;
  const io::Fd signals = io::signals_as_file();
  asking.session = arguments.session;
  asking.ticket = arguments.ticket.empty() ? "" : ticket_of(arguments.ticket);
  asking.state = arguments.state;
  asking.patience = from_seconds(std::stod(patience));
  asking.signals = signals.get();
  auto console = ask_for_console(asking);
  if (!console) {
    std::fprintf(stderr, "tandem-client control: %s\n", console.error().reason.c_str());
    return kRefused;
  }
  Attendant attendant(std::move(*console), asking.patience, arguments.json);
  return wish ? attendant.obey(*wish) : converse(attendant, signals.get());
}

}  // namespace

void add_control_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const command = root.add_subcommand("control", "Stops, resumes and looks after a session without sitting in it.");
  command->add_option("--server", arguments->server, "required: the address that tandem-server prints as `listening on`")->option_text("HOST:PORT")->required();
  command->add_option("--session", arguments->session, "name, code or id of the session; default: the ticket's, or the only one there")->option_text("NAME|CODE|ID");
  command->add_option("--ticket", arguments->ticket, "what `tandem-server ticket --role operator` printed, or a file with it; not needed beside a server on loopback that made its keys itself")
      ->option_text("TICKET|FILE");
  command->add_option("--role", arguments->role, "without a ticket: operator, instructor or recorder; default: operator, for `authority` instructor")->option_text("ROLE");
  command->add_option("--state", arguments->state, "folder of this workstation's key; default: $TANDEM_CLIENT_STATE, else ~/.config/tandem")->option_text("DIR");
  command->add_option("--patience", arguments->patience, "how long to wait for a server that does not answer [s]; default 5")->option_text("S");
  command->add_flag("--json", arguments->json, "status for machines");
  command->add_option("ORDER", arguments->words, "one of those below; none: a console that takes one order per line and stays connected")->option_text("...");
  command->footer(std::string("Orders\n") + control_words_help() +
                  "\nA ticket is good for one connection: for several orders use the console (a pipe will do). A stop is latched and numbered; who\n"
                  "resumes names the newest, so that an old order never undoes a newer stop.\n"
                  "Exit: 0 done; 1 refused, with the reason, or server not there; 2 wrong arguments. In the console: the greatest of its orders.\n\n"
                  "Examples\n"
                  "  tandem-client control --server 127.0.0.1:7000 stop somebody is in the way\n"
                  "  tandem-client control --server lab-server:7000 --ticket operator.ticket");
  command->callback([arguments, &action] { action = [arguments] { return control_command(*arguments); }; });
}

}  // namespace tandem::client
