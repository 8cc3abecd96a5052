#pragma once

#include "common/base/axes.h"
#include "common/base/local_contact.h"

namespace tandem::server {

/// What a source of contacts may look at in one tick. Frame: the tip's, SI units.
struct ToolView {
  double dt = 0.001;           ///< tick [s]
  double time = 0;             ///< session clock [s]
  std::size_t axes = 3;        ///< of the port, 1 to 3
  AxisArray x{}, v{};          ///< of the tool at the end of the last tick [m, m/s]

  bool slave = false;          ///< a SLAVE seat serves the tool, and its device is engaged
  bool fresh = false;          ///< it was heard since the last tick
  AxisArray slave_x{}, slave_v{};  ///< as it said last [m, m/s]
  AxisArray slave_f{};         ///< of what it touches, on it, as its spring and damper tell: exact while it stands still [N]
};

/// Surfaces near one tool that are not the scene's own, under law `replica`: from a physics engine, a camera, a measurement. The session asks
/// once per tick and gives the same surfaces to its own tool and, with FORCE, to every MASTER seat that follows the tool.
///
/// To plug one in: derive from this class and give it to `Session::set_contact_source` before the first tick. A surface keeps its `id` while it is
/// the same surface; it may move, turn and stiffen from tick to tick. At both ends it then moves at most at `channel.v_app_m_s` where
/// it presses (`control::LocalContacts`), and only as far as a hand's ledger pays. One that is not named any more stays for 100 ms.
class ContactSource {
 public:
  virtual ~ContactSource() = default;
  /// @param out  empty; takes the surfaces that matter now. The session leaves out what is no surface or not in range, and counts it.
  virtual void look(const ToolView& tool, LocalContactList& out) noexcept TANDEM_REALTIME = 0;
  /// How far what it names is all that a SLAVE seat's device meets [0, 1]. The rest is felt by a spring to the device, over the network. At a
  /// step of it the tool's force steps: it is to move by a few per second.
  [[nodiscard]] virtual double trust() const noexcept TANDEM_REALTIME { return 1; }
};

}  // namespace tandem::server
