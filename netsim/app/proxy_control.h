#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <list>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "netsim/app/control_words.h"
#include "netsim/app/proxy.h"
#include "netsim/app/proxy_order.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// Changes the network of a running proxy as people ask for it. Paths are built here, on an ordinary thread; the packet
/// thread swaps them between two datagrams, for all clients meant at one moment.
class ProxyControl {
 public:
  /// A network that a command names.
  struct Network {
    LinkSpec link;
    std::vector<std::string> notes = {};  ///< what answer and report must say about it
  };
  using Find = std::function<std::expected<Network, std::string>(const std::string& name)>;

  /// `proxy` must live longer; one thread uses this.
  ProxyControl(Proxy& proxy, const LinkSpec& start, Find find);

  struct Answer {
    bool understood = true;  ///< false: the command is wrong
    bool done = true;        ///< false: it could not be carried out
    bool stop = false;       ///< the proxy shall end
    std::string text;        ///< whole lines
  };
  Answer carry_out(const std::string& line);

  /// What was changed, for the report.
  struct Note {
    Duration at{};
    std::string words;
    std::vector<std::string> notes;  ///< of the network named
  };
  [[nodiscard]] std::span<const Note> notes() const noexcept { return notes_; }

 private:
  struct Outage {
    OutageSpec spec;
    std::optional<Direction> direction;
    std::vector<std::uint64_t> clients;  ///< empty: all
  };
  Answer change(const ControlRequest& request, const std::string& line);
  Answer rebind(const ControlRequest& request, const std::string& line);
  /// @return empty: carried out; else why not
  std::string post(ProxyOrder& order);
  [[nodiscard]] bool has_own(std::uint64_t number) const;
  [[nodiscard]] LinkSpec link_of(std::uint64_t number) const;
  [[nodiscard]] LinkSpec with_outages(LinkSpec link, std::uint64_t number) const;
  void note(Duration at, const std::string& line, std::vector<std::string> notes = {});

  Proxy& proxy_;
  const LinkSpec start_;
  Find find_;
  LinkSpec all_;                           ///< of those that have none of their own
  std::map<std::uint64_t, LinkSpec> own_;  ///< by number from 1
  std::vector<Outage> outages_;            ///< asked for live and not over
  std::list<ProxyOrder> orders_;           ///< those not carried out yet must stay
  std::vector<Note> notes_;
};

}  // namespace tandem::netsim
