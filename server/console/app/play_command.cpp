#include "server/console/app/play_command.h"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "server/archive/io/recording_file.h"
#include "server/console/app/page_address.h"
#include "server/console/app/web_server.h"

namespace tandem::console {
namespace {

constexpr std::size_t kPlayedMax = 100;

struct PlayArguments {
  std::vector<std::string> files;
  PageAddressArguments page;
};

int run_play(const PlayArguments& arguments) {
  io::UsageErrors errors;
  PageAddress page = page_address_of(arguments.page, errors);
  if (arguments.files.size() > kPlayedMax)
    errors.add("FILE: " + std::to_string(arguments.files.size()) +
               " recordings; at most 100 are allowed. Show a folder with: tandem-console --recordings DIR");
  for (const std::string& file : arguments.files)
    if (const auto recording = server::RecordingFile::open(file); !recording)
      errors.add(file + ": " + recording.error() +
                 "; give a recording of tandem-server, tandem-client or "
                 "tandem-netsim");
  if (!errors.empty()) return errors.print("tandem-console: ");
  const io::Fd signals = io::make_signalfd();
  const WebOptions web{.listen = page.listen,
                       .tls = std::move(page.tls),
                       .signals = signals.get(),
                       .gateway = {.join = {}, .local = false, .release = TANDEM_VERSION, .files = arguments.files}};
  const auto served = run_web_server(web, {}, print_page_url);
  if (served) return io::kExitDone;
  io::print(stderr, "tandem-console: " + served.error() + "\n");
  return io::kExitTrouble;
}

}  // namespace

void add_play_command(const io::Command& root) {
  auto [command, arguments] =
      root.add_command<PlayArguments>("play", "plays recordings in a browser, without any server", run_play);
  command.add_option("FILE", arguments.files, "recordings (MCAP); the page compares two of them").required();
  add_page_address_options(command, arguments.page);
  command.footer(
      "Exit: 0 ended by a signal; 1 port in use; 2 wrong arguments, or a file that is no recording.\n\n"
      "Examples\n"
      "  tandem-console play lesson.mcap\n"
      "  tandem-console play expert.mcap learner.mcap --listen 127.0.0.1:0");
}

}  // namespace tandem::console
