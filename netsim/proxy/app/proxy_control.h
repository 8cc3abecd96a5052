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
#include "netsim/models/path_spec.h"
#include "netsim/proxy/app/control_request.h"
#include "netsim/proxy/app/proxy.h"
#include "netsim/proxy/app/proxy_request.h"

namespace tandem::netsim {

/// Executes operator commands that change the network of a running proxy. It builds paths on an ordinary thread. The
/// packet thread swaps them between two datagrams, for all affected clients at once.
class ProxyControl {
 public:
  /// Network named by a command.
  struct Network {
    LinkSpec link;
    std::vector<std::string> notes = {};  ///< notes that answer and report must contain
  };
  using FindNetwork = std::function<std::expected<Network, std::string>(const std::string& name)>;

  /// @param proxy  must outlive this object; one thread uses this object
  ProxyControl(Proxy& proxy, const LinkSpec& start, FindNetwork find);

  /// Result of a command.
  struct Answer {
    bool understood = true;  ///< false: invalid command
    bool done = true;        ///< false: the command could not be executed
    bool stop = false;       ///< true: the proxy must end
    std::string text;        ///< complete lines
  };
  Answer execute(const std::string& line);

  /// Change of the network, for the report.
  struct Change {
    Duration at{};
    std::string command;
    std::vector<std::string> notes;  ///< notes about the named network
  };
  [[nodiscard]] std::span<const Change> changes() const noexcept { return changes_; }

 private:
  struct Outage {
    OutageSpec spec;
    std::optional<Direction> direction;
    std::vector<std::uint64_t> clients;  ///< empty: all
  };
  /// Links as commands have set them.
  struct Links {
    LinkSpec common;                             ///< link of clients without an own link
    std::map<std::uint64_t, LinkSpec> own = {};  ///< by number from 1
    std::vector<Outage> outages = {};            ///< requested by commands and not over yet
  };
  Answer change(const ControlRequest& request, const std::string& line);
  Answer rebind(const ControlRequest& request, const std::string& line);
  /// Posts a request. Returns an error, or empty if it was executed.
  std::string post(ProxyRequest& request);
  [[nodiscard]] bool has_own(std::uint64_t number) const;
  [[nodiscard]] LinkSpec link_of(std::uint64_t number) const;
  [[nodiscard]] LinkSpec with_outages(LinkSpec link, std::uint64_t number) const;
  void record_change(Duration at, const std::string& line, std::vector<std::string> notes = {});

  Proxy& proxy_;
  const LinkSpec start_;
  FindNetwork find_network_;
  Links links_;
  std::list<ProxyRequest> requests_;  ///< unfinished requests must keep their addresses
  std::vector<Change> changes_;
};

}  // namespace tandem::netsim
