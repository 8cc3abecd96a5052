#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Checks the authority over all tools: roles, its slew limit, and the force step that a change may cause. A stopped
/// session brakes its tools, and a seat that stopped its hand or is quarantined gains no authority.
class AuthorityChecker {
 public:
  explicit AuthorityChecker(const SceneSpec& scene);

  /// @param lived  ticks that the session ran since the last call
  /// @param scale  tip gain to port gain, per axis of the port
  void check(std::uint32_t lived, const server::Session& session, const AxisArray& scale,
             server::Violations& violations);

 private:
  struct Tool {
    std::array<double, kMastersMax> alpha{};  ///< authority after the previous tick
    bool braked = true;
  };
  void check_seats(std::size_t tool, std::uint32_t lived, const server::Session& session,
                   server::Violations& violations) const;
  [[nodiscard]] bool pulls_elsewhere(std::size_t seat, std::size_t tool, const server::Session& session) const noexcept;
  [[nodiscard]] double felt_share(const server::Session& session) const noexcept;
  [[nodiscard]] AxisArray force_step(std::size_t tool, const server::Session& session) const noexcept;

  const SceneSpec* scene_;
  std::vector<Tool> tools_;
  std::array<double, kMastersMax> stopped_s_{};  ///< since the seat's client first reported a local stop [s]
};

}  // namespace tandem::netsim
