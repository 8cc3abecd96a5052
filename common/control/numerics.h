#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tandem::control {

/// Methods that advance a simulated tool by one step of length h (common/control/integrator.h has the equations).
enum class Integrator : std::uint8_t {
  kImplicitEuler,      ///< order 1, dissipates; default
  kImplicitMidpoint,   ///< order 2, conserves the energy of linear springs
  kSemiImplicitEuler,  ///< order 1, symplectic: its energy error is bounded; stable for small h only
  kRk4,                ///< order 4, explicit; stable for small h only
  kExact,              ///< exact for forces that are linear within the step: the zero-order hold
};
/// Numbers in which a step computes.
enum class Precision : std::uint8_t { kDouble, kFloat };

/// Number of integrators.
inline constexpr std::size_t kIntegrators = 5;
/// Names of the integrators in tables, in their order.
inline constexpr std::array<std::string_view, kIntegrators> kIntegratorNames{"implicit_euler", "implicit_midpoint",
                                                                             "semi_implicit_euler", "rk4", "exact"};
/// Names of the precisions in tables, in their order.
inline constexpr std::array<std::string_view, 2> kPrecisionNames{"double", "float"};

/// How a simulated tool is stepped. The server's tool and each client's copy have the same values.
struct Numerics {
  Integrator integrator = Integrator::kImplicitEuler;
  Precision precision = Precision::kDouble;
  std::uint8_t substeps = 1;  ///< steps per tick, 1 to kSubstepsMax

  /// Whether no step creates energy for any gains and surfaces. Other choices take the surfaces as linear from the
  /// start of a step, and meet them one step late.
  [[nodiscard]] constexpr bool keeps_proof() const noexcept {
    return integrator == Integrator::kImplicitEuler && precision == Precision::kDouble;
  }
  /// Whether one implicit step per tick is taken, the default.
  [[nodiscard]] constexpr bool is_default() const noexcept { return keeps_proof() && substeps == 1; }
};
/// Largest number of steps per tick.
inline constexpr std::uint8_t kSubstepsMax = 64;

}  // namespace tandem::control
