#pragma once

#include <optional>
#include <string>

#include "netsim/demo/app/child_process.h"
#include "netsim/demo/app/live_run.h"

namespace tandem::netsim::demo {

/// tandem-console beside the runs of a live demo, so that they can be watched in a browser. Trouble with it ends no
/// run.
class ConsoleBeside {
 public:
  explicit ConsoleBeside(DemoPaths places) : places_(std::move(places)) {}
  ConsoleBeside(const ConsoleBeside&) = delete;
  ConsoleBeside& operator=(const ConsoleBeside&) = delete;
  ~ConsoleBeside();

  /// A server listens at this address; those of later runs are expected at the same.
  void on_server(const std::string& address);
  /// Continues with the start. Call it often. @return a line for the user, once there is one
  [[nodiscard]] std::optional<std::string> poll();
  static constexpr const char* kLog = "console.log";  ///< file that it writes, relative to the output folder

 private:
  std::optional<std::string> give_up(const std::string& what);
  std::optional<std::string> start();

  DemoPaths places_;
  std::string server_;
  std::optional<ChildProcess> console_;
  bool over_ = false;  ///< the line was given, or there is none
};

/// Returns the URL in the output of tandem-console; empty if there is no complete line with one yet.
[[nodiscard]] std::string console_url(const std::string& output);

}  // namespace tandem::netsim::demo
