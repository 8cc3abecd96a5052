#pragma once

#include <expected>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/io/child_program.h"
#include "proto/spec/scene_spec.h"

namespace tandem::client {

/// Returns the seat of the person who tries a scene: the wanted one, else an instructor's, else the first with
/// authority. @return error: the scene has no MASTER seat of the wanted name
[[nodiscard]] std::expected<const SeatSpec*, std::string> seat_for_person(const SceneSpec& scene,
                                                                          const std::string& wanted);

/// Returns the other seats without which the session does not run: those of the simulated partners.
[[nodiscard]] std::vector<std::string> partners_of(const SceneSpec& scene, const SeatSpec& own);

/// Server and simulated partners of a trial on this computer, as child processes on loopback. The destructor ends them.
class TrialPrograms {
 public:
  /// @param scene      name or file, as tandem-server reads it
  /// @param partners   seats with a simulated hand
  /// @param duration   of the session [s]; nullopt: the scene's own
  /// @param interrupt  file that ends the start when it becomes readable
  /// @return error: the reason; empty: interrupted
  [[nodiscard]] static std::expected<TrialPrograms, std::string> start(const std::string& scene,
                                                                       const std::vector<std::string>& partners,
                                                                       std::optional<double> duration, int interrupt);
  /// @param programs  the server first, then the partners
  explicit TrialPrograms(std::vector<io::ChildProgram> programs, std::string address = {})
      : children_(std::move(programs)), address_(std::move(address)) {}
  TrialPrograms(TrialPrograms&&) noexcept = default;
  TrialPrograms& operator=(TrialPrograms&&) = delete;
  ~TrialPrograms() { stop(); }

  /// Address of the server, HOST:PORT.
  [[nodiscard]] const std::string& address() const noexcept { return address_; }
  /// Returns which program failed, with its last output; empty: none.
  [[nodiscard]] std::string failure();
  /// Ends the partners before the server, so that each can leave its seat cleanly.
  void stop() noexcept {
    while (!children_.empty()) children_.pop_back();
  }

 private:
  std::vector<io::ChildProgram> children_;  ///< the server, then the partners
  std::string address_;
};

}  // namespace tandem::client
