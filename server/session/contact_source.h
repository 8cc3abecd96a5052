#pragma once

#include "common/base/axes.h"
#include "common/base/local_contact.h"

namespace tandem::server {

/// Input of a contact source in one tick: time, tool and slave. Tip frame, SI units.
struct ToolView {
  double dt = 0.001;     ///< tick [s]
  double time = 0;       ///< session clock [s]
  std::size_t axes = 3;  ///< number of port axes, 1 to 3
  AxisArray x{}, v{};    ///< position and velocity of the tool at the end of the last tick [m, m/s]

  bool slave = false;              ///< a SLAVE seat serves the tool and its device is engaged
  bool fresh = false;              ///< a STATE arrived since the last tick
  AxisArray slave_x{}, slave_v{};  ///< as of the newest STATE [m, m/s]
  AxisArray slave_f{};  ///< contact force on the device, derived from its spring and damper: exact at rest [N]
};

/// Source of surfaces near one tool that are not the scene's own, under law `replica`. Examples: a physics engine, a
/// camera, a measurement. The session calls it once per tick. It applies the surfaces to its own tool and sends them
/// in FORCE to every MASTER seat that follows the tool.
///
/// To add one, derive from this class and pass it to `Session::set_contact_source` before the first tick. A surface
/// keeps its `id` while it is the same surface; it may move, turn and stiffen from tick to tick. At both ends a
/// surface that presses moves at most at `channel.v_app_m_s` (`control::LocalContacts`), and only as far as the hand's
/// ledger pays for it. A surface that is not returned any more is kept for 100 ms.
class ContactSource {
 public:
  virtual ~ContactSource() = default;
  /// @param out  empty on entry; receives the relevant surfaces. The session drops and counts invalid surfaces and
  /// those out of range.
  virtual void find_contacts(const ToolView& tool, LocalContactList& out) noexcept TANDEM_REALTIME = 0;
  /// How completely the returned surfaces describe what a SLAVE seat's device touches, in [0, 1]. Hands feel the
  /// remainder by a spring to the device, over the network. A step of the confidence makes a step of the tool's force,
  /// so change it by a few per second at most.
  [[nodiscard]] virtual double confidence() const noexcept TANDEM_REALTIME { return 1; }
};

}  // namespace tandem::server
