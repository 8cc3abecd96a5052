#pragma once

#include "netsim/app/control_socket.h"
#include "netsim/app/proxy.h"
#include "netsim/app/proxy_control.h"

namespace tandem::netsim {

/// Stays with a running proxy: shows the live view, on a terminal in place and else one plain line every five seconds,
/// and carries out what is typed or comes through the control socket.
/// Returns when a signal came, the proxy has ended, or somebody asked it to.
/// @param signals   readable when a signal came
/// @param finished  readable when the proxy has ended
void watch_proxy(Proxy& proxy, ProxyControl& control, ControlSocket& socket, int signals, int finished);

/// How an answer travels through the control socket: its first character says how it went.
[[nodiscard]] std::string wire_text(const ProxyControl::Answer& answer);

}  // namespace tandem::netsim
