#pragma once

#include <optional>
#include <string>

#include "netsim/demo/app/child_process.h"
#include "netsim/demo/app/live_run.h"

namespace tandem::netsim::demo {

/// tandem-console beside the runs of a live demo, so that they can be watched in a browser. It is built after the first
/// run has begun, with the lowest priority, so that the report comes no later. Trouble with it ends no run.
class ConsoleBeside {
 public:
  /// @param build  folder of the build in which ninja makes tandem-console; empty: it is not built, only started
  ConsoleBeside(DemoPaths places, std::string build) : places_(std::move(places)), build_(std::move(build)) {}
  ConsoleBeside(const ConsoleBeside&) = delete;
  ConsoleBeside& operator=(const ConsoleBeside&) = delete;
  ~ConsoleBeside();

  /// A server listens at this address; those of later runs are expected at the same.
  void on_server(const std::string& address);
  /// Continues with the build and the start. Call it often. @return a line for the user, once there is one
  [[nodiscard]] std::optional<std::string> poll();
  /// Files that it writes, relative to the output folder.
  static constexpr const char* kBuildLog = "console-build.log";
  static constexpr const char* kLog = "console.log";

 private:
  std::optional<std::string> give_up(const std::string& what, const char* log);
  std::optional<std::string> start();

  DemoPaths places_;
  std::string build_, server_;
  std::optional<ChildProcess> builder_, console_;
  bool over_ = false;  ///< the line was given, or there is none
};

/// Returns the URL in the output of tandem-console; empty if there is no complete line with one yet.
[[nodiscard]] std::string console_url(const std::string& output);

}  // namespace tandem::netsim::demo
