#include "server/console/app/play_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/io/exit_code.h"
#include "common/io/print.h"
#include "common/io/signals.h"
#include "server/archive/io/part_files.h"
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

/// Adds the other files of long recordings, which lie beside the named ones. Of an incomplete recording the page shows
/// the named files, and what is missing.
std::vector<std::string> all_files(const std::vector<std::string>& named) {
  std::vector<std::string> files;
  const auto add = [&files](const std::string& file) {
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  };
  for (const std::string& file : named) {
    const auto found = server::find_recordings({file});
    if (!found) {
      add(file);
      continue;
    }
    for (const server::RecordedPart& part : found->front())
      add(std::filesystem::path(part.file).lexically_normal().string());
  }
  return files;
}

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
  const WebOptions web{
      .listen = page.listen,
      .tls = std::move(page.tls),
      .signals = signals.get(),
      .gateway = {.join = {}, .local = false, .release = TANDEM_VERSION, .files = all_files(arguments.files)}};
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
      "A long session has several files, NAME.mcap, NAME-2.mcap and so on, which the page plays as one recording: name "
      "one "
      "of them.\n\n"
      "Exit: 0 ended by a signal; 1 port in use; 2 wrong arguments, or a file that is no recording.\n\n"
      "Examples\n"
      "  tandem-console play lesson.mcap\n"
      "  tandem-console play expert.mcap learner.mcap --listen 127.0.0.1:0");
}

}  // namespace tandem::console
