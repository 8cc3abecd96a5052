#pragma once

namespace tandem::netsim {

/// Energy that a motor gives a hand since the last fresh datagram. Its bound is the tank of the force gate. The gate
/// acts only when its program wakes up, so it cannot limit two kinds of steps between wake-ups:
///   - a step that began with a fresh datagram: the gate then passes an effort without asking its tank;
///   - a step longer than the recent ones: the gate predicts the energy of an effort over the longest of these.
/// After such a step the gate may give no more than was given by then, until the next fresh datagram.
class SilenceEnergy {
 public:
  struct Bound {
    double tank = 0;      ///< of the gate, with the energy that its encoders cannot see [J]
    double step_max = 0;  ///< the device drops an effort that is not renewed within this time [s]
  };

  /// Adds work of the motor, positive into the hand [J].
  void add(double work) noexcept { given_ += work; }
  /// Judges the energy given up to a wake-up of the program. @param step  time since the previous wake-up [s]
  /// @return whether the gate kept the bound
  [[nodiscard]] bool wake_up(double step, const Bound& bound) noexcept;
  /// A fresh datagram at this wake-up permits the whole tank again. Work after the wake-up counts from zero.
  void restart() noexcept;

 private:
  double given_ = 0;        ///< since the restart [J]
  double unlimited_ = 0;    ///< given at the end of the last step that the gate could not limit [J]
  double longest_ = 0;      ///< recent step [s]
  bool restarted_ = false;  ///< at the previous wake-up
};

}  // namespace tandem::netsim
