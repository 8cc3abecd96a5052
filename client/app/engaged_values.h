#pragma once

#include <cstdint>
#include <optional>

namespace tandem::client {

/// Values of a seat while it is engaged, for its report: at the end of a session the seat is released, and has neither
/// authority nor a leader.
class EngagedValues {
 public:
  /// Takes one sample of an engaged seat. @param alpha  own authority [0, 1]
  /// @param beside_leader_m  distance between the leader's tip and the own tip [m]; nullopt: no other hand leads
  void add(double alpha, std::optional<double> beside_leader_m) noexcept {
    alpha_.add(alpha);
    if (beside_leader_m) beside_.add(*beside_leader_m);
  }
  /// Last values and means; nullopt: there was no sample. The distance counts while another hand leads.
  [[nodiscard]] std::optional<double> alpha() const noexcept { return alpha_.last; }
  [[nodiscard]] std::optional<double> alpha_mean() const noexcept { return alpha_.mean(); }
  [[nodiscard]] std::optional<double> beside_leader_m() const noexcept { return beside_.last; }
  [[nodiscard]] std::optional<double> beside_leader_mean_m() const noexcept { return beside_.mean(); }

 private:
  struct Series {
    void add(double value) noexcept {
      last = value;
      sum += value;
      ++count;
    }
    [[nodiscard]] std::optional<double> mean() const noexcept {
      return count == 0 ? std::nullopt : std::optional{sum / static_cast<double>(count)};
    }
    std::optional<double> last{};
    double sum = 0;
    std::uint64_t count = 0;
  };
  Series alpha_, beside_;
};

}  // namespace tandem::client
