#pragma once

#include "common/control/plane_estimator.h"
#include "server/contact_source.h"

namespace tandem::server {

/// The plane that a SLAVE seat's device touches, estimated from what it reports. Where it touches nothing there is none, and nothing is felt;
/// while it touches what is not known yet, hands feel the spring to the device.
class EstimatedPlane final : public ContactSource {
 public:
  static constexpr double kTrustRate = 5;  ///< of `trust` [1/s]
  static constexpr double kDamping = 5;    ///< of the plane [N s/m]

  /// @param axes  of the port, 1 to 3
  explicit EstimatedPlane(std::size_t axes) noexcept : estimator_(axes) {}
  void look(const ToolView& tool, LocalContactList& out) noexcept override;
  [[nodiscard]] double trust() const noexcept override { return trust_; }
  [[nodiscard]] const control::PlaneEstimator& estimator() const noexcept { return estimator_; }

 private:
  control::PlaneEstimator estimator_;
  double waited_ = 0;  ///< since the newest sample [s]
  double trust_ = 1;
};

}  // namespace tandem::server
