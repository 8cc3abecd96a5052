#pragma once

#include <array>
#include <cstddef>

#include "common/base/axes.h"
#include "common/control/contact.h"
#include "common/control/numerics.h"
#include "common/control/pull.h"

namespace tandem::control {

/// A tool without a device: a mass that touches its surfaces itself. The server steps one per tool and every client
/// steps a copy of it, with this same code. The step is implicit: springs, dampers, surfaces and their friction act at
/// its end. No step therefore creates energy, for any gains [Stramigioli, LNCIS 266, 2001]. Several surfaces are solved
/// together. Other `Numerics` are possible (virtual_tool_numerics.cpp).
class VirtualTool {
 public:
  static constexpr std::size_t kAxes = 3;

  /// Inertia and damping of the tool.
  struct Gains {
    double m = 0.02;  ///< [kg], above 0
    double b = 0.2;   ///< towards the ground [N s/m]
  };
  /// Springs and dampers on the tool, per axis.
  using Pulls = std::array<Pull, kAxes>;

  /// Account of a tick that was taken in several parts or by another integrator.
  struct Parts {
    bool finite = false;                  ///< false: the tool stayed where it was, at rest
    std::array<double, kAxes> squares{};  ///< sum of v^2 h over the parts, per axis [m^2/s]
  };

  /// @param axes  1 to 3; the other axes stay at 0
  /// @param numerics  surfaces with friction need an implicit Euler step in double
  VirtualTool(const Gains& gains, std::size_t axes, const ContactSet& contacts = {},
              const Numerics& numerics = {}) noexcept
      : gains_(gains),
        axes_(axes),
        own_contacts_(static_cast<std::uint8_t>(contacts.size())),
        in_parts_(!numerics.is_default()),
        numerics_(numerics),
        contacts_(contacts) {}

  /// Replaces the surfaces received from the server; those of the constructor stay. Surfaces beyond the capacity are
  /// omitted.
  void set_received_contacts(const ContactSet& received) noexcept TANDEM_REALTIME;

  /// Places the tool at `x` [m], at rest.
  void rest_at(const AxisArray& x) noexcept;
  /// Advances by one step of length `dt` [s]. If the result is not finite, the tool stays where it was, at rest.
  /// @return whether the result was finite.
  bool step(double dt, const Pulls& pulls) noexcept TANDEM_REALTIME {
    return in_parts_ ? step_in_parts(dt, pulls).finite : implicit_step(dt, pulls);
  }
  /// Advances likewise by the numerics of this tool. @return what an energy account needs
  Parts step_in_parts(double dt, const Pulls& pulls) noexcept TANDEM_REALTIME;
  /// Returns the heat of one axis in these parts that an account may spend [J]. It is zero for numerics without a proof
  /// of passivity. @param b, k  of the dampers, and of the springs whose implicit step also dissipates
  [[nodiscard]] double heat(const Parts& parts, std::size_t axis, double b, double k, double dt) const noexcept;
  /// Whether accounts need `step_in_parts` and `heat`.
  [[nodiscard]] bool in_parts() const noexcept { return in_parts_; }
  [[nodiscard]] const Numerics& numerics() const noexcept { return numerics_; }

  /// Position [m].
  [[nodiscard]] double x(std::size_t axis) const noexcept { return x_[axis]; }
  /// Velocity [m/s].
  [[nodiscard]] double v(std::size_t axis) const noexcept { return v_[axis]; }
  [[nodiscard]] const Gains& gains() const noexcept { return gains_; }
  [[nodiscard]] std::size_t axes() const noexcept { return axes_; }
  /// Force of all surfaces on the tool at the end of the last step [N].
  [[nodiscard]] const std::array<double, kAxes>& surface_force() const noexcept { return surface_force_; }
  /// Limits damping relative to the motion that drives the tool. Such damping has no reaction on the hand, so at a
  /// stiff surface it would create energy.
  /// @param b_rel   wanted, above 0 [N s/m]  @param b_others  other damping along this axis [N s/m]
  /// @param k_c     of the spring that the hand feels  @param k_others  of other springs [N/m]
  /// @return share of b_rel that may act (0, 1]
  [[nodiscard]] double relative_damping_share(std::size_t axis, double b_rel, double b_others, double k_c,
                                              double k_others) const noexcept {
    if (!(surface_k_[axis] > 0)) return 1;
    const double most = (gains_.b + surface_b_[axis] + b_others) * k_c / (surface_k_[axis] + k_others);
    return most < b_rel ? most / b_rel : 1;
  }
  /// Deepest penetration [m]; 0 without contact.
  [[nodiscard]] double penetration() const noexcept;
  /// Energy stored in all surfaces [J].
  [[nodiscard]] double surface_energy() const noexcept;

 private:
  /// Advances by one implicit step, the default.
  bool implicit_step(double dt, const Pulls& pulls) noexcept;
  /// Advances by one step of the integrator in numbers of type S.
  template <class S>
  bool linear_step(double dt, const Pulls& pulls) noexcept;
  /// Equation of one axis without surfaces: inertia times the velocity at the end of the step equals momentum.
  struct FreeAxis {
    double inertia, momentum;
  };
  [[nodiscard]] FreeAxis free_axis(std::size_t axis, double dt, const Pull& pull) const noexcept {
    return {gains_.m + dt * (gains_.b + pull.b) + dt * dt * pull.k,
            gains_.m * v_[axis] + dt * (pull.k_anchor - pull.k * x_[axis] + pull.b_velocity)};
  }
  void feel_surfaces() noexcept;
  /// The equations of one step: matrix v' = rhs.
  struct Equations {
    std::array<std::array<double, kAxes>, kAxes> matrix{};
    std::array<double, kAxes> rhs{};
  };
  struct Met {
    /// State of one surface within a step.
    bool met = false;
    double force = 0, gain = 0;  ///< the surface's force is force - gain * (normal . velocity)
    double drag = 0;             ///< friction as damping across the surface [N s/m]
  };
  using Surfaces = std::array<Met, ContactSet::kMax>;
  /// Finds the touched surfaces and the velocity at the end of the step.
  void meet_surfaces(double dt, const Equations& free, std::array<double, kAxes>& velocity) noexcept;
  /// Returns the velocity at the end of the step with the touched surfaces.
  [[nodiscard]] std::array<double, kAxes> with_surfaces(double dt, Equations equations,
                                                        const Surfaces& surfaces) const noexcept;
  void apply_friction(double dt, const Equations& free, Surfaces& surfaces,
                      std::array<double, kAxes>& velocity) const noexcept;
  [[nodiscard]] std::array<double, kAxes> across(const Contact& contact,
                                                 const std::array<double, kAxes>& vector) const noexcept;

  Gains gains_;
  std::size_t axes_;
  std::uint8_t own_contacts_;  ///< number of leading entries of `contacts_` that come from the constructor
  bool in_parts_;
  Numerics numerics_;
  ContactSet contacts_;
  std::array<double, kAxes> x_{}, v_{};
  std::array<double, kAxes> surface_force_{}, surface_k_{}, surface_b_{};
};

}  // namespace tandem::control
