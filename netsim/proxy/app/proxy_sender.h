#pragma once

#include <cstdint>

#include "common/base/histogram.h"
#include "common/io/datagram_batch.h"
#include "netsim/proxy/app/live_delay_histogram.h"
#include "netsim/proxy/app/proxy_clients.h"
#include "netsim/proxy/app/proxy_clock.h"
#include "netsim/proxy/app/proxy_status.h"
#include "netsim/proxy/app/send_queue.h"
#include "netsim/proxy/proxy_core.h"

namespace tandem::netsim {

/// Sends the due datagrams of a proxy, one system call per socket. Measures the lateness of each datagram against the
/// schedule, and the delay since its arrival. Allocates nothing.
class ProxySender {
 public:
  /// All references must outlive the sender.
  /// @param late_limit  a datagram sent later than this after its due time counts as late
  ProxySender(ProxyCore& core, ProxyClients& clients, const ProxyClock& clock, ClientDelays& delays,
              ProxyErrors& errors, Duration late_limit)
      : core_(core), clients_(clients), clock_(clock), delays_(delays), errors_(errors), late_limit_(late_limit) {}

  [[nodiscard]] bool full() const noexcept { return queue_.full(); }
  /// Adds a due datagram. A change of its client's address takes effect here. Requires !full().
  void add(const ProxyCore::Egress& egress) noexcept;
  /// Sends all datagrams added.
  void flush() noexcept;

  [[nodiscard]] Duration last_sent() const noexcept { return last_sent_; }
  [[nodiscard]] std::uint64_t released() const noexcept { return released_; }  ///< datagrams handed to the kernel
  [[nodiscard]] std::uint64_t late() const noexcept { return late_; }          ///< of these, those above `late_limit`
  /// Returns the lateness of all datagrams [ns]. Only for the sending thread, or after it ended.
  [[nodiscard]] const Histogram& lateness() const noexcept { return lateness_; }
  /// Returns the same for any thread, with less resolution.
  [[nodiscard]] const LiveDelayHistogram& live_lateness() const noexcept { return live_lateness_; }

 private:
  [[nodiscard]] ProxySource socket_of(const ProxyCore::Egress& egress) noexcept;

  ProxyCore& core_;
  ProxyClients& clients_;
  const ProxyClock& clock_;
  ClientDelays& delays_;
  ProxyErrors& errors_;
  Duration late_limit_;
  SendQueue queue_;
  io::SendBatch out_;
  Histogram lateness_;
  LiveDelayHistogram live_lateness_;
  std::uint64_t released_ = 0, late_ = 0;
  Duration last_sent_{};
};

}  // namespace tandem::netsim
